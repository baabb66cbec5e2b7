/// \file
/// Tendon that lies in its groove, from the knot to the take-off: a chain of springs whose nodes rub. N, mm, rad.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "rig/cord.h"
#include "rig/string_geometry.h"

namespace fusee::rig {

/// By how much a convex polygon has turned at an arc along it, counted on through turns.
class Turning {
 public:
  explicit Turning(const Hull& hull);
  double at(double arc) const;

 private:
  double around_ = 1;
  bool climbs_ = false;
  std::vector<double> angle_;  ///< at even steps of arc
};

/// Each spring keeps its material for as long as it lies on the pulley; between two of them the tensions may differ by
/// e^(μφ), φ being the turn of the groove from the middle of one to the middle of the other. What differs by more
/// slides, spring after spring, from the take-off inwards.
class GrooveChain {
 public:
  GrooveChain() = default;
  /// From the knot to the take-off under one tension.
  GrooveChain(const Hull& hull, double knot, double take_off, double tension, double friction, const Cord& cord);

  /// The groove leaves the tendon at this arc from now on. `before`: tension at the take-off up to now.
  void reach(double take_off, double before, const Cord& cord);
  /// After reach(): the knot gives way by this much material.
  void let_go(double material);
  /// Material that the groove takes from the free tendon since reach(), with this tension at the take-off; less than
  /// nothing: gives. Grows with the tension where the groove grows, falls where springs slide out.
  double taken(double tension) const;
  /// So be it. Returns what was taken.
  double settle(double tension);

  /// From the knot to the take-off, mm.
  double length() const { return take_off_ - knot_; }
  /// Of all springs, mm.
  double material() const;
  /// Of the spring nearest to the knot; 0 when there is none.
  double knot_tension() const;
  /// Stretched energy of all springs, N·mm; of T = EA ε alone.
  double stored() const;
  std::size_t springs() const { return springs_.size(); }

 private:
  struct Spring {
    double length = 0;
    double material = 0;
    double tension = 0;
    double hold = 1;  ///< most that the tension may be of its outer neighbour's
  };
  void measure();
  double slid_out(double tension, std::vector<double>* after) const;
  double fresh_tension(double tension) const { return 0.5 * (before_ + tension); }

  double turn_to(double arc) const { return turning_->at(arc); }

  std::shared_ptr<const Turning> turning_;
  Cord cord_;
  double friction_ = 0;
  double knot_ = 0;
  double take_off_ = 0;
  std::vector<Spring> springs_;  ///< the first at the knot
  double before_ = 0;
  double cut_ = 0;    ///< material that came off with the groove
  double fresh_ = 0;  ///< length wound since
  double fresh_hold_ = 1;
  bool calm_ = false;  ///< nothing but the take-off can have made a spring slide
};

}  // namespace fusee::rig
