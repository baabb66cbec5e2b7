#include "calibration/model.h"

#include <algorithm>
#include <cmath>

namespace fusee {

Said Model::said(const Imperfections& at) const {
  Said words{evidence_.theta - flat(forward_(at)), flat(forward_.looseness(at))};
  for (Eigen::Index i = 0; i < words.residual.size(); ++i) {
    const double beyond = std::max(0.0, std::abs(words.residual[i]) - words.loose[i]);
    if (words.loose[i] > 0) words.residual[i] = std::copysign(beyond, words.residual[i]);
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
  return 2.0 * floor * floor * std::log1p(2.0 * loose / (std::sqrt(k_two_pi) * floor));
}

double rms_apart(const Evidence& evidence, const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const std::vector<Eigen::Index> rows = evidence.rows();
  double squares = 0;
  for (const Eigen::Index row : rows) squares += (one[row] - other[row]) * (one[row] - other[row]);
  return rows.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(rows.size()));
}

}  // namespace fusee
