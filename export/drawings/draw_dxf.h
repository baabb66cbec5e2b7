/// \file
/// Model space of a DXF file, drawn: entities and inserted blocks as points in their places, in mm.
#pragma once

#include <string>

#include "export/drawings/dxf_file.h"
#include "fusee/export/drawings.h"

namespace fusee {

/// Paths as they come, ends that meet not joined yet. Blocks nest 16 deep at most; what would grow beyond all measure
/// is refused. Throws InputError.
Drawing draw_dxf(const DxfFile& dxf, const std::string& file);

}  // namespace fusee
