/// \file
/// Tendon that lies in its groove, from the knot to the take-off: a chain of springs whose nodes rub. N, mm, rad.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "rig/string_geometry.h"

namespace fusee::rig {

/// T = EA ε (1 + ε/h). The unloaded length is material × `natural`.
struct Cord {
  double EA = 0;
  double hardening = 0;  ///< h; 0: T = EA ε
  double natural = 1;    ///< grows with warmth and creep

  double strain_at(double tension) const {
    if (hardening <= 0) return tension / EA;
    return 0.5 * hardening * (std::sqrt(1.0 + 4.0 * tension / (EA * hardening)) - 1.0);
  }
  /// 0 when slack.
  double tension(double length, double material) const {
    const double strain = length / (material * natural) - 1.0;
    if (!(strain > 0)) return 0.0;
    return EA * strain * (hardening > 0 ? 1.0 + strain / hardening : 1.0);
  }
  bool operator==(const Cord&) const = default;
  double length(double material, double tension) const { return material * natural * (1.0 + strain_at(tension)); }
  double material(double length, double tension) const { return length / (natural * (1.0 + strain_at(tension))); }
};

/// Direction of a convex polygon at an arc along it, continuous over turns.
class TurningAngle {
 public:
  explicit TurningAngle(const Hull& hull);
  double at(double arc) const;

 private:
  double around_ = 1;
  bool is_helical_ = false;
  std::vector<double> angle_;  ///< at even steps of arc
};

/// Each spring keeps its material while it is on the pulley. The tensions of neighbours differ by a factor of at most
/// e^(μφ), where φ is the angle between their middles (capstan equation). Beyond, springs slide one by one, from the
/// take-off inwards.
class GrooveChain {
 public:
  GrooveChain() = default;
  /// From the knot to the take-off under one tension.
  GrooveChain(const Hull& hull, double knot, double take_off, double tension, double friction, const Cord& cord);

  /// The groove leaves the tendon at this arc from now on. `before`: tension at the take-off up to now.
  void reach(double take_off, double before, const Cord& cord);
  /// After reach(): the knot releases this length of tendon.
  void let_go(double material);
  /// Material that the groove takes from the free tendon since reach() at this tension of the take-off; < 0: releases.
  double taken(double tension) const;
  /// Applies this tension. Returns the material taken.
  double settle(double tension);

  /// From the knot to the take-off, mm.
  double length() const { return take_off_ - knot_; }
  /// Material of all springs, mm.
  double material() const;
  /// Tension of the spring at the knot; 0 without springs.
  double knot_tension() const;
  /// Elastic energy of all springs for T = EA ε, N·mm.
  double stored() const;
  std::size_t springs() const { return springs_.size(); }

 private:
  struct Spring {
    double length = 0;
    double material = 0;
    double tension = 0;
    double hold = 1;  ///< largest ratio to the tension of its outer neighbour
  };
  void measure();
  double slid_out(double tension, std::vector<double>* after) const;
  double fresh_tension(double tension) const { return 0.5 * (before_ + tension); }

  double turn_to(double arc) const { return turning_->at(arc); }

  std::shared_ptr<const TurningAngle> turning_;
  Cord cord_;
  double friction_ = 0;
  double knot_ = 0;
  double take_off_ = 0;
  std::vector<Spring> springs_;  ///< the first at the knot
  double before_ = 0;
  double cut_ = 0;    ///< material that left with the groove
  double fresh_ = 0;  ///< length wound since
  double fresh_hold_ = 1;
  bool calm_ = false;  ///< only the take-off can have changed a tension
};

}  // namespace fusee::rig
