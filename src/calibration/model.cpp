#include "calibration/model.h"

#include <algorithm>
#include <cmath>

namespace fusee::calibration {
namespace {

/// Weight of a row in which the joint has the play `loose`, 1 if it is taut.
double weight_of(double loose, double floor) {
  // Standard deviation of the place at which a loose joint rests, as a share of its play.
  constexpr double uncertain = 1.0 / 3.0;
  return floor / elementary::hypot(floor, uncertain * loose);
}

}  // namespace

ModelResidual Model::evaluate(const Imperfections& at, LooseRow loose_row) const {
  const Eigen::VectorXd theta = flat(forward_(at));
  if (loose_row == LooseRow::pushed) return {evidence_.theta - theta, Eigen::VectorXd::Zero(theta.size())};
  ModelResidual evaluation{evidence_.theta - theta, flat(forward_.looseness(at))};
  for (Eigen::Index i = 0; i < evaluation.residual.size(); ++i) {
    if (evaluation.loose[i] > 0) evaluation.residual[i] *= weight_of(evaluation.loose[i], evidence_.floor);
  }
  return evaluation;
}

Eigen::VectorXd Model::slope(const Imperfections& at, const EffectParameter& parameter, const Eigen::VectorXd& residual,
                             LooseRow loose_row) const {
  Imperfections moved = at;
  const double value = value_of(at, parameter);
  const double step = value + parameter.step <= parameter.most ? 1.0 : -1.0;
  set_value(moved, parameter, value + step * parameter.step);
  return (residual - evaluate(moved, loose_row).residual) / step;
}

double play_correction(double loose, double floor) {
  const double weight = weight_of(loose, floor);
  return floor * floor * (1.0 - weight * weight);
}

LooseRows loose_rows(const Eigen::VectorXd& residual, const Eigen::VectorXd& loose, double floor) {
  constexpr int k_most_rounds = 40;
  const Eigen::Index rows = residual.size();
  LooseRows result{0, Eigen::VectorXd::Zero(rows)};
  Eigen::VectorXd pushed(rows), anywhere(rows), weight(rows);  // densities relative to the peak of the noise density
  double count = 0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    weight[i] = weight_of(loose[i], floor);
    const double squares = residual[i] * residual[i] / (floor * floor);
    pushed[i] = elementary::exp(-0.5 * squares / (weight[i] * weight[i]));
    anywhere[i] = weight[i] * elementary::exp(-0.5 * squares);
    if (loose[i] > 0) count += 1;
  }
  if (count == 0) return result;
  const auto pushed_probability = [&](Eigen::Index i, double share) {
    return (1.0 - share) * pushed[i] / ((1.0 - share) * pushed[i] + share * anywhere[i]);
  };
  double share = 0.5;  // share of rows that rest anywhere, by expectation maximisation
  for (int round = 0; round < k_most_rounds; ++round) {
    double sum = 0;
    for (Eigen::Index i = 0; i < rows; ++i) {
      if (loose[i] > 0) sum += 1.0 - pushed_probability(i, share);
    }
    share = std::clamp(sum / count, 1e-9, 1.0 - 1e-9);
  }
  result.nats = 0.5 * elementary::log(count);  // the share is one fitted number
  for (Eigen::Index i = 0; i < rows; ++i) {
    if (!(loose[i] > 0)) continue;
    const double squares = residual[i] * residual[i] / (floor * floor);
    result.nats -= elementary::log((1.0 - share) * pushed[i] + share * anywhere[i]) + 0.5 * squares;
    result.extra_information[i] = pushed_probability(i, share) * (1.0 / (weight[i] * weight[i]) - 1.0);
  }
  return result;
}

double rms_apart(const Evidence& evidence, const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const std::vector<Eigen::Index> rows = evidence.rows();
  double squares = 0;
  for (const Eigen::Index row : rows) squares += (one[row] - other[row]) * (one[row] - other[row]);
  return rows.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(rows.size()));
}

}  // namespace fusee::calibration
