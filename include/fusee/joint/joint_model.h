/// \file
/// Static model of a joint: both tendon paths as mounted, their stiffness, friction and load.
///
/// A tendon's path splits at a fixed point of the pin's rim: the part above depends only on θ, the part below only on
/// α. A pulley made for one mechanism and mounted in another is therefore no special case.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "fusee/mechanism/imperfections.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/transmission/guide_friction.h"
#include "fusee/transmission/transmission.h"

namespace fusee {

/// A mechanism with identified pins, length, friction and tendon. Its pulley is still the declared one.
struct MountedMechanism {
  Mechanism mechanism;
  std::array<PathError, 2> longer = {};  ///< left, right
};

/// A tendon below its pin, in its right-hand image (increasing α winds in). mm, rad.
struct LowerPath {
  double p = 0;       ///< moment arm about the pulley's axis
  double normal = 0;  ///< direction of the line's outward normal
  /// Free span: from the pin's tangent point, or the sheath exit, to the contact on the pulley.
  double reach = 0;
  double wound = 0;  ///< arc length on the pulley, up to the contact and up to a constant
};

/// Both pulleys as made for one mechanism, with tendons from pins that may be elsewhere. Cheap to copy; immutable.
class MadePulleys {
 public:
  explicit MadePulleys(const Mechanism& made_for) : declared_(made_for) {}

  /// Both pitch curves offset outwards by `by` (print offset, tendon thickness), mm.
  MadePulleys offset_by(double by) const;

  /// Both tendons (left, right) at the pulley angle `alpha`. NaN where a tendon touches a part of the curve outside the
  /// law's range.
  std::array<LowerPath, 2> paths(const std::array<LowerGuide, 2>& mounted, double alpha) const;
  std::array<LowerPath, 2> paths(const std::array<PinPlace, 2>& mounted, double alpha) const {
    return paths(std::array{mounted[0].lower(), mounted[1].lower()}, alpha);
  }
  const Transmission& declared() const { return declared_; }

 private:
  LowerPath path(Side side, const LowerGuide& mounted, double alpha, const TransmissionPoint& first) const;

  Transmission declared_;
  double offset_ = 0;
};

/// Arc between the unwound end of the range and the tendon's knot, mm. An assumption: `fusee build` places 40° to 95°
/// of wrap there, and the file does not specify it. 15 mm more change the mean deflection by at most 0.6 % (R 100, r1
/// 16, 12 N, μ 0.05 to 0.5). Multi-turn tendons have body.spare_turns instead.
constexpr double k_arc_to_knot = 5.0;

struct UpperSpans;  // lookup tables of both upper spans over the joint angle

/// Plain values: a joint with other pins, stiffness or runout is a copy with members or `lower` replaced.
struct JointModel {
  std::array<PinPlace, 2> pins;  ///< left, right, as mounted
  double lever = 0;              ///< OC, at whose end a tip force acts, mm
  std::function<std::array<LowerPath, 2>(double alpha)> lower;
  std::function<double(double alpha)> expected;  ///< approximate θ, as a start for root finding
  double EA = 0;                                 ///< axial stiffness of a tendon: tension per strain, N
  GuideFriction guide;                           ///< pins or idlers
  SheathLoad sheath;                             ///< sheath of each tendon
  double pretension = 0;                         ///< of tendon 1 at home, unloaded, N
  double drum_friction = 0;                      ///< between tendon and drum, like groove_friction
  double slack = 0;                              ///< excess material of each tendon beyond the path, mm
  double bearing_friction = 0;                   ///< dry friction of the joint's bearing, N·mm
  RubbingError rubbing;                          ///< dry friction that depends on the tendons' tension
  CableStiffening waves;                         ///< waves of each tendon between its pin and its end
  double pin_compliance = 0;                     ///< compliance of a pin under its tendon's force, mm/N
  /// Capstan coefficient between tendon and groove, which limits the sliding of the wound tendon up to the knot.
  /// Infinite: the tendon keeps the strain of its winding; 0: it acts as part of the spring.
  double groove_friction = 0;
  double alpha_least = 0;  ///< range that the pulley was made for, rad; the knots lie beyond its ends
  double alpha_most = 0;
  /// Arc from the ends of the range to the knots, mm
  std::array<double, 2> arcs_to_knots = {k_arc_to_knot, k_arc_to_knot};
  double weight = 0;  ///< mass · g · lever, N·mm
  double tilt = 0;    ///< θ at which the link points straight up, rad
  Spring spring;
  double last_step = 1e-13;  ///< convergence limit of the equilibrium search for θ, rad
  double theta_least = 0;    ///< limits of θ between which both tendons have a moment arm about O, rad
  double theta_most = 0;
  std::shared_ptr<const UpperSpans> upper;  ///< tables for these pins and limits

  /// Total dry friction on the joint for tendons pulling with `left` and `right` N; N·mm.
  double dry_friction(double left, double right) const;

  /// Torque of weight and spring against +θ, N·mm, and its derivative.
  double own_torque(double theta) const { return weight * std::sin(tilt - theta) + spring.torque(theta); }
  double own_slope(double theta) const { return spring.stiffness - weight * std::cos(tilt - theta); }
};

/// Model of the joint as declared. Its law must exist over the range (Transmission::dead_centre() is null).
JointModel joint_model(const Mechanism& mechanism);
/// Model of the pulleys `made` in the mechanism `mounted`, whose own [pulley] law is ignored.
JointModel joint_model(const MadePulleys& made, const MountedMechanism& mounted);
/// Sets EA, friction, pretension, weight and spring of `mounted` in a model of the same geometry.
void set_statics(JointModel& model, const MountedMechanism& mounted);

}  // namespace fusee
