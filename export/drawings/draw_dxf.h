/// \file
/// Internal: model space of a DXF file as points in mm, with inserted blocks expanded.
#pragma once

#include <string>

#include "export/drawings/dxf_file.h"
#include "fusee/export.h"

namespace fusee::formats {

/// Paths in the order of the file, with ends not yet joined. Blocks nest at most 16 deep, and excessive expansion is
/// rejected. Throws InputError.
Drawing draw_dxf(const DxfFile& dxf, const std::string& file);

}  // namespace fusee::formats
