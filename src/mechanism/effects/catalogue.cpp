#include <algorithm>
#include <cmath>

#include "mechanism/effects/effect.h"

namespace fusee {

// One line each, in the order of the chain.
Effect motor_offset(const Mechanism&, const Measurement&);
Effect motor_sensor_eccentricity(const Mechanism&, const Measurement&);
Effect backlash(const Mechanism&, const Measurement&);
Effect radius_offset(const Mechanism&, const Measurement&);
Effect pulley_scale(const Mechanism&, const Measurement&);
Effect pulley_runout(const Mechanism&, const Measurement&);
Effect profile_error(const Mechanism&, const Measurement&);
Effect tendon_stretch(const Mechanism&, const Measurement&);
Effect slack(const Mechanism&, const Measurement&);
Effect creep(const Mechanism&, const Measurement&);
Effect tendon_slip(const Mechanism&, const Measurement&);
Effect thermal_expansion(const Mechanism&, const Measurement&);
Effect capstan_friction(const Mechanism&, const Measurement&);
Effect guide_radius(const Mechanism&, const Measurement&);
Effect guide_position(const Mechanism&, const Measurement&);
Effect joint_length(const Mechanism&, const Measurement&);
Effect gravity(const Mechanism&, const Measurement&);
Effect zero_offset(const Mechanism&, const Measurement&);
Effect joint_sensor_gain(const Mechanism&, const Measurement&);
Effect joint_sensor_eccentricity(const Mechanism&, const Measurement&);
Effect sensor_lag(const Mechanism&, const Measurement&);

std::vector<Effect> catalogue(const Mechanism& declared, const Measurement& measurement) {
  using Make = Effect (*)(const Mechanism&, const Measurement&);
  constexpr Make all[] = {
      motor_offset,
      motor_sensor_eccentricity,
      backlash,
      radius_offset,
      pulley_scale,
      pulley_runout,
      profile_error,
      tendon_stretch,
      slack,
      creep,
      tendon_slip,
      thermal_expansion,
      capstan_friction,
      guide_radius,
      guide_position,
      joint_length,
      gravity,
      zero_offset,
      joint_sensor_gain,
      joint_sensor_eccentricity,
      sensor_lag,
  };
  std::vector<Effect> effects;
  for (const Make make : all) {
    Effect effect = make(declared, measurement);
    if (effect.applies(declared, measurement)) effects.push_back(std::move(effect));
  }
  return effects;
}

namespace applies {

bool with_time(const Mechanism&, const Measurement& measurement) {
  return std::all_of(measurement.runs.begin(), measurement.runs.end(), [](const Run& run) { return run.has_time; });
}

bool with_temperature(const Mechanism&, const Measurement& measurement) {
  double least = 1e300;
  double most = -1e300;
  for (const Run& run : measurement.runs) {
    if (!run.has_temperature) return false;
    for (const Sample& sample : run.samples) {
      least = std::min(least, sample.temperature);
      most = std::max(most, sample.temperature);
    }
  }
  return most - least > 1.0;
}

bool with_load(const Mechanism& declared, const Measurement& measurement) {
  double most = std::abs(declared.load.tip_force) + std::abs(declared.load.torque) + declared.load.mass;
  for (const Run& run : measurement.runs) {
    if (!run.has_load) continue;
    for (const Sample& sample : run.samples) most = std::max(most, std::abs(sample.load));
  }
  return most > 0;
}

bool with_time_and_load(const Mechanism& declared, const Measurement& measurement) {
  return with_time(declared, measurement) && with_load(declared, measurement);
}

bool to_tendons_or_load(const Mechanism& declared, const Measurement& measurement) {
  return !declared.transmission || with_load(declared, measurement);
}

bool to_full_turn(const Mechanism&, const Measurement& measurement) {
  double least = 1e300;
  double most = -1e300;
  for (const Run& run : measurement.runs) {
    for (const Sample& sample : run.samples) {
      least = std::min(least, sample.alpha);
      most = std::max(most, sample.alpha);
    }
  }
  return most - least > radians(150.0);
}

}  // namespace applies

}  // namespace fusee
