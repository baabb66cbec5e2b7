#include "export/report/home_words.h"

#include <cmath>
#include <optional>

#include "base/text.h"

namespace fusee::formats {
namespace {

/// Position of the knot of tendon 2 in the frame of the mesh, mm.
std::optional<Vec2> knot_of_tendon2(const Product& product) {
  if (product.helix) {
    for (const helical_solid::HelicalAnchor& anchor : product.helix->pulley.anchors) {
      if (anchor.side == transmission::Side::right) return Vec2(anchor.pocket.head<2>());
    }
    return std::nullopt;
  }
  for (const solid::Anchor& anchor : product.pulley.anchors) {
    if (anchor.side == transmission::Side::right && anchor.wound_end) return anchor.pocket;
  }
  return std::nullopt;
}

}  // namespace

std::string home_words(const Product& product) {
  if (product.pulley.has_home_mark()) return "the home mark pointing to +y";
  const std::optional<Vec2> knot = knot_of_tendon2(product);
  if (!knot) return "its +y of the drawings pointing to +y";
  const double turn = degrees(std::remainder(elementary::atan2(knot->y(), knot->x()) - 0.5 * k_pi, k_two_pi));
  return "tendon 2’s knot pocket " + fixed(std::abs(turn), 0) + "° " + (turn > 0 ? "counter-clockwise" : "clockwise") +
         " of +y, seen from above (it has no home mark)";
}

}  // namespace fusee::formats
