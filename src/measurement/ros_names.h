/// \file
/// Internal: names of logged numbers as ROS tools have them, "/joint_states/motor/position", and names of angles as
/// builders have them, "servo_deg".
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/units.h"

namespace fusee::measurement {

/// True for a topic with a part of its message: "/joint_states/motor/position".
bool is_ros_name(std::string_view name);

/// The unit that ROS prescribes (REP 103): rad for positions, N and N·m for wrenches, N·m for efforts, °C. nullptr if
/// there is none for that quantity.
const Unit* ros_unit(std::string_view name, Quantity quantity);

/// The name without what a message adds: "/motor_deg/data" is "/motor_deg".
std::string_view without_field(std::string_view name);

/// True if `wanted` selects `name`: all of it or its end, with or without its last part:
/// "/joint_states/motor/position", "motor/position", "motor".
bool selects(std::string_view wanted, std::string_view name);

/// Indices of names that can be angles: all positions, and if there are fewer than two, all numbers of std_msgs.
std::vector<std::size_t> ros_angles(const std::vector<std::string>& names);

/// Motor and joint among the names, by words such as "motor" and "joint" in which they differ. Given ones are kept. If
/// there are two angles of one kind, the choice of one decides the other. Empty where the choice is not obvious.
struct AnglePair {
  std::optional<std::size_t> alpha, theta;
};
AnglePair choose_ros_angles(const std::vector<std::string>& names, AnglePair given);

/// Motor and joint among the columns of a table, by words such as "servo" and "joint". Given ones are kept. Beside one
/// that is found, the only other angle sensor ("pot", "encoder") is the other one. Columns of other quantities
/// ("motor_current") and of commands ("setpoint") are none, except for the command of a servo without a sensor.
AnglePair choose_table_angles(const std::vector<std::string>& names, AnglePair given);

/// The likeliest columns for a question, also where the choice is not obvious. Given ones are kept.
AnglePair likely_table_angles(const std::vector<std::string>& names, AnglePair given);

}  // namespace fusee::measurement
