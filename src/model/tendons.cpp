#include <algorithm>
#include <cmath>

#include "fusee/base/text.h"
#include "fusee/base/units.h"
#include "fusee/model/model.h"

namespace fusee {
namespace {

constexpr int k_places = 1000;

/// In the right-hand image, where θ is positive towards the pin's side.
struct Span {
  double length = 0;  ///< C to the tangent point, and on round the pin to its rightmost point; mm, but for a constant
  double normal = 0;  ///< direction of the outward normal, rad
};

Span span_at(const WrappedTendon& tendon, double R, double theta) {
  const Vec2 pin(mirror_sign(tendon.side) * tendon.pin.x(), tendon.pin.y());
  const Vec2 to_c = Vec2(R * std::sin(theta), R * std::cos(theta)) - pin;
  const double distance = to_c.norm();
  // From straight up, so that no turn is lost where C comes down beside the pin.
  const double towards_c = 0.5 * k_pi + std::atan2(-to_c.x(), to_c.y());
  const double normal = towards_c - std::acos(std::min(1.0, tendon.rho / distance));
  return {std::sqrt(std::max(0.0, (distance - tendon.rho) * (distance + tendon.rho))) + tendon.rho * normal, normal};
}

Vec2 mirrored(const Vec2& point, Side side) { return {mirror_sign(side) * point.x(), point.y()}; }

WrappedTendon wrapped(const Mechanism& mechanism, Side side, const AngleMap& map) {
  WrappedTendon tendon;
  tendon.side = side;
  const PinPlace place = pin_place(mechanism, side, mechanism.seen_pitch_radius());
  tendon.pin = mirrored(place.pin(), side);
  tendon.rho = place.rho;
  double least = k_pi, most = -k_pi;
  for (int i = 0; i <= k_places; ++i) {
    const double theta = mirror_sign(side) * std::lerp(map.theta_min, map.theta_max, double(i) / k_places);
    const double normal = span_at(tendon, mechanism.joint.R, theta).normal;
    least = std::min(least, normal);
    most = std::max(most, normal);
  }
  // Where it leaves the pin for a point that stands still: so far on that it lies on the pin at every angle.
  constexpr double k_always_wrapped = radians(10);
  const double leaving = least - k_always_wrapped;
  const Vec2 normal(std::cos(leaving), std::sin(leaving)), onwards(normal.y(), -normal.x());
  const double reach = 0.5 * mechanism.joint.R;
  tendon.most_wrap = most - leaving;
  const double middle = 0.5 * (most + leaving);
  tendon.anchor = mirrored(place.pin() + tendon.rho * normal + reach * onwards, side);
  tendon.outer = mirrored(place.pin() + 3 * tendon.rho * Vec2(std::cos(middle), std::sin(middle)), side);
  tendon.home_length = span_at(tendon, mechanism.joint.R, 0).length - tendon.rho * leaving + reach;
  return tendon;
}

/// −dL/dθ: how far the span passes from O, mm.
double arm_at(const WrappedTendon& tendon, double R, double theta) {
  return R * std::sin(theta + span_at(tendon, R, theta).normal);
}

/// Whether this path has the moment arms that the transmission knows: whatever else a joint's tendons run over, there
/// they differ.
bool has_arms(const WrappedTendon& tendon, double R, const Transmission& law) {
  for (int i = 0; i <= 8; ++i) {
    const TransmissionPoint point = law.at_alpha(std::lerp(law.alpha_min(), law.alpha_max(), i / 8.0));
    const double theta = mirror_sign(tendon.side) * point.theta;
    const double arm = arm_at(tendon, R, theta);
    const double known = (tendon.side == Side::left ? point.t1 : point.t2).m;
    if (!(std::abs(arm - known) <= 1e-6 * R)) return false;
  }
  return true;
}

struct Held {
  Polynomial length;
  double error = 0;
};

/// What the pulley takes of a tendon, as a polynomial of α of as low a degree as does.
Held fit_length(const WrappedTendon& tendon, double R, const AngleMap& map) {
  const double home = span_at(tendon, R, 0).length, sign = mirror_sign(tendon.side);
  std::vector<FitPoint> points;
  for (int i = 0; i <= k_places; ++i) {
    const double alpha = std::lerp(map.alpha_min, map.alpha_max, double(i) / k_places), theta = sign * map.theta(alpha);
    points.push_back({alpha, span_at(tendon, R, theta).length - home, 1 / std::abs(arm_at(tendon, R, theta))});
  }
  constexpr double k_exact = 1e-9;  // rad: round to the last digits that a fit has
  PolynomialFit fit = least_largest_error(points, 1);
  if (fit.error > k_exact) fit = least_largest_error(points, k_equality_degree);
  return {fit.p, fit.error};
}

}  // namespace

double tendon_error(const WrappedTendon& tendon, double R, const Polynomial& length, const AngleMap& map) {
  const double home = span_at(tendon, R, 0).length, sign = mirror_sign(tendon.side);
  double largest = 0;
  for (int i = 0; i <= k_places; ++i) {
    const double alpha = std::lerp(map.alpha_min, map.alpha_max, double(i) / k_places), wanted = map.theta(alpha);
    double theta = wanted;
    for (int turn = 0; turn < 20; ++turn) {
      const double missing = home + length(alpha) - span_at(tendon, R, sign * theta).length;
      const double move = -sign * missing / arm_at(tendon, R, sign * theta);
      if (!std::isfinite(move)) return k_pi;
      theta += move;
      if (std::abs(move) < 1e-13) break;
    }
    largest = std::max(largest, std::abs(theta - wanted));
  }
  return largest;
}

std::optional<TendonModel> tendon_model(const Mechanism& mounted, const AngleMap& map, std::string& why_not) {
  if (!mounted.joint.is_plain()) {
    why_not = "tendons over a drum of the joint, or to ends of their own, have no such model yet";
    return std::nullopt;
  }
  const Transmission law(mounted);
  TendonModel model;
  model.error = std::numeric_limits<double>::infinity();
  for (const Side side : {Side::left, Side::right}) {
    const std::size_t i = side == Side::left ? 0 : 1;
    model.tendons[i] = wrapped(mounted, side, map);
    if (!has_arms(model.tendons[i], mounted.joint.R, law)) {
      why_not = "the tendons of this joint do not run straight from C to a pin";
      return std::nullopt;
    }
    // The judges' joints lie round it by less; beyond half a turn the other way round would be the shorter one.
    constexpr double k_most_wrap = radians(170);
    if (model.tendons[i].rho > 0 && model.tendons[i].most_wrap > k_most_wrap) {
      why_not = "a tendon lies round nearly half of its pin, and simulators wrap it the shorter way";
      return std::nullopt;
    }
    if (const Held held = fit_length(model.tendons[i], mounted.joint.R, map); held.error < model.error) {
      model.held = side;
      model.length = held.length;
      model.error = held.error;
    }
  }
  return model;
}

}  // namespace fusee
