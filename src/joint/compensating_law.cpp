#include "joint/compensating_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/decompositions.h"
#include "base/golden_section.h"
#include "fusee/joint.h"
#include "fusee/transmission.h"
#include "joint/imperfect_joint.h"
#include "transmission/load.h"

namespace fusee::joint {
namespace {

/// Error of θ up to which P1 stays round. A drawn outline has a similar error, and an error that justifies a new pulley
/// is much larger.
constexpr double k_round_suffices = radians(0.005);
/// Deflection below which the law is not changed.
constexpr double k_least_shift = radians(0.002);
constexpr int k_rows_beyond = 4;  ///< rows beyond each end of the range, at the same spacing

/// Accuracy of the search for the law.
struct LawAccuracy {
  int intervals = 152;  ///< into which the rows of the law divide the range of θ
  /// Residual error of the loaded joint at which the iteration ends.
  double reached = radians(1e-5);
};
LawAccuracy accuracy_of(LawSearch search) {
  constexpr LawAccuracy k_brief{48, radians(0.01)};
  return search == LawSearch::whole ? LawAccuracy{} : k_brief;
}

/// True when the law must be adapted to the load. Friction and pretension alone hardly change the mean of both
/// directions.
bool is_deflected(const Imperfections& errors) {
  return errors.tendon.stretch != 0 || errors.sheath.compliance != 0 || errors.joint.weight != WeightError{} ||
         errors.joint.mean_load != 0;
}

/// The target motion as rows that include both ends of the range, and slightly beyond them where the law continues.
/// Beyond the end of a table all θ have one α, up to rounding; such rows are skipped. Empty where the law does not
/// exist.
std::vector<LawRow> declared_rows(const Mechanism& declared, int intervals) {
  const transmission::Transmission law(declared);
  if (law.dead_centre()) return {};
  const double low = declared.joint.theta_min, high = declared.joint.theta_max;
  const double least_step = 1e-9 * (law.alpha(high) - law.alpha(low));
  std::vector<LawRow> rows;
  for (int i = -k_rows_beyond; i <= intervals + k_rows_beyond; ++i) {
    const double theta = (low * (intervals - i) + high * i) / intervals;
    const LawRow row{law.alpha(theta), theta};
    if (!std::isfinite(row.alpha) || (!rows.empty() && !(row.alpha > rows.back().alpha + least_step))) continue;
    rows.push_back(row);
  }
  return rows;
}

/// Expresses a torque error as a mass on the lever.
Load with_weight(Load load, const WeightError& error, double R) {
  if (error == WeightError{}) return load;
  const Weight weight = with_error({transmission::weight_moment(load), load.tilt}, error);
  if (load.lever == 0) load.lever = R;
  load.mass_kg = weight.moment / (transmission::k_gravity * load.lever);
  load.tilt = weight.tilt;
  return load;
}

/// `rows` relative to the pulley's home, at which its tendons are tied with θ = 0.
std::vector<LawRow> from_home(std::vector<LawRow> rows, double home) {
  for (LawRow& row : rows) row.alpha -= home;
  return rows;
}

}  // namespace

Mechanism identified_mechanism(const DeclaredMechanism& declared) {
  Mechanism joint = mounted(declared, declared.identified).mechanism;
  joint.load = with_weight(joint.load, declared.identified.joint.weight, joint.joint.R);
  return joint;
}

Mechanism with_law(Mechanism joint, const CompensatingLaw& compensating) {
  joint.pulley.law = Law::table;
  joint.pulley.rows = from_home(compensating.rows, compensating.home);
  joint.joint.theta_min = compensating.theta_min;
  joint.joint.theta_max = compensating.theta_max;
  return joint;
}

namespace {

/// A run up and down through these angles under a constant tip force, twice: only in the first cycle does the wound
/// tendon settle.
BenchLog sweep(const std::vector<LawRow>& rows, double tip_force) {
  BenchRun run;
  run.has_load = true;
  const auto add = [&](const LawRow& row) { run.rows.push_back({.alpha = row.alpha, .load = tip_force}); };
  for (int round = 0; round < 2; ++round) {
    std::for_each(rows.begin(), rows.end(), add);
    std::for_each(rows.rbegin(), rows.rend(), add);
  }
  return {run};
}

/// θ of the loaded joint at each row's α, averaged over both directions.
std::vector<double> mean_motion(const Mechanism& joint, const std::vector<LawRow>& rows, double tip_force) {
  const std::vector<double> theta = predict(joint, {}, sweep(rows, tip_force)).front();
  std::vector<double> mean;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double up = theta[2 * rows.size() + i], down = theta[theta.size() - 1 - i];  // of the second cycle
    mean.push_back(0.5 * (up + down));
  }
  return mean;
}

/// Least squares fit by Chebyshev polynomials of α. It removes kinks, such as where a tendon becomes slack: a pulley's
/// curvature contains the second derivative of the law, so a kink would be a dent. Deflections under moderate loads are
/// smooth and are reproduced to 1e-5.
class ChebyshevSmoother {
 public:
  explicit ChebyshevSmoother(const std::vector<LawRow>& rows) : basis_(chebyshev_of(rows)), solver_(basis_) {}
  Eigen::VectorXd smoothed(const Eigen::VectorXd& values) const { return basis_ * solver_.nearest(values); }

 private:
  static constexpr Eigen::Index k_terms = 9;

  static Eigen::MatrixXd chebyshev_of(const std::vector<LawRow>& rows) {
    Eigen::MatrixXd basis(static_cast<Eigen::Index>(rows.size()), k_terms);
    const double middle = 0.5 * (rows.front().alpha + rows.back().alpha),
                 half = 0.5 * (rows.back().alpha - rows.front().alpha);
    for (Eigen::Index i = 0; i < basis.rows(); ++i) {
      const double x = std::clamp((rows[static_cast<std::size_t>(i)].alpha - middle) / half, -1.0, 1.0);
      for (Eigen::Index k = 0; k < k_terms; ++k)
        basis(i, k) = elementary::cos(static_cast<double>(k) * elementary::acos(x));
    }
    return basis;
  }

  Eigen::MatrixXd basis_;
  LeastSquares solver_;
};

/// The law minus the residual error of θ; null where θ would not increase with α. Its θ at the ends of the declared
/// range are the range without load, widened to contain 0.
std::optional<CompensatingLaw> corrected_law(CompensatingLaw compensating, const std::vector<LawRow>& target,
                                             const Joint& joint, const Eigen::VectorXd& error) {
  constexpr double k_rounding = 1e-12;  // rad
  double low = 0, high = 0;
  for (std::size_t i = 0; i < target.size(); ++i) {
    LawRow& row = compensating.rows[i];
    row.theta -= error(static_cast<Eigen::Index>(i));
    if (i > 0 && row.theta <= compensating.rows[i - 1].theta) return std::nullopt;
    if (target[i].theta <= joint.theta_min + k_rounding) low = row.theta;
    if (target[i].theta <= joint.theta_max + k_rounding) high = row.theta;
  }
  compensating.theta_min = std::min(low, 0.0);
  compensating.theta_max = std::max(high, 0.0);
  return compensating;
}

/// The law with which `joint`, deflected by its load, follows the target motion `declared`. Null if there is none.
/// Fixed-point iteration: each round subtracts the error of the loaded joint. Friction at the pins is ignored: it
/// causes hysteresis about the mean, and a pulley cannot correct its reversals at the ends of the range.
std::optional<CompensatingLaw> law_under_load(Mechanism joint, const CompensatingLaw& declared, double tip_force,
                                              double reached) {
  joint = transmission::without_friction(std::move(joint));
  const std::vector<LawRow>& target = declared.rows;
  constexpr int k_rounds = 20;
  const ChebyshevSmoother smoother(target);
  CompensatingLaw compensating = declared;
  for (int i = 0; i < k_rounds; ++i) {
    const Mechanism made = with_law(joint, compensating);
    if (transmission::Transmission(made).dead_centre()) return std::nullopt;
    const std::vector<double> theta = mean_motion(made, from_home(target, compensating.home), tip_force);
    Eigen::VectorXd error(static_cast<Eigen::Index>(target.size()));
    for (std::size_t k = 0; k < target.size(); ++k) error(static_cast<Eigen::Index>(k)) = theta[k] - target[k].theta;
    if (!error.allFinite()) return std::nullopt;
    error = smoother.smoothed(error);
    const auto next = corrected_law(compensating, target, joint.joint, error);
    if (!next) return std::nullopt;
    compensating = *next;
    compensating.home = 0;
    compensating.home = transmission::Transmission(with_law(joint, compensating)).alpha(0.0);
    if (error.cwiseAbs().maxCoeff() < reached) break;
  }
  for (std::size_t k = 0; k < target.size(); ++k)
    compensating.shifted =
        compensating.shifted || std::abs(compensating.rows[k].theta - target[k].theta) > k_least_shift;
  return compensating;
}

}  // namespace

CompensatingLaw compensating_law(const DeclaredMechanism& declared, LawSearch search) {
  const LawAccuracy accuracy = accuracy_of(search);
  const CompensatingLaw as_declared{declared_rows(declared, accuracy.intervals), 0, declared.joint.theta_min,
                                    declared.joint.theta_max, false};
  if (as_declared.rows.empty() || !is_deflected(declared.identified)) return as_declared;
  const auto compensating =
      law_under_load(identified_mechanism(declared), as_declared,
                     declared.load.tip_force + declared.identified.joint.mean_load, accuracy.reached);
  return compensating && compensating->shifted ? *compensating : as_declared;
}

namespace {

/// Maximum error of θ of the law of `joint` against the compensating law. If the latter is shifted, the assembly angle
/// is free, and the best one counts.
double largest_error(const Mechanism& joint, const CompensatingLaw& compensating) {
  const transmission::Transmission law(joint);
  constexpr double none = std::numeric_limits<double>::infinity();
  if (law.dead_centre()) return none;
  double least = none, most = -none;
  for (const LawRow& row : compensating.rows) {
    // First order: Δθ = g Δα, with g = dθ/dα.
    const double error = (law.alpha(row.theta) - row.alpha) * law.at_theta(row.theta).g;
    if (!std::isfinite(error)) return none;
    least = std::min(least, error);
    most = std::max(most, error);
  }
  return compensating.shifted ? 0.5 * (most - least) : std::max(most, -least);
}

}  // namespace

RoundChoice round_choice(const DeclaredMechanism& declared, const CompensatingLaw& compensating) {
  Mechanism joint = identified_mechanism(declared);
  RoundChoice choice;
  choice.r1 = joint.pulley.r1;
  if (declared.pulley.law != Law::compensate || compensating.rows.empty()) return choice;
  const auto error_of = [&](double r1) {
    joint.pulley.r1 = r1;
    return largest_error(joint, compensating);
  };
  // The maximum error has one minimum over r1.
  constexpr int k_sections = 40;
  choice.r1 = golden_section({0.8 * choice.r1, 1.25 * choice.r1}, k_sections, error_of).middle();
  choice.max_error = error_of(choice.r1);
  choice.suffices = choice.max_error <= k_round_suffices;
  return choice;
}

}  // namespace fusee::joint
