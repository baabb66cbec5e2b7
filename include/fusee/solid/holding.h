/// \file
/// How the tendons are held on the pulley: the tension that the wrap leaves at each knot, compared with the knot's
/// strength. N, rad.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fusee/analysis/analysis.h"
#include "fusee/analysis/stroke.h"
#include "fusee/profile/synthesis.h"
#include "fusee/solid/pulley.h"

namespace fusee {

/// Largest safe fraction of a knot's strength. Above it, varying loads wear the knot out. Rope makers require a factor
/// of 2 or more on static loads alone.
inline constexpr double k_safe_knot_share = 0.5;

/// The knot of one tendon on its pulley at its largest load: over the stroke, in both directions of motion, with and
/// without the declared load.
struct KnotHold {
  Side side = Side::left;
  double alpha = 0;
  double wrap_left = 0;  ///< wrap between take-off and tie-off at `alpha`
  double tension = 0;    ///< tension of the tendon between pulley and pin at `alpha`
  double at_knot = 0;    ///< tension · e^(−μ · wrap_left), the capstan equation with pulley.friction
};

struct Holding {
  std::vector<KnotHold> knots;       ///< one for each tied tendon
  std::optional<Strength> strength;  ///< strength of the tendon, if known
  std::vector<std::string> warnings;
  std::vector<StrokePoint> loaded;  ///< the declared load's cycle at each place of the synthesis' stroke

  /// Tension at the knot as a fraction of its strength; empty if the strength is unknown.
  std::optional<double> share(const KnotHold& knot) const;
};

/// Requires a pulley that was made. Each warning lists changes with which all knots bear at most half of their
/// strength. Each listed change was tried.
Holding tendon_holding(const Mechanism& mechanism, const SynthesisResult& synthesis, const Pulley& pulley);

}  // namespace fusee
