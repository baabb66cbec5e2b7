#include "export/report/tendon_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fusee/base.h"

namespace fusee::formats {
namespace {

/// Direction (rad) of the outward normal of the tangent from `point` to a circle, which the tendon passes on its outer
/// side. `point_above`: the point is the tendon's end at the joint, otherwise a point of the pulley. `sign`:
/// mirror_sign() of the side. NaN if the point is inside the circle.
double tangent_normal(const Vec2& centre, double rho, const Vec2& point, bool point_above, double sign) {
  const Vec2 to_point = point - centre;
  const double opening = elementary::acos(rho / to_point.norm());
  const double direction = elementary::atan2(to_point.y(), to_point.x());
  // Right tendon: the outer side is clockwise of a point above, counter-clockwise of a point below.
  return direction + (point_above ? -sign : sign) * opening;
}

struct PulleyContact {
  std::size_t index = 0;  ///< in the outline
  double normal = 0;      ///< of the lower span, in the world, rad
};

/// The common outer tangent of the pin (or of the sheath's exit) and the turned pitch polygon: the outermost of the
/// tangents from the vertices.
std::optional<PulleyContact> pulley_contact(const Mechanism& mechanism, const profile::Outline& outline, double alpha) {
  const double sign = transmission::mirror_sign(outline.side);
  const bool sheathed = mechanism.sheath.is_there();
  const Vec2 pin = sheathed ? sheath_exit(mechanism, outline.side) : pin_centre(mechanism, outline.side);
  const Vec2 axis = pulley_axis(mechanism);
  const double rho = sheathed ? 0.0 : mechanism.guide_pitch_radius();
  // Measured from the tangent towards the axis, so that the comparison never crosses ±π.
  const double reference = tangent_normal(pin, rho, axis, false, sign);
  PulleyContact best;
  double outermost = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const Vec2 vertex = axis + turned(outline.points[i].position, -alpha);
    const double normal = tangent_normal(pin, rho, vertex, false, sign);
    if (!std::isfinite(normal)) return std::nullopt;
    const double outward = sign * std::remainder(normal - reference, k_two_pi);
    if (outward > outermost) {
      outermost = outward;
      best = {i, normal};
    }
  }
  if (!std::isfinite(outermost)) return std::nullopt;
  return best;
}

/// Vertices from `first` to the anchor's end of the active arc; only `first` if it already lies at or beyond that end.
std::vector<std::size_t> wound_indices(const profile::Outline& outline, std::size_t first) {
  const std::size_t n = outline.points.size();
  const std::size_t last = outline.anchor_end();
  const bool forward = outline.side == transmission::Side::left;
  const auto steps_between = [&](std::size_t from, std::size_t to) {
    return forward ? (to + n - from) % n : (from + n - to) % n;
  };
  const std::size_t active_steps = steps_between(forward ? outline.active_first : outline.active_last, last);
  const std::size_t steps = steps_between(first, last);
  std::vector<std::size_t> indices{first};
  // A take-off up to two vertices beyond the active arc's unwound end still winds all of it.
  if (steps > active_steps + 2) return indices;
  for (std::size_t k = 1; k <= steps; ++k) indices.push_back(forward ? (first + k) % n : (first + n - k) % n);
  return indices;
}

double length_of(const std::vector<Vec2>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// Points of an arc every few degrees, both ends included.
std::vector<Vec2> arc(const Vec2& centre, double radius, double from, double to) {
  const int steps = std::clamp(static_cast<int>(std::ceil(std::abs(to - from) / radians(4))), 1, 360);
  std::vector<Vec2> points;
  for (int i = 0; i <= steps; ++i) points.push_back(centre + radius * unit(from + (to - from) * i / steps));
  return points;
}

}  // namespace

Vec2 pulley_axis(const Mechanism& mechanism) { return {0, -mechanism.guides.OE - mechanism.pulley.EF}; }

Vec2 pin_centre(const Mechanism& mechanism, transmission::Side side) {
  const Guides& guides = mechanism.guides;
  return side == transmission::Side::left ? Vec2(-guides.EB, -guides.OE)
                                          : Vec2(guides.ED, -guides.OE - guides.D_below_B);
}

Vec2 sheath_exit(const Mechanism& mechanism, transmission::Side side) {
  return pulley_axis(mechanism) +
         Vec2(transmission::mirror_sign(side) * mechanism.sheath.exit_across, mechanism.sheath.exit_above);
}

std::vector<Vec2> sheath_curve(const Mechanism& mechanism, transmission::Side side) {
  const double sign = transmission::mirror_sign(side);
  const Vec2 from = pin_centre(mechanism, side) + Vec2(sign * mechanism.guide_pitch_radius(), 0.0),
             to = sheath_exit(mechanism, side);
  const double reach = 0.5 * (to - from).norm();
  // A cubic Bézier curve that begins straight down and arrives at the exit from above and outside.
  const Vec2 down(0.0, -reach), outwards(0.9 * sign * reach, 0.0);
  const Vec2 first = from + down, second = to - down + outwards;
  constexpr int k_steps = 24;
  std::vector<Vec2> points;
  for (int i = 0; i <= k_steps; ++i) {
    const double u = static_cast<double>(i) / k_steps, v = 1.0 - u;
    points.push_back(v * v * v * from + 3 * v * v * u * first + 3 * v * u * u * second + u * u * u * to);
  }
  return points;
}

Vec2 attachment(const Mechanism& mechanism, transmission::Side side, double theta) {
  if (mechanism.joint.is_plain()) return mechanism.joint.R * Vec2(elementary::sin(theta), elementary::cos(theta));
  const transmission::PinPlace place = transmission::pin_place(mechanism, side, mechanism.guide_pitch_radius());
  const double angle = theta + transmission::mirror_sign(side) * place.twist;
  return place.R * Vec2(elementary::sin(angle), elementary::cos(angle));
}

// The tendon as a taut string over the drawn shapes: the tangent from C to the pin, the common tangent of the pin and
// the pitch polygon, then along the polygon. Only α and θ come from the transmission. A constant length of the path
// over the stroke therefore tests both synthesis and drawing.
std::optional<TendonTrace> trace_tendon(const Mechanism& mechanism, const profile::Outline& outline, double alpha,
                                        double theta) {
  if (outline.points.size() < 3) return std::nullopt;
  const double sign = transmission::mirror_sign(outline.side);
  const double rho = mechanism.guide_pitch_radius();
  const Vec2 pin = pin_centre(mechanism, outline.side);
  TendonTrace trace;
  trace.attachment = attachment(mechanism, outline.side, theta);
  double upper = tangent_normal(pin, rho, trace.attachment, true, sign);
  std::vector<Vec2> over_drum;
  double length_to_drum_end = 0;  // from the attachment to where the tendon leaves the drum
  if (mechanism.joint.drum_radius > 0) {
    const transmission::PinPlace place = transmission::pin_place(mechanism, outline.side, rho);
    const transmission::UpperSpan span = transmission::upper_span(place, sign * theta);
    if (span.on_drum > 0) {
      const auto world = [sign](double normal) { return sign > 0 ? normal : k_pi - normal; };
      upper = world(span.normal);
      over_drum = arc({0, 0}, place.drum, world(span.end_normal), upper);
      length_to_drum_end = (over_drum.front() - trace.attachment).norm() + place.drum * span.on_drum;
    }
  }
  const auto contact = pulley_contact(mechanism, outline, alpha);
  if (!std::isfinite(upper) || !contact) return std::nullopt;
  const bool sheathed = mechanism.sheath.is_there();
  const double off_pin = !sheathed ? contact->normal : sign > 0 ? 0.0 : k_pi;
  // Wrap is positive when the tendon lies on the pin: the normal turns clockwise on the right on its way down.
  const double wrap = -sign * std::remainder(off_pin - upper, k_two_pi);
  trace.onto_pin = pin + rho * unit(upper);
  trace.off_pin = pin + rho * unit(off_pin);
  const Vec2 axis = pulley_axis(mechanism);
  for (const std::size_t i : wound_indices(outline, contact->index)) {
    trace.wound_path.push_back(axis + turned(outline.points[i].position, -alpha));
  }
  trace.take_off = trace.wound_path.front();
  const Vec2 from = over_drum.empty() ? trace.attachment : over_drum.back();
  trace.free_path = arc(pin, rho, upper, upper - sign * wrap);
  trace.free_path.insert(trace.free_path.begin(), over_drum.begin(), over_drum.end());
  trace.free_path.insert(trace.free_path.begin(), trace.attachment);
  Vec2 onto_pulley = trace.off_pin;
  if (sheathed) {
    const std::vector<Vec2> through = sheath_curve(mechanism, outline.side);
    trace.free_path.insert(trace.free_path.end(), through.begin(), through.end());
    onto_pulley = through.back();
  }
  trace.free_path.push_back(trace.take_off);
  trace.free_length =
      length_to_drum_end + (trace.onto_pin - from).norm() + rho * wrap + (trace.take_off - onto_pulley).norm();
  if (sheathed) trace.free_length += mechanism.sheath.length;
  trace.wound_length = length_of(trace.wound_path);
  return trace;
}

}  // namespace fusee::formats
