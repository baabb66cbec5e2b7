/// \file
/// What drawings and reports are made from.
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

/// What a pulley of several turns has beside: its curves are no outlines, and its grooves lie in no plane.
struct HelixProduct {
  HelixSynthesis synthesis;
  HelicalPulley pulley;  ///< its mesh and conditions are Product::pulley's
  HelicalRewind as_built;

  /// Heights above the part's lower face: of the tendons' ends on the joint, or of their guides' collars.
  TendonsLaid laid(bool collar) const {
    return tendons_laid(pulley, synthesis.sides[0].spiral, synthesis.sides[1].spiral, synthesis.sides[0].attachment_z,
                        synthesis.sides[1].attachment_z, collar);
  }
};

/// All that is known of a finished pulley.
struct Product {
  MechanismFile file;  ///< as it was read
  JointAsItIs joint;   ///< what was made, and what for
  SynthesisResult synthesis;
  Pulley pulley;
  std::optional<BodyLayout>
      cut_layout;   ///< where it is known: of what is cut, which neither shrinks nor gets elephant's feet
  Holding holding;  ///< of its tendons
  RewindResult as_built;
  std::vector<Check> checks;
  std::optional<HelixProduct> helix =
      {};  ///< wound several times; `synthesis` then has no outlines, `pulley` no anchors
};

}  // namespace fusee
