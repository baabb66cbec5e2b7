/// \file
/// pulley.step: the part as a solid of exact surfaces, AP214, mm, for CAD. OpenCASCADE writes it, in the module
/// `fusee-step`, which is loaded on demand. A fusee may be built or installed without it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/export.h"
#include "fusee/helical_solid.h"

namespace fusee::formats {

/// The reason why this fusee cannot write STEP; empty if it can. Loads the module.
std::optional<std::string> step_missing();

struct StepFile {
  std::string bytes;
  std::string complaint;  ///< OpenCASCADE's error, if there are no bytes
};
/// Grooves are B-splines within 1e-4 mm of the curves. Throws InputError if they require more pieces than a CAD part
/// may have ("too large for STEP: …"). The same part gives the same bytes.
StepFile step_file(const Product& product);

/// Result of reading a written file back.
struct StepInspection {
  std::vector<Check> checks;
  Polygon floor1, floor2;  ///< one turn: groove floors of P1 and P2, with shrinkage compensation, mm
  std::vector<helical_solid::FloorLine> helical;  ///< several turns: helical floors, without that compensation, mm
};
/// `tolerance`: of the mesh that the volume is compared with, mm.
StepInspection inspect_step(const std::filesystem::path& path, const Product& product, double tolerance);

}  // namespace fusee::formats
