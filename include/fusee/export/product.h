/// \file
/// The input of drawings and reports.
#pragma once

#include <optional>
#include <vector>

#include "fusee/base/check.h"
#include "fusee/coil/helical_pulley.h"
#include "fusee/coil/helical_rewind.h"
#include "fusee/helix/synthesis.h"
#include "fusee/joint/as_it_is.h"
#include "fusee/mechanism/file.h"
#include "fusee/profile/rewind.h"
#include "fusee/profile/synthesis.h"
#include "fusee/solid/holding.h"
#include "fusee/solid/pulley.h"

namespace fusee {

/// Additional data of a multi-turn pulley, whose curves are no outlines and whose grooves lie in no plane.
struct HelixProduct {
  HelixSynthesis synthesis;
  HelicalPulley pulley;  ///< its mesh and conditions are in Product::pulley
  HelicalRewind as_built;

  /// Heights above the part's lower face of the tendons' ends on the joint, or of their guides' collars.
  TendonsLaid laid(bool collar) const {
    return tendons_laid(pulley, synthesis.sides[0].spiral, synthesis.sides[1].spiral, synthesis.sides[0].attachment_z,
                        synthesis.sides[1].attachment_z, collar);
  }
};

/// The complete data of a finished pulley.
struct Product {
  MechanismFile file;  ///< as read
  JointAsItIs joint;   ///< the identified joint that the pulley was designed for
  SynthesisResult synthesis;
  Pulley pulley;
  std::optional<BodyLayout> cut_layout;  ///< layout for cutting, without shrinkage and chamfer, if known
  Holding holding;                       ///< of its tendons
  RewindResult as_built;
  std::vector<Check> checks;
  std::optional<HelixProduct> helix = {};  ///< several turns; `synthesis` then has no outlines and `pulley` no anchors
};

}  // namespace fusee
