#include "rig/bench.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fusee::rig {
namespace {

/// Constant of the Dahl bristle at a pin: after this sliding, 1/e of the change of direction remains, mm.
constexpr double k_bristle = 2e-4;
constexpr double k_furthest = radians(85.0);  // of a joint that is not declared to go further
constexpr double k_beyond_range = radians(25.0);
/// Distance of the knot along the groove beyond the last take-off of the range, mm.
constexpr double k_arc_to_knot = 5.0;
/// Time constant of the fastest creep element, √10 s.
constexpr double k_first_decade = 3.16;

/// To a tendon's image and back: tendon 1 is mirrored.
Vec2 in_image(std::size_t side, const Vec2& point) { return side == 0 ? Vec2(-point.x(), point.y()) : point; }

/// Root of a decreasing function in (low, high): false position with the Illinois rule.
template <typename Function>
double find_root_between(double low, double at_low, double high, double at_high, double tolerance, Function function) {
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

/// Root of a decreasing function with value `at_zero` > 0 at 0, bracketed from `guess`.
template <typename Function>
double find_root(double guess, double at_zero, Function function) {
  constexpr double k_tension = 1e-10;  // N
  double low = 0, at_low = at_zero;
  double high = guess > 0 ? guess : 1.0;
  double step = 0.02 * high;
  double at_high = function(high);
  if (at_high <= 0) {
    while (high - step > 0) {
      const double value = function(high - step);
      if (value > 0) return find_root_between(high - step, value, high, at_high, k_tension, function);
      high -= step, at_high = value;
      step *= 4.0;
    }
    return find_root_between(low, at_low, high, at_high, k_tension, function);
  }
  for (int i = 0; i < 60 && at_high > 0; ++i) {
    low = high, at_low = at_high;
    high += step;
    step *= 4.0;
    at_high = function(high);
  }
  return find_root_between(low, at_low, high, at_high, k_tension, function);
}

/// A point of the printed curve with all errors of the print, in the right-hand image.
Vec2 print_point(const profile::OutlinePoint& point, std::size_t side, const HiddenFaults& hidden) {
  const double wave = hidden.profile_error * std::cos(hidden.profile_harmonic * point.psi + hidden.profile_phase);
  const Vec2 moved = (1.0 + hidden.pulley_scale) * point.position + (hidden.radius_offset + wave) * point.normal +
                     Vec2(hidden.runout_x, hidden.runout_y);
  return in_image(side, moved);
}

Hull print_outline(const profile::Outline& outline, std::size_t side, const HiddenFaults& hidden) {
  Polygon corners;
  corners.reserve(outline.points.size());
  for (const profile::OutlinePoint& point : outline.points) corners.push_back(print_point(point, side, hidden));
  return hull_of(corners);
}

/// A printed helical groove with the same errors.
Hull print_spiral(const MadeSpiral& made, std::size_t side, const HiddenFaults& hidden) {
  Polygon corners;
  std::vector<double> heights;
  for (const helix::SpiralRow& row : made.rows) {
    corners.push_back(print_point({row.turn, {row.x, row.y}, {std::cos(row.turn), std::sin(row.turn)}}, side, hidden));
    heights.push_back(row.z);
  }
  auto home = static_cast<std::ptrdiff_t>(made.home);
  if (side == 0) {
    std::reverse(corners.begin(), corners.end());
    std::reverse(heights.begin(), heights.end());
    home = std::ssize(corners) - 1 - home;
  }
  return spiral_of(std::move(corners), std::move(heights), home);
}

/// A hardening tendon follows T = E' ε (1 + ε/h): E' such that dT/dε is as declared at the declared pretension.
double initial_stiffness(double EA, double pretension, double hardening) {
  // x = ε/h there: EA = E' (1 + 2x), pretension = E' h x (1 + x).
  const double c = pretension / (EA * hardening);
  const double x = 0.5 * (2.0 * c - 1.0 + std::sqrt((1.0 - 2.0 * c) * (1.0 - 2.0 * c) + 4.0 * c));
  return EA / (1.0 + 2.0 * x);
}

/// Upside down, the drum is a pulley below its pin.
Vec2 flipped(const Vec2& point) { return {point.x(), -point.y()}; }

constexpr int k_drum_corners = 2048;
constexpr int k_sheath_bends = 16;

double direction(const Vec2& v) { return std::atan2(v.y(), v.x()); }

/// Used share of the friction after sliding by `slipped` (Dahl 1968), > 0 towards the pulley.
double bend_bristle(double bristle, double slipped) {
  const double towards = slipped > 0 ? 1.0 : -1.0;
  return towards + (bristle - towards) * std::exp(-std::abs(slipped) / k_bristle);
}

Vec2 rotate(const Vec2& v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// The string from its attachment over the drum to the pin. Computed in the frame of the link: the pin moves around it,
/// and `over` follows.
UpperString find_upper_string(const BenchTendon& tendon, const Circle& pin, double theta, std::ptrdiff_t& over) {
  if (tendon.drum.corners.empty()) return upper_string(rotate(tendon.end, -theta), pin);
  const LowerString string = lower_string(tendon.drum, {flipped(rotate(pin.centre, theta)), pin.radius}, over);
  const auto count = static_cast<std::ptrdiff_t>(tendon.drum.corners.size());
  over = string.corner;
  const auto turns = static_cast<double>((string.corner - tendon.tied) / count);
  const std::size_t at = static_cast<std::size_t>(((string.corner % count) + count) % count);
  double on_drum = tendon.drum.arc[at] - tendon.drum.arc[static_cast<std::size_t>(tendon.tied)];
  on_drum += tendon.drum.around * std::max(0.0, turns);
  if (string.corner >= tendon.tied && on_drum < 0) on_drum += tendon.drum.around;
  return {string.length + on_drum, rotate(flipped(string.normal), -theta), string.arm};
}

}  // namespace

// ---- at home --------------------------------------------------------------------------------------------------------

Bench::Bench(const MadeJoint& joint, const HiddenFaults& hidden)
    : hidden_(hidden),
      longer_{Actors(hidden.longer[0], 0), Actors(hidden.longer[1], 1)},
      torque_(hidden.torque),
      dry_(hidden.dry) {
  const DeclaredMechanism& declared = joint.declared;
  collar_ = declared.guides.collar;
  R_ = declared.joint.R + hidden.joint_length;
  friction_ = std::max(0.0, declared.guides.mu + hidden.friction);
  if (declared.guides.kind == GuideKind::idler) {
    const double to_cord = declared.guides.radius + hidden.guide_radius + 0.5 * declared.tendon.diameter;
    const double bearing = std::max(0.0, declared.guides.bearing_friction + hidden.bearing_friction);
    friction_ = 0;
    turning_ = bearing * declared.guides.bearing_radius / to_cord;
  }
  furthest_ =
      std::max({k_furthest, declared.joint.theta_max + k_beyond_range, k_beyond_range - declared.joint.theta_min});
  if (declared.joint.is_plain()) furthest_ = k_furthest;
  torque_declared_ = declared.load.torque;
  weight_ = 9.80665 * declared.load.mass_kg * declared.load.lever;
  tilt_ = declared.load.tilt;
  spring_ = declared.spring;
  const double modulus = hidden.modulus > 0 ? hidden.modulus : declared.tendon.modulus;
  EA_ = modulus * k_pi * declared.tendon.diameter * declared.tendon.diameter / 4.0;
  if (hidden.hardening > 0) EA_ = initial_stiffness(EA_, declared.tendon.pretension, hidden.hardening);
  double arm = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    BenchTendon& tendon = tendons_[side];
    const MadeSpiral& spiral = joint.spirals[side];
    tendon.hull = spiral.rows.empty() ? print_outline(side == 0 ? joint.p1 : joint.p2, side, hidden)
                                      : print_spiral(spiral, side, hidden);
    tendon.held_at = spiral.held_at;
    tendon.sign = side == 0 ? -1.0 : 1.0;
    const double outward =
        (side == 0 ? declared.guides.EB : declared.guides.ED) + hidden.guide_outward + hidden.pin_outward[side];
    tendon.pin = {{outward, -declared.guides.OE - hidden.guide_down - hidden.pin_down[side]},
                  declared.guides.radius + hidden.guide_radius + 0.5 * declared.tendon.diameter};
    build_link(tendon, side, declared);
    tendon.axis = {0.0, -declared.guides.OE - declared.pulley.EF};
    if (declared.sheath.is_there()) add_sheath(tendon, declared);
    const double own_arm = level_arm_at_home(tendon);
    const double pretension = hidden.slack > 0 ? 0.0 : declared.tendon.pretension;
    const Vec2 pull = cut_to_length(tendon, side == 0 ? pretension : pretension * arm / own_arm, hidden.slack,
                                    side == 0 ? -joint.alpha_max : joint.alpha_min);
    now_.tension[side] = tendon.upper_tension;
    now_.pull[side] = in_image(side, pull);
    arm = own_arm;
  }
  // Actions start at home.
  Moment home = now_;
  home.seconds = 1e-9;
  for (Actors& actors : longer_) actors(home);
}

void Bench::build_link(BenchTendon& tendon, std::size_t side, const DeclaredMechanism& declared) const {
  const Joint& joint = declared.joint;
  const auto& own = side == 0 ? joint.attachment1 : joint.attachment2;
  const auto seen = [side](const Vec2& place) { return in_image(side, place); };
  tendon.end = own ? seen(Vec2(own->across, own->along) + hidden_.end_moved[side]) : Vec2(0.0, R_);
  if (!(joint.drum_radius > 0)) return;
  const double radius = joint.drum_radius + hidden_.drum_radius + 0.5 * declared.tendon.diameter;
  const Vec2 centre =
      seen(hidden_.drum_runout * Vec2(std::cos(hidden_.drum_runout_phase), std::sin(hidden_.drum_runout_phase)));
  // An attachment inside the drum is moved to the radius of the tendon's axis.
  const Vec2 from_centre = tendon.end - centre;
  if (from_centre.norm() < radius) tendon.end = centre + radius / from_centre.norm() * from_centre;
  Polygon corners = {flipped(tendon.end)};
  for (int i = 0; i < k_drum_corners; ++i) {
    const double angle = k_two_pi * i / k_drum_corners;
    corners.push_back(flipped(centre) + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  tendon.drum = hull_of(corners);
  const auto nearer = [&](const Vec2& a, const Vec2& b) { return (a - corners[0]).norm() < (b - corners[0]).norm(); };
  const Polygon& hull = tendon.drum.corners;
  tendon.over = tendon.tied = std::min_element(hull.begin(), hull.end(), nearer) - hull.begin();
}

// Equally spaced bends share length, compliance and friction of the sheath.
void Bench::add_sheath(BenchTendon& tendon, const DeclaredMechanism& declared) const {
  const Sheath& sheath = declared.sheath;
  tendon.guide = {tendon.axis + Vec2(sheath.exit_across, sheath.exit_above), 0.0};
  const double compliance =
      std::max(0.0, (sheath.stiffness > 0 ? 1.0 / sheath.stiffness : 0.0) + hidden_.sheath_compliance);
  const double log_ratio = std::max(0.0, sheath.mu * sheath.bend + hidden_.sheath_friction);
  for (int i = 0; i <= k_sheath_bends; ++i) {
    const double share = (i == 0 || i == k_sheath_bends ? 0.5 : 1.0) / k_sheath_bends;
    tendon.sheath.push_back({share * sheath.length, share * compliance, i == 0 ? 0.0 : log_ratio / k_sheath_bends});
  }
}

Circle Bench::seen_guide(const BenchTendon& tendon, const Circle& pin) const {
  const Circle& guide = tendon.sheath.empty() ? pin : tendon.guide;
  return {guide.centre - tendon.axis, guide.radius};
}

double Bench::pull_through(std::vector<SheathPiece>& sheath, const Cord& cord, double home, double tension,
                           double& slipped) {
  for (SheathPiece& piece : sheath) {
    piece.bristle = bend_bristle(piece.bristle, slipped);
    tension *= std::exp(-piece.log_ratio * piece.bristle);
    const double material = cord.material(piece.length - piece.compliance * (tension - home), tension);
    slipped += material - piece.material;
    piece.material = material;
  }
  return tension;
}

/// Length of an evenly rising path per its length in the plane.
double Bench::length_ratio(double level, double rise) { return std::hypot(1.0, rise / level); }

/// Additional length of the straight span of a tendon with a collar.
double Bench::sloping_more(const BenchTendon& tendon, const LowerString& string) {
  return std::hypot(string.length, rise_of(tendon, string)) - string.length;
}

double Bench::rise_of(const BenchTendon& tendon, const LowerString& string) {
  return tendon.hull.is_helical() ? string.height - tendon.held_at : 0.0;
}

/// Torque on the joint per tension, of a tendon that may rise.
double Bench::level_arm_at_home(BenchTendon& tendon) const {
  const UpperString up = find_upper_string(tendon, tendon.pin, 0.0, tendon.over);
  if (collar_ || !tendon.hull.is_helical()) return up.arm;
  const Circle seen = seen_guide(tendon, tendon.pin);
  const LowerString low = lower_string(tendon.hull, seen, initial_corner(tendon.hull, seen));
  const double level = up.length + low.length + tendon.pin.radius * (direction(up.normal) - direction(low.normal));
  return up.arm / length_ratio(level, rise_of(tendon, low));
}

/// Lower per upper tension at this share of the friction. The load on an idler's bearing is the vector sum of both.
double Bench::ratio(double wrap, double bristle) const {
  if (turning_ == 0) return std::exp(friction_ * wrap * bristle);
  double lower = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double pressed = std::sqrt(1.0 + lower * lower - 2.0 * lower * std::cos(wrap));
    const double next = 1.0 + bristle * turning_ * pressed;
    if (std::abs(next - lower) < 1e-15) break;
    lower = next;
  }
  return lower;
}

/// Arc of the knot. A helical groove begins at its knot, behind its spare turns.
double Bench::knot_of(const BenchTendon& tendon, const Circle& seen, const LowerString& at_home, double unwound) {
  if (tendon.hull.is_helical()) return 0.0;
  // In steps of less than half a turn, within which the search is unambiguous.
  LowerString at_end = at_home;
  const int steps = 1 + static_cast<int>(std::abs(unwound));
  for (int i = 1; i <= steps; ++i)
    at_end = lower_string(tendon.hull, {rotate(seen.centre, unwound * i / steps), seen.radius}, at_end.corner);
  return at_end.arc - k_arc_to_knot;
}

/// Cuts the tendon to the length at which it has `tension` at home without friction. `unwound`: angle of the image at
/// which the knot is reached. Returns the unit force on the link's end, in the image.
Vec2 Bench::cut_to_length(BenchTendon& tendon, double tension, double slack, double unwound) {
  const UpperString up = find_upper_string(tendon, tendon.pin, 0.0, tendon.over);
  const Circle seen = seen_guide(tendon, tendon.pin);
  const LowerString low = lower_string(tendon.hull, seen, initial_corner(tendon.hull, seen));
  const Cord cord{EA_, hidden_.hardening, 1.0};
  // A sheath starts vertically.
  const double off_pin = tendon.sheath.empty() ? direction(low.normal) : 0.0;
  tendon.mark = tendon.sheath.empty() ? 0.5 * (direction(up.normal) + off_pin) : off_pin;
  double above = up.length + tendon.pin.radius * (direction(up.normal) - tendon.mark);
  double below = low.length + tendon.pin.radius * (tendon.mark - off_pin);
  if (tendon.hull.is_helical() && !collar_) {
    const double longer = length_ratio(above + below, rise_of(tendon, low));
    above *= longer;
    below *= longer;
  }
  if (collar_) below += sloping_more(tendon, low);
  for (SheathPiece& piece : tendon.sheath) piece.material = cord.material(piece.length, tension);
  tendon.upper = cord.material(above, tension) + 0.25 * slack;
  tendon.lower = cord.material(below, tension) + 0.25 * slack;
  tendon.wound = low.arc;
  tendon.corner = low.corner;
  tendon.laid =
      GrooveChain(tendon.hull, knot_of(tendon, seen, low, unwound), low.arc, tension, hidden_.groove_friction, cord);
  tendon.upper_tension = tendon.lower_tension = tendon.home_tension = tension;
  const Vec2 down = rotate(Vec2(std::cos(off_pin), std::sin(off_pin)), -0.5 * k_pi);
  const Vec2 pull = rotate(up.normal, -0.5 * k_pi);
  tendon.push = tendon.home_push = tension * (down - pull);
  return pull;
}

// ---- the material ---------------------------------------------------------------------------------------------------

Cord Bench::cord(std::size_t side, const Conditions& at) const {
  const double warmth = at.warmth * (side == 0 ? hidden_.expansion_other : 1.0);
  double crept = 0;
  for (const double strain : tendons_[side].crept) crept += strain;
  return {EA_, hidden_.hardening, (1.0 + hidden_.expansion * warmth) * (1.0 + crept)};
}

void Bench::creep(BenchTendon& tendon, double seconds) const {
  if (hidden_.creep == 0) return;
  const double tension = 0.5 * (tendon.upper_tension + tendon.lower_tension) - tendon.home_tension;
  double time = k_first_decade;
  for (double& strain : tendon.crept) {
    strain += (hidden_.creep * tension / EA_ - strain) * (1.0 - std::exp(-seconds / time));
    time *= 10.0;
  }
}

// ---- a step ---------------------------------------------------------------------------------------------------------

double Bench::lump(double alpha) const {
  if (hidden_.lump == 0) return 0;
  const double x = (alpha - hidden_.lump_at) / hidden_.lump_width;
  return hidden_.lump * std::exp(-0.5 * x * x);
}

Bench::LowerSpan Bench::place_lower_span(std::size_t side, const Conditions& at, double longer,
                                         const Vec2& moved) const {
  const BenchTendon& tendon = tendons_[side];
  const double image_angle = tendon.sign * at.pulley;
  LowerSpan below;
  below.pin = {tendon.pin.centre + moved, tendon.pin.radius};
  // In the frame of the pulley the pin moves around it.
  const Circle guide = seen_guide(tendon, below.pin);
  const Circle seen{rotate(guide.centre, image_angle), guide.radius};
  const LowerString string = lower_string(tendon.hull, seen, tendon.corner);
  below.normal = tendon.sheath.empty() ? direction(rotate(string.normal, -image_angle)) : 0.0;
  below.corner = string.corner;
  below.over = tendon.over;
  below.wound = string.arc;
  below.length = string.length + tendon.pin.radius * (tendon.mark - below.normal);
  if (collar_)
    below.length += sloping_more(tendon, string);
  else
    below.rise = rise_of(tendon, string);
  below.length += tendon.sign * (lump(at.alpha) - lump(0.0)) + longer;
  below.material = tendon.lower;
  below.cord = cord(side, at);
  below.laid = tendon.laid;
  below.laid.reach(string.arc, tendon.lower_tension, below.cord);
  below.laid.let_go(at.let_go[side] - tendon.let_go);
  below.guess = tendon.lower_tension;
  return below;
}

// The tension below the pin determines the exchange with the groove, the slip over the pin, the bristle and the tension
// above the pin. It is the root of: upper tension × friction ratio − lower tension.
Bench::Trial Bench::evaluate(std::size_t side, LowerSpan& below, double theta) const {
  const BenchTendon& tendon = tendons_[side];
  const double image_theta = tendon.sign * theta;
  const UpperString up = find_upper_string(tendon, below.pin, image_theta, below.over);
  const double normal = direction(up.normal);
  const double level = up.length + below.pin.radius * (normal - tendon.mark);
  const double longer = length_ratio(level + below.length, below.rise);
  const double length = level * longer, lower_length = below.length * longer;
  const double wrap = std::max(0.0, normal - below.normal) / longer;
  Trial trial;
  const auto slip = [&](double slipped) {
    trial.slipped = slipped;
    trial.bristle = bend_bristle(tendon.bristle, slipped);
    trial.upper_tension = below.cord.tension(length, tendon.upper - slipped);
  };
  const auto too_little = [&](double tension) {
    double slipped = below.cord.material(lower_length, tension) - below.material + below.laid.taken(tension);
    trial.pulley_tension = tension;
    trial.to_span = slipped;
    trial.sheath = tendon.sheath;
    trial.lower_tension = pull_through(trial.sheath, below.cord, tendon.home_tension, tension, slipped);
    slip(slipped);
    return trial.upper_tension * ratio(wrap, trial.bristle) - trial.lower_tension;
  };
  const double loose = too_little(0.0);
  if (loose > 0) {
    below.guess = find_root(below.guess, loose, too_little);
    too_little(below.guess);
  } else {
    // Both parts are slack: the smallest possible slip.
    const double least = trial.slipped;
    slip(std::clamp(0.0, least, std::max(least, tendon.upper - length / below.cord.natural)));
    trial.to_span += trial.slipped - least;
  }
  trial.torque = trial.upper_tension * up.arm / longer;
  trial.pull = rotate(up.normal, -0.5 * k_pi);
  const Vec2 down = rotate(Vec2(std::cos(below.normal), std::sin(below.normal)), -0.5 * k_pi);
  trial.push = trial.lower_tension * down - trial.upper_tension * trial.pull;
  return trial;
}

double Bench::excess_torque(std::array<LowerSpan, 2>& below, double theta, const Conditions& at) const {
  const double weight = hidden_.gravity * std::sin(theta - hidden_.gravity_direction);
  double all = evaluate(1, below[1], theta).torque - evaluate(0, below[0], theta).torque - at.load * R_ + weight;
  all -= torque_declared_ + weight_ * std::sin(tilt_ - theta);
  all -= spring_.preload + spring_.stiffness * (theta - spring_.free);
  if (!torque_.empty()) {
    Moment then = at;
    then.theta_speed = (theta - theta_) / std::max(1e-9, at.seconds);
    then.theta = theta;
    all += torque_.preview(then);
  }
  return all;
}

double Bench::dry_friction(const Conditions& at) {
  const double speed = std::abs(step_) / std::max(1e-9, at.seconds) / hidden_.bearing_speed;
  const double stick = hidden_.bearing_stick > 0 ? hidden_.bearing_stick * std::exp(-speed * speed) : 0.0;
  return std::max(0.0, hidden_.bearing + stick + dry_(at));
}

// From θ the joint moves in the direction of the excess torque until dry friction balances it.
double Bench::solve_balance(std::array<LowerSpan, 2>& below, const Conditions& at, double dry) const {
  const double now = excess_torque(below, theta_, at);
  if (std::isnan(now)) return now;
  if (std::abs(now) <= dry) return theta_;
  const double towards = now > 0 ? 1.0 : -1.0;
  const auto unbalanced = [&](double way) { return towards * excess_torque(below, theta_ + towards * way, at) - dry; };
  double low = 0;
  double at_low = std::abs(now) - dry;
  double high = std::max(1e-6, 1.2 * std::abs(step_));
  double at_high = unbalanced(high);
  while (at_high > 0) {
    low = high;
    at_low = at_high;
    high *= 2.0;
    if (!(std::abs(theta_ + towards * high) < furthest_)) return std::numeric_limits<double>::quiet_NaN();
    at_high = unbalanced(high);
  }
  return theta_ + towards * find_root_between(low, at_low, high, at_high, 1e-12, unbalanced);
}

/// Fixed point of displacements that depend on the forces: compliant pins, and elongations that depend on tension.
/// Broyden's method from the last displacements `there`; the Jacobian is recomputed if it does not converge. False
/// without convergence.
template <typename Answer>
bool Bench::solve_displacements(Answer answer, Displacements there) {
  constexpr double k_way = 1e-7, k_look = 1e-5;  // mm
  constexpr int k_astray = 15, k_most = 60;
  const auto apart_at = [&](const Displacements& ways) -> Displacements { return answer(ways) - ways; };
  Displacements apart = apart_at(there);
  for (int i = 1; i <= k_most && apart.allFinite(); ++i) {
    if (apart.norm() < k_way) return true;
    if (i % k_astray == 0) {
      Eigen::Matrix<double, 6, 6> slopes;
      for (Eigen::Index k = 0; k < 6; ++k)
        slopes.col(k) = (apart - apart_at(there + k_look * Displacements::Unit(k))) / k_look;
      towards_rest_ = slopes.inverse();
      if (!towards_rest_.allFinite()) break;
    }
    const Displacements step = towards_rest_ * apart;
    there += step;
    const Displacements now_apart = apart_at(there);
    const Displacements along = towards_rest_ * (now_apart - apart);
    const double share = step.dot(along);
    // A smaller denominator makes the update singular.
    if (std::abs(share) > 1e-3 * step.squaredNorm())
      towards_rest_ -= (step + along) * (step.transpose() * towards_rest_) / share;
    else
      towards_rest_.setIdentity();
    apart = now_apart;
  }
  towards_rest_.setIdentity();
  return false;
}

double Bench::to(double pulley, double alpha, const Conditions& conditions) {
  Conditions at = conditions;
  at.alpha = alpha;
  at.pulley = pulley;
  at.theta = theta_;
  at.theta_speed = now_.theta_speed;
  at.tension = now_.tension;
  at.pull = now_.pull;
  const double dry = dry_friction(at);
  std::array<LowerSpan, 2> lower;
  std::array<Trial, 2> now;
  double theta = theta_;
  const auto stand = [&](const Displacements& ways) {
    for (std::size_t side = 0; side < 2; ++side) {
      const auto own = static_cast<Eigen::Index>(3 * side);
      lower[side] = place_lower_span(side, at, ways[own], ways.segment<2>(own + 1));
    }
    theta = solve_balance(lower, at, dry);
    if (!std::isfinite(theta)) return;
    for (std::size_t side = 0; side < 2; ++side) {
      now[side] = evaluate(side, lower[side], theta);
      at.tension[side] = now[side].upper_tension;
      at.pull[side] = in_image(side, now[side].pull);
    }
    at.theta = theta;
    at.theta_speed = (theta - theta_) / std::max(1e-9, at.seconds);
  };
  const auto ways = [&](const std::array<Vec2, 2>& push) {
    Displacements all;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto own = static_cast<Eigen::Index>(3 * side);
      all[own] = longer_[side].preview(at);
      all.segment<2>(own + 1) = hidden_.frame_compliance * (push[side] - tendons_[side].home_push);
    }
    return all;
  };
  const auto answer = [&](const Displacements& before) -> Displacements {
    stand(before);
    return std::isfinite(theta) ? ways({now[0].push, now[1].push}) : Displacements::Constant(theta);
  };
  if (!solve_displacements(answer, ways({tendons_[0].push, tendons_[1].push})))
    return std::numeric_limits<double>::quiet_NaN();
  for (std::size_t side = 0; side < 2; ++side) {
    BenchTendon& tendon = tendons_[side];
    tendon.upper -= now[side].slipped;
    const double taken = lower[side].laid.settle(now[side].pulley_tension);
    tendon.lower = lower[side].material - taken + now[side].to_span;
    tendon.sheath = std::move(now[side].sheath);
    tendon.laid = std::move(lower[side].laid);
    tendon.wound = lower[side].wound;
    tendon.corner = lower[side].corner;
    tendon.over = lower[side].over;
    tendon.bristle = now[side].bristle;
    tendon.let_go = at.let_go[side];
    tendon.upper_tension = now[side].upper_tension;
    tendon.lower_tension = now[side].pulley_tension;
    tendon.push = now[side].push;
    creep(tendon, at.seconds);
    if (!longer_[side].empty()) longer_[side](at);
  }
  step_ = theta - theta_;
  theta_ = theta;
  if (!torque_.empty()) torque_(at);
  now_ = at;
  return theta;
}

}  // namespace fusee::rig
