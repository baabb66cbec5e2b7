/// \file
/// What each effect that was found does to the joint, by how much of it there is and under which load: simulated, so
/// that a person can turn it up and down.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fusee/analysis/stroke.h"
#include "fusee/calibration/calibration.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// The joint as it was expected, under one load.
struct LoadedStroke {
  double load = 0;                  ///< tip force, positive against +θ, N
  std::vector<StrokePoint> points;  ///< at each place of the stroke
};

/// How much of an effect: of what was found.
inline constexpr std::array k_rehearsed_shares{0.0, 0.5, 1.0, 1.5, 2.0};

/// By how much the joint's sensor shows another angle with the effect alone, rad.
struct RehearsedShare {
  std::vector<FittedParameter> parameters;           ///< the numbers of that share
  std::vector<std::vector<double>> rising, falling;  ///< by load, by place
};

struct RehearsedEffect {
  std::string name;
  std::vector<RehearsedShare> shares;  ///< of k_rehearsed_shares
};

struct Rehearsal {
  Mechanism mechanism;        ///< the joint as it was expected
  SynthesisResult synthesis;  ///< of the pulley that is mounted
  std::vector<LoadedStroke> strokes;
  std::vector<RehearsedEffect> effects;  ///< those of which a slow stroke back and forth shows anything
};

/// Empty for a joint that is declared by a ratio, or whose pulley cannot be drawn. `expected`: expected_joint().
Rehearsal rehearse(const DeclaredMechanism& expected, const Measurement& measurement, const Calibration& calibration);

}  // namespace fusee
