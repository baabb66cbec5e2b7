/// \file
/// A joint as its statics see it: both tendon paths as mounted, their stiffness, the pins' friction, the load.
///
/// The path of a tendon splits at a point of the pin's rim that stands still: what lies above it depends on θ alone,
/// what lies below it on α alone. So a pulley made for one mechanism and mounted in another needs no further case.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "fusee/mechanism/imperfections.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/transmission/guide_friction.h"
#include "fusee/transmission/transmission.h"

namespace fusee {

/// A mechanism with identified pins, length, friction and tendon in place of the declared ones. Its pulley is still the
/// declared one.
struct MountedMechanism {
  Mechanism mechanism;
  std::array<PathError, 2> longer = {};  ///< left, right
};

/// A tendon below its pin, in its right-hand image (α counts as winding in). mm, rad.
struct LowerPath {
  double p = 0;       ///< moment arm about the pulley's axis
  double normal = 0;  ///< direction of the line's outward normal
  double reach =
      0;  ///< from the pin's tangent point, or the sheath's mouth, to where the pulley is touched: the free span
  double wound = 0;  ///< arc length that lies on the pulley, up to there, but for a constant
};

/// Both pulleys as made for a mechanism, looked at from pins that may stand elsewhere. Cheap to copy; immutable.
class MadePulleys {
 public:
  explicit MadePulleys(const Mechanism& made_for) : declared_(made_for) {}

  /// The same with both pitch curves `by` further out all round (print offset, tendon thickness), mm.
  MadePulleys offset_by(double by) const;

  /// Both tendons (left, right) at the pulley angle `alpha`. NaN where a tendon touches a part of the curve that the
  /// law does not define.
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

/// Where a tendon is tied: this much of arc beyond the end of the range that it unwinds to, mm. An assumption: what
/// `fusee build` makes has 40° to 95° of wrap there, and a joint's file says nothing of it. 15 mm more change the mean
/// deflection by 0.6 % at most (R 100, r1 16, 12 N, μ 0.05 to 0.5). A tendon that is wound several times is tied
/// body.spare_turns beyond it.
constexpr double k_knot_beyond = 5.0;

struct UpperSpans;  // both upper spans over the joint's angles, looked up

/// Plain values: a joint with other pins, another stiffness, runout … is this one with a member changed, or with
/// another `lower`.
struct JointModel {
  std::array<PinPlace, 2> pins;  ///< left, right, as mounted
  double lever = 0;              ///< OC, at whose end a tip force acts, mm
  std::function<std::array<LowerPath, 2>(double alpha)> lower;
  std::function<double(double alpha)> expected;  ///< about where θ will be: a root finder's start
  double EA = 0;                                 ///< stiffness of a tendon's section: tension per strain, N
  GuideFriction guide;                           ///< of the pins or idlers
  SheathLoad sheath;                             ///< of each tendon's sheath
  double pretension = 0;                         ///< of tendon 1 at home, unloaded, N
  double drum_friction = 0;                      ///< between tendon and drum, as groove_friction
  double slack = 0;                              ///< material of each tendon beyond what the pretension leaves, mm
  double bearing_friction = 0;                   ///< dry, of the joint's bearing, N·mm
  RubbingError rubbing;                          ///< dry, and by the tendons' pull
  CableStiffening waves;                         ///< of each tendon, between its pin and its end
  double pin_give = 0;                           ///< a pin moves by this along what its tendon pushes it with, mm/N
  /// Between tendon and groove: what lies on a pulley slides as far as this lets it, up to the knot. Infinite: it keeps
  /// the strain that it was wound at; 0: it is a part of the spring.
  double groove_friction = 0;
  double alpha_least = 0;  ///< the range that the pulley was made for, rad: the knots lie beyond its ends …
  double alpha_most = 0;
  std::array<double, 2> knots_beyond = {k_knot_beyond, k_knot_beyond};  ///< … by so much, mm
  double weight = 0;                                                    ///< mass · g · lever, N·mm
  double tilt = 0;  ///< θ at which the link points straight up, rad
  Spring spring;
  double last_step = 1e-13;  ///< of the search for the equilibrium: how exactly θ is found, rad
  double theta_least = 0;    ///< between here and theta_most both tendons have a moment arm about O, rad
  double theta_most = 0;
  std::shared_ptr<const UpperSpans> upper;  ///< of these pins between these angles

  /// All dry friction that holds the joint, of tendons that pull it with `left` and `right` N; N·mm.
  double dry_friction(double left, double right) const;

  /// What weight and spring turn the joint with, against +θ, N·mm; and its derivative.
  double own_torque(double theta) const { return weight * std::sin(tilt - theta) + spring.torque(theta); }
  double own_slope(double theta) const { return spring.stiffness - weight * std::cos(tilt - theta); }
};

/// The joint as declared. Its law must exist over the range (Transmission::dead_centre() is null).
JointModel joint_model(const Mechanism& mechanism);
/// The pulleys `made`, turned in the mechanism `mounted`, whose own [pulley] law is not looked at.
JointModel joint_model(const MadePulleys& made, const MountedMechanism& mounted);
/// EA, friction, pretension, weight and spring of `mounted` in a model of the same geometry.
void set_statics(JointModel& model, const MountedMechanism& mounted);

}  // namespace fusee
