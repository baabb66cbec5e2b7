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

/// The letter without its accent, for the letters of Latin-1 in UTF-8, where `second` follows 0xC3; else a blank.
char without_accent(char second) {
  constexpr std::string_view k_letters = "aaaaaaaceeeeiiiidnooooo ouuuuytsaaaaaaaceeeeiiiidnooooo ouuuuyty";
  const auto at = static_cast<unsigned char>(second) - 0x80U;
  return at < k_letters.size() ? k_letters[at] : ' ';
}

std::string without_accents(std::string_view name) {
  std::string letters;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool is_latin = name[i] == '\xC3' && i + 1 < name.size();
    letters += is_latin ? without_accent(name[++i]) : name[i];
  }
  return letters;
}

/// Lower-case words of a name: "/Motor_1/joint_states" has motor, joint and states.
Words words_in(std::string_view accented) {
  const std::string letters = without_accents(accented);
  const std::string_view name = letters;
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

// Tables --------------------------------------------------------------------------------------------------------------

constexpr std::array<std::string_view, 12> k_further_motor_words = {"stepper",     "spool",  "winch",    "antrieb",
                                                                    "motorwinkel", "motore", "moteur",   "stellmotor",
                                                                    "motorhoek",   "silnik", "actuador", "actionneur"};
constexpr std::array<std::string_view, 27> k_further_joint_words = {
    "gelenk",       "gelenkwinkel", "finger",      "elbow", "knee",     "wrist",      "shoulder", "thumb", "hip",
    "ankle",        "limb",         "arm",         "staw",  "gewricht", "giunto",     "junta",    "doigt", "dedo",
    "articulation", "articulacion", "articulacao", "dito",  "ellbogen", "handgelenk", "knie",     "coude", "codo"};
constexpr std::array<std::string_view, 19> k_sensor_words = {
    "encoder", "enc",      "pot", "poti", "potentiometer", "sensor", "angle", "winkel", "pos", "position", "hall",
    "adc",     "resolver", "imu", "as",   "angolo",        "angulo", "hoek",  "kat"};
constexpr std::array<std::string_view, 12> k_command_words = {
    "cmd", "command", "commanded", "setpoint", "set", "target", "ref", "sp", "demand", "reference", "desired", "goal"};
constexpr std::array<std::string_view, 66> k_other_words = {
    "velocity", "speed",   "vel",       "rate",       "omega",
    "current",  "torque",  "tau",       "force",      "load",
    "temp",     "effort",  "volt",      "pwm",        "duty",
    "power",    "error",   "err",       "time",       "timestamp",
    "millis",   "micros",  "t",         "ms",         "us",
    "s",        "sec",     "index",     "id",         "row",
    "sample",   "voltage", "status",    "state",      "mode",
    "acc",      "accel",   "a",         "ma",         "v",
    "mv",       "nm",      "rpm",       "rps",        "dps",
    "w",        "hz",      "date",      "pressure",   "temperature",
    "last",     "kraft",   "fuerza",    "forza",      "carga",
    "charge",   "carico",  "belastung", "zeit",       "temps",
    "tiempo",   "strom",   "spannung",  "drehmoment", "geschwindigkeit",
    "datum"};

/// A column of a table that may be an angle.
struct NamedAngle {
  std::size_t index = 0;
  Words words;
  bool is_command = false;

  bool is_of_motor() const { return has_one_of(words, k_motor_words) || has_one_of(words, k_further_motor_words); }
  bool is_of_joint() const { return has_one_of(words, k_joint_words) || has_one_of(words, k_further_joint_words); }
};

/// "A0": an analog input.
bool is_analog_input(std::string_view name) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return name.size() > 1 && (name.front() == 'A' || name.front() == 'a') &&
         std::all_of(name.begin() + 1, name.end(), is_digit);
}

bool is_other_quantity(std::string_view name) {
  if (is_analog_input(name)) return false;
  return name.empty() || has_one_of(words_in(name), k_other_words) ||
         parse_column_name(name, Quantity::load).unit != nullptr ||
         parse_column_name(name, Quantity::temperature).unit != nullptr;
}

/// The columns that may be angles, with the words in which they differ.
std::vector<NamedAngle> named_angles(const std::vector<std::string>& names) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!is_other_quantity(trimmed(names[i]))) indices.push_back(i);
  }
  const std::vector<Words> words = distinguishing_words(names, indices);
  std::vector<NamedAngle> angles;
  for (std::size_t i = 0; i < indices.size(); ++i)
    angles.push_back({indices[i], words[i], has_one_of(words_in(names[indices[i]]), k_command_words)});
  return angles;
}

bool is_sensor(const NamedAngle& angle, const std::vector<std::string>& names) {
  const std::string_view name = trimmed(names[angle.index]);
  return !angle.is_command && (is_analog_input(name) || has_one_of(words_in(name), k_sensor_words));
}

/// Columns of the table by the side that their words name.
struct TableAngles {
  std::vector<std::size_t> motors, servo_commands, joints, sensors, commands;
};

TableAngles table_angles(const std::vector<std::string>& names, const AnglePair& given) {
  TableAngles found;
  for (const NamedAngle& angle : named_angles(names)) {
    if (angle.index == given.alpha || angle.index == given.theta) continue;
    const bool of_motor = angle.is_of_motor() && !angle.is_of_joint();
    const bool of_joint = angle.is_of_joint() && !angle.is_of_motor();
    if (angle.is_command) {
      (of_motor ? found.servo_commands : found.commands).push_back(angle.index);
    } else if (of_motor) {
      found.motors.push_back(angle.index);
    } else if (of_joint) {
      found.joints.push_back(angle.index);
    } else if (is_sensor(angle, names)) {
      found.sensors.push_back(angle.index);
    }
  }
  return found;
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

AnglePair choose_table_angles(const std::vector<std::string>& names, AnglePair given) {
  const TableAngles angles = table_angles(names, given);
  AnglePair found = given;
  if (!found.alpha) found.alpha = only_one(angles.motors.empty() ? angles.servo_commands : angles.motors);
  if (!found.theta) found.theta = only_one(angles.joints);
  if (found.alpha && !found.theta && angles.joints.empty()) found.theta = only_one(angles.sensors);
  if (found.theta && !found.alpha && angles.motors.empty()) found.alpha = only_one(angles.sensors);
  return found;
}

AnglePair likely_table_angles(const std::vector<std::string>& names, AnglePair given) {
  const TableAngles angles = table_angles(names, given);
  AnglePair likely = given;
  const auto take_first = [](std::optional<std::size_t>& place, const std::optional<std::size_t>& other,
                             const std::vector<std::size_t>& list) {
    for (const std::size_t index : list) {
      if (!place && index != other) place = index;
    }
  };
  take_first(likely.alpha, likely.theta, angles.motors);
  take_first(likely.theta, likely.alpha, angles.joints);
  take_first(likely.alpha, likely.theta, angles.servo_commands);
  if (angles.sensors.size() > 1) take_first(likely.alpha, likely.theta, angles.sensors);
  take_first(likely.theta, likely.alpha, angles.sensors);
  take_first(likely.alpha, likely.theta, angles.commands);
  take_first(likely.alpha, likely.theta, angles.sensors);
  return likely;
}

}  // namespace fusee::measurement
