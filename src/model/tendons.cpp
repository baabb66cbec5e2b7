#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/model.h"

namespace fusee::model {
namespace {

// Lengths and angles are computed for a tendon on the right. One on the left is mirrored about the y axis. In both
// cases θ is then positive towards the pin's side.

/// Number of intervals of the range in which a tendon is evaluated.
constexpr int k_intervals = 1000;

/// The upper part of a mirrored tendon: straight from its end to the pin, then round the pin.
struct UpperPart {
  /// From the end to the tangent point and round the pin to its rightmost point, mm, up to a constant.
  double length = 0;
  double normal = 0;  ///< angle of the outward normal of the straight part, rad
};

Vec2 mirrored(const Vec2& point, transmission::Side side) {
  return {transmission::mirror_sign(side) * point.x(), point.y()};
}

/// Position of a mirrored point of the link at a mirrored joint angle: clockwise rotation about O.
Vec2 at_angle(const Vec2& home, double theta) {
  const double c = elementary::cos(theta), s = elementary::sin(theta);
  return {c * home.x() + s * home.y(), c * home.y() - s * home.x()};
}

UpperPart upper_part_at(const WrappedTendon& tendon, double theta) {
  const Vec2 pin = mirrored(tendon.pin, tendon.side);
  const Vec2 to_end = at_angle(mirrored(tendon.end, tendon.side), theta) - pin;
  const double distance = to_end.norm();
  // Direction from the pin to the end. Measured from +y, so that it jumps only if the end passes below the pin.
  const double direction = 0.5 * k_pi + elementary::atan2(-to_end.x(), to_end.y());
  const double normal = direction - elementary::acos(std::min(1.0, tendon.rho / distance));
  return {std::sqrt(std::max(0.0, (distance - tendon.rho) * (distance + tendon.rho))) + tendon.rho * normal, normal};
}

/// Length of the tendon above its pin, mm, up to a constant. On a drum it falls by radius times angle.
double length_at(const WrappedTendon& tendon, double theta) {
  return tendon.drum > 0 ? -tendon.drum * theta : upper_part_at(tendon, theta).length;
}

/// Moment arm −dL/dθ: distance of the straight part from O, mm.
double arm_at(const WrappedTendon& tendon, double theta) {
  if (tendon.drum > 0) return tendon.drum;
  const Vec2 end = at_angle(mirrored(tendon.end, tendon.side), theta),
             normal = unit(upper_part_at(tendon, theta).normal);
  return end.dot(normal);
}

/// Angle of wrap that remains at the cylinder at every joint angle, rad: simulators require some wrap.
constexpr double k_always_wrapped = radians(10);

/// Sets the anchor below the pin, the point beyond the pin on its outer side, and the sheath. `least`, `most`: range of
/// the angle of the normal at which the tendon reaches the pin, rad; `R`: length of the link, mm.
void set_anchor(WrappedTendon& tendon, const transmission::PinPlace& place, double least, double most, double R) {
  // A tendon enters its sheath straight down if it is wrapped by at least 1° then.
  const bool goes_down = place.sheath_exit && least > radians(1);
  const double leaving = goes_down ? 0.0 : least - k_always_wrapped;  // angle of the normal below the pin
  // The tendon runs on in the direction of the normal turned clockwise by a right angle.
  const Vec2 normal = unit(leaving), onwards(normal.y(), -normal.x());
  const double reach = goes_down ? tendon.rho + 0.1 * R : 0.5 * R;  // from the pin to the anchor
  tendon.most_wrap = most - leaving;
  const Vec2 anchor = place.pin() + tendon.rho * normal + reach * onwards;
  tendon.anchor = mirrored(anchor, tendon.side);
  tendon.outer = mirrored(place.pin() + 3 * tendon.rho * unit(0.5 * (most + leaving)), tendon.side);
  // The length so far counts the arc down to a normal angle of 0.
  tendon.home_length += reach - tendon.rho * leaving;
  if (!place.sheath_exit) return;
  const Vec2 exit = place.pulley_axis() + Vec2(place.sheath_exit->across, place.sheath_exit->above);
  tendon.sheath_exit = mirrored(exit, tendon.side);
  tendon.home_length += (exit - anchor).norm();
}

/// Sets up a tendon that is never on a drum.
void set_free_tendon(WrappedTendon& tendon, const transmission::PinPlace& place, const AngleMap& map, double R) {
  double least = k_pi, most = -k_pi;
  for (int i = 0; i <= k_intervals; ++i) {
    const double theta =
        transmission::mirror_sign(tendon.side) * std::lerp(map.theta_min, map.theta_max, double(i) / k_intervals);
    const double normal = upper_part_at(tendon, theta).normal;
    least = std::min(least, normal);
    most = std::max(most, normal);
  }
  tendon.home_length = upper_part_at(tendon, 0).length;
  set_anchor(tendon, place, least, most, R);
}

/// Sets up a tendon that lies on a drum at every joint angle. Its contact ends where it leaves for the fixed pin. The
/// arc of the drum that is covered at every angle moves with the link: a chain of points of the link represents it. A
/// wrapping cylinder cannot: between two points on its surface, MuJoCo 3.14.0 alternates between both ways round.
void set_tendon_on_drum(WrappedTendon& tendon, const transmission::PinPlace& place, const AngleMap& map, double R) {
  const double sign = transmission::mirror_sign(tendon.side);
  const transmission::UpperSpan home = transmission::upper_span(place, 0),
                                low = transmission::upper_span(place, sign * map.theta_min),
                                high = transmission::upper_span(place, sign * map.theta_max);
  const double least = std::min(low.on_drum, high.on_drum);               // angle of wrap, rad
  const double always_covered = std::max(0.0, least - k_always_wrapped);  // rad
  // Simulators require points near a wrapping cylinder to be slightly outside of it.
  constexpr double k_outside = 1e-6;
  constexpr double k_longest_chord = radians(10);
  const double rho = place.drum, just_outside = rho * (1 + k_outside);
  tendon.drum = rho;
  const bool ends_on_drum = place.R < just_outside;
  if (ends_on_drum) tendon.end *= just_outside / place.R;
  const int chords = static_cast<int>(std::ceil(always_covered / k_longest_chord));
  for (int i = ends_on_drum ? 1 : 0; i <= chords && chords > 0; ++i)
    tendon.on_drum.push_back(mirrored(just_outside * unit(home.end_normal - always_covered * i / chords), tendon.side));
  // Mean angle of wrap after the points of the link, rad.
  const double wrapped = 0.5 * (low.on_drum + high.on_drum) - always_covered;
  tendon.drum_outer = mirrored(1.5 * rho * unit(home.normal + 0.5 * wrapped), tendon.side);
  tendon.off_drum =
      mirrored(0.5 * (rho * unit(home.normal) + place.pin() + place.rho * unit(home.normal)), tendon.side);
  tendon.home_length = home.length;
  // Chords are shorter than the arc that they replace.
  if (chords > 0)
    tendon.home_length +=
        2 * just_outside * chords * elementary::sin(0.5 * always_covered / chords) - rho * always_covered;
  set_anchor(tendon, place, home.normal, home.normal, R);
}

/// Sets up the tendon of a side. Returns the reason why simulators cannot represent it, or "". Simulators wrap a tendon
/// the shorter way round a cylinder, and require a point of it between two cylinders.
std::string set_tendon(WrappedTendon& tendon, const Mechanism& mechanism, transmission::Side side,
                       const AngleMap& map) {
  const transmission::PinPlace place = transmission::pin_place(mechanism, side, mechanism.seen_pitch_radius());
  tendon.side = side;
  tendon.pin = mirrored(place.pin(), side);
  tendon.rho = place.rho;
  tendon.end = place.at_C ? Vec2(0, place.R)
                          : mirrored(place.R * Vec2(elementary::sin(place.twist), elementary::cos(place.twist)), side);
  // Range of the mirrored joint angle, and the angle from which on the tendon has left the drum.
  const double sign = transmission::mirror_sign(side), low = std::min(sign * map.theta_min, sign * map.theta_max),
               high = std::max(sign * map.theta_min, sign * map.theta_max);
  const auto leaves = transmission::lift_off(place);
  if (leaves && place.drum_offset != 0) return "it lies on a drum whose centre moves with the joint";
  if (leaves && low < *leaves && *leaves < high)
    return "it leaves the drum within the range, and simulators require a fixed point between two "
           "cylinders";
  constexpr double k_most_wrap = radians(170);
  if (leaves && high <= *leaves) {
    set_tendon_on_drum(tendon, place, map, mechanism.joint.R);
    // The least wrap after the points of the link, plus the wrap that is added over the range.
    if (std::min(*leaves - high, k_always_wrapped) + high - low > k_most_wrap)
      return "it is wound on the drum by nearly half a turn, and simulators wrap it the shorter way";
  } else {
    set_free_tendon(tendon, place, map, mechanism.joint.R);
  }
  // Beyond half a turn the other way round would be the shorter one.
  if (tendon.rho > 0 && tendon.most_wrap > k_most_wrap)
    return "it wraps nearly half of its pin, and simulators wrap it the shorter way";
  return "";
}

/// True if the path has the moment arms of the transmission. They differ if the tendon also runs over another guide.
bool has_arms(const WrappedTendon& tendon, double R, const transmission::Transmission& law) {
  for (int i = 0; i <= 8; ++i) {
    const transmission::TransmissionPoint point = law.at_alpha(std::lerp(law.alpha_min(), law.alpha_max(), i / 8.0));
    const double arm = arm_at(tendon, transmission::mirror_sign(tendon.side) * point.theta);
    const double known = (tendon.side == transmission::Side::left ? point.t1 : point.t2).m;
    if (!(std::abs(arm - known) <= 1e-6 * R)) return false;
  }
  return true;
}

struct LengthFit {
  Polynomial length;  ///< mm over rad
  double error = 0;   ///< largest error of θ, rad
};

/// The length of a tendon minus that at home: a straight line in α if a line is exact, otherwise a polynomial of degree
/// k_equality_degree.
LengthFit fit_length(const WrappedTendon& tendon, const AngleMap& map) {
  const double home = length_at(tendon, 0), sign = transmission::mirror_sign(tendon.side);
  std::vector<FitPoint> points;
  for (int i = 0; i <= k_intervals; ++i) {
    const double alpha = std::lerp(map.alpha_min, map.alpha_max, double(i) / k_intervals),
                 theta = sign * map.theta(alpha);
    // The weight converts an error of the length to the error of θ that it causes.
    points.push_back({alpha, length_at(tendon, theta) - home, 1 / std::abs(arm_at(tendon, theta))});
  }
  constexpr double k_exact = 1e-9;  // rad, near the rounding of a fit
  PolynomialFit fit = least_largest_error(points, 1);
  if (fit.error > k_exact) fit = least_largest_error(points, k_equality_degree);
  return {fit.p, fit.error};
}

}  // namespace

double tendon_error(const WrappedTendon& tendon, const Polynomial& length, const AngleMap& map) {
  const double home = length_at(tendon, 0), sign = transmission::mirror_sign(tendon.side);
  double largest = 0;
  for (int i = 0; i <= k_intervals; ++i) {
    const double alpha = std::lerp(map.alpha_min, map.alpha_max, double(i) / k_intervals), wanted = map.theta(alpha);
    double theta = wanted;
    for (int step = 0; step < 20; ++step) {  // Newton's method
      const double missing = home + length(alpha) - length_at(tendon, sign * theta);
      const double move = -sign * missing / arm_at(tendon, sign * theta);
      if (!std::isfinite(move)) return k_pi;
      theta += move;
      if (std::abs(move) < 1e-13) break;
    }
    largest = std::max(largest, std::abs(theta - wanted));
  }
  return largest;
}

std::optional<TendonModel> tendon_model(const Mechanism& mounted, const AngleMap& map, std::string& why_not) {
  const transmission::Transmission law(mounted);
  TendonModel model;
  model.error = std::numeric_limits<double>::infinity();
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const std::size_t i = side == transmission::Side::left ? 0 : 1;
    WrappedTendon& tendon = model.tendons[i];
    model.omission[i] = set_tendon(tendon, mounted, side, map);
    if (model.omission[i].empty() && !has_arms(tendon, mounted.joint.R, law))
      model.omission[i] = "it does not run straight to its pin";
    if (!model.omission[i].empty()) {
      why_not = "tendon " + std::string(i == 0 ? "1" : "2") + ": " + model.omission[i];
      continue;
    }
    if (const LengthFit fit = fit_length(tendon, map); fit.error < model.error) {
      model.constrained = side;
      model.length = fit.length;
      model.error = fit.error;
    }
  }
  if (!model.omission[0].empty() && !model.omission[1].empty()) return std::nullopt;
  return model;
}

}  // namespace fusee::model
