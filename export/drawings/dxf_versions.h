/// \file
/// A document in either of the versions of DXF that are written. dxf_text() has looked at it before.
#pragma once

#include <string>
#include <string_view>

#include "export/drawings/dxf_tag_writer.h"
#include "export/drawings/dxf_writer.h"

namespace fusee {

std::string r12_text(const DxfDocument& document);
std::string ac1015_text(const DxfDocument& document);

// What both say ------------------------------------------------------------------------------------------------------

void write_remarks(DxfTagWriter& tags, const DxfDocument& document);
/// The header's variables that both know: version, extents, units.
void write_variables(DxfTagWriter& tags, std::string_view version, const Box2d& box);
/// Centre and radius.
void write_circle_values(DxfTagWriter& tags, const RoundHole& circle);
/// Of the one text style, which no text is written in.
void write_style_values(DxfTagWriter& tags);

}  // namespace fusee
