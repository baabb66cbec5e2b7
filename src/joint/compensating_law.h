/// \file
/// The compensating law: the law of a pulley with which the identified joint follows the target motion.
#pragma once

#include <vector>

#include "fusee/joint.h"

namespace fusee::joint {

/// The joint with identified geometry and statics, and the keys of the target motion.
Mechanism identified_mechanism(const DeclaredMechanism& declared);

/// The law of the pulley in the identified joint.
struct CompensatingLaw {
  std::vector<LawRow> rows;  ///< θ of the unloaded joint at each α of the motor
  double home = 0;           ///< α at which these rows have θ = 0
  double theta_min = 0;      ///< range of the unloaded joint; includes 0
  double theta_max = 0;
  bool shifted = false;  ///< true if the rows differ from the target motion
};

/// Returns the target motion when the joint's compliance does not justify another one.
CompensatingLaw compensating_law(const DeclaredMechanism& declared, LawSearch search = LawSearch::whole);

/// `joint` with a pulley for that law.
Mechanism with_law(Mechanism joint, const CompensatingLaw& compensating);

/// See fusee/joint.h.
RoundChoice round_choice(const DeclaredMechanism& declared, const CompensatingLaw& compensating);

}  // namespace fusee::joint
