/// \file
/// The names that CONTRACT §6 promises, written once by hand: what the catalogue, the rig's truths and the tests of
/// every effect are held against.
#pragma once

#include <array>

namespace fusee {

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

}  // namespace fusee
