#include "fusee/transmission.h"

#include <algorithm>
#include <array>

#include "fusee/base.h"
#include "transmission/equations.h"
#include "transmission/table_law.h"
#include "transmission/torque_law.h"

namespace fusee::transmission {
namespace {

/// Moment arm of one tendon and its derivatives by the mechanism's θ.
struct Arm {
  UpperSpan span;
  double m = 0;
  double dm = 0;
  double d2m = 0;
};

Arm arm(const PinPlace& place, Side side, double theta) {
  const double sign = mirror_sign(side);
  const UpperSpan span = upper_span(place, sign * theta);
  return {span, span.m, sign * span.dm, span.d2m};
}

double to_world(Side side, double image_angle) { return side == Side::right ? image_angle : k_pi - image_angle; }

/// Difference of a pulley's radius from that of a planar tendon, with derivatives.
struct Excess {
  double p = 0, dp = 0, d2p = 0;
};

TendonPoint tendon_point(const PinPlace& place, Side side, const Arm& arm, double g, double dg, double d2g,
                         const Excess& excess) {
  TendonPoint point;
  point.m = arm.m;
  point.p = pulley_radius(arm.m, g) + excess.p;
  point.dp = arm.dm * g * g + arm.m * dg + excess.dp;
  point.d2p = arm.d2m * g * g * g + 3.0 * arm.dm * g * dg + arm.m * d2g + excess.d2p;
  Domain ignored_domain;  // NaN where the pin lies inside the pulley
  const LowerGuide guide = place.lower();
  const LowerLine<double> lower = lower_line(point.p, guide.rho, guide.c(), guide.phi(), ignored_domain);
  point.upper_normal = to_world(side, arm.span.normal);
  point.lower_normal = to_world(side, lower.normal);
  point.wrap = arm.span.normal - place.off_pin(lower.normal);
  point.free_upper = arm.span.free;
  point.lower_reach = lower.reach;
  point.in_sheath = place.in_sheath;
  point.length = point.free_upper + place.rho * point.wrap + point.lower_reach + point.in_sheath;
  return point;
}

/// Derivatives of θ(a(α)) with a = α + q/r1, for a sloping tendon on a round P1: chain rule up to the third derivative.
void apply_sloped_path(TransmissionPoint& point, const ChebyshevSeries::Value& q, double r1) {
  const double d1 = 1.0 + q.d1 / r1, d2 = q.d2 / r1, d3 = q.d3 / r1;
  const double g = point.g, dg = point.dg, d2g = point.d2g;
  point.g = g * d1;
  point.dg = dg * d1 * d1 + g * d2;
  point.d2g = d2g * d1 * d1 * d1 + 3.0 * dg * d1 * d2 + g * d3;
}

/// dq/dα in the tendon's image, by [h1] of physics.md and d(L + σ) = −m dθ + p dα.
Excess excess_of(const ChebyshevSeries::Value& q, Side side) {
  const double sign = mirror_sign(side);
  return {sign * q.d1, sign * q.d2, sign * q.d3};
}

/// Bisects to the place between `good` and `bad` where `holds` turns false, to machine precision.
template <typename Predicate>
double bisect_border(double good, double bad, Predicate holds) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (good + bad);
    (holds(middle) ? good : bad) = middle;
  }
  return bad;
}

/// The root of an increasing function in [low, high]: Newton steps, replaced by bisection when they leave the bracket.
template <typename ValueAndSlope>
double solve_increasing(double target, double low, double high, double start, ValueAndSlope evaluate) {
  double x = std::clamp(start, low, high);
  for (int i = 0; i < 80; ++i) {
    const auto [value, slope] = evaluate(x);
    const double miss = value - target;
    if (miss == 0) break;
    (miss > 0 ? high : low) = x;
    double next = x - miss / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 1e-15 * (1.0 + std::abs(x))) return next;
    x = next;
  }
  return x;
}

/// Margin of the root search beyond the range, as a fraction of the range: integrators and root finders step over its
/// ends.
constexpr double k_margin = 0.02;

}  // namespace

Transmission::Transmission(const Transmission&) = default;
Transmission::Transmission(Transmission&&) noexcept = default;
Transmission& Transmission::operator=(const Transmission&) = default;
Transmission& Transmission::operator=(Transmission&&) noexcept = default;
Transmission::~Transmission() = default;

Transmission::Transmission(const Mechanism& mechanism) : Transmission(mechanism, mechanism.seen_pitch_radius()) {}

Transmission::Transmission(const Mechanism& mechanism, std::shared_ptr<const SlopedPaths> paths)
    : Transmission(mechanism) {
  paths_ = std::move(paths);
  if (paths_ != nullptr && !dead_centre_) find_range();
}

Transmission::Transmission(const Mechanism& mechanism, double rho)
    : law_(mechanism.pulley.law),
      r1_(mechanism.pulley.r1),
      ratio_(mechanism.pulley.ratio),
      left_(pin_place(mechanism, Side::left, rho)),
      right_(pin_place(mechanism, Side::right, rho)),
      theta_min_(mechanism.joint.theta_min),
      theta_max_(mechanism.joint.theta_max) {
  if (law_ == Law::table) table_ = std::make_shared<const TableLaw>(mechanism.pulley.rows);
  if (law_ == Law::torque) {
    torque_ = std::make_shared<const TorqueLaw>(mechanism);
    dead_centre_ = torque_->fails_at();
  }
  home_length_ = upper_span(left_, 0.0).length;

  const auto has_arms = [this](double theta) {
    return upper_span(left_, -theta).m > 0 && upper_span(right_, theta).m > 0;
  };
  // The search runs from home outwards, so that the first failing angle is reported.
  constexpr int steps = 64;
  for (int i = 0; i <= steps && !dead_centre_; ++i) {
    for (const double end : {theta_min_, theta_max_}) {
      const double theta = end * i / steps;
      if (!has_arms(theta)) dead_centre_ = i == 0 ? 0.0 : bisect_border(end * (i - 1) / steps, theta, has_arms);
    }
  }
  if (!dead_centre_) find_range();
}

void Transmission::find_range() {
  const double first = alpha(theta_min_), last = alpha(theta_max_);
  alpha_min_ = first;
  alpha_max_ = last;
}

// A round P1 pays out r1 α, of which q1 does not reach the joint. The remainder turns the joint like a planar tendon at
// α + q1(α)/r1.
double Transmission::alpha(double theta) const {
  const double planar = planar_alpha(theta);
  if (law_ != Law::compensate || paths_ == nullptr) return planar;
  double alpha = planar;
  for (int i = 0; i < 60; ++i) {
    const double next = planar - paths_->q1.at(alpha).d0 / r1_;
    if (std::abs(next - alpha) <= 1e-15 * (1.0 + std::abs(alpha))) return next;
    alpha = next;
  }
  return alpha;
}

double Transmission::theta(double alpha) const {
  const bool has_sloped_path = law_ == Law::compensate && paths_ != nullptr;
  return planar_theta(has_sloped_path ? alpha + paths_->q1.at(alpha).d0 / r1_ : alpha);
}

double Transmission::planar_alpha(double theta) const {
  switch (law_) {
    case Law::compensate:
      // Tendon 1 is wound on a round pulley: P1 pays out what the upper span takes.
      return (upper_span(left_, -theta).length - home_length_) / r1_;
    case Law::linear:
      return theta * ratio_;
    case Law::torque:
      return torque_->alpha(theta);
    case Law::table:
      break;
  }
  const double reach = table_->last_alpha() - table_->first_alpha();
  const double low = table_->first_alpha() - k_margin * reach;
  const double high = table_->last_alpha() + k_margin * reach;
  return solve_increasing(theta, low, high, 0.5 * (low + high), [this](double a) {
    const LawValue value = table_->at(a);
    return std::array{value.theta, value.d1};
  });
}

double Transmission::planar_theta(double alpha) const {
  switch (law_) {
    case Law::compensate:
    case Law::torque:
      break;
    case Law::linear:
      return alpha / ratio_;
    case Law::table:
      return table_->at(alpha).theta;
  }
  const double span = theta_max_ - theta_min_;
  const double stroke = alpha_max_ - alpha_min_;
  const double start = theta_min_ + span * (alpha - alpha_min_) / stroke;
  return solve_increasing(alpha, theta_min_ - k_margin * span, theta_max_ + k_margin * span, start, [this](double t) {
    if (torque_) return std::array{torque_->alpha(t), 1.0 / torque_->at(t).d1};
    const UpperSpan upper = upper_span(left_, -t);
    return std::array{(upper.length - home_length_) / r1_, upper.m / r1_};
  });
}

TransmissionPoint Transmission::at_alpha(double alpha) const { return at(alpha, theta(alpha)); }

TransmissionPoint Transmission::at_theta(double theta) const { return at(alpha(theta), theta); }

TransmissionPoint Transmission::at(double alpha, double theta) const {
  const Arm arm1 = arm(left_, Side::left, theta);
  const Arm arm2 = arm(right_, Side::right, theta);
  TransmissionPoint point;
  point.alpha = alpha;
  point.theta = theta;
  switch (law_) {
    case Law::compensate:
      // p1 = m1 g = r1 for all α: its derivatives vanish, which gives those of g.
      point.g = slope_over_round_pulley(r1_, arm1.m);
      point.dg = -arm1.dm * point.g * point.g / arm1.m;
      point.d2g = -(arm1.d2m * point.g * point.g * point.g + 3.0 * arm1.dm * point.g * point.dg) / arm1.m;
      if (paths_ != nullptr) apply_sloped_path(point, paths_->q1.at(alpha), r1_);
      break;
    case Law::linear:
      point.g = 1.0 / ratio_;
      break;
    case Law::table:
    case Law::torque: {
      const LawValue value = torque_ ? torque_->at(theta) : table_->at(alpha);
      point.g = value.d1;
      point.dg = value.d2;
      point.d2g = value.d3;
      break;
    }
  }
  Excess excess1, excess2;
  if (paths_ != nullptr) {
    excess1 = excess_of(paths_->q1.at(alpha), Side::left);
    excess2 = excess_of(paths_->q2.at(alpha), Side::right);
  }
  point.t1 = tendon_point(left_, Side::left, arm1, point.g, point.dg, point.d2g, excess1);
  point.t2 = tendon_point(right_, Side::right, arm2, point.g, point.dg, point.d2g, excess2);
  if (law_ == Law::compensate) {
    // Exactly round, without rounding error: a round P1 must give a circular outline.
    point.t1.p = r1_;
    point.t1.dp = 0;
    point.t1.d2p = 0;
  }
  return point;
}

}  // namespace fusee::transmission
