#include "solid/corners.h"

#include <cstddef>

namespace fusee::solid {
namespace {

// Least projection of a corner from the line between its neighbours, mm. Angles are meaningless for edges as short as a
// float step. The corners of a circle of 200 facets and 5 mm project by ten times this.
constexpr double k_straight = 1e-4;

}  // namespace

Polygon corners_of(Polygon corners) {
  while (corners.size() > 3) {
    const std::size_t n = corners.size();
    std::size_t flattest = 0;
    double least = k_straight;
    for (std::size_t i = 0; i < n; ++i) {
      const double out = distance_to_segment(corners[i], corners[(i + n - 1) % n], corners[(i + 1) % n]);
      if (out >= least) continue;
      least = out;
      flattest = i;
    }
    if (least == k_straight) break;
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(flattest));
  }
  return corners;
}

}  // namespace fusee::solid
