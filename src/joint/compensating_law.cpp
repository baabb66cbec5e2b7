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

/// Error of the compensating law up to which P1 stays round. It is comparable with that of a drawn outline and small
/// against any error worth a pulley.
constexpr double k_round_suffices = radians(0.005);
/// Deflection below which the law is not changed.
constexpr double k_least_shift = radians(0.002);
constexpr int k_rows_beyond = 4;  ///< rows beyond each end of the range, at the same spacing

struct LawAccuracy {
  int rows = 152;
  /// Residual error of the loaded joint at which the iteration ends.
  double reached = radians(1e-5);
};
LawAccuracy accuracy_of(LawSearch search) {
  return search == LawSearch::whole ? LawAccuracy{} : LawAccuracy{48, radians(0.01)};
}

/// True when the law must be adapted to the load. Friction and pretension alone hardly change the mean of both
/// directions.
bool is_deflected(const Imperfections& at) {
  return at.tendon.stretch != 0 || at.sheath.compliance != 0 || at.joint.weight != WeightError{} ||
         at.joint.mean_load != 0;
}
/// The target motion as rows that include both ends of the range, and slightly beyond them where the law continues.
/// Beyond the end of a table all θ have one α, up to rounding; such rows are skipped. Empty where the law does not
/// exist.
std::vector<LawRow> declared_rows(const Mechanism& declared, int count) {
  const transmission::Transmission law(declared);
  if (law.dead_centre()) return {};
  const double low = declared.joint.theta_min, high = declared.joint.theta_max;
  const double least_step = 1e-9 * (law.alpha(high) - law.alpha(low));
  std::vector<LawRow> rows;
  for (int i = -k_rows_beyond; i <= count + k_rows_beyond; ++i) {
    const double theta = (low * (count - i) + high * i) / count;
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

Mechanism with_law(Mechanism joint, const CompensatingLaw& needed) {
  joint.pulley.law = Law::table;
  joint.pulley.rows = from_home(needed.rows, needed.home);
  joint.joint.theta_min = needed.theta_min;
  joint.joint.theta_max = needed.theta_max;
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
std::vector<double> mean_motion(const Mechanism& joint, const std::vector<LawRow>& at, double tip_force) {
  const std::vector<double> theta = predict(joint, {}, sweep(at, tip_force)).front();
  std::vector<double> mean;
  for (std::size_t i = 0; i < at.size(); ++i)
    mean.push_back(0.5 * (theta[2 * at.size() + i] + theta[theta.size() - 1 - i]));
  return mean;
}

/// Least squares fit by Chebyshev polynomials of α. A pulley's curvature contains the second derivative of the law, so
/// that a kink (a tendon becoming slack) would be a dent. Deflections under moderate loads are smooth and reproduced to
/// 1e-5.
class ChebyshevSmoother {
 public:
  explicit ChebyshevSmoother(const std::vector<LawRow>& rows) : basis_(chebyshev_of(rows)), solver_(basis_) {}
  Eigen::VectorXd of(const Eigen::VectorXd& values) const { return basis_ * solver_.nearest(values); }

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

/// The law minus the residual error `miss`; null where θ would not increase with α.
std::optional<CompensatingLaw> corrected_law(CompensatingLaw needed, const std::vector<LawRow>& wanted,
                                             const Joint& joint, const Eigen::VectorXd& miss) {
  constexpr double rounding = 1e-12;
  double low = 0, high = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    LawRow& row = needed.rows[i];
    row.theta -= miss(static_cast<Eigen::Index>(i));
    if (i > 0 && row.theta <= needed.rows[i - 1].theta) return std::nullopt;
    if (wanted[i].theta <= joint.theta_min + rounding) low = row.theta;
    if (wanted[i].theta <= joint.theta_max + rounding) high = row.theta;
  }
  needed.theta_min = std::min(low, 0.0);
  needed.theta_max = std::max(high, 0.0);
  return needed;
}

/// The law with which `joint`, deflected by its load, follows `wanted`. Null if there is none. Friction at the pins is
/// ignored: it causes hysteresis about the mean, and its reversals at the ends of the range cannot be corrected by a
/// pulley.
std::optional<CompensatingLaw> law_under_load(Mechanism joint, const CompensatingLaw& declared, double tip_force,
                                              double reached) {
  joint = transmission::without_friction(std::move(joint));
  const std::vector<LawRow>& wanted = declared.rows;
  const ChebyshevSmoother smoothed(wanted);
  CompensatingLaw needed = declared;
  for (int i = 0; i < 20; ++i) {
    const Mechanism made = with_law(joint, needed);
    if (transmission::Transmission(made).dead_centre()) return std::nullopt;
    const std::vector<double> theta = mean_motion(made, from_home(wanted, needed.home), tip_force);
    Eigen::VectorXd miss(static_cast<Eigen::Index>(wanted.size()));
    for (std::size_t k = 0; k < wanted.size(); ++k) miss(static_cast<Eigen::Index>(k)) = theta[k] - wanted[k].theta;
    if (!miss.allFinite()) return std::nullopt;
    miss = smoothed.of(miss);
    const auto next = corrected_law(needed, wanted, joint.joint, miss);
    if (!next) return std::nullopt;
    needed = *next;
    needed.home = 0;
    needed.home = transmission::Transmission(with_law(joint, needed)).alpha(0.0);
    if (miss.cwiseAbs().maxCoeff() < reached) break;
  }
  for (std::size_t k = 0; k < wanted.size(); ++k)
    needed.shifted = needed.shifted || std::abs(needed.rows[k].theta - wanted[k].theta) > k_least_shift;
  return needed;
}

}  // namespace

CompensatingLaw compensating_law(const DeclaredMechanism& declared, LawSearch search) {
  const LawAccuracy accuracy = accuracy_of(search);
  const CompensatingLaw as_declared{declared_rows(declared, accuracy.rows), 0, declared.joint.theta_min,
                                    declared.joint.theta_max, false};
  if (as_declared.rows.empty() || !is_deflected(declared.identified)) return as_declared;
  const auto needed = law_under_load(identified_mechanism(declared), as_declared,
                                     declared.load.tip_force + declared.identified.joint.mean_load, accuracy.reached);
  return needed && needed->shifted ? *needed : as_declared;
}

namespace {

/// Maximum error of a joint with the law of `joint` against the rows; if home may shift, at the best assembly angle.
double worst_miss(const Mechanism& joint, const CompensatingLaw& needed) {
  const transmission::Transmission law(joint);
  constexpr double none = std::numeric_limits<double>::infinity();
  if (law.dead_centre()) return none;
  double least = none, most = -none;
  for (const LawRow& row : needed.rows) {
    const double off = (law.alpha(row.theta) - row.alpha) * law.at_theta(row.theta).g;
    if (!std::isfinite(off)) return none;
    least = std::min(least, off);
    most = std::max(most, off);
  }
  return needed.shifted ? 0.5 * (most - least) : std::max(most, -least);
}

}  // namespace

RoundChoice round_choice(const DeclaredMechanism& declared, const CompensatingLaw& needed) {
  Mechanism joint = identified_mechanism(declared);
  RoundChoice choice;
  choice.r1 = joint.pulley.r1;
  if (declared.pulley.law != Law::compensate || needed.rows.empty()) return choice;
  const auto miss = [&](double r1) {
    joint.pulley.r1 = r1;
    return worst_miss(joint, needed);
  };
  // The maximum error has one minimum over r1.
  choice.r1 = golden_section({0.8 * choice.r1, 1.25 * choice.r1}, 40, miss).middle();
  choice.max_error = miss(choice.r1);
  choice.suffices = choice.max_error <= k_round_suffices;
  return choice;
}

}  // namespace fusee::joint
