/// \file
/// plates.dxf: all plates flat on their sheets, ready to cut. Engravings and the check square come first, then holes,
/// then outlines, because a plate that is cut free may move.
#include <algorithm>

#include "base/text.h"
#include "export/drawings/dxf_writer.h"
#include "export/drawings/nesting.h"
#include "export/drawings/plane_shapes.h"
#include "export/drawings/plates.h"
#include "export/drawings/sheet_notes.h"
#include "fusee/export.h"

namespace fusee::formats {
namespace {

void add_sheets(DxfDocument& drawing, const Plates& plates) {
  for (int i = 0; i < plates.sheets; ++i) {
    const Vec2 corner = sheet_corner(i, plates.sheet);
    drawing.add_closed("SHEET", rectangle(corner, corner + plates.sheet));
  }
}

void add_engraving(DxfDocument& drawing, const Plates& plates) {
  for (const PlacedPlate& plate : plates.placed) {
    const PlateLayer& layer = plates.layers[plate.layer];
    for (const Polygon& stroke : layer.engraving) drawing.add_open("ENGRAVE", shifted(stroke, plate.shift));
    if (layer.label_height > 0)
      drawing.add_text("ENGRAVE", plate_label(plates, plate), layer.label + plate.shift, layer.label_height);
  }
}

void add_cuts(DxfDocument& drawing, const Plates& plates) {
  for (const PlacedPlate& plate : plates.placed) {
    for (const Contour& hole : plates.layers[plate.layer].cut_holes) drawing.add_closed("CUT_INNER", hole, plate.shift);
  }
  for (const PlacedPlate& plate : plates.placed) {
    for (const Polygon& outline : plates.layers[plate.layer].cut_outer)
      drawing.add_closed("CUT_OUTER", shifted(outline, plate.shift));
  }
}

}  // namespace

std::string plates_dxf(const Product& product, DxfVersion version) {
  const Mechanism& mechanism = product.joint.mechanism;
  const Plates plates = make_plates(product);
  DxfDocument drawing;
  drawing.layers = {{"ENGRAVE", 3},      {"CUT_INNER", 5},    {"CUT_OUTER", 1},
                    {"SHEET", 8, false}, {"NOTES", 8, false}, {"CHECK_10MM", 9, false}};
  drawing.remarks = plates.notes;
  drawing.remarks.insert(drawing.remarks.begin(),
                         {mechanism.name + ": plates to cut, true size in mm, not scaled for a print's shrinkage",
                          kerf_remark(mechanism.cut.kerf)});
  add_engraving(drawing, plates);
  drawing.add_closed("CHECK_10MM", shifted(check_square(mechanism.cut.kerf), plates.check_square));
  add_cuts(drawing, plates);
  add_sheets(drawing, plates);
  add_sheet_notes(drawing, drawing.remarks, plates.sheet.x());
  return dxf_text(drawing, version);
}

}  // namespace fusee::formats
