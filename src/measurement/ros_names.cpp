#include "measurement/ros_names.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include "base/text.h"
#include "measurement/words.h"

namespace fusee::measurement {
namespace {

constexpr std::string_view k_position = "/position", k_number = "/data";

/// Words of the motor's side and of the joint's side of a transmission.
constexpr std::array<std::string_view, 9> k_motor_words = {"motor", "alpha",  "actuator", "act",   "servo",
                                                           "drive", "driver", "input",    "motors"};
constexpr std::array<std::string_view, 5> k_joint_words = {"joint", "joints", "theta", "output", "link"};

using Words = std::set<std::string>;

/// Lower-case words of a name: "/Motor_1/joint_states" has motor, joint and states.
Words words_in(std::string_view name) {
  Words words;
  std::string word;
  const auto end_word = [&] {
    if (!word.empty()) words.insert(std::move(word));
    word.clear();
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool is_capital = c >= 'A' && c <= 'Z', is_small = c >= 'a' && c <= 'z';
    if (!is_capital && !is_small) {
      end_word();
      continue;
    }
    const bool after_small = i > 0 && name[i - 1] >= 'a' && name[i - 1] <= 'z';
    if (is_capital && after_small) end_word();
    word += lower(name.substr(i, 1));
  }
  end_word();
  return words;
}

template <typename List>
bool has_one_of(const Words& words, const List& list) {
  return std::any_of(list.begin(), list.end(),
                     [&](std::string_view word) { return words.count(std::string(word)) > 0; });
}

/// The words of each name that not all names share.
std::vector<Words> distinguishing_words(const std::vector<std::string>& names, const std::vector<std::size_t>& angles) {
  std::vector<Words> all;
  for (const std::size_t angle : angles) all.push_back(words_in(names[angle]));
  if (all.size() < 2) return all;
  Words common = all.front();
  for (const Words& words : all) std::erase_if(common, [&](const std::string& word) { return words.count(word) == 0; });
  for (Words& words : all) std::erase_if(words, [&](const std::string& word) { return common.count(word) > 0; });
  return all;
}

std::optional<std::size_t> only_one(const std::vector<std::size_t>& list) {
  return list.size() == 1 ? std::optional(list.front()) : std::nullopt;
}

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
    const std::string_view whole = name.substr(0, name.size() - field.size());
    if (!whole.ends_with(wanted)) continue;
    if (whole.size() == wanted.size() || wanted.front() == '/' || whole[whole.size() - wanted.size() - 1] == '/')
      return true;
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
  const std::vector<Words> words = distinguishing_words(names, angles);
  std::vector<std::size_t> motors, joints, others;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (angles[i] == given.alpha || angles[i] == given.theta) continue;
    const bool is_motor = has_one_of(words[i], k_motor_words);
    (is_motor ? motors : has_one_of(words[i], k_joint_words) ? joints : others).push_back(angles[i]);
  }
  AnglePair found = given;
  if (!found.alpha) found.alpha = only_one(motors);
  if (!found.theta) found.theta = only_one(joints);
  if (found.alpha.has_value() == found.theta.has_value()) return found;
  const std::size_t one = found.alpha ? *found.alpha : *found.theta;
  std::vector<std::size_t> rest;
  std::copy_if(angles.begin(), angles.end(), std::back_inserter(rest), [&](std::size_t angle) {
    return angle != one && ends_name(names[angle], k_position) == ends_name(names[one], k_position);
  });
  (found.alpha ? found.theta : found.alpha) = only_one(rest);
  return found;
}

}  // namespace fusee::measurement
