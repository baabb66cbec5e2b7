/// \file
/// The tendon that lies on a pulley, from its knot to where it takes off: how much material (unstretched length) it
/// holds, and how it slides in its groove.
///
/// Capstan law [7] along the whole wrap, with memory: an element at the wrap φ behind the take-off has
/// T e^(−μφ) ≤ T(φ) ≤ T e^(μφ) and keeps what it had within. Strains are tensions over EA.
#pragma once

#include <memory>
#include <vector>

namespace fusee {

/// A place of the groove.
struct GroovePlace {
  double turn = 0;  ///< of the curve's normal, growing towards the take-off, rad
  double arc = 0;   ///< mm
};

/// How the arc grows with the turning, looked up; and where the knot is.
class GrooveArc {
 public:
  /// `along`: from the unwound end of the range to the wound one, strictly growing, at least two. Beyond both ends the
  /// groove is taken as round, of the radius that it has there.
  GrooveArc(std::vector<GroovePlace> along, double knot_beyond);
  /// A round drum of `radius`, from the turn 0 on; `behind` it, straight, there is so much more tendon to the knot.
  static GrooveArc round(double radius, double behind);

  double arc(double turn) const;
  const GroovePlace& knot() const { return knot_; }

 private:
  struct Knot {
    double turn, arc, slope;
    double bend, twist;  ///< arc + h (slope + h (bend + h twist)) at h beyond it, up to the next
  };
  std::vector<Knot> knots_;
  double per_turn_ = 0;  ///< knots
  GroovePlace knot_;
};

/// What a stretch of the groove holds.
struct WoundContent {
  double material = 0;  ///< mm
  double energy = 0;    ///< over EA, mm
};

/// A stretch of groove. Either it lies as it was laid, with a density (material per arc length: 1/(1 + strain)) that
/// changes linearly; or it has slid, and strain falls from `to` as e^{fall (turn_to − turn)}.
struct WoundPiece {
  GroovePlace from;
  GroovePlace to;
  double density_from = 1;
  double density_to = 1;
  bool slid = false;
  double fall = 0;  ///< of what slid, per rad
  WoundContent held;
  double swelling = 1;  ///< at which `held` was summed up
};

class WoundProfile;

/// A pulley that has turned, before the strain at its take-off is known.
struct Turned {
  GroovePlace take_off;
  GroovePlace before;      ///< where what is wound in this step begins; the take-off itself while paying out
  std::size_t below = 0;   ///< pieces that stay as they are …
  WoundPiece top;          ///< … and the one above them, cut at the take-off
  bool has_top = false;    ///< else nothing is left on the pulley
  double lies = 0;         ///< strain of what lies at `before` …
  double log_lies = 0;     ///< … and its logarithm
  double log_top = 0;      ///< the same at the upper end of `top`
  double came_off = 0;     ///< material, with the turning alone, mm
  WoundContent past_knot;  ///< of that: what the range was left for by
};

/// What a turned pulley holds at a trial strain of its take-off.
struct Slide {
  double strain = 0;
  double freed = 0;  ///< material that came off since the last step, mm; negative: went on
  double length =
      0;  ///< a span of this length would give as much per strain: d freed / d strain = length/(1 + strain)²
  double at_before = 0;  ///< strain at Turned::before
  bool slides = false;
  double fall = 0;        ///< of the part that slides
  GroovePlace cut;        ///< where that ends
  WoundContent sliding;   ///< what it holds between there and Turned::before
  std::size_t below = 0;  ///< pieces beyond the cut that stay as they are
  WoundPiece rest;        ///< what stays of the one that was cut
  bool has_rest = false;
};

/// Last wound, first paid out; in between it slides as far as friction lets it. With strain ε at the take-off an
/// element that lies at the wrap φ behind it has ε e^{−μφ} … ε e^{μφ} and keeps what it had within these bounds.
///
/// `swelling` is 1 + expansion of the material since home, which all material here is measured at.
class WoundProfile {
 public:
  WoundProfile() = default;
  /// From the knot to `take_off` at `density`.
  WoundProfile(std::shared_ptr<const GrooveArc> groove, double friction, const GroovePlace& take_off, double density);

  const GroovePlace& take_off() const { return take_off_; }
  /// At the take-off.
  double strain(double swelling) const;
  double strain_at_knot(double swelling) const;

  Turned turned_to(const GroovePlace& take_off, double swelling) const;
  Slide slide(const Turned& turned, double strain, double swelling) const;
  /// Takes a slide as what happened. What the pulley then holds more.
  WoundContent accept(const Turned& turned, const Slide& slide, double swelling);

 private:
  std::shared_ptr<const GrooveArc> groove_;
  double friction_ = 0;
  double home_density_ = 1;
  GroovePlace take_off_;
  double density_ = 1;  ///< there; what lies next to it may have none of it where friction has no end
  std::vector<WoundPiece> pieces_;
};

}  // namespace fusee
