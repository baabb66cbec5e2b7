#include "export/drawings/plates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/text.h"
#include "export/drawings/cut_shapes.h"
#include "export/drawings/nesting.h"
#include "export/drawings/plane_shapes.h"
#include "export/drawings/polygon_cgal.h"
#include "export/drawings/sheet_notes.h"
#include "export/drawings/stroke_font.h"
#include "fusee/base.h"
#include "solid/body.h"
#include "solid/dowels.h"

namespace fusee::formats {
namespace {

constexpr double k_least_wall = 1.0;        // least material between cuts, mm
constexpr double k_least_feature = 1.0;     // narrowest feature that a laser cuts cleanly, mm
constexpr double k_groove_width = 1.1;      // between the flanges, in tendon diameters
constexpr double k_engraving_margin = 0.5;  // from an engraving to every edge, mm

/// The features that plates are cut with, collected once.
struct CutFeatures {
  const Product& product;
  const Mechanism& mechanism;
  solid::BodyLayout layout;
  Contour bore;
  std::vector<Contour> screw_holes;
  solid::FlangeRims rims;
  Polygon floor1;
  Polygon floor2;
  double wall;  ///< least material between cuts, mm

  explicit CutFeatures(const Product& made)
      : product(made),
        mechanism(made.joint.mechanism),
        layout(layout_to_cut(made)),
        bore(bore_contour(layout.bore)),
        rims(solid::flange_rims(made.synthesis.p1, made.synthesis.p2, mechanism.tendon.diameter, layout.groove_depth,
                                mechanism.body.flange)),
        floor1(profile::parallel(made.synthesis.p1, -0.5 * mechanism.tendon.diameter)),
        floor2(profile::parallel(made.synthesis.p2, -0.5 * mechanism.tendon.diameter)),
        wall(std::max(layout.min_wall, k_least_wall)) {
    std::vector<Polygon> holes = layout.bore.screw_holes;
    // A recess goes through all plates and includes the centre hole above it, which is the first hole.
    if (layout.bore.horn_recess > 0) holes.erase(holes.begin());
    for (const Polygon& hole : holes) screw_holes.push_back(circle_contour(solid::circle_within(hole)));
  }

  Contour pocket(const solid::Anchor& anchor) const {
    return circle_contour({anchor.pocket, 2 * layout.pocket_radius});
  }
  /// An anchor's cuts into the edge of a plate. A knot in a pocket requires channel and pocket in the plate of its
  /// groove. A tie-off through the face requires a slot in the plate of its flange.
  std::vector<Polygon> edge_cuts(const solid::Anchor& anchor) const {
    std::vector<Polygon> parts{anchor.channel};
    if (!anchor.seat) parts.push_back(pocket(anchor).points);
    return parts;
  }
};

/// Adds a note about something that is not as declared, once.
void note_omission(Plates& plates, const std::string& note) {
  if (std::find(plates.notes.begin(), plates.notes.end(), note) != plates.notes.end()) return;
  plates.notes.push_back(note);
  plates.omissions.push_back(note);
}

// ---- Dowels ---------------------------------------------------------------------------------------------------------

/// The material common to all plates: within both floors, clear of all cuts.
Material2d common_material(const CutFeatures& features) {
  Material2d material;
  material.add_outline(features.floor1);
  material.add_outline(features.floor2);
  material.add_hole(features.bore.points);
  for (const Contour& hole : features.screw_holes) material.add_hole(hole.points);
  for (const solid::Anchor& anchor : features.product.pulley.anchors) {
    if (anchor.channel.size() > 2) material.add_hole(anchor.channel);
    if (features.layout.pocket_radius > 0 && !anchor.seat) material.add_hole(features.pocket(anchor).points);
  }
  return material;
}

std::optional<std::pair<Vec2, Vec2>> dowel_places(const CutFeatures& features, const Material2d& material,
                                                  double diameter) {
  return solid::pin_places(circumradius(features.floor1), diameter, features.wall,
                           [&](const Vec2& place) { return material.holds(place, 0.5 * diameter + features.wall); });
}

void place_dowels(Plates& plates, const CutFeatures& features) {
  const double declared = features.mechanism.cut.dowel;
  if (!(declared > 0)) {
    plates.notes.push_back("no dowels: cut.dowel_mm = 0");
    return;
  }
  const Material2d material = common_material(features);
  constexpr double k_shares[] = {1.0, 0.85, 0.7, 0.5, 0.35};  // of the declared diameter, until there is space
  for (const double share : k_shares) {
    const double diameter = share * declared;
    if (diameter - features.mechanism.cut.kerf < k_least_feature) break;  // the cutter's path would be too narrow
    const auto places = dowel_places(features, material, diameter);
    if (!places) continue;
    plates.dowels = {places->first, places->second};
    plates.dowel_diameter = diameter;
    if (share < 1)
      note_omission(plates,
                    fmt::format("dowels of {} mm: there is no space for {} mm", rounded(diameter), rounded(declared)));
    return;
  }
  const char* why =
      declared - features.mechanism.cut.kerf < k_least_feature ? "the cut would be too narrow" : "there is no space";
  note_omission(plates,
                fmt::format("no dowels: {} for two of {} mm; align the plates on the shaft", why, rounded(declared)));
}

// ---- Shapes ---------------------------------------------------------------------------------------------------------

class LayerMaker {
 public:
  LayerMaker(Plates& plates, const CutFeatures& features)
      : plates_(plates), features_(features), kerf_(features.mechanism.cut.kerf) {}

  /// `channels`: anchors that are cut into this plate's edge; `pockets`: those whose pocket is a hole in it.
  void add(const std::string& name, int count, const Polygon& outline,
           const std::vector<const solid::Anchor*>& channels, const std::vector<const solid::Anchor*>& pockets) {
    PlateLayer layer;
    layer.name = name;
    layer.count = count;
    layer.outer = {outline};
    layer.cut_outer = {cut_around(outline, 0.5 * kerf_)};
    for (const solid::Anchor* anchor : channels) cut_channel(layer, *anchor);
    add_hole(layer, features_.bore, "bore");
    for (const Contour& hole : features_.screw_holes) add_hole(layer, hole, "screw hole");
    for (const Vec2& dowel : plates_.dowels)
      add_hole(layer, circle_contour({dowel, plates_.dowel_diameter}), "dowel hole");
    for (const solid::Anchor* anchor : pockets) add_hole(layer, features_.pocket(*anchor), "knot pocket");
    plates_.layers.push_back(std::move(layer));
  }

 private:
  void add_hole(PlateLayer& layer, const Contour& hole, const char* name) {
    const auto path = cut_hole(hole, kerf_);
    if (!path) {
      note_omission(plates_, fmt::format("the {} is omitted: a kerf of {} mm is wider", name, rounded(kerf_)));
      return;
    }
    if (bounding_box(path->points).size().minCoeff() < k_least_feature) {
      note_omission(
          plates_,
          fmt::format("{}: the {} of {} mm is omitted, the cut would be narrower than {} mm: drill it", layer.name,
                      name, rounded(bounding_box(hole.points).size().minCoeff(), 3), rounded(k_least_feature)));
      return;
    }
    layer.holes.push_back(hole);
    layer.cut_holes.push_back(*path);
  }

  /// Channel and pocket are narrowed by half a kerf on each side before they are subtracted from the cutter's path. The
  /// path is thus parallel to the finished edges, with mitred corners.
  void cut_channel(PlateLayer& layer, const solid::Anchor& anchor) {
    std::vector<Polygon> finished;
    std::vector<Polygon> path;
    for (const Polygon& part : features_.edge_cuts(anchor)) {
      const auto inner = part.size() > 2 && is_simple(part) ? cut_hole({part, {}, 0}, kerf_) : std::nullopt;
      if (!inner) {
        note_omission(plates_, fmt::format("a tendon channel is omitted: a kerf of {} mm is wider", rounded(kerf_)));
        return;
      }
      finished.push_back(part);
      path.push_back(inner->points);
    }
    const std::vector<Polygon> outer = difference(layer.outer.front(), finished);
    const std::vector<Polygon> cut_outer = difference(layer.cut_outer.front(), path);
    if (!is_one_plate(outer) || !is_one_plate(cut_outer)) {
      note_omission(plates_, fmt::format("{}: a tendon channel is omitted, it would cut the plate in two", layer.name));
      return;
    }
    layer.outer = {outer.front()};
    layer.cut_outer = {cut_outer.front()};
  }

  /// The remaining plate must be connected and open at the tendon's entry. Slivers are ignored.
  static bool is_one_plate(const std::vector<Polygon>& loops) {
    constexpr double k_sliver = 1.0;  // mm²
    return !loops.empty() && is_simple(loops.front()) &&
           (loops.size() == 1 || std::abs(signed_area(loops[1])) < k_sliver);
  }

  Plates& plates_;
  const CutFeatures& features_;
  double kerf_;
};

/// Radius of the hub's disc, wide enough for the dowels.
double hub_radius(const CutFeatures& features, const Plates& plates) {
  double radius = features.layout.hub_radius;
  for (const Vec2& dowel : plates.dowels)
    radius = std::max(radius, dowel.norm() + 0.5 * plates.dowel_diameter + features.wall);
  return radius;
}

void add_layers(Plates& plates, const CutFeatures& features) {
  const double thickness = features.mechanism.cut.plate;
  const int flange = plates_for(features.layout.flange_thickness, thickness);
  const int core = plates_for(k_groove_width * features.mechanism.tendon.diameter, thickness);
  const auto anchors_of = [&features](transmission::Side side, bool through_face) {
    std::vector<const solid::Anchor*> anchors;
    if (features.layout.pocket_radius <= 0) return anchors;
    for (const solid::Anchor& anchor : features.product.pulley.anchors) {
      if (anchor.side == side && anchor.seat.has_value() == through_face) anchors.push_back(&anchor);
    }
    return anchors;
  };
  const auto left = anchors_of(transmission::Side::left, false), right = anchors_of(transmission::Side::right, false);
  LayerMaker maker(plates, features);
  maker.add("FLANGE 1", flange, features.rims.lower, anchors_of(transmission::Side::left, true), left);
  maker.add("P1 CORE", core, features.floor1, left, {});
  maker.add("MIDDLE", flange, features.rims.middle, {}, {});
  maker.add("P2 CORE", core, features.floor2, right, {});
  maker.add("FLANGE 2", flange, features.rims.upper, anchors_of(transmission::Side::right, true), right);
  if (features.layout.hub_radius > 0) {
    maker.add("HUB", plates_for(features.layout.z_hub - features.layout.z_top, thickness),
              circle_polygon({0, 0}, hub_radius(features, plates)), {}, {});
  }
}

// ---- Engraving ------------------------------------------------------------------------------------------------------

Material2d material_of(const PlateLayer& layer) {
  Material2d material;
  material.add_outline(layer.outer.front());
  for (const Contour& hole : layer.holes) material.add_hole(hole.points);
  return material;
}

/// A short line at the edge in the home direction, +y, as far from the axis as the plate allows.
void engrave_home(PlateLayer& layer, const Material2d& material) {
  constexpr double k_length = 2.5, k_step = 0.25;  // mm
  const double top = bounding_box(layer.outer.front()).high.y();
  for (double y = top - k_engraving_margin; y > 0; y -= k_step) {
    const Vec2 low(0, y - k_length);
    if (!material.holds_box(low, {0, k_length}, k_engraving_margin)) continue;
    layer.engraving.push_back({low, {0, y}});
    return;
  }
}

/// The first free place for a label of this size, from below the axis upward.
std::optional<Vec2> label_place(const PlateLayer& layer, const Material2d& material, const Vec2& size) {
  const Box2d box = bounding_box(layer.outer.front());
  for (double y = box.low.y(); y + size.y() < box.high.y(); y += 1.0) {
    for (int step = 0; step < 40; ++step) {
      // The label's middle alternates between left and right, from the axis outward, by eightieths of the plate's
      // width.
      const int side = step % 2 ? 1 : -1;
      const double middle = side * 0.5 * (step + 1) / 2.0 * (box.size().x() / 20);
      const double x = middle - 0.5 * size.x();
      if (x < box.low.x() || x + size.x() > box.high.x()) continue;
      const double margin = k_engraving_margin;
      const bool is_on_home_mark = !layer.engraving.empty() && x < margin && x + size.x() > -margin &&
                                   y + size.y() > layer.engraving[0][0].y() - margin;
      if (!is_on_home_mark && material.holds_box({x, y}, size, k_engraving_margin)) return Vec2(x, y);
    }
  }
  return std::nullopt;
}

std::string label_text(const PlateLayer& layer, LabelKind kind, int number, int total) {
  if (kind == LabelKind::number) return std::to_string(number);
  return fmt::format("{}/{}{}", number, total, kind == LabelKind::name ? " " + layer.name : "");
}

void engrave(Plates& plates, std::size_t index, int total) {
  PlateLayer& layer = plates.layers[index];
  const Material2d material = material_of(layer);
  engrave_home(layer, material);
  for (const LabelKind kind : {LabelKind::name, LabelKind::count, LabelKind::number}) {
    const std::string widest = label_text(layer, kind, total, total);
    for (const double height : {3.0, 2.2, 1.6}) {  // of the capitals, mm
      const auto place = label_place(layer, material, {stroke_text_width(widest, height), height});
      if (!place) continue;
      layer.label = *place;
      layer.label_height = height;
      layer.label_kind = kind;
      return;
    }
  }
  plates.notes.push_back(layer.name + ": there is no space for the plate's number");
}

// ---- Notes ----------------------------------------------------------------------------------------------------------

void describe_stack(Plates& plates, const CutFeatures& features) {
  const double thickness = features.mechanism.cut.plate;
  std::vector<std::string> lines;
  int first = 1;
  for (const PlateLayer& layer : plates.layers) {
    const int last = first + layer.count - 1;
    const std::string which =
        layer.count == 1 ? fmt::format("plate {}", first) : fmt::format("plates {} to {}", first, last);
    lines.push_back(fmt::format("{}: {} - z {} to {} mm", layer.name, which, rounded((first - 1) * thickness),
                                rounded(last * thickness)));
    first = last + 1;
  }
  const double groove_width = thickness * plates.layers[1].count;  // "P1 CORE" is between the flanges
  const double tendon_diameter = features.mechanism.tendon.diameter;
  lines.push_back(fmt::format("stack from plate 1 upward, numbers facing up, home marks in line; plates of {} mm",
                              rounded(thickness)));
  lines.push_back(
      fmt::format("the grooves are {} mm wide for a tendon of {} mm", rounded(groove_width), rounded(tendon_diameter)));
  if (features.layout.set_screw.present) lines.push_back("the plates have no set screw: drill it across the hub");
  if (std::any_of(features.product.pulley.anchors.begin(), features.product.pulley.anchors.end(),
                  [](const solid::Anchor& anchor) { return anchor.tail.has_value(); }))
    lines.push_back("the plates have no slots for the tendons' tails: glue the tails down");
  if (features.layout.bore.horn_recess > 0)
    lines.push_back(fmt::format("the horn's recess goes through all plates; it would be {} mm deep",
                                rounded(features.layout.bore.horn_recess)));
  plates.notes.insert(plates.notes.begin(), lines.begin(), lines.end());
}

/// Adds notes about cut features that are narrower than k_least_feature.
void note_small_features(Plates& plates, const CutFeatures& features) {
  const double narrow = features.layout.channel_width;
  if (!features.product.pulley.anchors.empty() && narrow < k_least_feature) {
    plates.notes.push_back(fmt::format("the tendon channels are {} mm wide, below {} mm: see body.anchor_hole_mm",
                                       rounded(narrow), rounded(k_least_feature)));
  }
  for (const PlateLayer& layer : plates.layers) {
    for (const Contour& hole : layer.holes) {
      const double width = bounding_box(hole.points).size().minCoeff();
      if (width < k_least_feature)
        plates.notes.push_back(
            fmt::format("{}: a hole is {} mm wide, below {} mm", layer.name, rounded(width), rounded(k_least_feature)));
    }
  }
}

// ---- Sheets ---------------------------------------------------------------------------------------------------------

/// The sheet of [cut], or the size that the largest plate requires, in whole mm. A larger sheet changes no cut, and
/// another machine may take it. `sizes`: of the placed plates, and last of the check square.
void choose_sheet(Plates& plates, const Cut& cut, const std::vector<Vec2>& sizes, double gap) {
  const Vec2 declared(cut.sheet_width, cut.sheet_height);
  plates.sheet = declared;
  std::string larger;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Vec2 needed = (sizes[i] + Vec2::Constant(2 * gap)).array().ceil().matrix();
    if ((needed.array() <= declared.array()).all()) continue;
    plates.sheet = plates.sheet.cwiseMax(needed);
    larger += fmt::format("{}{} requires {} x {} mm", larger.empty() ? "" : ", ",
                          i < plates.placed.size() ? plates.layers[plates.placed[i].layer].name : "CHECK SQUARE",
                          rounded(needed.x()), rounded(needed.y()));
  }
  if (larger.empty()) return;
  note_omission(plates, fmt::format("a sheet of {} x {} mm (cut.sheet_width_mm, cut.sheet_height_mm) is too small: "
                                    "drawn on {} x {} mm, because {}",
                                    rounded(declared.x()), rounded(declared.y()), rounded(plates.sheet.x()),
                                    rounded(plates.sheet.y()), larger));
}

void lay_on_sheets(Plates& plates, const Cut& cut) {
  std::vector<Vec2> sizes;
  std::vector<Vec2> axes;  // from the box's lower left corner
  for (std::size_t i = 0; i < plates.layers.size(); ++i) {
    const Box2d box = bounding_box(plates.layers[i].cut_outer.front());
    for (int k = 0; k < plates.layers[i].count; ++k) {
      plates.placed.push_back({i, static_cast<int>(plates.placed.size()) + 1, Vec2::Zero()});
      sizes.push_back(box.size());
      axes.push_back(-box.low);
    }
  }
  constexpr double k_least_gap = 2.0;  // mm, between pieces
  const double gap = std::max(k_least_gap, 2 * cut.kerf);
  sizes.push_back(bounding_box(check_square(cut.kerf)).size());
  choose_sheet(plates, cut, sizes, gap);
  const std::vector<NestedPlace> places = nest(sizes, plates.sheet, gap);
  for (std::size_t i = 0; i < plates.placed.size(); ++i)
    plates.placed[i].shift = corner_on_drawing(places[i], plates.sheet) + axes[i];
  plates.check_square = corner_on_drawing(places.back(), plates.sheet);
  plates.sheets = sheet_count(places);
}

}  // namespace

int plates_for(double height, double thickness) {
  return std::max(1, static_cast<int>(std::ceil(height / thickness - 1e-6)));  // a rounding error adds no plate
}

std::string plate_label(const Plates& plates, const PlacedPlate& plate) {
  const PlateLayer& layer = plates.layers[plate.layer];
  return label_text(layer, layer.label_kind, plate.number, static_cast<int>(plates.placed.size()));
}

std::vector<std::string> plate_omissions(const Product& product) { return make_plates(product).omissions; }

Plates make_plates(const Product& product) {
  const CutFeatures features(product);
  Plates plates;
  place_dowels(plates, features);
  add_layers(plates, features);
  const int total = std::accumulate(plates.layers.begin(), plates.layers.end(), 0,
                                    [](int sum, const PlateLayer& layer) { return sum + layer.count; });
  for (std::size_t i = 0; i < plates.layers.size(); ++i) engrave(plates, i, total);
  note_small_features(plates, features);
  describe_stack(plates, features);
  lay_on_sheets(plates, features.mechanism.cut);
  return plates;
}

}  // namespace fusee::formats
