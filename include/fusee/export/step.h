/// \file
/// pulley.step: the part as a solid of exact surfaces, AP214, mm, for CAD. OpenCASCADE writes it, in the module
/// `fusee-step` that is loaded when it is asked for: a fusee may have been built, or installed, without.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base/check.h"
#include "fusee/base/plane.h"
#include "fusee/coil/helical_rewind.h"
#include "fusee/export/product.h"

namespace fusee {

/// Why this fusee cannot write STEP; null: it can. Loads the module.
std::optional<std::string> step_missing();

struct StepFile {
  std::string bytes;
  std::string complaint;  ///< OpenCASCADE's, where it could not make the solid and there are no bytes
};
/// Grooves are B-splines within 1e-4 mm of the curves; InputError where that takes more pieces than a part for CAD may
/// have ("too large for STEP: …"). The same part gives the same bytes.
StepFile step_file(const Product& product);

/// A file of ours, read again: what it is, and its groove floors: at the heights that the part has them, as printed, or
/// of several turns all that climb, as finished.
struct StepLook {
  std::vector<Check> checks;
  Polygon floor1, floor2;
  std::vector<FloorLine> climbing;
};
/// `tolerance`: of the mesh that its volume is held against, mm.
StepLook look_at_step(const std::filesystem::path& path, const Product& product, double tolerance);

}  // namespace fusee
