#include "calibration/forward_motion.h"

#include <algorithm>
#include <cmath>

#include "transmission/tendon_balance.h"

// What is wound carries home's strain. The other law, the strain of the moment, gives with the same numbers a joint that yields under load by
// 15 % more where much is wound: six joints "measured" on a rig with other numerics (tests/data/rig) decide for this one, with
// residuals at the sensors' noise for both loads, directions and all places.

namespace fusee {

BenchMotion::BenchMotion(const JointModel& model, double slack) : model_(model) {
  const std::array<LowerPath, 2> paths = model.lower(0.0);
  const double arm1 = upper_span(model.pins[0], 0.0).m;
  const double arm2 = upper_span(model.pins[1], 0.0).m;
  for (std::size_t i = 0; i < 2; ++i) {
    const PinPlace& place = model.pins[i];
    const UpperSpan span = upper_span(place, 0.0);
    Tendon& tendon = tendons_[i];
    const double tension = i == 0 ? model.pretension : model.pretension * arm1 / arm2;
    tendon.sign = i == 0 ? -1.0 : 1.0;
    tendon.rim = 0.5 * (span.normal + paths[i].normal);
    tendon.density = 1.0 / (1.0 + tension / model.EA);
    tendon.upper_material = tendon.density * (span.free + place.rho * (span.normal - tendon.rim)) + 0.25 * slack;
    tendon.lower_material = tendon.density * (paths[i].reach + place.rho * (tendon.rim - paths[i].normal)) + 0.25 * slack;
    tendon.wound = paths[i].wound;
  }
  expected_ = model.expected(0.0);
}

BenchMotion::Pull BenchMotion::pull(const Tendon& tendon, const LowerPath& path, const PinPlace& place, double theta) const {
  const UpperSpan span = upper_span(place, tendon.sign * theta);
  const double wrap = span.normal - path.normal;
  Spans spans;
  spans.EA = model_.EA;
  spans.upper_length = span.free + place.rho * (span.normal - tendon.rim);
  spans.lower_length = path.reach + place.rho * (tendon.rim - path.normal);
  spans.upper_material = tendon.upper_material;
  spans.lower_material = tendon.lower_material;
  spans.capstan = std::exp(model_.mu * std::max(0.0, wrap));
  const TendonBalance now = balance(spans);
  double rate = -span.m * now.per_length;
  if (wrap > 0) rate -= now.per_capstan * model_.mu * place.R * std::cos(tendon.sign * theta + span.normal) / span.free;
  return {now.upper * span.m, rate * span.m + now.upper * span.dm, now.crossed};
}

std::optional<double> BenchMotion::to(double alpha, double torque) {
  const std::array<LowerPath, 2> paths = model_.lower(alpha);
  std::array<Tendon, 2> next = tendons_;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!std::isfinite(paths[i].wound)) return std::nullopt;
    next[i].lower_material -= (paths[i].wound - next[i].wound) * next[i].density;
    next[i].wound = paths[i].wound;
    if (!(next[i].lower_material > 0)) return std::nullopt;
  }
  std::array<Pull, 2> pulls;
  const auto excess = [&](double theta) {
    for (std::size_t i = 0; i < 2; ++i) pulls[i] = pull(next[i], paths[i], model_.pins[i], theta);
    return pulls[1].value - pulls[0].value - torque - model_.weight_torque(theta);
  };
  double low = model_.theta_least;
  double high = model_.theta_most;
  const double expected = model_.expected(alpha);
  double theta = theta_;
  // A joint that nothing pulls stays where it is.
  if (excess(theta) != 0) theta = std::clamp(theta_ + expected - expected_, low, high);
  bool found = false;
  for (int i = 0; i < 100 && !found; ++i) {
    const double value = excess(theta);
    if (!std::isfinite(value)) return std::nullopt;
    if (value == 0) break;
    (value > 0 ? low : high) = theta;
    const double slope = pulls[0].slope + pulls[1].slope - model_.weight_slope(theta);
    double to = slope < 0 ? theta - value / slope : 0.5 * (low + high);
    if (!(to > low && to < high) || i % 12 > 9) to = 0.5 * (low + high);
    found = std::abs(to - theta) < 1e-11 || !(high - low > 1e-13);
    theta = to;
  }
  if (theta - model_.theta_least < 1e-9 || model_.theta_most - theta < 1e-9) return std::nullopt;
  excess(theta);
  for (std::size_t i = 0; i < 2; ++i) {
    next[i].upper_material += pulls[i].crossed;
    next[i].lower_material -= pulls[i].crossed;
  }
  tendons_ = next;
  theta_ = theta;
  expected_ = expected;
  return theta;
}

}  // namespace fusee
