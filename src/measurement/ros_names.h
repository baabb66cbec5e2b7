/// \file
/// Internal: names that ROS tools give to logged numbers, such as "/joint_states/motor/position".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/angle_words.h"
#include "measurement/units.h"

namespace fusee::measurement {

/// True for a topic with a part of its message: "/joint_states/motor/position".
bool is_ros_name(std::string_view name);

/// The unit that ROS prescribes (REP 103): rad for positions, N and N·m for wrenches, N·m for efforts, °C. nullptr if
/// there is none for that quantity.
const Unit* ros_unit(std::string_view name, Quantity quantity);

/// The name without the field of a std_msgs message: "/motor_deg/data" becomes "/motor_deg".
std::string_view without_field(std::string_view name);

/// True if `wanted` is the whole name or its end, with or without the field. "/joint_states/motor/position" is selected
/// by itself, by "motor/position" and by "motor".
bool selects(std::string_view wanted, std::string_view name);

/// Indices of names that can be angles: all positions, and if there are fewer than two, all numbers of std_msgs.
std::vector<std::size_t> ros_angles(const std::vector<std::string>& names);

/// Motor and joint among ROS names, by words such as "motor" and "joint" in which they differ. Names in `given` are
/// kept. If there are two positions, or two numbers of std_msgs, the choice of one decides the other. Empty where the
/// choice is not obvious.
AnglePair choose_ros_angles(const std::vector<std::string>& names, AnglePair given);

}  // namespace fusee::measurement
