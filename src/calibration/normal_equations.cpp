#include "calibration/normal_equations.h"

#include <cmath>

#include "base/decompositions.h"
#include "calibration/fit.h"

namespace fusee::calibration {
namespace {

double reading_of(const HandReading& reading, const Evidence& evidence, const Imperfections& at) {
  return reading_by_hand(*reading.parameter, at, *evidence.declared);
}

/// d(reading)/dx, by a step of each number.
Eigen::VectorXd slopes_of(const HandReading& reading, const Evidence& evidence, const Fit& fit) {
  Eigen::VectorXd slopes(fit.x.size());
  const double here = reading_of(reading, evidence, fit.at);
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    Imperfections moved = fit.at;
    set_value(moved, *fit.parameters[k], value_of(fit.at, *fit.parameters[k]) + fit.parameters[k]->step);
    slopes[static_cast<Eigen::Index>(k)] = reading_of(reading, evidence, moved) - here;
  }
  return slopes;
}

void add_row(const Fit& fit, Eigen::Index row, double floor, NormalEquations& normal) {
  for (Eigen::Index k = 0; k < fit.x.size(); ++k) {
    for (Eigen::Index i = 0; i < fit.x.size(); ++i) normal.JJ(i, k) += fit.J(row, i) * fit.J(row, k);
    normal.Jr[k] += fit.J(row, k) * fit.residual[row];
  }
  normal.rr += fit.residual[row] * fit.residual[row] + play_correction(fit.loose[row], floor);
  normal.rows += 1;
}

}  // namespace

NormalEquations NormalEquations::none(Eigen::Index parameters) {
  return {Eigen::MatrixXd::Zero(parameters, parameters), Eigen::VectorXd::Zero(parameters), 0, 0};
}

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  JJ += other.JJ;
  Jr += other.Jr;
  return *this;
}

NormalEquations& NormalEquations::operator-=(const NormalEquations& other) {
  JJ -= other.JJ;
  Jr -= other.Jr;
  return *this;
}

Eigen::VectorXd least_squares_step(const NormalEquations& normal, const Eigen::VectorXd& x, double ridge) {
  if (normal.empty()) return {};
  const Eigen::MatrixXd A = normal.JJ + ridge * Eigen::MatrixXd::Identity(normal.JJ.rows(), normal.JJ.cols());
  return solved(A, Eigen::VectorXd(normal.Jr - ridge * x));
}

NormalEquations sums_of(const Block& block, const Fit& fit, double floor) {
  NormalEquations sums = NormalEquations::none(fit.x.size());
  for (const std::size_t row : block.rows) add_row(fit, static_cast<Eigen::Index>(row), floor, sums);
  return sums;
}

NormalEquations sums_of_readings(const Evidence& evidence, const Fit& fit) {
  NormalEquations sums = NormalEquations::none(fit.x.size());
  for (const HandReading& reading : evidence.readings) {
    const double scale = evidence.floor / reading.uncertainty;
    const Eigen::VectorXd slopes = scale * slopes_of(reading, evidence, fit);
    sums.JJ.noalias() += slopes * slopes.transpose();
    sums.Jr += slopes * scale * (reading.value - reading_of(reading, evidence, fit.at));
  }
  return sums;
}

double caliper_chi2(const Evidence& evidence, const Imperfections& at) {
  double squares = 0;
  for (const HandReading& reading : evidence.readings)
    squares += std::pow((reading.value - reading_of(reading, evidence, at)) / reading.uncertainty, 2);
  return squares;
}

NormalEquations sums_of_all(const Evidence& evidence, const Fit& fit) {
  NormalEquations normal = fit.readings;
  for (const Eigen::Index row : evidence.rows()) add_row(fit, row, evidence.floor, normal);
  return normal;
}

bool is_finite(const Evidence& evidence, const Fit& fit) {
  for (const Eigen::Index row : evidence.rows()) {
    if (!std::isfinite(fit.residual[row])) return false;
    for (Eigen::Index k = 0; k < fit.x.size(); ++k) {
      if (!std::isfinite(fit.J(row, k))) return false;
    }
  }
  return true;
}

}  // namespace fusee::calibration
