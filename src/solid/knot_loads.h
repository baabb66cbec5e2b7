/// \file
/// Internal: the largest tension of each tendon where it leaves the pulley, and the part of it that reaches a knot
/// after the wrap.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fusee/analysis.h"
#include "fusee/solid.h"
#include "solid/tie_offs.h"

namespace fusee::solid {

/// Tension at a take-off, and the angle from it to the end of the active arc. rad, N
struct TakeOffLoad {
  double alpha = 0;
  double tension = 0;
  double turn = 0;
};
using StrokeLoads = std::array<std::vector<TakeOffLoad>, 2>;  ///< for P1 and P2

/// The largest tension at each take-off. `loaded`: the declared load's cycle. The unloaded cycle counts too, because a
/// load that relieves one tendon loads the other.
StrokeLoads stroke_loads(const Mechanism& mechanism, const std::vector<transmission::TransmissionPoint>& stroke,
                         const std::vector<analysis::StrokePoint>& loaded);

/// The knot at its largest load. `wrap_past_arc`: wrap between the end of the active arc and the tie-off, rad.
KnotHold worst_knot(transmission::Side side, const StrokeLoads& loads, double mu, double wrap_past_arc);

/// Loads of the knots on planned tie-offs. Computed only if the tendon's strength is known.
class KnotLoads {
 public:
  KnotLoads(const Mechanism& mechanism, const profile::SynthesisResult& synthesis);

  /// Number of knots that carry more than the safe fraction of their strength; 0 if it is unknown.
  int count_unsafe(const std::vector<PlannedAnchor>& anchors) const;

 private:
  double mu_;
  Holding holding_;
  StrokeLoads loads_;
};

}  // namespace fusee::solid
