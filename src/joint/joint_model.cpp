#include <algorithm>
#include <cmath>
#include <limits>

#include "fusee/joint.h"
#include "joint/upper_span_table.h"
#include "transmission/load.h"

namespace fusee::joint {
namespace {

/// Extension of the range up to which the joint may be pushed, while the moment arms exist.
constexpr double k_reach = radians(60.0);

/// The last θ from `start` towards `end` up to which both moment arms are positive.
double last_with_arms(const std::array<transmission::PinPlace, 2>& pins, double start, double end) {
  const auto has_arms = [&](double theta) {
    return transmission::upper_span(pins[0], -theta).m > 0 && transmission::upper_span(pins[1], theta).m > 0;
  };
  constexpr int k_steps = 60, k_bisections = 50;
  double good = start;
  for (int i = 1; i <= k_steps; ++i) {
    double bad = start + (end - start) * i / k_steps;
    if (has_arms(bad)) {
      good = bad;
      continue;
    }
    for (int bisection = 0; bisection < k_bisections; ++bisection) {
      const double middle = 0.5 * (good + bad);
      (has_arms(middle) ? good : bad) = middle;
    }
    return good;
  }
  return end;
}

/// The element of the pitch curve that touches the tendon at one point of the declared motion, in the image. mm, rad.
struct CurveElement {
  double normal = 0;   ///< in the pulley's frame
  double support = 0;  ///< distance of the tangent from the pulley's axis
  double arc = 0;      ///< up to a constant
  double reach = 0;    ///< w: length of the declared line from the foot of the axis' perpendicular
  double slope = 0;    ///< d support / d declared α: p'
  double ahead = 0;    ///< dh/dψ: distance from that foot to the element, towards the pin
};

// The tendon is inextensible: its lengths above the pin, between pin and pulley, and on the pulley have a constant sum
// along the target motion. This gives the arc in closed form: s = −L_up(θ) − (w − h') + ρψ. The contact is at h n + h'
// t, not at the foot of the axis' perpendicular. From ψ' = 1 + p'/w follows h' = p'/(1 + p'/w).
CurveElement curve_element(const transmission::PinPlace& place, transmission::Side side,
                           const transmission::TransmissionPoint& at, double offset) {
  const double sign = transmission::mirror_sign(side);
  const transmission::TendonPoint& tendon = side == transmission::Side::right ? at.t2 : at.t1;
  const double lower_normal = side == transmission::Side::right ? tendon.lower_normal : k_pi - tendon.lower_normal;
  CurveElement curve;
  curve.normal = lower_normal + sign * at.alpha;
  curve.support = tendon.p + offset;
  curve.reach = tendon.lower_reach;
  curve.slope = sign * tendon.dp;
  curve.ahead = curve.slope / (1.0 + curve.slope / curve.reach);
  curve.arc = -tendon.free_upper - place.rho * tendon.wrap - curve.reach + curve.ahead + offset * curve.normal;
  return curve;
}

/// Arc from the range to the knots. If the range takes more than one turn of either pulley, both have helical grooves
/// with spare turns.
std::array<double, 2> arcs_to_knots(const JointModel& model, const Mechanism& mechanism) {
  const auto least = model.lower(model.alpha_least), most = model.lower(model.alpha_most);
  std::array<double, 2> spare{};
  bool is_multi_turn = false;
  for (const std::size_t i : {0, 1}) {
    const double sign = i == 1 ? 1.0 : -1.0;
    const double turned = most[i].normal - least[i].normal + sign * (model.alpha_most - model.alpha_least);
    is_multi_turn = is_multi_turn || std::abs(turned) > k_two_pi;
    // Spare turns are circular.
    spare[i] = k_two_pi * mechanism.body.spare_turns * std::abs((i == 1 ? least : most)[i].p);
    if (!std::isfinite(spare[i])) return {k_arc_to_knot, k_arc_to_knot};
  }
  const bool may_be_multi_turn = mechanism.pulley.winding != WindingChoice::one_turn;
  return is_multi_turn && may_be_multi_turn ? spare : std::array{k_arc_to_knot, k_arc_to_knot};
}

}  // namespace

MadePulleys MadePulleys::offset_by(double by) const {
  MadePulleys larger = *this;
  larger.offset_ += by;
  return larger;
}

// A line of the pulley's frame with the normal ψ_b has the direction ψ = ψ_b − α. It touches the mounted pin's circle
// on the outer side when
//   F = c cos(φ − ψ) + ρ − h(ψ_b) = 0.
// The curve is parametrized by the declared α0 at which each element is touched: ψ_b' = 1 + h'/w0, so F' = w ψ_b' − h'
// with w = c sin(φ − ψ). Newton's method on F starts at α0 = α, the solution for pins as declared.
LowerPath MadePulleys::path(transmission::Side side, const transmission::LowerGuide& mounted, double alpha,
                            const transmission::TransmissionPoint& first) const {
  const transmission::PinPlace& place = declared_.place(side);
  const double sign = transmission::mirror_sign(side);
  const double c = mounted.c();
  const double phi = mounted.phi();
  constexpr int k_steps = 20;
  constexpr double k_converged = 1e-12;  // of the distance c
  transmission::TransmissionPoint at = first;
  for (int i = 0; i < k_steps; ++i) {
    const CurveElement curve = curve_element(place, side, at, offset_);
    const double normal = curve.normal - sign * alpha;
    const double reach = c * elementary::sin(phi - normal);
    const double miss = c * elementary::cos(phi - normal) + mounted.rho - curve.support;
    if (std::abs(miss) <= k_converged * c) return {curve.support, normal, reach - curve.ahead, curve.arc};
    const double step = sign * miss / (reach * (1.0 + curve.slope / curve.reach) - curve.slope);
    // Iterates over the declared joint angle, in which the usual laws are closed formulas.
    const double theta = at.theta - step * at.g;
    if (!(std::abs(theta) < k_pi)) break;
    at = declared_.at_theta(theta);
  }
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {nan, nan, nan, nan};
}

std::array<LowerPath, 2> MadePulleys::paths(const std::array<transmission::LowerGuide, 2>& mounted,
                                            double alpha) const {
  const transmission::TransmissionPoint first = declared_.at_alpha(alpha);
  return {path(transmission::Side::left, mounted[0], alpha, first),
          path(transmission::Side::right, mounted[1], alpha, first)};
}

JointModel joint_model(const Mechanism& mechanism) {
  return joint_model(MadePulleys(mechanism), MountedMechanism{mechanism});
}

JointModel joint_model(const MadePulleys& made, const MountedMechanism& in) {
  const Mechanism& mounted = in.mechanism;
  const double rho = mounted.seen_pitch_radius();
  JointModel model;
  model.pins = {transmission::pin_place(mounted, transmission::Side::left, rho),
                transmission::pin_place(mounted, transmission::Side::right, rho)};
  model.lever = mounted.joint.R;
  model.lower = [made, pins = model.pins](double alpha) { return made.paths(pins, alpha); };
  model.expected = [made](double alpha) { return made.declared().theta(alpha); };
  model.alpha_least = made.declared().alpha_min();
  model.alpha_most = made.declared().alpha_max();
  model.arcs_to_knots = arcs_to_knots(model, mounted);
  set_statics(model, in);
  model.theta_least = last_with_arms(model.pins, 0.0, mounted.joint.theta_min - k_reach);
  model.theta_most = last_with_arms(model.pins, 0.0, mounted.joint.theta_max + k_reach);
  model.upper = std::make_shared<const UpperSpans>(model.pins, model.theta_least, model.theta_most, in.longer);
  return model;
}

double JointModel::dry_friction(double left, double right) const {
  if (rubbing == RubbingError{}) return bearing_friction;
  const double left_ratio = std::max(0.0, left) / k_usual_pull, right_ratio = std::max(0.0, right) / k_usual_pull;
  const double area = 0.5 * (elementary::pow(left_ratio, 2.0 / 3.0) + elementary::pow(right_ratio, 2.0 / 3.0));
  return bearing_friction + rubbing.by_area * area + rubbing.by_lesser * std::min(left_ratio, right_ratio);
}

void set_statics(JointModel& model, const MountedMechanism& in) {
  const Mechanism& mounted = in.mechanism;
  model.EA = section_stiffness(mounted.tendon);
  model.guide = transmission::guide_friction(mounted);
  model.sheath = transmission::sheath_load(mounted);
  model.drum_friction = mounted.joint.drum_mu;
  model.groove_friction = mounted.pulley.mu;
  model.pretension = mounted.tendon.pretension;
  model.weight = transmission::weight_moment(mounted.load);
  model.tilt = mounted.load.tilt;
  model.spring = mounted.spring;
}

}  // namespace fusee::joint
