#include "helix/pitch_spiral.h"

#include <algorithm>
#include <cmath>

namespace fusee::helix {
namespace {

// Number of equal intervals of the joint angle between samples of the working arc.
constexpr int k_samples = 192;

/// Weight w(u) that falls from 1 to 0 over the spare turns with zero slope at both ends, and its derivatives.
struct Taper {
  double w = 0, d1 = 0, d2 = 0;
};

/// The taper at the angle u of spare turns that have the angle `length`.
Taper taper(double u, double length) {
  const double x = u / length;
  return {1.0 - x * x * (3.0 - 2.0 * x), -6.0 * x * (1.0 - x) / length, -6.0 * (1.0 - 2.0 * x) / (length * length)};
}

/// ∫ sin v w(v) dv from 0 to u, by Simpson's rule. `length`: angle of the spare turns.
double tapered_sine_integral(double u, double length) {
  constexpr int k_steps = 64;
  const auto value = [length](double v) { return elementary::sin(v) * taper(v, length).w; };
  double sum = value(0.0) + value(u);
  for (int i = 1; i < k_steps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * value(u * i / k_steps);
  return sum * u / (3.0 * k_steps);
}

}  // namespace

PitchSpiral::PitchSpiral(const Mechanism& mechanism, const profile::TakeOffs& take_offs,
                         const transmission::ChebyshevSeries* lengthening)
    : take_offs_(take_offs),
      lengthening_(lengthening),
      collar_(mechanism.guides.collar),
      spare_(k_two_pi * mechanism.body.spare_turns),
      home_(take_offs.at(0.0)) {
  const double sign = transmission::mirror_sign(take_offs.side());
  const double first = sign > 0 ? mechanism.joint.theta_min : -mechanism.joint.theta_max;
  const double last = sign > 0 ? mechanism.joint.theta_max : -mechanism.joint.theta_min;
  for (int i = 0; i <= k_samples; ++i)
    samples_.push_back(take_offs.at(i == k_samples ? last : first + (last - first) * i / k_samples));
}

FreePath PitchSpiral::free_path(const profile::TakeOff& take_off) const {
  const transmission::TendonPoint& tendon = take_offs_.tendon(take_off);
  FreePath path;
  path.whole = tendon.length - take_off.curve.dh;
  path.sloping = collar_ ? tendon.lower_reach - take_off.curve.dh : path.whole;
  return path;
}

// From the balance of lengths L + σ = q + const (sloped_paths.cpp), where L is the free path's whole length.
double PitchSpiral::sigma(const profile::TakeOff& take_off) const {
  return lengthened(take_off.stroke.alpha) - lengthened(home_.stroke.alpha) - free_path(take_off).whole +
         free_path(home_).whole;
}

// Within the working arc: Newton's method for the joint angle with this ψ, within the bracket of both neighbouring
// samples. dψ/dθ = (dψ/dα)/g.
SpiralPoint PitchSpiral::at(double psi) const {
  if (psi < working_begin())
    return beyond(working_begin() - psi, {samples_.front().curve, sigma(samples_.front())}, -1);
  if (psi > working_end()) return beyond(psi - working_end(), {samples_.back().curve, sigma(samples_.back())}, 1);
  const auto above =
      std::upper_bound(samples_.begin() + 1, samples_.end() - 1, psi,
                       [](double value, const profile::TakeOff& sample) { return value < sample.curve.psi; });
  const double sign = transmission::mirror_sign(take_offs_.side());
  double low = sign * (above - 1)->stroke.theta, high = sign * above->stroke.theta;
  profile::TakeOff found = *(above - 1);
  double theta = low;
  constexpr int k_most_steps = 60;
  constexpr double k_solved = 1e-13;  // relative
  for (int i = 0; i < k_most_steps; ++i) {
    const double miss = found.curve.psi - psi;
    if (std::abs(miss) < k_solved * (1.0 + std::abs(psi))) break;
    (miss > 0 ? high : low) = theta;
    double next = theta - miss * found.stroke.g / found.dpsi;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (next == theta) break;
    theta = next;
    found = take_offs_.at(theta);
  }
  return {found.curve, sigma(found)};
}

// Along u, outwards from an end of the working arc with the support h and d = ±dh/dψ, the support p and the radius of
// curvature ρ are
//   p = h + d sin u w      p' = d (cos u w + sin u w')      ρ = p + p'' = h + d (2 cos u w' + sin u w'')
//   ∫ρ du = p' − d + h u + d ∫ sin u w du
SpiralPoint PitchSpiral::beyond(double turned, const SpiralPoint& from, double direction) const {
  const double u = std::min(turned, spare_);
  const double d = direction * from.curve.dh;
  const Taper w = taper(u, spare_);
  const double slope = d * (elementary::cos(u) * w.w + elementary::sin(u) * w.d1);
  SpiralPoint point;
  point.curve.psi = from.curve.psi + direction * u;
  point.curve.h = from.curve.h + d * elementary::sin(u) * w.w;
  point.curve.dh = direction * slope;
  point.curve.radius = from.curve.h + d * (2.0 * elementary::cos(u) * w.d1 + elementary::sin(u) * w.d2);
  const double length = slope - d + from.curve.h * u + d * tapered_sine_integral(u, spare_);
  point.sigma = from.sigma + direction * length;
  return point;
}

}  // namespace fusee::helix
