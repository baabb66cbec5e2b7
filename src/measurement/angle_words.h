/// \file
/// Internal: recognises the angles of motor and joint by the words of their names. Builders call their columns
/// "servo_deg", "pot" or "A0".
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace fusee::measurement {

/// Lower-case words of a name: "/Motor_1/joint_states" has motor, joint and states.
using NameWords = std::set<std::string>;

/// The words of each selected name, without the words that all selected names share.
std::vector<NameWords> distinguishing_words(const std::vector<std::string>& names,
                                            const std::vector<std::size_t>& selected);

/// True if a word names the motor's side of a transmission: "motor", "servo".
bool has_motor_word(const NameWords& words);
/// True if a word names the joint's side of a transmission: "joint", "output".
bool has_joint_word(const NameWords& words);

/// The entry of a list that has exactly one; otherwise empty.
std::optional<std::size_t> only_entry(const std::vector<std::size_t>& list);

/// Indices of the names of the motor's angle α and the joint's angle θ; empty if the name is not known.
struct AnglePair {
  std::optional<std::size_t> alpha, theta;
};

/// Motor and joint among the columns of a table, by words such as "servo" and "joint". Columns in `given` are kept. If
/// one angle is found, the only other angle sensor ("pot", "encoder") is taken for the other. Excluded are columns of
/// other quantities ("motor_current") and of commands ("setpoint"), except for the command of a servo without a sensor.
AnglePair choose_table_angles(const std::vector<std::string>& names, AnglePair given);

/// The likeliest column of each angle, to be suggested in a message. Unlike choose_table_angles(), this takes the first
/// of several candidates. Columns in `given` are kept.
AnglePair likely_table_angles(const std::vector<std::string>& names, AnglePair given);

}  // namespace fusee::measurement
