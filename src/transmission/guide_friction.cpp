#include <algorithm>

#include "fusee/transmission.h"

namespace fusee::transmission {
namespace {

/// Upper bound of ε, the bearing's share of the tension. Near 1 the idler would hold any ratio of tensions; valid files
/// stay far below.
constexpr double k_max_loss = 0.999;

/// ε of the equation below.
double loss(double turning, double wrap) {
  return std::min(k_max_loss, turning * elementary::sin(0.5 * std::max(0.0, wrap)));
}

}  // namespace

// Both tensions press the idler onto its bearing with (T1 + T2) sin(φ/2), to first order in their difference. The
// bearing resists with μb rb times that: (T2 − T1) ρ = μb rb (T1 + T2) sin(φ/2). With ε = μb (rb/ρ) sin(φ/2), T2/T1 =
// (1 + ε)/(1 − ε).
double GuideFriction::log_ratio(double wrap) const {
  if (!is_idler) return mu * std::max(0.0, wrap);
  const double epsilon = loss(turning, wrap);
  return elementary::log1p(2.0 * epsilon / (1.0 - epsilon));
}

double GuideFriction::slope(double wrap) const {
  if (!is_idler) return mu;
  const double epsilon = loss(turning, wrap);
  return turning * elementary::cos(0.5 * wrap) / (1.0 - epsilon * epsilon);
}

GuideFriction guide_friction(const Mechanism& mechanism) {
  const Guides& guides = mechanism.guides;
  if (guides.kind == GuideKind::pin) return {guides.mu, 0, false};
  return {0, guides.bearing_friction * guides.bearing_radius / mechanism.guide_pitch_radius(), true};
}

// A bent sheath deflects its tendon like pins do: T2/T1 = e^{μβ} [7]. The ratio depends on the total bend β alone, not
// on the positions and radii of the bends. The tension of the enclosed tendon compresses the sheath from end to end.
SheathLoad sheath_load(const Mechanism& mechanism) {
  const Sheath& sheath = mechanism.sheath;
  if (!sheath.is_there()) return {};
  return {sheath.length, sheath.stiffness > 0 ? 1.0 / sheath.stiffness : 0.0, sheath.mu * sheath.bend};
}

Mechanism without_friction(Mechanism mechanism) {
  mechanism.guides.mu = mechanism.guides.bearing_friction = mechanism.joint.drum_mu = mechanism.sheath.mu = 0;
  return mechanism;
}

}  // namespace fusee::transmission
