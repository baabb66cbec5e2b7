// kit.dxf: base plate, scale, link and bracket as plates to cut, nested on sheets. Engravings and the check square come
// first, then holes, then outlines, because a plate that is cut free may move.

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "export/drawings/cut_shapes.h"
#include "export/drawings/dxf_writer.h"
#include "export/drawings/nesting.h"
#include "export/drawings/plane_shapes.h"
#include "export/drawings/plates.h"
#include "export/drawings/sheet_notes.h"
#include "export/drawings/stroke_font.h"
#include "fusee/export.h"

namespace fusee::formats {
namespace {

constexpr double k_sheet_margin = 4;  // mm
constexpr double k_label_height = 3;  // mm
/// Thinner slabs are engraved instead of cut, mm. The kit's engravings are 0.6 mm deep (kit/parts.cpp).
constexpr double k_engraving_depth = 0.61;
constexpr double k_least_cut = 1.0;  // mm, narrowest feature that a laser cuts cleanly

/// One shape of plate.
struct KitPlate {
  std::string label;
  int count = 1;
  kit::DiscHull rim;
  std::vector<kit::DiscHull> holes;
  std::vector<kit::DiscHull> lines;  ///< engraved, each from the centre of its first disc to that of its last
  double height = 0;                 ///< of all slabs of this shape, mm
};

bool is_same(const kit::DiscHull& a, const kit::DiscHull& b) { return kit::outline_of(a) == kit::outline_of(b); }

bool has_hole(const KitPlate& plate, const kit::DiscHull& hull) {
  return std::any_of(plate.holes.begin(), plate.holes.end(),
                     [&](const kit::DiscHull& hole) { return is_same(hole, hull); });
}

std::string capitals(std::string name) {
  for (char& c : name) {
    if (c == '_') c = ' ';
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return name;
}

/// Adds the slabs of a part as plates, bottom to top, up to the first slab that consists of several pieces. A thin slab
/// becomes an engraving of the plate below.
void add_plates(std::vector<KitPlate>& plates, const kit::KitPart& part, double thickness) {
  const std::size_t first = plates.size();
  for (const kit::Slab& slab : part.body.slabs) {
    std::vector<const kit::SlabLoop*> rims;
    for (const kit::SlabLoop& loop : slab.loops) {
      if (!loop.hole) rims.push_back(&loop);
    }
    if (rims.size() != 1) break;  // the tensioner's guide on the link is printed
    KitPlate plate;
    plate.label = capitals(part.name);
    plate.rim = rims.front()->hull;
    plate.height = slab.high - slab.low;
    const bool engraved = plates.size() > first && plate.height < k_engraving_depth;
    for (const kit::SlabLoop& loop : slab.loops) {
      if (!loop.hole) continue;
      if (!engraved)
        plate.holes.push_back(loop.hull);
      else if (!has_hole(plates.back(), loop.hull))
        plates.back().lines.push_back(loop.hull);
    }
    if (engraved)
      plates.back().height += plate.height;
    else
      plates.push_back(plate);
  }
  const bool has_several = plates.size() - first > 1;
  for (std::size_t i = first; i < plates.size(); ++i) {
    plates[i].count = plates_for(plates[i].height, thickness);
    if (has_several) plates[i].label += " " + std::to_string(i - first + 1);
  }
}

/// The outline of a hull, `outward` (mm) of it.
Contour contour_of(const kit::DiscHull& hull, double outward) {
  if (hull.discs.size() == 1)
    return circle_contour({hull.discs.front().centre, 2 * (hull.discs.front().radius + outward)});
  return {kit::outline_of(hull, outward), {}, 0};
}

double smallest_width(const kit::DiscHull& hull) {
  const Box2d bounding = bounding_box(kit::outline_of(hull));
  return bounding.size().minCoeff();
}

/// Lower left corner of a place for the plate's name, searched from the lower left of the plate upwards.
std::optional<Vec2> label_corner(const KitPlate& plate) {
  Material2d material;
  material.add_outline(kit::outline_of(plate.rim));
  for (const kit::DiscHull& hole : plate.holes) material.add_hole(kit::outline_of(hole));
  for (const kit::DiscHull& line : plate.lines) material.add_hole(kit::outline_of(line));
  const Vec2 size(stroke_text_width(plate.label, k_label_height), k_label_height);
  constexpr double k_margin = 1, k_step = 2;  // mm
  const Box2d box = bounding_box(kit::outline_of(plate.rim));
  for (double y = box.low.y() + k_margin; y + size.y() < box.high.y(); y += k_step) {
    for (double x = box.low.x() + k_margin; x + size.x() < box.high.x(); x += k_step) {
      if (material.holds_box({x, y}, size, k_margin)) return Vec2(x, y);
    }
  }
  return std::nullopt;
}

struct ShiftedPlate {
  const KitPlate* plate;
  Vec2 shift;
};

class KitSheets {
 public:
  KitSheets(const std::vector<KitPlate>& plates, const Cut& cut) : sheet_(cut.sheet_width, cut.sheet_height) {
    std::vector<Vec2> sizes;
    std::vector<Box2d> boxes;
    for (const KitPlate& plate : plates) {
      for (int i = 0; i < plate.count; ++i) {
        placed_.push_back({&plate, {0, 0}});
        boxes.push_back(bounding_box(kit::outline_of(plate.rim, 0.5 * cut.kerf)));
        sizes.push_back(boxes.back().size());
        sheet_ = sheet_.cwiseMax(sizes.back() + Vec2(2 * k_sheet_margin, 2 * k_sheet_margin));
      }
    }
    sizes.push_back(bounding_box(check_square(cut.kerf)).size());
    sheet_ = sheet_.cwiseMax(sizes.back() + Vec2(2 * k_sheet_margin, 2 * k_sheet_margin));
    const std::vector<NestedPlace> places = nest(sizes, sheet_, k_sheet_margin);
    for (std::size_t i = 0; i < placed_.size(); ++i)
      placed_[i].shift = corner_on_drawing(places[i], sheet_) - boxes[i].low;
    check_square_ = corner_on_drawing(places.back(), sheet_);
    count_ = sheet_count(places);
  }

  const std::vector<ShiftedPlate>& placed() const { return placed_; }
  /// Lower left corner of the check square.
  const Vec2& check_square_corner() const { return check_square_; }
  double width() const { return sheet_.x(); }
  void draw(DxfDocument& drawing) const {
    for (int i = 0; i < count_; ++i) {
      const Vec2 corner = sheet_corner(i, sheet_);
      drawing.add_closed("SHEET", rectangle(corner, corner + sheet_));
    }
  }

 private:
  Vec2 sheet_;
  int count_ = 1;
  std::vector<ShiftedPlate> placed_;
  Vec2 check_square_ = Vec2::Zero();
};

std::vector<std::string> remarks_of(const KitProduct& product, const std::vector<KitPlate>& plates) {
  const Mechanism& mechanism = product.pulley.joint.mechanism;
  std::vector<std::string> remarks{
      mechanism.name + ": the test rig's plates to cut, true size in mm", kerf_remark(mechanism.cut.kerf),
      "sheets of " + rounded(mechanism.cut.plate) + " mm; plates of one name are glued one upon another"};
  for (const KitPlate& plate : plates) {
    for (const kit::DiscHull& hole : plate.holes) {
      if (smallest_width(hole) - mechanism.cut.kerf < k_least_cut)
        remarks.push_back(plate.label + ": a hole of " + rounded(smallest_width(hole), 3) + " mm is omitted: drill it");
    }
  }
  return remarks;
}

}  // namespace

std::string kit_dxf(const KitProduct& product, DxfVersion version) {
  const Cut& cut = product.pulley.joint.mechanism.cut;
  std::vector<KitPlate> plates;
  for (const kit::KitPart& part : product.plan.parts) {
    if (part.plate) add_plates(plates, part, cut.plate);
  }
  const KitSheets sheets(plates, cut);
  DxfDocument drawing;
  drawing.layers = {{"ENGRAVE", 3},      {"CUT_INNER", 5},    {"CUT_OUTER", 1},
                    {"SHEET", 8, false}, {"NOTES", 8, false}, {"CHECK_10MM", 9, false}};
  drawing.remarks = remarks_of(product, plates);
  for (const auto& [plate, shift] : sheets.placed()) {
    for (const kit::DiscHull& line : plate->lines)
      drawing.add_open("ENGRAVE", {line.discs.front().centre + shift, line.discs.back().centre + shift});
    if (const auto corner = label_corner(*plate))
      drawing.add_text("ENGRAVE", plate->label, *corner + shift, k_label_height);
  }
  drawing.add_closed("CHECK_10MM", shifted(check_square(cut.kerf), sheets.check_square_corner()));
  for (const auto& [plate, shift] : sheets.placed()) {
    for (const kit::DiscHull& hole : plate->holes) {
      if (smallest_width(hole) - cut.kerf >= k_least_cut)
        drawing.add_closed("CUT_INNER", contour_of(hole, -0.5 * cut.kerf), shift);
    }
  }
  for (const auto& [plate, shift] : sheets.placed())
    drawing.add_closed("CUT_OUTER", shifted(kit::outline_of(plate->rim, 0.5 * cut.kerf), shift));
  sheets.draw(drawing);
  add_sheet_notes(drawing, drawing.remarks, sheets.width());
  return dxf_text(drawing, version);
}

}  // namespace fusee::formats
