/// \file
/// Names of effects that outputs promise, written by hand: the catalogue, the truths of the rig and the tests of every
/// effect are compared with them.
#pragma once

#include <array>

namespace fusee::calibration {

inline constexpr std::array k_contract_effects = {"zero_offset",
                                                  "motor_offset",
                                                  "joint_sensor_gain",
                                                  "joint_sensor_eccentricity",
                                                  "motor_sensor_eccentricity",
                                                  "sensor_lag",
                                                  "radius_offset",
                                                  "pulley_scale",
                                                  "pulley_runout",
                                                  "guide_radius",
                                                  "guide_position",
                                                  "joint_length",
                                                  "tendon_stretch",
                                                  "capstan_friction",
                                                  "backlash",
                                                  "slack",
                                                  "creep",
                                                  "tendon_slip",
                                                  "thermal_expansion",
                                                  "gravity",
                                                  "profile_error",
                                                  "groove_friction",
                                                  "joint_friction",
                                                  "frame_compliance",
                                                  "motor_sensor_harmonic",
                                                  "joint_sensor_harmonic"};

}  // namespace fusee::calibration
