/// \file
/// Internal: the check square and the notes of a drawing on sheets. mm.
#pragma once

#include <string>
#include <vector>

#include "export/drawings/dxf_writer.h"
#include "fusee/base.h"

namespace fusee::formats {

/// The cutter's path for a square whose cut piece is 10 mm wide, with its lower left corner at the origin: half a kerf
/// outside, as for every outline. The piece's excess over 10 mm is then the error of the kerf.
Polygon check_square(double kerf);

/// "lines are the centre of the cut: outlines half a kerf (0.1 mm) outside, …".
std::string kerf_remark(double kerf);

/// Adds lines of text on layer NOTES below the first sheet, wrapped to its width.
void add_sheet_notes(DxfDocument& drawing, const std::vector<std::string>& notes, double sheet_width);

}  // namespace fusee::formats
