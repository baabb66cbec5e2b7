#include <ceres/ceres.h>
#include <glog/logging.h>

#include <cmath>
#include <limits>
#include <mutex>

#include "calibration/misfit.h"

namespace fusee {
namespace {

/// Residuals beyond this many scales count linearly: what is left of outliers when every stroke was looked through.
constexpr double k_robust = 5.0;

Imperfections placed(const Parameters& parameters, Imperfections at, const double* x) {
  for (std::size_t i = 0; i < parameters.size(); ++i) set_value(at, *parameters[i], x[i] * parameters[i]->step);
  return at;
}

/// Robust residuals, in units of the scale, of the rows in use and of what was measured by hand.
class Misfit : public ceres::CostFunction {
 public:
  Misfit(const Model& model, const Parameters& parameters, const Imperfections& from, double scale)
      : model_(model), parameters_(parameters), from_(from), scale_(scale), rows_(model.evidence().rows()) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
    set_num_residuals(static_cast<int>(rows_.size() + readings().size()));
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const Imperfections here = placed(parameters_, from_, x[0]);
    const Eigen::VectorXd at = model_.said(here).residual;
    std::vector<double> slopes(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double u = at[rows_[i]] / scale_;
      if (!std::isfinite(u)) return false;
      const double size = std::abs(u);
      const double robust = size <= k_robust ? size : std::sqrt(2.0 * k_robust * size - k_robust * k_robust);
      residuals[i] = std::copysign(robust, u);
      slopes[i] = size <= k_robust ? 1.0 : k_robust / robust;
    }
    for (std::size_t i = 0; i < readings().size(); ++i) {
      const HandReading& reading = readings()[i];
      residuals[rows_.size() + i] = (reading.value - value_of(here, *reading.parameter)) / reading.uncertainty * floor() / scale_;
    }
    if (jacobians != nullptr && jacobians[0] != nullptr) differentiate(x[0], at, slopes, jacobians[0]);
    return true;
  }

 private:
  void differentiate(const double* x, const Eigen::VectorXd& at, const std::vector<double>& slopes,
                     double* jacobian) const {
    const std::size_t count = parameters_.size();
    std::vector<double> y(x, x + count);
    for (std::size_t k = 0; k < count; ++k) {
      const EffectParameter& parameter = *parameters_[k];
      const double step = (y[k] + 1.0) * parameter.step <= parameter.most ? 1.0 : -1.0;
      y[k] += step;
      const Eigen::VectorXd moved = model_.said(placed(parameters_, from_, y.data())).residual;
      y[k] -= step;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        const double slope = (moved[rows_[i]] - at[rows_[i]]) / step / scale_ * slopes[i];
        jacobian[i * count + k] = std::isfinite(slope) ? slope : 0.0;
      }
      for (std::size_t i = 0; i < readings().size(); ++i) {
        const HandReading& reading = readings()[i];
        jacobian[(rows_.size() + i) * count + k] =
            is_read_by(parameter, reading) ? -parameter.step / reading.uncertainty * floor() / scale_ : 0.0;
      }
    }
  }

  const std::vector<HandReading>& readings() const { return model_.evidence().readings; }
  double floor() const { return model_.evidence().floor; }

  const Model& model_;
  const Parameters& parameters_;
  Imperfections from_;
  double scale_;
  std::vector<Eigen::Index> rows_;
};

/// Whether there is an equilibrium wherever the joint was logged.
bool can_be_simulated(const Misfit& misfit) {
  std::vector<double> residuals(static_cast<std::size_t>(misfit.num_residuals()));
  const double* nothing = nullptr;
  return misfit.Evaluate(&nothing, residuals.data(), nullptr);
}

ceres::Solver::Options solver_options() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.max_num_iterations = 8;
  options.function_tolerance = 1e-4;
  options.logging_type = ceres::SILENT;
  return options;
}

bool solve(const Misfit& misfit, const Parameters& parameters, std::vector<double>& x) {
  ceres::Problem::Options borrowed;
  borrowed.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(borrowed);
  problem.AddResidualBlock(const_cast<Misfit*>(&misfit), nullptr, x.data());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    problem.SetParameterLowerBound(x.data(), static_cast<int>(i), parameters[i]->least / parameters[i]->step);
    problem.SetParameterUpperBound(x.data(), static_cast<int>(i), parameters[i]->most / parameters[i]->step);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(), &problem, &summary);
  return summary.termination_type != ceres::FAILURE && std::isfinite(summary.final_cost);
}

void silence_glog() {
  static std::once_flag once;
  std::call_once(once, [] { FLAGS_minloglevel = google::GLOG_FATAL; });
}

}  // namespace

Minimum least_misfit(const Model& model, const Parameters& parameters, const Imperfections& from, double scale) {
  silence_glog();
  const Misfit misfit(model, parameters, from, scale);
  std::vector<double> x;
  for (const EffectParameter* parameter : parameters) x.push_back(value_of(from, *parameter) / parameter->step);
  Minimum minimum;
  minimum.found = parameters.empty() ? can_be_simulated(misfit) : solve(misfit, parameters, x);
  if (!minimum.found) return minimum;
  minimum.at = placed(parameters, from, x.data());
  minimum.x = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  return minimum;
}

}  // namespace fusee
