/// \file
/// How the tendons are held on the pulley: what the wrap leaves to each knot, against what a knot bears. N, rad.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fusee/analysis/analysis.h"
#include "fusee/analysis/stroke.h"
#include "fusee/profile/synthesis.h"
#include "fusee/solid/pulley.h"

namespace fusee {

/// Above this share of what a knot bears, loads that come and go wear it out: makers of rope ask for a factor of 2 and
/// more on static loads alone.
inline constexpr double k_safe_knot_share = 0.5;

/// The knot of one tendon on its pulley, where it bears most: over the stroke, in both directions of motion, with the
/// declared load and without it.
struct KnotHold {
  Side side = Side::left;
  double alpha = 0;
  double wrap_left = 0;  ///< between take-off and tie-off at `alpha`
  double tension = 0;    ///< of the tendon between pulley and pin at `alpha`
  double at_knot = 0;    ///< tension · e^(−μ · wrap_left), the capstan equation with pulley.friction
};

struct Holding {
  std::vector<KnotHold> knots;       ///< one a tied tendon
  std::optional<Strength> strength;  ///< of the tendon, where it is known
  std::vector<std::string> warnings;
  std::vector<StrokePoint> loaded;  ///< the declared load's cycle at each place of the synthesis' stroke

  /// Of what it bears at a knot; null where that is not known.
  std::optional<double> share(const KnotHold& knot) const;
};

/// Of a pulley that was made. A warning names changes with which all knots bear no more than half of what they can;
/// each was tried.
Holding tendon_holding(const Mechanism& mechanism, const SynthesisResult& synthesis, const Pulley& pulley);

}  // namespace fusee
