#include "measurement/angle_words.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/text.h"
#include "measurement/log_text.h"
#include "measurement/units.h"

namespace fusee::measurement {
namespace {

/// Words of the motor's side and of the joint's side of a transmission, in ROS names and in tables.
constexpr std::array<std::string_view, 9> k_motor_words = {"motor", "alpha",  "actuator", "act",   "servo",
                                                           "drive", "driver", "input",    "motors"};
constexpr std::array<std::string_view, 5> k_joint_words = {"joint", "joints", "theta", "output", "link"};

/// Further words of the two sides, in tables alone.
constexpr std::array<std::string_view, 12> k_table_motor_words = {"stepper",     "spool",  "winch",    "antrieb",
                                                                  "motorwinkel", "motore", "moteur",   "stellmotor",
                                                                  "motorhoek",   "silnik", "actuador", "actionneur"};
constexpr std::array<std::string_view, 28> k_table_joint_words = {
    "gelenk",        "gelenkwinkel", "finger",   "elbow",      "knee", "wrist",        "shoulder",
    "thumb",         "hip",          "ankle",    "limb",       "arm",  "staw",         "gewricht",
    "gewrichtshoek", "giunto",       "junta",    "doigt",      "dedo", "articulation", "articulacion",
    "articulacao",   "dito",         "ellbogen", "handgelenk", "knie", "coude",        "codo"};
/// Words of an angle sensor of either side.
constexpr std::array<std::string_view, 19> k_sensor_words = {
    "encoder", "enc",      "pot", "poti", "potentiometer", "sensor", "angle", "winkel", "pos", "position", "hall",
    "adc",     "resolver", "imu", "as",   "angolo",        "angulo", "hoek",  "kat"};
/// Words of a commanded angle.
constexpr std::array<std::string_view, 12> k_command_words = {
    "cmd", "command", "commanded", "setpoint", "set", "target", "ref", "sp", "demand", "reference", "desired", "goal"};
/// Words of quantities other than an angle, and of their units.
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

/// The letter without its accent, for U+00C0 … U+00FF in UTF-8: there, `second` follows 0xC3 and begins at 0x80. A
/// blank for × and ÷.
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

/// Lower-case words of a name. A word ends at a character that is no letter, and before a capital that follows a small
/// letter.
NameWords words_in(std::string_view accented) {
  const std::string letters = without_accents(accented);
  const std::string_view name = letters;
  NameWords words;
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
bool has_one_of(const NameWords& words, const List& list) {
  return std::any_of(list.begin(), list.end(),
                     [&](std::string_view word) { return words.count(std::string(word)) > 0; });
}

/// A column of a table that may be an angle.
struct NamedAngle {
  std::size_t index = 0;
  NameWords words;
  bool is_command = false;

  bool is_of_motor() const { return has_motor_word(words) || has_one_of(words, k_table_motor_words); }
  bool is_of_joint() const { return has_joint_word(words) || has_one_of(words, k_table_joint_words); }
};

/// "A0": an analog input.
bool is_analog_input(std::string_view name) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return name.size() > 1 && (name.front() == 'A' || name.front() == 'a') &&
         std::all_of(name.begin() + 1, name.end(), is_digit);
}

bool is_other_quantity(std::string_view name) {
  if (is_analog_input(name)) return false;  // its only word is "a", which is also the unit ampere
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
  const std::vector<NameWords> words = distinguishing_words(names, indices);
  std::vector<NamedAngle> angles;
  for (std::size_t i = 0; i < indices.size(); ++i)
    angles.push_back({indices[i], words[i], has_one_of(words_in(names[indices[i]]), k_command_words)});
  return angles;
}

bool is_sensor(const NamedAngle& angle, const std::vector<std::string>& names) {
  const std::string_view name = trimmed(names[angle.index]);
  return !angle.is_command && (is_analog_input(name) || has_one_of(words_in(name), k_sensor_words));
}

/// Columns of the table, grouped by what their words name. `servo_commands` are commands of the motor.
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

/// Sets `angle`, if it is still open, to the first candidate that is not the column of the other angle.
void fill_from(std::optional<std::size_t>& angle, const std::optional<std::size_t>& other_angle,
               const std::vector<std::size_t>& candidates) {
  for (const std::size_t index : candidates) {
    if (!angle && index != other_angle) angle = index;
  }
}

}  // namespace

std::vector<NameWords> distinguishing_words(const std::vector<std::string>& names,
                                            const std::vector<std::size_t>& selected) {
  std::vector<NameWords> all;
  for (const std::size_t index : selected) all.push_back(words_in(names[index]));
  if (all.size() < 2) return all;
  NameWords common = all.front();
  for (const NameWords& words : all)
    std::erase_if(common, [&](const std::string& word) { return words.count(word) == 0; });
  for (NameWords& words : all) std::erase_if(words, [&](const std::string& word) { return common.count(word) > 0; });
  return all;
}

bool has_motor_word(const NameWords& words) { return has_one_of(words, k_motor_words); }

bool has_joint_word(const NameWords& words) { return has_one_of(words, k_joint_words); }

std::optional<std::size_t> only_entry(const std::vector<std::size_t>& list) {
  return list.size() == 1 ? std::optional(list.front()) : std::nullopt;
}

AnglePair choose_table_angles(const std::vector<std::string>& names, AnglePair given) {
  const TableAngles angles = table_angles(names, given);
  AnglePair found = given;
  if (!found.alpha) found.alpha = only_entry(angles.motors.empty() ? angles.servo_commands : angles.motors);
  if (!found.theta) found.theta = only_entry(angles.joints);
  if (found.alpha && !found.theta && angles.joints.empty()) found.theta = only_entry(angles.sensors);
  if (found.theta && !found.alpha && angles.motors.empty()) found.alpha = only_entry(angles.sensors);
  return found;
}

AnglePair likely_table_angles(const std::vector<std::string>& names, AnglePair given) {
  const TableAngles angles = table_angles(names, given);
  AnglePair likely = given;
  fill_from(likely.alpha, likely.theta, angles.motors);
  fill_from(likely.theta, likely.alpha, angles.joints);
  fill_from(likely.alpha, likely.theta, angles.servo_commands);
  // A single sensor is suggested for the joint.
  if (angles.sensors.size() > 1) fill_from(likely.alpha, likely.theta, angles.sensors);
  fill_from(likely.theta, likely.alpha, angles.sensors);
  fill_from(likely.alpha, likely.theta, angles.commands);
  fill_from(likely.alpha, likely.theta, angles.sensors);
  return likely;
}

}  // namespace fusee::measurement
