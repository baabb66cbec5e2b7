#include "measurement/ros_names.h"

#include <algorithm>
#include <iterator>

namespace fusee::measurement {
namespace {

/// Fields of sensor_msgs/JointState and of std_msgs at the end of a name.
constexpr std::string_view k_position = "/position", k_number = "/data";

bool ends_name(std::string_view name, std::string_view end) { return name.ends_with(end) && name.size() > end.size(); }

}  // namespace

bool is_ros_name(std::string_view name) {
  return name.size() > 2 && name.front() == '/' && name.find('/', 1) != std::string_view::npos;
}

const Unit* ros_unit(std::string_view name, Quantity quantity) {
  if (quantity == Quantity::time && name == "__time") return find_unit(quantity, "s");  // of PlotJuggler
  if (!is_ros_name(name)) return nullptr;
  if (quantity == Quantity::angle && ends_name(name, k_position)) return find_unit(quantity, "rad");
  if (quantity == Quantity::temperature && ends_name(name, "/temperature")) return find_unit(quantity, "C");
  if (quantity != Quantity::load) return nullptr;
  if (ends_name(name, "/effort")) return find_unit(quantity, "Nm");
  const std::string_view part = name.substr(0, name.rfind('/'));
  if (ends_name(part, "/force")) return find_unit(quantity, "N");
  return ends_name(part, "/torque") ? find_unit(quantity, "Nm") : nullptr;
}

std::string_view without_field(std::string_view name) {
  if (is_ros_name(name) && ends_name(name, k_number)) name.remove_suffix(k_number.size());
  return name;
}

bool selects(std::string_view wanted, std::string_view name) {
  if (!is_ros_name(name) || wanted.empty()) return false;
  for (const std::string_view field : {std::string_view(), k_position, k_number}) {
    if (!field.empty() && !ends_name(name, field)) continue;
    const std::string_view owner = name.substr(0, name.size() - field.size());  // "/joint_states/motor"
    if (!owner.ends_with(wanted)) continue;
    const bool begins_part =
        owner.size() == wanted.size() || wanted.front() == '/' || owner[owner.size() - wanted.size() - 1] == '/';
    if (begins_part) return true;
  }
  return false;
}

std::vector<std::size_t> ros_angles(const std::vector<std::string>& names) {
  std::vector<std::size_t> found;
  for (const std::string_view field : {k_position, k_number}) {
    if (found.size() >= 2) break;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (is_ros_name(names[i]) && ends_name(names[i], field)) found.push_back(i);
    }
  }
  return found;
}

AnglePair choose_ros_angles(const std::vector<std::string>& names, AnglePair given) {
  const std::vector<std::size_t> angles = ros_angles(names);
  const std::vector<NameWords> words = distinguishing_words(names, angles);
  std::vector<std::size_t> motors, joints;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (angles[i] == given.alpha || angles[i] == given.theta) continue;
    if (has_motor_word(words[i])) {
      motors.push_back(angles[i]);
    } else if (has_joint_word(words[i])) {
      joints.push_back(angles[i]);
    }
  }
  AnglePair found = given;
  if (!found.alpha) found.alpha = only_entry(motors);
  if (!found.theta) found.theta = only_entry(joints);
  if (found.alpha.has_value() == found.theta.has_value()) return found;
  // One angle is known: the only other name with the same field is the other angle.
  const std::size_t known = found.alpha ? *found.alpha : *found.theta;
  std::vector<std::size_t> candidates;
  std::copy_if(angles.begin(), angles.end(), std::back_inserter(candidates), [&](std::size_t angle) {
    return angle != known && ends_name(names[angle], k_position) == ends_name(names[known], k_position);
  });
  (found.alpha ? found.theta : found.alpha) = only_entry(candidates);
  return found;
}

}  // namespace fusee::measurement
