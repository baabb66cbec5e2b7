#include "rig/bench.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fusee::rig {
namespace {

/// Tendon that moves over a pin by this much has the friction of its new direction, but for 1/e. mm
constexpr double k_bristle = 2e-4;
constexpr double k_furthest = radians(85.0);

Vec2 mirrored(const Vec2& point) { return {-point.x(), point.y()}; }

/// Where a falling function that is positive at `low` first is not: false position with the Illinois rule.
template <typename Function>
double crossing(double low, double at_low, double high, double at_high, double tolerance, Function function) {
  int side = 0;
  for (int i = 0; i < 200 && high - low > tolerance; ++i) {
    double middle = (low * at_high - high * at_low) / (at_high - at_low);
    // Kinks can hold one end for long.
    if (!(middle > low && middle < high) || i % 12 > 9) middle = 0.5 * (low + high);
    const double value = function(middle);
    if (value > 0) {
      low = middle;
      at_low = value;
      if (side == 1) at_high *= 0.5;
      side = 1;
    } else {
      high = middle;
      at_high = value;
      if (side == -1) at_low *= 0.5;
      side = -1;
    }
  }
  return high;
}

/// The printed outline with all that is wrong with it, as the right-hand image sees it.
Hull printed(const Outline& outline, std::size_t side, const Hidden& hidden) {
  Polygon corners;
  corners.reserve(outline.points.size());
  for (const OutlinePoint& point : outline.points) {
    const double wave = hidden.profile_error * std::cos(hidden.profile_harmonic * point.psi + hidden.profile_phase);
    const Vec2 moved = (1.0 + hidden.pulley_scale) * point.position + (hidden.radius_offset + wave) * point.normal +
                       Vec2(hidden.runout_x, hidden.runout_y);
    corners.push_back(side == 0 ? mirrored(moved) : moved);
  }
  return hull_of(corners);
}

/// A hardening tendon follows T = E' ε (1 + ε/h): E' such that dT/dε is as declared at the declared pretension.
double softer_at_rest(double EA, double pretension, double hardening) {
  // x = ε/h there: EA = E' (1 + 2x), pretension = E' h x (1 + x).
  const double c = pretension / (EA * hardening);
  const double x = 0.5 * (2.0 * c - 1.0 + std::sqrt((1.0 - 2.0 * c) * (1.0 - 2.0 * c) + 4.0 * c));
  return EA / (1.0 + 2.0 * x);
}

double direction(const Vec2& v) { return std::atan2(v.y(), v.x()); }

Vec2 turned(const Vec2& v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// Unstretched length of what lies on the pulley between two arcs; below what was laid since home all is as at home.
double unstretched(const std::vector<LaidTendon>& laid, double home_density, double from, double to) {
  double material = 0;
  double end = to;
  for (auto piece = laid.rbegin(); piece != laid.rend() && end > from; ++piece) {
    const double start = std::max(from, piece->from);
    if (start >= end) continue;
    material += (end - start) * piece->density;
    end = start;
  }
  return material + std::max(0.0, end - from) * home_density;
}

/// Off comes what was laid above `wound`; what is new goes on.
void lay(std::vector<LaidTendon>& laid, double before, double wound, double density) {
  while (!laid.empty() && laid.back().from >= wound) laid.pop_back();
  if (wound > before) laid.push_back({before, density});
}

}  // namespace

// ---- at home --------------------------------------------------------------------------------------------------------

Bench::Bench(const MadeJoint& joint, const Hidden& hidden) : hidden_(hidden) {
  const DeclaredMechanism& declared = joint.declared;
  R_ = declared.joint.R + hidden.joint_length;
  friction_ = std::max(0.0, declared.guides.mu + hidden.friction);
  const double modulus = hidden.modulus > 0 ? hidden.modulus : declared.tendon.modulus;
  EA_ = modulus * k_pi * declared.tendon.diameter * declared.tendon.diameter / 4.0;
  if (hidden.hardening > 0) EA_ = softer_at_rest(EA_, declared.tendon.pretension, hidden.hardening);
  double arm = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    BenchTendon& tendon = tendons_[side];
    tendon.hull = printed(side == 0 ? joint.p1 : joint.p2, side, hidden);
    tendon.sign = side == 0 ? -1.0 : 1.0;
    const double outward = (side == 0 ? declared.guides.EB : declared.guides.ED) + hidden.guide_outward;
    tendon.pin = {{outward, -declared.guides.OE - hidden.guide_down},
                  declared.guides.radius + hidden.guide_radius + 0.5 * declared.tendon.diameter};
    tendon.axis = {0.0, -declared.guides.OE - declared.pulley.EF};
    const double own_arm = upper_string({0.0, R_}, tendon.pin).arm;
    const double pretension = hidden.slack > 0 ? 0.0 : declared.tendon.pretension;
    hang(tendon, side == 0 ? pretension : pretension * arm / own_arm, hidden.slack);
    arm = own_arm;
  }
}

/// Cut to length so that it carries `tension` at home; the friction of its pin is not in use.
void Bench::hang(BenchTendon& tendon, double tension, double slack) {
  const UpperString up = upper_string({0.0, R_}, tendon.pin);
  const Circle seen{tendon.pin.centre - tendon.axis, tendon.pin.radius};
  const LowerString low = lower_string(tendon.hull, seen, first_look(tendon.hull, seen));
  tendon.mark = 0.5 * (direction(up.normal) + direction(low.normal));
  tendon.density = 1.0 / (1.0 + strain_at(tension));
  tendon.upper = tendon.density * (up.length + tendon.pin.radius * (direction(up.normal) - tendon.mark)) + 0.25 * slack;
  tendon.lower =
      tendon.density * (low.length + tendon.pin.radius * (tendon.mark - direction(low.normal))) + 0.25 * slack;
  tendon.wound = low.arc;
  tendon.corner = low.corner;
  tendon.upper_tension = tendon.lower_tension = tension;
  tendon.push = tendon.home_push = tension * (turned(low.normal, -0.5 * k_pi) - turned(up.normal, -0.5 * k_pi));
}

// ---- the material ---------------------------------------------------------------------------------------------------

double Bench::strain_at(double tension) const {
  if (hidden_.hardening <= 0) return tension / EA_;
  return 0.5 * hidden_.hardening * (std::sqrt(1.0 + 4.0 * tension / (EA_ * hidden_.hardening)) - 1.0);
}

double Bench::tension(double length, double material, std::size_t side, const Conditions& at) const {
  const double warmth = at.warmth * (side == 0 ? hidden_.expansion_other : 1.0);
  const double strain = length / (material * (1.0 + hidden_.expansion * warmth)) - 1.0;
  if (!(strain > 0)) return 0.0;
  const double yielding = 1.0 + hidden_.creep * std::log10(1.0 + std::max(0.0, at.creep_time));
  const double stiffer = hidden_.hardening > 0 ? 1.0 + strain / hidden_.hardening : 1.0;
  return EA_ * strain * stiffer / yielding;
}

// ---- a step ---------------------------------------------------------------------------------------------------------

double Bench::lump(double alpha) const {
  if (hidden_.lump == 0) return 0;
  const double x = (alpha - hidden_.lump_at) / hidden_.lump_width;
  return hidden_.lump * std::exp(-0.5 * x * x);
}

Bench::Below Bench::below(std::size_t side, double pulley, double alpha, const Conditions& at, const Vec2& push) const {
  const BenchTendon& tendon = tendons_[side];
  const double image_angle = tendon.sign * pulley;
  Below below;
  below.pin = {tendon.pin.centre + hidden_.frame_give * (push - tendon.home_push), tendon.pin.radius};
  // The pulley stands still and the pin goes round it.
  const Circle seen{turned(below.pin.centre - tendon.axis, image_angle), tendon.pin.radius};
  const LowerString string = lower_string(tendon.hull, seen, tendon.corner);
  below.normal = direction(turned(string.normal, -image_angle));
  below.corner = string.corner;
  below.wound = string.arc;
  below.length = string.length + tendon.pin.radius * (tendon.mark - below.normal);
  below.length += tendon.sign * (lump(alpha) - lump(0.0));
  below.material = tendon.lower + at.let_go[side] - tendon.let_go;
  if (string.arc > tendon.wound) {
    const double density =
        hidden_.keeps_winding_strain ? 1.0 / (1.0 + strain_at(tendon.lower_tension)) : tendon.density;
    below.material -= density * (string.arc - tendon.wound);
  } else {
    below.material += unstretched(tendon.laid, tendon.density, string.arc, tendon.wound);
  }
  return below;
}

// What slips is where the tensions above and below differ by as much as the bristle holds. Both tensions fall to
// nothing when all their stretch has slipped away, which encloses it.
Bench::Trial Bench::tried(std::size_t side, const Below& below, double theta, const Conditions& at) const {
  const BenchTendon& tendon = tendons_[side];
  const double image_theta = tendon.sign * theta;
  const Vec2 end(R_ * std::sin(image_theta), R_ * std::cos(image_theta));
  const UpperString up = upper_string(end, below.pin);
  const double normal = direction(up.normal);
  const double length = up.length + below.pin.radius * (normal - tendon.mark);
  const double grip = friction_ * std::max(0.0, normal - below.normal);
  Trial trial;
  const auto slip = [&](double slipped) {
    const double towards = slipped > 0 ? 1.0 : -1.0;
    trial.slipped = slipped;
    trial.bristle = towards + (tendon.bristle - towards) * std::exp(-std::abs(slipped) / k_bristle);
    trial.upper_tension = tension(length, tendon.upper - slipped, side, at);
    trial.lower_tension = tension(below.length, below.material + slipped, side, at);
    return trial.lower_tension - trial.upper_tension * std::exp(grip * trial.bristle);
  };
  const double now = slip(0.0);
  if (now != 0) {
    const double towards = now > 0 ? 1.0 : -1.0;
    const auto left = [&](double way) { return towards * slip(towards * way); };
    // All the stretch there is, cooled tendon included.
    const double all = std::abs(length - tendon.upper) + std::abs(below.length - below.material) +
                       std::abs(hidden_.expansion * at.warmth) * (length + below.length);
    slip(towards * crossing(0.0, std::abs(now), all, left(all), 1e-13, left));
  }
  trial.torque = trial.upper_tension * up.arm;
  const Vec2 down = turned(Vec2(std::cos(below.normal), std::sin(below.normal)), -0.5 * k_pi);
  trial.push = trial.lower_tension * down - trial.upper_tension * turned(up.normal, -0.5 * k_pi);
  return trial;
}

double Bench::excess(const std::array<Below, 2>& below, double theta, const Conditions& at) const {
  const double weight = hidden_.gravity * std::sin(theta - hidden_.gravity_direction);
  return tried(1, below[1], theta, at).torque - tried(0, below[0], theta, at).torque - at.load * R_ + weight;
}

double Bench::dry_friction(const Conditions& at) const {
  const double speed = std::abs(step_) / std::max(1e-9, at.seconds) / hidden_.bearing_speed;
  return hidden_.bearing + hidden_.bearing_stick * std::exp(-speed * speed);
}

// From where it stands the joint goes towards what pulls harder, until the pull is used up.
double Bench::balanced(const std::array<Below, 2>& below, const Conditions& at) const {
  const double dry = hidden_.bearing + hidden_.bearing_stick > 0 ? dry_friction(at) : 0.0;
  const double now = excess(below, theta_, at);
  if (std::isnan(now)) return now;
  if (std::abs(now) <= dry) return theta_;
  const double towards = now > 0 ? 1.0 : -1.0;
  const auto left = [&](double way) { return towards * excess(below, theta_ + towards * way, at) - dry; };
  double low = 0;
  double at_low = std::abs(now) - dry;
  double high = std::max(1e-6, 1.2 * std::abs(step_));
  double at_high = left(high);
  while (at_high > 0) {
    low = high;
    at_low = at_high;
    high *= 2.0;
    if (!(std::abs(theta_ + towards * high) < k_furthest)) return std::numeric_limits<double>::quiet_NaN();
    at_high = left(high);
  }
  return theta_ + towards * crossing(low, at_low, high, at_high, 1e-12, left);
}

double Bench::to(double pulley, double alpha, const Conditions& at) {
  std::array<Vec2, 2> push{tendons_[0].push, tendons_[1].push};
  std::array<Below, 2> lower;
  std::array<Trial, 2> now;
  double theta = theta_;
  // A frame that gives moves the pins, which changes the pull.
  const int looks = hidden_.frame_give > 0 ? 6 : 1;
  for (int look = 0; look < looks; ++look) {
    for (std::size_t side = 0; side < 2; ++side) lower[side] = below(side, pulley, alpha, at, push[side]);
    theta = balanced(lower, at);
    if (!std::isfinite(theta)) return theta;
    for (std::size_t side = 0; side < 2; ++side) {
      now[side] = tried(side, lower[side], theta, at);
      push[side] = now[side].push;
    }
  }
  for (std::size_t side = 0; side < 2; ++side) {
    BenchTendon& tendon = tendons_[side];
    if (hidden_.keeps_winding_strain) {
      lay(tendon.laid, tendon.wound, lower[side].wound, 1.0 / (1.0 + strain_at(tendon.lower_tension)));
    }
    tendon.upper -= now[side].slipped;
    tendon.lower = lower[side].material + now[side].slipped;
    tendon.wound = lower[side].wound;
    tendon.corner = lower[side].corner;
    tendon.bristle = now[side].bristle;
    tendon.let_go = at.let_go[side];
    tendon.upper_tension = now[side].upper_tension;
    tendon.lower_tension = now[side].lower_tension;
    tendon.push = now[side].push;
  }
  step_ = theta - theta_;
  theta_ = theta;
  return theta;
}

}  // namespace fusee::rig
