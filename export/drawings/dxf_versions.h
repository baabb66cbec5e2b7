/// \file
/// Internal: writers of both DXF versions. Their documents have been validated by dxf_text().
#pragma once

#include <string>
#include <string_view>

#include "export/drawings/dxf_tag_writer.h"
#include "export/drawings/dxf_writer.h"

namespace fusee::formats {

std::string r12_text(const DxfDocument& document);
std::string ac1015_text(const DxfDocument& document);

// Flags of polylines and vertices, group 70 ------------------------------------------------------------------------

inline constexpr int k_closed = 1;
inline constexpr int k_polyline_3d = 8;
inline constexpr int k_vertex_3d = 32;

// Common to both versions -------------------------------------------------------------------------------------------

void write_remarks(DxfTagWriter& tags, const DxfDocument& document);
/// Header variables of both versions: version, extents, units.
void write_variables(DxfTagWriter& tags, std::string_view version, const Box2d& box);
/// Writes centre and radius.
void write_circle_values(DxfTagWriter& tags, const solid::RoundHole& circle);
/// Writes the values of the text style that readers require, although text is drawn as strokes.
void write_style_values(DxfTagWriter& tags);

}  // namespace fusee::formats
