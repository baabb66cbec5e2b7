#include "profile/pitch_curve.h"

#include <algorithm>
#include <utility>

namespace fusee::profile {

double turned_into(double start, double psi) {
  const double turn = std::fmod(psi - start, k_two_pi);
  return start + (turn < 0 ? turn + k_two_pi : turn);
}

EnvelopeCurve::EnvelopeCurve(const TakeOffs& take_offs, const std::vector<TakeOff>& samples, const ClosingArc& closing,
                             std::vector<double> straight)
    : take_offs_(take_offs), samples_(samples), closing_(closing), straight_(std::move(straight)) {}

// The ends belong to the active arc in spite of rounding errors of full turns.
constexpr double k_rounding = 1e-12;
double EnvelopeCurve::turned(double psi) const { return turned_into(active_begin() - k_rounding, psi); }
bool EnvelopeCurve::is_active(double turned) const { return turned <= active_end() + k_rounding; }

CurvePoint EnvelopeCurve::at(double psi) const {
  const double here = turned(psi);
  CurvePoint point = is_active(here) ? active_at(here) : closing_.at(here);
  point.psi = psi;
  return point;
}

double EnvelopeCurve::radius(double psi) const {
  const double here = turned(psi);
  return is_active(here) ? active_at(here).radius : closing_.radius(here);
}

// Newton's method for the joint angle with this ψ, within the bracket of both neighbouring samples: dψ/dθ = (dψ/dα)/g.
CurvePoint EnvelopeCurve::active_at(double psi) const {
  const auto above = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, psi,
                                      [](double value, const TakeOff& sample) { return value < sample.curve.psi; });
  const double sign = transmission::mirror_sign(take_offs_.side());
  double low = sign * (above - 1)->stroke.theta;
  double high = sign * above->stroke.theta;
  TakeOff found = *(above - 1);
  double theta = low;
  constexpr int k_most_steps = 60;
  constexpr double k_solved = 1e-14;  // relative
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
  return found.curve;
}

}  // namespace fusee::profile
