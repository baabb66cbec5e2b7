/// \file
/// Reads DXF: ASCII, R12 to R2018. Straight and curved entities of model space become polylines in mm. Open ones whose
/// ends meet on one layer (end_points.h: within 1e-4 mm) are joined. Other entities (text, dimensions, hatches …) are
/// listed in `ignored`, and so are invisible entities and those of layers that are off or frozen.
///
/// Bytes → tags (dxf_tags.h) → header, layers, blocks, entities (dxf_file.h) → placed curves (draw_dxf.h, with
/// entity_curves.h and sampled_curves.h) → chains (join_paths.h).
///
/// Safe for any bytes: every number is checked, blocks nest at most 16 deep, and the whole drawing may have 4 million
/// points.
#include "export/drawings/draw_dxf.h"
#include "export/drawings/dxf_file.h"
#include "export/drawings/dxf_tags.h"
#include "export/drawings/join_paths.h"
#include "fusee/export.h"

namespace fusee::formats {
namespace {

void refuse_other_formats(std::string_view bytes, const std::string& file) {
  if (bytes.starts_with("AutoCAD Binary DXF"))
    fail_in_dxf(file, 0, "this is a binary DXF", "save it as ASCII DXF (R12, or 2000 and later)");
  if (bytes.starts_with("AC10"))
    fail_in_dxf(file, 0, "this is a DWG drawing", "save it as ASCII DXF (R12, or 2000 and later)");
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) fail_in_dxf(file, 0, "the file is empty");
}

}  // namespace

Drawing read_dxf(std::string_view bytes, const std::string& file_name) {
  constexpr std::string_view k_byte_order_mark = "\xEF\xBB\xBF";
  if (bytes.starts_with(k_byte_order_mark)) bytes.remove_prefix(k_byte_order_mark.size());
  refuse_other_formats(bytes, file_name);
  Drawing drawing = draw_dxf(read_dxf_file(bytes, file_name), file_name);
  drawing.paths = joined_paths(std::move(drawing.paths));
  return drawing;
}

}  // namespace fusee::formats
