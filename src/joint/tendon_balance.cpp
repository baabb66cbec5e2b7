#include "joint/tendon_balance.h"

#include <algorithm>
#include <cmath>

namespace fusee::joint {
namespace {

/// A tendon that slides over its pin: T_up = ratio · T_low.
struct SlidingTendon {
  const Spans& spans;
  double ratio;

  /// Material of both spans, and what their path lengths exceed it by. mm
  double total() const { return spans.upper_material + spans.lower_material; }
  double stretch() const { return spans.upper_length + spans.lower_length - total(); }

  // All material is in the two spans: X = Lu t/(k + t) + Ll t/(rk + t), with the upper tension t, the stretch X and k =
  // EA. A quadratic whose roots differ in sign: total·t² + b t − X r k² = 0.
  double upper_tension() const {
    const double k = spans.EA;
    const double b = k * (ratio * spans.upper_length + spans.lower_length - stretch() * (1.0 + ratio));
    const double c = stretch() * ratio * k * k;
    const double root = std::sqrt(b * b + 4.0 * total() * c);
    return b >= 0 ? 2.0 * c / (b + root) : (root - b) / (2.0 * total());
  }
  /// Derivative of the stretch by the upper tension `t`: dX/dt = Lu k/(k + t)² + r Ll k/(rk + t)². mm/N
  double slope(double t) const {
    const double k = spans.EA;
    const double u = k / (k + t);
    const double l = k / (ratio * k + t);
    return spans.upper_length * u * u / k + ratio * spans.lower_length * l * l / k;
  }
  /// Derivatives of the upper tension by the upper length, N/mm, and by the ratio, N, from the total differential of X.
  double per_length(double t) const { return (1.0 - t / (spans.EA + t)) / slope(t); }
  double per_ratio(double t) const {
    const double below = ratio * spans.EA + t;
    return spans.lower_length * t * spans.EA / (below * below) / slope(t);
  }
};

/// Without tension: material crosses only to relieve the span that was taut.
TendonBalance untensioned(const Spans& spans, double upper, double lower) {
  TendonBalance none;
  none.contact = PinContact::slack;
  if (upper > 0) none.crossed = spans.upper_length - spans.upper_material;
  if (lower > 0) none.crossed = spans.lower_material - spans.lower_length;
  return none;
}

}  // namespace

TendonBalance balance(const Spans& spans) {
  const double upper = tension_of(spans.EA, spans.upper_length, spans.upper_material);
  const double lower = tension_of(spans.EA, spans.lower_length, spans.lower_material);
  if (upper <= spans.capstan * lower && lower <= spans.capstan * upper) {
    TendonBalance stuck{upper, lower, 0.0, upper > 0 ? PinContact::stick : PinContact::slack};
    stuck.per_length = stuck_rate(spans, stuck);
    return stuck;
  }
  const bool up = upper > lower;
  const SlidingTendon sliding{spans, up ? spans.capstan : 1.0 / spans.capstan};
  if (!(sliding.stretch() > 0)) return untensioned(spans, upper, lower);
  const double t = sliding.upper_tension();
  TendonBalance slid{t, t / sliding.ratio, 0.0, up ? PinContact::slip_up : PinContact::slip_down};
  slid.crossed = spans.upper_length / (1.0 + t / spans.EA) - spans.upper_material;
  slid.per_length = sliding.per_length(t);
  slid.per_capstan = sliding.per_ratio(t) * sliding.ratio * (up ? 1.0 : -1.0);
  return slid;
}

double stuck_rate(const Spans& spans, const TendonBalance& now) {
  // The upper span's material after the crossing: L/(1 + T/EA).
  return now.upper > 0 ? (spans.EA + now.upper) / spans.upper_length : 0.0;
}

double sliding_rate(const Spans& spans, const TendonBalance& now) {
  if (!(now.upper > 0 && now.lower > 0)) return stuck_rate(spans, now);
  return SlidingTendon{spans, now.upper / now.lower}.per_length(now.upper);
}

}  // namespace fusee::joint
