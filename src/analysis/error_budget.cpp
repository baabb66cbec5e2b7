#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/rigid_joint.h"
#include "base/normal_numbers.h"
#include "fusee/analysis.h"
#include "fusee/transmission.h"
#include "transmission/alpha_range.h"

namespace fusee::analysis {
namespace {

constexpr int k_steps = 8;  ///< of the range, at whose ends deviations are evaluated

std::vector<double> alphas_of(const transmission::Transmission& transmission) {
  return transmission::alphas_over_range(transmission, k_steps);
}

// ---- simplifications ------------------------------------------------------------------------------------------------

/// Widens the source by a deviation. Skips undefined ones, of a tendon beyond the curve's end.
void add_deviation(ErrorSource& source, double deviation, double alpha) {
  if (!std::isfinite(deviation)) return;
  if (std::abs(deviation) > std::max(-source.least, source.most)) source.worst_at = alpha;
  source.least = std::min(source.least, deviation);
  source.most = std::max(source.most, deviation);
}

/// Deviation of the joint with pulleys that were drawn for a simplified mechanism, from the law of that drawing.
ErrorSource simplified_drawing(std::string name, std::string meaning, const Mechanism& mechanism,
                               const joint::MadePulleys& drawn) {
  ErrorSource source{std::move(name), std::move(meaning)};
  const RigidJoint joint(drawn, mechanism);
  for (const double alpha : alphas_of(drawn.declared()))
    add_deviation(source, joint.at(alpha).theta - drawn.declared().theta(alpha), alpha);
  return source;
}

Mechanism with_exact_method(Mechanism mechanism) {
  mechanism.pulley.method = Method::exact;
  return mechanism;
}

ErrorSource pin_radius_ignored(const Mechanism& mechanism) {
  Mechanism drawn = with_exact_method(mechanism);
  drawn.guides.radius = 0;
  return simplified_drawing("pin_radius_ignored", "pin radius, if the pulley ignored it", mechanism,
                            joint::MadePulleys(drawn));
}

/// The groove's floor is placed where the centre line should be.
ErrorSource thickness_ignored(const Mechanism& mechanism) {
  Mechanism drawn = with_exact_method(mechanism);
  drawn.tendon.diameter = 0;
  return simplified_drawing("tendon_thickness_ignored", "tendon thickness, if the pulley ignored it", mechanism,
                            joint::MadePulleys(drawn).offset_by(0.5 * mechanism.tendon.diameter));
}

// ---- compliance -----------------------------------------------------------------------------------------------------

ErrorSource paper_stretch(const Mechanism& mechanism) {
  ErrorSource source{"stretch_paper", "stretch under the load, by [9]-[11]"};
  const transmission::Transmission declared(mechanism);
  // PaperForces::theta_error counts against +θ, a deviation towards it.
  for (const double alpha : alphas_of(declared))
    add_deviation(source, -transmission::paper_forces(mechanism, declared.at_alpha(alpha)).theta_error, alpha);
  return source;
}

/// Weighted sum of the full model's deviations in both directions: their mean with the shares 0.5 and 0.5, half their
/// difference with 0.5 and −0.5.
ErrorSource full_model(const char* name, const char* meaning, const Mechanism& mechanism, double rising_share,
                       double falling_share) {
  ErrorSource source{name, meaning};
  const transmission::Transmission declared(mechanism);
  for (const StrokePoint& point : settled_stroke(mechanism, alphas_of(declared))) {
    if (point.rising.status == joint::EquilibriumStatus::no_equilibrium ||
        point.falling.status == joint::EquilibriumStatus::no_equilibrium)
      continue;
    const double theta = declared.theta(point.rising.alpha);
    add_deviation(source, rising_share * (point.rising.theta - theta) + falling_share * (point.falling.theta - theta),
                  point.rising.alpha);
  }
  return source;
}

ErrorSource full_stretch(const Mechanism& mechanism) {
  return full_model("stretch", "stretch of both tendons, no friction at the pins",
                    transmission::without_friction(mechanism), 0.5, 0.5);
}

ErrorSource friction(const Mechanism& mechanism) {
  return full_model("friction", "half the hysteresis between both directions", mechanism, 0.5, -0.5);
}

// ---- tolerances -----------------------------------------------------------------------------------------------------

/// Half widths of the 95 % intervals at each α.
struct Spread {
  std::vector<double> theta;   ///< rad
  std::vector<double> excess;  ///< mm
};

/// Twice the standard deviation (95 %) about the joint as declared, over `samples` joints.
Spread spread_of(const std::vector<double>& alphas, const RigidJoint& declared, int samples,
                 const std::function<RigidJoint()>& sample) {
  const std::size_t count = alphas.size();
  Spread spread{std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)};
  std::vector<RigidPoint> nominal;
  for (const double alpha : alphas) nominal.push_back(declared.at(alpha));
  std::vector<int> used(count, 0);
  for (int i = 0; i < samples; ++i) {
    const RigidJoint joint = sample();
    for (std::size_t k = 0; k < count; ++k) {
      const RigidPoint point = joint.at(alphas[k]);
      const double dtheta = point.theta - nominal[k].theta;
      const double dexcess = point.excess - nominal[k].excess;
      if (!std::isfinite(dtheta) || !std::isfinite(dexcess)) continue;
      ++used[k];
      spread.theta[k] += dtheta * dtheta;
      spread.excess[k] += dexcess * dexcess;
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    spread.theta[k] = 2.0 * std::sqrt(spread.theta[k] / std::max(1, used[k]));
    spread.excess[k] = 2.0 * std::sqrt(spread.excess[k] / std::max(1, used[k]));
  }
  return spread;
}

std::size_t index_of_largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

ToleranceEffect tolerance_effect(std::string key, const std::vector<double>& alphas, const Spread& derived,
                                 const Spread& sampled) {
  const std::size_t theta = index_of_largest(derived.theta);
  const std::size_t excess = index_of_largest(derived.excess);
  return {std::move(key),         derived.theta[theta],   sampled.theta[theta], alphas[theta],
          derived.excess[excess], sampled.excess[excess], alphas[excess]};
}

Spread by_derivative(const std::vector<double>& alphas, const RigidJoint& joint, const Dimension& dimension,
                     double tolerance) {
  Spread spread;
  for (const double alpha : alphas) {
    const RigidPoint rate = derivative(joint, dimension, alpha);
    spread.theta.push_back(std::abs(rate.theta) * tolerance);
    spread.excess.push_back(std::abs(rate.excess) * tolerance);
  }
  return spread;
}

/// Variances of independent causes add.
void add_squares(Spread& sum, const Spread& more) {
  for (std::size_t k = 0; k < sum.theta.size(); ++k) {
    sum.theta[k] = elementary::hypot(sum.theta[k], more.theta[k]);
    sum.excess[k] = elementary::hypot(sum.excess[k], more.excess[k]);
  }
}

}  // namespace

std::vector<ErrorSource> error_sources(const Mechanism& mechanism) {
  return {paper_stretch(mechanism), full_stretch(mechanism), friction(mechanism), pin_radius_ignored(mechanism),
          thickness_ignored(mechanism)};
}

std::vector<ToleranceEffect> tolerance_effects(const Mechanism& mechanism, const AnalysisOptions& options,
                                               const RunContext& context) {
  const Mechanism exact = with_exact_method(mechanism);
  const joint::MadePulleys made(exact);
  const std::vector<double> alphas = alphas_of(made.declared());
  const RigidJoint joint(made, exact);
  const double sigma = 0.5 * options.dimension_tolerance;
  NormalNumbers numbers(options.seed);
  const auto next_change = [&] {
    context.throw_if_stopped();
    return sigma * numbers.next();
  };
  Spread all{std::vector<double>(alphas.size(), 0.0), std::vector<double>(alphas.size(), 0.0)};
  std::vector<ToleranceEffect> effects;
  const std::vector<Dimension> lengths = dimensions(exact);
  for (const Dimension& dimension : lengths) {
    const Spread derived = by_derivative(alphas, joint, dimension, options.dimension_tolerance);
    const Spread sampled =
        spread_of(alphas, joint, options.samples, [&] { return altered(made, exact, dimension, next_change()); });
    effects.push_back(tolerance_effect(std::string(dimension.key), alphas, derived, sampled));
    add_squares(all, derived);
  }
  const Spread sampled = spread_of(alphas, joint, options.samples, [&] {
    std::vector<double> changes;
    for (std::size_t i = 0; i < lengths.size(); ++i) changes.push_back(next_change());
    return altered(made, exact, changes);
  });
  effects.push_back(tolerance_effect("all", alphas, all, sampled));
  return effects;
}

}  // namespace fusee::analysis
