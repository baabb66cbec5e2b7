/// \file
/// Application of identified deviations: computes the mounted joint and the pulley to make for it, so that the joint
/// follows the declared law.
///
/// Every command that needs the real joint calls as_it_is(). No later stage reads [identified], and the declaration is
/// never overwritten.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/joint/joint_model.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// The declared mechanism with the pins, length, friction and tendon of `imperfections`.
MountedMechanism mounted(const Mechanism& declared, const Imperfections& imperfections);

/// The identified joint, and the pulley to make for it.
struct JointAsItIs {
  /// The mounted mechanism with its identified weight. [pulley], range and shrinkage describe the pulley to make:
  /// deflected by the mean load, the joint follows the declared θ(α), and scale errors of making are compensated.
  Mechanism mechanism;
  /// Further errors of making; draw_for_making() draws the opposite.
  OutlineError outline;
};
/// Accuracy of the compensating law of a compliant joint: that of the part to make, or about twenty times as fast with
/// 0.1° accuracy, for searches over hundreds of mechanisms.
enum class LawSearch { whole, brief };
/// Returns the declared mechanism when nothing relevant was identified.
JointAsItIs as_it_is(const DeclaredMechanism& declared, LawSearch search = LawSearch::whole);

/// The joint that a measurement is compared with: identified, with the pulley made for it, and with empty `identified`.
DeclaredMechanism expected_joint(const DeclaredMechanism& declared);

/// A curve point displaced so that it comes out of making in its place.
OutlinePoint drawn_for_making(OutlinePoint point, const OutlineError& outline);
/// Displaces all points of both curves.
void draw_for_making(SynthesisResult& synthesis, const OutlineError& outline);
/// The conditions that displaced curves violate: the correction of a wave may turn a sharp bend inward. One per
/// affected pulley.
std::vector<Condition> turns_inward_as_drawn(const SynthesisResult& drawn, const OutlineError& outline);
/// Inverse of draw_for_making(): a closed floor as it comes out of making.
Polygon as_made(Polygon drawn, const OutlineError& outline);
/// Inverse of draw_for_making() for an open line. Normals are averaged over `beside` points on either side.
Polygon line_as_made(Polygon drawn, const OutlineError& outline, std::size_t beside);
/// The joint with a thicker tendon and thinner pins, in which the tendon lies on a displaced floor as the real one lies
/// on the made floor.
Mechanism with_inset(const JointAsItIs& joint);

/// Assembly angle: position of the motor at which the tendons are tied, with the unloaded joint at home, so that the
/// loaded joint follows the declared law. rad. No pulley can correct it: tied at 0, the joint has this offset at every
/// α, and compensation.csv contains it.
double tied_at(const DeclaredMechanism& declared);

/// Choice of a round P1: allowed when the best r1 for the identified joint follows its compensating law closely enough.
struct RoundChoice {
  double r1 = 0;         ///< mm
  double max_error = 0;  ///< maximum error of θ, rad
  bool suffices = false;
};
/// For law = "compensate" only.
RoundChoice round_choice(const DeclaredMechanism& declared);

}  // namespace fusee
