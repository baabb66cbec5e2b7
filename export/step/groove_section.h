/// \file
/// A groove across: from lip to lip, with the arc of its seat where that is round.
#pragma once

#include <optional>
#include <vector>

#include "fusee/mechanism/mechanism.h"
#include "fusee/solid/layout.h"

namespace fusee {

/// The arc of a groove's seat in its section.
struct Seat {
  double radius = 0;
  double below = 0, above = 0;  ///< how far the arc turns to both sides of the floor, rad

  /// Where the arc is cut: one of a single span has a weight that is well away from 0. From −below to above.
  std::vector<double> angles() const;
};

/// Null: the groove is drawn straight from corner to corner.
std::optional<Seat> seat_of(const GrooveWalls& walls, const Mechanism& mechanism);

}  // namespace fusee
