#include "plan/signatures.h"

#include <algorithm>
#include <cmath>

#include "fusee/joint.h"
#include "joint/forward.h"
#include "joint/joint_effects.h"
#include "plan/thresholds.h"
#include "transmission/target_motion.h"

// Effective sample size: neighbouring rows of a log are correlated, so that few simulated rows have its information.
// One row of a simulated stroke stands for some 15° of the motor, or five rows of a log.

namespace fusee::plan {
namespace {

constexpr int k_rows_a_stroke = 24;
/// Numbers of Legendre polynomials over the range: shapes of the model error and of unmodelled causes.
constexpr int k_model_shapes = 3;
constexpr int k_unmodelled_shapes = 9;
/// Factors of the model error: 1, direction.
constexpr int k_model_factors = 2;
/// Factors of an unmodelled cause: 1, direction, load, load · direction, speed · direction.
constexpr int k_unmodelled_factors = 5;

/// Legendre polynomial, by the recurrence n P_n = (2n − 1) x P_(n−1) − (n − 1) P_(n−2).
double legendre(int degree, double x) {
  double before = 1, value = degree == 0 ? 1 : x;
  for (int n = 2; n <= degree; ++n) {
    const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
    before = value;
    value = next;
  }
  return value;
}

struct RowPosition {
  double in_range = 0;   ///< α, scaled to −1 … 1 over the motor range
  double direction = 0;  ///< of the motor, ±1; 0 before it moves
};
std::vector<RowPosition> positions_of(const joint::BenchRun& run, const Bench& bench) {
  std::vector<RowPosition> all;
  double direction = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double step = i > 0 ? run.rows[i].alpha - run.rows[i - 1].alpha : 0.0;
    if (step != 0) direction = step > 0 ? 1.0 : -1.0;
    all.push_back({2 * (run.rows[i].alpha - bench.from) / (bench.to - bench.from) - 1, direction});
  }
  return all;
}

}  // namespace

double usual_size(const fusee::EffectParameter& number, double largest_load) {
  return std::clamp(prior_of(number, largest_load), number.least, number.most);
}

Signatures::Signatures(const DeclaredMechanism& declared, const Bench& bench, double noise)
    : expected_(joint::expected_joint(declared)), bench_(bench), noise_(noise) {
  for (const Effect* effect : joint::effects_of(declared)) {
    const std::string reason = reason_to_leave_out(*effect);
    if (reason.empty()) {
      add(*effect);
    } else {
      left_out_.emplace_back(effect->name, reason);
    }
  }
  model_first_ = columns_;
  unmodelled_first_ = model_first_ + k_model_factors * k_model_shapes;
  columns_ = unmodelled_first_ + k_unmodelled_shapes * k_unmodelled_factors;
}

void Signatures::add(const Effect& effect) {
  Cause cause;
  cause.effect = &effect;
  cause.first = columns_;
  for (const fusee::EffectParameter& number : effect.parameters) {
    if (!number.searched) cause.numbers.push_back(&number);
  }
  columns_ += cause.count();
  causes_.push_back(std::move(cause));
}

std::string Signatures::reason_to_leave_out(const Effect& effect) const {
  if (effect.starts_in_time) return "it happens once, at any time: " + effect.separating_run;
  if (effect.needs.temperature) return "it follows the temperature: " + effect.separating_run;
  if (effect.needs.long_stroke && std::abs(bench_.to - bench_.from) <= k_most_linear_range)
    return "the motor does not turn far enough to show what comes back once a turn";
  if (effect.needs.load && bench_.largest_load() == 0) return "no load is planned";
  return "";
}

/// Change of the joint angle in each row when a number is set to its usual size, from the state `from`; 0 without
/// equilibrium.
Eigen::VectorXd Signatures::response_to(joint::Forward& forward, const Imperfections& from,
                                        const fusee::EffectParameter& number) const {
  const std::vector<double> before = forward(from).front();
  Imperfections with_number = from;
  set_value(with_number, number, usual_size(number, bench_.largest_load()));
  const std::vector<double> after = forward(with_number).front();
  Eigen::VectorXd change(static_cast<Eigen::Index>(before.size()));
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double difference = after[k] - before[k];
    change[static_cast<Eigen::Index>(k)] = std::isfinite(difference) ? difference : 0.0;
  }
  return change;
}

std::optional<Signatures::RunEquations> Signatures::of(const PlannedRun& run) const {
  const joint::BenchLog log = {driven(run, k_rows_a_stroke)};
  joint::Forward forward(expected_, log);
  const std::vector<double> undisturbed = forward({}).front();
  if (!std::all_of(undisturbed.begin(), undisturbed.end(), [](double angle) { return std::isfinite(angle); }))
    return std::nullopt;
  const auto rows = static_cast<Eigen::Index>(undisturbed.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, columns_);
  for (const Cause& cause : causes_) {
    for (Eigen::Index i = 0; i < cause.count(); ++i) {
      const Eigen::Index column = cause.first + i;
      A.col(column) = response_to(forward, {}, *cause.numbers[static_cast<std::size_t>(i)]);
      // A number that has no effect while the first number is 0 is varied from the first number's usual size.
      if (i > 0 && A.col(column).isZero(0)) {
        Imperfections first;
        set_value(first, *cause.numbers.front(), usual_size(*cause.numbers.front(), bench_.largest_load()));
        A.col(column) = response_to(forward, first, *cause.numbers[static_cast<std::size_t>(i)]);
      }
    }
  }
  const transmission::TargetMotion law(expected_);
  const std::vector<RowPosition> positions = positions_of(log.front(), bench_);
  // As shares of the largest ones.
  const double load = bench_.largest_load() > 0 ? run.load / bench_.largest_load() : 0.0;
  const double speed = run.speed / bench_.speeds.back();
  for (Eigen::Index k = 0; k < rows; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const double deflection = expected_.transmission ? 0.0 : undisturbed[row] - law.theta(log.front().rows[row].alpha);
    for (int n = 0; n < k_model_shapes; ++n) {
      const double error = k_plan.deflection_share * deflection * legendre(n, positions[row].in_range);
      A(k, model_first_ + k_model_factors * n) = error;
      A(k, model_first_ + k_model_factors * n + 1) = error * positions[row].direction;
    }
    const double factors[k_unmodelled_factors] = {1, positions[row].direction, load, load * positions[row].direction,
                                                  speed * positions[row].direction};
    // Columns of unmodelled causes are for 1° at the joint; false_positives.cpp multiplies them by the sizes.
    for (int n = 0; n < k_unmodelled_shapes; ++n) {
      for (int f = 0; f < k_unmodelled_factors; ++f)
        A(k, unmodelled_first_ + n * k_unmodelled_factors + f) =
            radians(1.0) * legendre(n, positions[row].in_range) * factors[f];
    }
  }
  A /= noise_;
  return RunEquations{A.transpose() * A, static_cast<double>(rows)};
}

Eigen::MatrixXd Signatures::of(const fusee::EffectParameter& reading) const {
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(columns_, columns_);
  for (const Cause& cause : causes_) {
    for (Eigen::Index i = 0; i < cause.count(); ++i) {
      if (cause.numbers[static_cast<std::size_t>(i)]->number != reading.number) continue;
      const double standard_errors = usual_size(reading, bench_.largest_load()) / reading.by_hand.uncertainty;
      squares(cause.first + i, cause.first + i) = standard_errors * standard_errors;
    }
  }
  return squares;
}

}  // namespace fusee::plan
