/// \file
/// The part as a stack of plates: which there are, what is cut out of each, where its number stands, and how all lie on
/// the sheets. mm.
#pragma once

#include <string>
#include <vector>

#include "export/drawings/plane_shapes.h"
#include "fusee/base/plane.h"
#include "fusee/export/product.h"

namespace fusee {

/// What is engraved, by the room there is: "3/8 P1 CORE", "3/8", "3".
enum class LabelKind { name, count, number };

/// Plates of one shape, one upon another. Outlines are about the axis, outer ones counter-clockwise.
struct PlateLayer {
  std::string name;  ///< "FLANGE 1", "P1 CORE" …
  int count = 1;
  std::vector<Polygon> outer;      ///< as the finished plate: one, with the tendon's channels cut into it
  std::vector<Contour> holes;      ///< bore, dowels, pockets
  std::vector<Polygon> cut_outer;  ///< where the cutter's middle runs: half a kerf outside …
  std::vector<Contour> cut_holes;  ///< … and half a kerf inside of the hole
  std::vector<Polygon> engraving;  ///< the home mark: open strokes
  Vec2 label = Vec2::Zero();       ///< lower left corner of the number and name
  double label_height = 0;         ///< 0: there is no room for it
  LabelKind label_kind = LabelKind::name;
};

struct PlacedPlate {
  std::size_t layer = 0;
  int number = 1;             ///< counted from the bottom of the stack
  Vec2 shift = Vec2::Zero();  ///< of the axis, on the drawing
};

struct Plates {
  std::vector<PlateLayer> layers;   ///< bottom to top
  std::vector<PlacedPlate> placed;  ///< by number
  std::vector<Vec2>
      dowels;  ///< centres; all on different radii and not in line with the axis, so that a plate fits in one way
  double dowel_diameter = 0;
  Vec2 sheet = Vec2::Zero();       ///< what they are drawn on: the workshop's, larger where a plate asks for it
  int sheets = 1;                  ///< side by side from x = 0, k_sheet_gap between them
  std::vector<std::string> notes;  ///< which plates make what, and what could not be had
};

inline constexpr double k_sheet_gap = 20;

/// How the plates of a layer are counted: enough of them to be `height` thick, one at least.
int plates_for(double height, double plate);

Plates make_plates(const Product& product);

/// What is engraved on a plate.
std::string plate_label(const Plates& plates, const PlacedPlate& plate);

}  // namespace fusee
