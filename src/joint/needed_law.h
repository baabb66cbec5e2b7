/// \file
/// The law that a pulley must follow for the joint as it is to follow the declared one.
#pragma once

#include <vector>

#include "fusee/joint/as_it_is.h"

namespace fusee {

/// The joint with identified geometry and statics, still with the declared law's keys.
Mechanism identified_joint(const DeclaredMechanism& declared);

/// What the pulley must do in the identified joint.
struct NeededLaw {
  std::vector<LawRow> rows;  ///< without load, by the motor's α
  double home = 0;           ///< α at which these rows have θ = 0
  double theta_min = 0;      ///< the range, without load; home lies within
  double theta_max = 0;
  bool shifted = false;  ///< the rows are not the declared ones
};

/// The declared one where the joint does not give way by an amount that is worth another.
NeededLaw needed_law(const DeclaredMechanism& declared, LawSearch search = LawSearch::whole);

/// `joint` with a pulley for that.
Mechanism with_law(Mechanism joint, const NeededLaw& needed);

/// See as_it_is.h.
RoundChoice round_choice(const DeclaredMechanism& declared, const NeededLaw& needed);

}  // namespace fusee
