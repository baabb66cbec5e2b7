#include "calibration/model.h"

#include <algorithm>
#include <cmath>

namespace fusee {

namespace {

/// What a row says of the place of a joint with so much play, by what it says of a taut one.
double weight_of(double loose, double floor) {
  constexpr double uncertain = 1.0 / 3.0;  // of the play: how far from where it was last pushed a loose joint may rest
  return floor / std::hypot(floor, uncertain * loose);
}

}  // namespace

Said Model::said(const Imperfections& at) const {
  Said words{evidence_.theta - flat(forward_(at)), flat(forward_.looseness(at))};
  for (Eigen::Index i = 0; i < words.residual.size(); ++i) {
    if (words.loose[i] > 0) words.residual[i] *= weight_of(words.loose[i], evidence_.floor);
  }
  return words;
}

Eigen::VectorXd Model::slope(const Imperfections& at, const EffectParameter& parameter,
                             const Eigen::VectorXd& residual) const {
  Imperfections moved = at;
  const double value = value_of(at, parameter);
  const double step = value + parameter.step <= parameter.most ? 1.0 : -1.0;
  set_value(moved, parameter, value + step * parameter.step);
  return (residual - said(moved).residual) / step;
}

double price_of_play(double loose, double floor) {
  const double weight = weight_of(loose, floor);
  return floor * floor * (1.0 - weight * weight);
}

double nats_of_play(double residual, double loose, double floor) {
  const double weight = weight_of(loose, floor);
  const double squares = residual * residual / (floor * floor);
  const double anywhere = squares - 2.0 * std::log(weight);
  return 0.5 * (std::min(anywhere, squares / (weight * weight)) - squares);
}

double rms_apart(const Evidence& evidence, const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const std::vector<Eigen::Index> rows = evidence.rows();
  double squares = 0;
  for (const Eigen::Index row : rows) squares += (one[row] - other[row]) * (one[row] - other[row]);
  return rows.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(rows.size()));
}

}  // namespace fusee
