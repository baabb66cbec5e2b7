/// \file
/// What to make so that the joint as it is follows the law that its file declares: the one gate between what was
/// declared and what is mounted and made.
///
/// Every command that asks what a joint really does goes through as_it_is(); nothing behind it knows of [identified],
/// and what was declared is never overwritten.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/joint/joint_model.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// What `imperfections` say of pins, length, friction and tendon, in place of what is declared.
MountedMechanism mounted(const Mechanism& declared, const Imperfections& imperfections);

/// The joint as it is, and what is made for it.
struct JointAsItIs {
  /// As mounted, with identified weight. [pulley], range and shrinkage are of the pulley to make: given way under the
  /// mean load the joint then follows the declared θ(α), and a pulley scaled in making comes out right.
  Mechanism mechanism;
  /// What making does to the curves beyond that: draw_for_making() draws them the other way.
  OutlineError outline;
};
/// How closely the law of a joint that gives way is looked for: as it is made, or, some twenty times as fast and to a
/// tenth of a degree, for a look at hundreds of mechanisms of which one is made.
enum class LawSearch { whole, brief };
/// The declared mechanism itself where nothing of this was identified.
JointAsItIs as_it_is(const DeclaredMechanism& declared, LawSearch search = LawSearch::whole);

/// The joint that a measurement is held against: as it is, with the pulley that was made for it. Nothing is left in
/// `identified`.
DeclaredMechanism expected_joint(const DeclaredMechanism& declared);

/// A point of a curve further in and off the axis, so that it comes out where it belongs …
OutlinePoint drawn_for_making(OutlinePoint point, const OutlineError& outline);
/// … and all of both curves.
void draw_for_making(SynthesisResult& synthesis, const OutlineError& outline);
/// What curves drawn so fail by: a wave may turn a sharp bend inward, one for each pulley of which it does.
std::vector<Condition> turns_inward_as_drawn(const SynthesisResult& drawn, const OutlineError& outline);
/// Seen the other way: a floor drawn off the axis, on it …
Polygon as_made(Polygon drawn, const OutlineError& outline);
/// … of which an open line is known in many points on each side, so that normals are those of so many on either hand …
Polygon line_as_made(Polygon drawn, const OutlineError& outline, std::size_t beside);
/// … and the joint in which the tendon lies on a floor drawn further in as the real one lies on the made floor:
/// thicker, over thinner pins.
Mechanism with_inset(const JointAsItIs& joint);

/// Where the motor must stand when the tendons are tied, the unloaded joint at home, for the loaded joint to follow the
/// declared law, rad. No pulley can give this: tied at 0, the joint is off by as much at every α, and compensation.csv
/// says so.
double tied_at(const DeclaredMechanism& declared);

/// P1 may stay round when the best r1 on the joint as it is misses the law it needs by little.
struct RoundChoice {
  double r1 = 0;         ///< mm
  double max_error = 0;  ///< of θ, rad
  bool suffices = false;
};
/// For law = "compensate" alone.
RoundChoice round_choice(const DeclaredMechanism& declared);

}  // namespace fusee
