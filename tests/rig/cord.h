/// \file
/// What a tendon is made of. N, mm.
#pragma once

#include <cmath>

namespace fusee::rig {

/// T = EA ε (1 + ε/h). A cord that is not pulled is as long as its material times `natural`.
struct Cord {
  double EA = 0;
  double hardening = 0;  ///< h; 0: T = EA ε
  double natural = 1;    ///< grows with warmth and creep

  double strain_at(double tension) const {
    if (hardening <= 0) return tension / EA;
    return 0.5 * hardening * (std::sqrt(1.0 + 4.0 * tension / (EA * hardening)) - 1.0);
  }
  /// Nothing when it hangs loose.
  double tension(double length, double material) const {
    const double strain = length / (material * natural) - 1.0;
    if (!(strain > 0)) return 0.0;
    return EA * strain * (hardening > 0 ? 1.0 + strain / hardening : 1.0);
  }
  bool operator==(const Cord&) const = default;
  double length(double material, double tension) const { return material * natural * (1.0 + strain_at(tension)); }
  double material(double length, double tension) const { return length / (natural * (1.0 + strain_at(tension))); }
};

}  // namespace fusee::rig
