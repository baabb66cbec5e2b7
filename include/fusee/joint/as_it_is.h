/// \file
/// What to make so that the joint as it is follows the law that its file declares.
#pragma once

#include "fusee/base/plane.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// The joint as [identified] says it is, asked to follow the law that the file declares: identified geometry, tendon
/// and weight; a law that, given way under the mean load, is the declared θ(α); and shrinkage that a pulley scaled in
/// making comes out right from. The range is that of the unloaded joint. Of `identified` only what draw_for_making()
/// takes out stays: radius offset, wave of the profile and runout. The mechanism itself when nothing of this was
/// identified.
Mechanism as_it_is(const Mechanism& mechanism);
/// The joint that a measurement is held against: as it is, with the pulley that was made for it. Nothing is left in
/// `identified`.
Mechanism expected_joint(const Mechanism& declared);

/// Draws both curves further in and off the axis, so that they come out where they belong.
void draw_for_making(SynthesisResult& synthesis, const Mechanism& mechanism);
/// Seen the other way: a floor drawn off the axis, on it …
Polygon as_made(Polygon drawn, const Mechanism& mechanism);
/// … and the joint in which the tendon lies on a floor drawn further in as the real one lies on the made floor:
/// thicker, over thinner pins.
Mechanism with_inset(Mechanism mechanism);

/// Where the motor must stand when the tendons are tied, the unloaded joint at home, for the loaded joint to follow the
/// declared law, rad. No pulley can give this: tied at 0, the joint is off by as much at every α, and compensation.csv
/// says so.
double tied_at(const Mechanism& mechanism);

/// P1 may stay round when the best r1 on the joint as it is misses the law it needs by little.
struct RoundChoice {
  double r1 = 0;         ///< mm
  double max_error = 0;  ///< of θ, rad
  bool suffices = false;
};
/// For law = "compensate" alone.
RoundChoice round_choice(const Mechanism& mechanism);

}  // namespace fusee
