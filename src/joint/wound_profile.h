/// \file
/// The tendon on a pulley, from its knot to the take-off: the material (unstretched length) that it holds, and its
/// sliding in the groove.
///
/// Capstan law, [7] in transmission/equations.h, along the whole wrap, with memory: an element at the wrap φ behind the
/// take-off has a tension between T e^(−μφ) and T e^(μφ), and keeps its own within these bounds. A strain is a tension
/// over EA.
#pragma once

#include <memory>
#include <vector>

namespace fusee::joint {

/// A position in the groove.
struct GroovePlace {
  double turn = 0;  ///< turn of the curve's normal, increasing towards the take-off, rad
  double arc = 0;   ///< arc length, increasing with `turn`, mm
};

/// Table of arc length over turn, and the position of the knot.
class GrooveArc {
 public:
  /// `along`: from the unwound end of the range to the wound one, strictly increasing, at least two. Beyond both ends
  /// the groove is assumed round with the radius there. `knot_beyond`: arc from the unwound end to the knot, mm.
  GrooveArc(std::vector<GroovePlace> along, double knot_beyond);
  /// A round drum of `radius`, from the turn 0. `behind`: straight length from the drum to the knot.
  static GrooveArc round(double radius, double behind);

  double arc(double turn) const;
  const GroovePlace& knot() const { return knot_; }

 private:
  /// A node of the interpolation.
  struct Node {
    double turn, arc, slope;
    double bend, twist;  ///< arc + h (slope + h (bend + h twist)) at h beyond the node, up to the next
  };
  std::vector<Node> nodes_;
  double per_turn_ = 0;  ///< nodes per rad
  GroovePlace knot_;
};

/// Tendon on a segment of the groove.
struct WoundContent {
  double material = 0;  ///< mm
  double energy = 0;    ///< elastic energy over EA, mm
};

/// A segment of the groove. Either it lies as it was laid, with linearly varying density (material per arc length:
/// 1/(1 + strain)), or it has slid, and the strain decays from `to` as e^{fall (turn_to − turn)}.
struct WoundPiece {
  GroovePlace from;
  GroovePlace to;
  double density_from = 1;
  double density_to = 1;
  bool slid = false;
  double fall = 0;  ///< exponent of a slid segment, per rad
  WoundContent content;
  double swelling = 1;  ///< swelling for which `content` was computed
};

class WoundProfile;

/// A pulley after turning, before the strain at its take-off is known.
struct TurnedPulley {
  GroovePlace take_off;
  GroovePlace before;           ///< where the part wound in this step begins; the take-off itself while paying out
  std::size_t below = 0;        ///< number of unchanged pieces below `top`
  WoundPiece top;               ///< the highest remaining piece, cut at `before`
  bool has_top = false;         ///< false: nothing is left on the pulley
  double wound_strain = 0;      ///< strain of the tendon at `before`
  double log_wound_strain = 0;  ///< logarithm of `wound_strain`
  double log_top = 0;           ///< logarithm of the strain at the upper end of `top`
  double came_off = 0;          ///< material released by the turning itself, mm
  WoundContent past_knot;       ///< part of came_off from beyond the range
};

/// State of a turned pulley for a trial strain at its take-off.
struct Slide {
  double strain = 0;
  double freed = 0;  ///< material released since the last step, mm; negative: taken up
  /// Length of an equivalent span: d freed / d strain = length/(1 + strain)².
  double length = 0;
  double at_before = 0;  ///< strain at TurnedPulley::before
  bool slides = false;
  double fall = 0;        ///< exponent of the sliding part
  GroovePlace cut;        ///< end of the sliding part
  WoundContent sliding;   ///< content of the sliding part between the cut and TurnedPulley::before
  std::size_t below = 0;  ///< number of unchanged pieces beyond the cut
  WoundPiece remainder;   ///< part beyond the cut of the piece that was cut
  bool has_remainder = false;
};

/// The tendon on a pulley: last wound, first paid out, and sliding in between as far as friction permits. With the
/// strain ε at the take-off, an element at the wrap φ behind it has a strain between ε e^{−μφ} and ε e^{μφ}, and keeps
/// its own within these bounds.
///
/// `swelling`: 1 + expansion of the material since home, to which all material here refers.
class WoundProfile {
 public:
  WoundProfile() = default;
  /// Winds from the knot to `take_off` at `density`. `friction`: coefficient μ between tendon and groove.
  WoundProfile(std::shared_ptr<const GrooveArc> groove, double friction, const GroovePlace& take_off, double density);

  const GroovePlace& take_off() const { return take_off_; }
  /// Strain at the take-off.
  double strain(double swelling) const;
  double strain_at_knot(double swelling) const;

  /// The pulley turned until the take-off is at `take_off`.
  TurnedPulley turned_to(const GroovePlace& take_off, double swelling) const;
  /// The sliding that the strain at the take-off causes.
  Slide slide(const TurnedPulley& turned, double strain, double swelling) const;
  /// Makes a slide permanent. Returns the increase of the pulley's content.
  WoundContent accept(const TurnedPulley& turned, const Slide& slide, double swelling);

 private:
  std::shared_ptr<const GrooveArc> groove_;
  double friction_ = 0;
  double home_density_ = 1;
  GroovePlace take_off_;
  double density_ = 1;              ///< density at the take-off; the adjacent tendon may differ with infinite friction
  std::vector<WoundPiece> pieces_;  ///< from the knot to the take-off
};

}  // namespace fusee::joint
