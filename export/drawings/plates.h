/// \file
/// Internal: the part as a stack of plates, with the cut features, the number of each plate and its place on the
/// sheets. mm.
#pragma once

#include <string>
#include <vector>

#include "export/drawings/plane_shapes.h"
#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::formats {

/// The engraved label, depending on the space: "3/8 P1 CORE", "3/8", "3".
enum class LabelKind { name, count, number };

/// Stacked plates of one shape. Outlines are about the axis, outer ones counter-clockwise.
struct PlateLayer {
  std::string name;  ///< "FLANGE 1", "P1 CORE" …
  int count = 1;
  std::vector<Polygon> outer;      ///< of the finished plate: one outline, with the tendon's channels cut into it
  std::vector<Contour> holes;      ///< bore, screw holes, dowel holes, pockets
  std::vector<Polygon> cut_outer;  ///< path of the cutter's centre, half a kerf outside
  std::vector<Contour> cut_holes;  ///< paths half a kerf inside the holes
  std::vector<Polygon> engraving;  ///< the home mark: open strokes
  Vec2 label = Vec2::Zero();       ///< lower left corner of the number and name
  double label_height = 0;         ///< 0: no space
  LabelKind label_kind = LabelKind::name;
};

struct PlacedPlate {
  std::size_t layer = 0;
  int number = 1;             ///< counted from the bottom of the stack
  Vec2 shift = Vec2::Zero();  ///< position of the axis on the drawing
};

struct Plates {
  std::vector<PlateLayer> layers;   ///< bottom to top
  std::vector<PlacedPlate> placed;  ///< by number
  /// Centres, on different radii and not in line with the axis, so that plates fit in one orientation only.
  std::vector<Vec2> dowels;
  double dowel_diameter = 0;
  Vec2 sheet = Vec2::Zero();           ///< the sheet of [cut], or a larger one if a plate requires it
  Vec2 check_square = Vec2::Zero();    ///< position of its lower left corner on the drawing
  int sheets = 1;                      ///< side by side from x = 0, k_sheet_gap between them
  std::vector<std::string> notes;      ///< the order of the stack, and features that are narrow, changed or omitted
  std::vector<std::string> omissions;  ///< those of `notes` about features or sizes of [cut] that are not as declared
};

/// Number of plates of this thickness that make at least `height`, at least one.
int plates_for(double height, double thickness);

Plates make_plates(const Product& product);

/// The label engraved on a plate.
std::string plate_label(const Plates& plates, const PlacedPlate& plate);

}  // namespace fusee::formats
