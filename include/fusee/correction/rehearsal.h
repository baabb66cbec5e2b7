/// \file
/// Simulated influence of each identified effect on the joint, by size of the effect and load: data of the sliders in
/// the report.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fusee/analysis/stroke.h"
#include "fusee/calibration/calibration.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// Stroke of the expected joint under one load.
struct LoadedStroke {
  double load = 0;                  ///< tip force, N, positive against +θ
  std::vector<StrokePoint> points;  ///< along the stroke
};

/// Sizes of an effect, as multiples of the identified size.
inline constexpr std::array k_rehearsed_shares{0.0, 0.5, 1.0, 1.5, 2.0};

/// Change of the sensed joint angle by the effect alone, rad.
struct RehearsedShare {
  std::vector<FittedParameter> parameters;           ///< the effect's parameters at that share
  std::vector<std::vector<double>> rising, falling;  ///< by load and place
};

struct RehearsedEffect {
  std::string name;
  std::vector<RehearsedShare> shares;  ///< one for each of k_rehearsed_shares
};

struct Rehearsal {
  Mechanism mechanism;        ///< the expected joint
  SynthesisResult synthesis;  ///< of the mounted pulley
  std::vector<LoadedStroke> strokes;
  std::vector<RehearsedEffect> effects;  ///< effects with an influence on a slow stroke there and back
};

/// Simulates all effects. Empty for a joint declared by a ratio, or without a feasible pulley. `expected`: from
/// expected_joint().
Rehearsal rehearse(const DeclaredMechanism& expected, const Measurement& measurement, const Calibration& calibration);

}  // namespace fusee
