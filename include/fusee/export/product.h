/// \file
/// What drawings and reports are made from.
#pragma once

#include <optional>
#include <vector>

#include "fusee/base/check.h"
#include "fusee/joint/as_it_is.h"
#include "fusee/mechanism/file.h"
#include "fusee/profile/rewind.h"
#include "fusee/profile/synthesis.h"
#include "fusee/solid/holding.h"
#include "fusee/solid/pulley.h"

namespace fusee {

/// All that is known of a finished pulley.
struct Product {
  MechanismFile file;  ///< as it was read
  JointAsItIs joint;   ///< what was made, and what for
  SynthesisResult synthesis;
  Pulley pulley;
  std::optional<BodyLayout> cut_layout;  ///< where it is known: of what is cut, which neither shrinks nor gets elephant's feet
  Holding holding;  ///< of its tendons
  RewindResult as_built;
  std::vector<Check> checks;
};

}  // namespace fusee
