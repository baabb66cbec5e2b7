#include "measurement/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/text.h"
#include "measurement/angle_words.h"
#include "measurement/log_text.h"
#include "measurement/ros_names.h"

namespace fusee::measurement {
namespace {

/// Names that are recognised for a role without --column, in any unit, besides the default name.
const std::vector<std::string>& words_of(const std::string& role) {
  static const std::map<std::string, std::vector<std::string>> words = {
      {"alpha", {"alpha", "α"}},
      {"theta", {"theta", "θ", "ϑ"}},
      {"load", {"load"}},
      {"time",
       {"time", "timestamp", "time_stamp", "%time", "__time", "zeit", "zeitstempel", "zeitpunkt", "temps", "horodatage",
        "tiempo", "tempo", "tijd", "czas"}},
      {"tension1", {"tension1"}},
      {"temperature", {"temperature", "temp"}},
      {"tension2", {"tension2"}}};
  static const std::vector<std::string> none;
  const auto found = words.find(role);
  return found == words.end() ? none : found->second;
}

/// Load and force in the languages of builders. A column with a word of the first list and a unit of a load is taken as
/// the joint's load. A force may be a tendon's: a word of the second list only adds a note.
constexpr std::array<std::string_view, 7> k_load_words = {"last",   "belastung", "carga",     "carico",
                                                          "charge", "lading",    "obciążenie"};
constexpr std::array<std::string_view, 14> k_force_words = {"force",  "kraft",  "fuerza",  "forza",  "força",
                                                            "kracht", "weight", "gewicht", "peso",   "poids",
                                                            "mass",   "masse",  "torque",  "payload"};

/// Columns that `fusee simulate` writes beside those of a log.
constexpr std::array<std::string_view, 6> k_simulated_columns = {
    "motor_torque_Nmm", "tension1_joint_N", "tension2_joint_N", "loose_deg", "joint_deg", "status"};

template <typename Words>
bool is_one_of(const Words& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A column name as an argument of --column, quoted if the shell requires it.
std::string shell_argument(const std::string& name) {
  const bool is_plain = name.find_first_of(" '\"$\\`;&()[]{}<>|*?#!~%") == std::string::npos;
  return is_plain ? name : "\"" + name + "\"";
}

class ColumnFinder {
 public:
  ColumnFinder(const std::vector<std::string>& names, const MeasurementOptions& options, bool above_numbers)
      : names_(names), options_(options) {
    if (above_numbers && ros_angles(names).empty()) by_words_ = choose_table_angles(names, known_angles());
  }

  Header find() {
    bool all_angles = true;
    for (const auto& [role, default_name] : column_roles()) {
      const auto given = options_.columns.find(role);
      const bool is_given = given != options_.columns.end();
      std::optional<std::size_t> index =
          is_given ? index_of(to_utf8(given->second)) : index_of_recognised_name(role, default_name);
      if (!index && !is_given) index = ros_index(role);
      if (!index && !is_given) index = index_by_words(role);
      if (!index && !is_given && role == "load") index = load_in_other_languages();
      const bool is_needed = role == "alpha" || (role == "theta" && options_.needs_theta);
      if (index) {
        add_column(role, *index, is_given);
      } else if (is_needed || is_given) {
        report_missing(role, is_given ? to_utf8(given->second) : default_name);
        all_angles = all_angles && !is_needed;
      }
    }
    header_.has_angles = all_angles;
    report_missing_angles();
    report_shared_columns();
    note_unread_load();
    list_unused();
    return std::move(header_);
  }

 private:
  /// The column of that name; else of that name in another case or between blanks; else the ROS name that it selects.
  std::optional<std::size_t> index_of(const std::string& wanted) {
    for (const bool exactly : {true, false}) {
      const auto same = [&](const std::string& name) {
        return exactly ? name == wanted : lower(trimmed(name)) == lower(trimmed(wanted));
      };
      const auto found = std::find_if(names_.begin(), names_.end(), same);
      if (found == names_.end()) continue;
      if (std::find_if(found + 1, names_.end(), same) != names_.end())
        add_problem("two columns are called " + shown(wanted), "each column needs a name of its own");
      return static_cast<std::size_t>(found - names_.begin());
    }
    return index_of_part(wanted);
  }

  /// The one ROS name that a part of it selects: "motor" for "/joint_states/motor/position".
  std::optional<std::size_t> index_of_part(const std::string& wanted) const {
    std::optional<std::size_t> index;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (!selects(lower(wanted), lower(names_[i]))) continue;
      if (index) return std::nullopt;
      index = i;
    }
    return index;
  }

  /// α or θ among ROS names, where the choice is obvious.
  std::optional<std::size_t> ros_index(const std::string& role) {
    if (role != "alpha" && role != "theta") return std::nullopt;
    AnglePair given;
    for (const auto& [angle, column] : options_.columns) {
      if (angle == "alpha") given.alpha = index_of(to_utf8(column));
      if (angle == "theta") given.theta = index_of(to_utf8(column));
    }
    const AnglePair pair = choose_ros_angles(names_, given);
    return role == "alpha" ? pair.alpha : pair.theta;
  }

  /// The angles that an option or a recognised name determines.
  AnglePair known_angles() {
    const auto known = [&](const char* role, const char* default_name) {
      const auto given = options_.columns.find(role);
      return given != options_.columns.end() ? index_of(to_utf8(given->second))
                                             : index_of_recognised_name(role, default_name);
    };
    const Header before = header_;
    const AnglePair found{known("alpha", "alpha_deg"), known("theta", "theta_deg")};
    header_ = before;  // without problems and notes of this search: find() reports them
    return found;
  }

  std::optional<std::size_t> index_by_words(const std::string& role) {
    if (role != "alpha" && role != "theta") return std::nullopt;
    const std::optional<std::size_t> index = role == "alpha" ? by_words_.alpha : by_words_.theta;
    if (index)
      header_.notes.push_back(role + ": taken from the column " + shown(names_[*index]) + ", by its name (--column " +
                              role + "=NAME overrides this)");
    return index;
  }

  /// The one column that is called load in another language and states a unit of a load: "Last [g]".
  std::optional<std::size_t> load_in_other_languages() {
    std::optional<std::size_t> index;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const ColumnName name = parse_column_name(names_[i], Quantity::load);
      if (name.unit == nullptr || !is_one_of(k_load_words, name.base)) continue;
      if (index) return std::nullopt;
      index = i;
    }
    if (index)
      header_.notes.push_back("load: taken from the column " + shown(names_[*index]) +
                              ", by its name (--column load=NAME overrides this)");
    return index;
  }

  /// A column with the default name of the role, or with another recognised name in any unit.
  std::optional<std::size_t> index_of_recognised_name(const std::string& role, const std::string& default_name) {
    if (const auto index = index_of(default_name)) return index;
    const std::vector<std::string>& words = words_of(role);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (std::find(words.begin(), words.end(), lower(trimmed(names_[i]))) != words.end()) return i;
      const ColumnName name = parse_column_name(names_[i], quantity_of(role));
      if (std::find(words.begin(), words.end(), name.base) == words.end()) continue;
      if (name.unknown_unit.empty() || name.states_unit) return i;
      // "theta_ref" is another column, not θ in the unit "ref".
      const bool is_load = quantity_of(role) == Quantity::load;
      if (!is_load && quantity_of(role) != Quantity::time) continue;
      header_.notes.push_back("column " + shown(names_[i]) + " is not used: " + shown(name.unknown_unit) +
                              (is_load ? " is no unit of a load" : " is no unit of time") +
                              "; select the column and its unit with --column " + role + "=" +
                              shell_argument(names_[i]) + " --unit " + role + (is_load ? "=N" : "=s"));
      noted_.insert(i);
    }
    return role == "time" ? clock_index() : std::nullopt;
  }

  /// The first column that is called by a unit of time alone, "millis()" or "us", or "t"; "T" is a temperature.
  std::optional<std::size_t> clock_index() const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const ColumnName name = parse_column_name(names_[i], Quantity::time);
      const bool is_t = trimmed(names_[i]) == "t" || (name.base == "t" && name.unit != nullptr);
      if (clock_unit(names_[i]) != nullptr || is_t) return i;
    }
    return std::nullopt;
  }

  /// The unit that is the whole name of a clock; null for other names, for a single letter, and for a minimum.
  static const Unit* clock_unit(const std::string& name) {
    std::string word = lower(trimmed(name));
    if (word.ends_with("()")) word.resize(word.size() - 2);
    return word.size() > 1 && word != "min" ? find_unit(Quantity::time, word) : nullptr;
  }

  /// `by_option`: --column names the column.
  void add_column(const std::string& role, std::size_t index, bool by_option) {
    Column column;
    column.index = index;
    column.role = role;
    column.name = names_[index];
    column.quantity = quantity_of(role);
    const auto unit = options_.units.find(role);
    const auto ticks = options_.ticks_per_turn.find(role);
    const auto zero = options_.zero_ticks.find(role);
    const bool has_ticks = ticks != options_.ticks_per_turn.end(), has_zero = zero != options_.zero_ticks.end();
    if (has_ticks || has_zero) {
      column.unit = find_unit(Quantity::angle, "counts");
      column.ticks_per_turn = has_ticks ? ticks->second : 0;  // 0: determined by settle_units()
      column.home_reading = has_zero ? zero->second : 0;
      column.is_given = true;
    } else if (unit != options_.units.end()) {
      column.unit = find_unit(column.quantity, unit->second);
      column.is_given = true;
    } else if (column.quantity != Quantity::none) {
      take_unit_of_name(column, by_option);
    }
    if (const auto home = options_.home_readings.find(role); home != options_.home_readings.end())
      column.home_reading = home->second;
    if (column.unit != nullptr && column.unit->base != "N" && role.substr(0, 7) == "tension")
      add_problem(role + " in " + std::string(column.unit->name) + " is a torque", "a tension is a force: N, kg, lbf");
    header_.columns.push_back(std::move(column));
  }

  static bool is_voltage(const std::string& unit) {
    const std::string word = lower(unit);
    return word == "v" || word == "mv" || word == "volt" || word == "volts";
  }

  void take_unit_of_name(Column& column, bool by_option) {
    column.unit = ros_unit(column.name, column.quantity);
    if (column.unit == nullptr && column.quantity == Quantity::time) column.unit = clock_unit(column.name);
    if (column.unit != nullptr) return;
    const ColumnName name = parse_column_name(without_field(column.name), column.quantity);
    column.unit = name.unit;
    // The angle at which an encoder is mounted is no reading of an encoder: it is in degrees unless its name states a
    // unit.
    const bool is_mounting = column.quantity == Quantity::angle && member_of(column.role) == nullptr;
    if (is_mounting && (name.unit == nullptr || name.unit->is_counts())) column.unit = usual_unit(Quantity::angle);
    if (column.unit != nullptr) return;
    if (column.quantity == Quantity::angle && is_voltage(name.unknown_unit)) {
      add_problem(shown(column.name) + " is a voltage, and " + column.role + " an angle",
                  "give the volts of a whole turn of the sensor and the volts at home: --ticks-per-turn " +
                      column.role + "=4.4 --home-reading " + column.role +
                      "=1.65 for 3.3 V over 270 deg and half of it at home");
      return;
    }
    const bool is_load = column.role == "load";
    const bool is_unknown = name.states_unit || (is_load && by_option && !name.unknown_unit.empty());
    if (is_unknown) {
      add_problem("the unit of " + shown(column.name) + " is unknown: " + shown(name.unknown_unit),
                  "units: " + unit_names(column.quantity) + "; select one with --unit " + column.role + "=" +
                      std::string(usual_unit(column.quantity)->name));
      return;
    }
    const bool values_decide = column.quantity == Quantity::angle || column.quantity == Quantity::time;
    if (values_decide) return;  // see settle_units()
    column.unit = usual_unit(column.quantity);
    column.is_unit_stated = false;
    if (is_load)
      header_.notes.push_back("load: taken as N, as the name " + shown(column.name) +
                              " states no unit (--unit load=kg overrides this)");
  }

  /// If there is no load, a column whose name ends in a unit of load ("pull_N") or is a word for it ("Last") may be the
  /// load.
  void note_unread_load() {
    const auto has_role = [&](const Column& column) { return column.role == "load"; };
    if (std::any_of(header_.columns.begin(), header_.columns.end(), has_role)) return;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const ColumnName name = parse_column_name(names_[i], Quantity::load);
      const bool is_word = is_one_of(k_load_words, name.base) || is_one_of(k_force_words, name.base);
      if ((name.unit == nullptr && !is_word) || name.base.empty()) continue;
      if (is_used(i)) continue;
      header_.notes.push_back("column " + shown(names_[i]) + " is not used" + assumed_load() +
                              ": if it is the load, add --column load=" + shell_argument(names_[i]) +
                              (name.unit == nullptr ? " --unit load=N, or its unit" : ""));
      noted_.insert(i);
    }
  }

  /// True if the column has a role.
  bool is_used(std::size_t index) const {
    return std::any_of(header_.columns.begin(), header_.columns.end(),
                       [index](const Column& column) { return column.index == index; });
  }

  std::string assumed_load() const {
    return options_.tip_force == 0 ? ""
                                   : ", and the load of the file, " + rounded(options_.tip_force, 3) + " N, is assumed";
  }

  /// Lists the columns without a role, except those that a program named: of ROS, and of `fusee simulate`.
  void list_unused() {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const bool is_expected = is_ros_name(names_[i]) || is_one_of(k_simulated_columns, names_[i]);
      if (names_[i].empty() || is_expected || noted_.count(i) > 0) continue;
      if (!is_used(i)) header_.unused.push_back(names_[i]);
    }
  }

  /// Reports a column that is taken for two roles.
  void report_shared_columns() {
    for (std::size_t i = 0; i < header_.columns.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Column &one = header_.columns[i], &other = header_.columns[j];
        if (one.index != other.index) continue;
        add_problem("column " + shown(one.name) + " is taken as " + other.role + " and as " + one.role,
                    "give each role a column of its own with --column " + one.role + "=NAME");
      }
    }
  }

  /// Reports the missing angles in one problem, with the options to give.
  void report_missing_angles() {
    if (missing_.empty()) return;
    const bool both = missing_.size() > 1;
    const AnglePair likely = likely_table_angles(names_, known_angles());
    std::string options;
    bool are_all_likely = true;
    for (const auto& [role, default_name] : missing_) {
      const std::optional<std::size_t> index = role == "alpha" ? likely.alpha : likely.theta;
      are_all_likely = are_all_likely && index.has_value();
      options +=
          (options.empty() ? "" : " ") + ("--column " + role + "=" + (index ? shell_argument(names_[*index]) : "NAME"));
    }
    const std::string unit = " (in degrees, or its name ends in its unit: _rad, _turns, _counts)";
    std::string message = "there is no column " + missing_.front().second;
    if (both) message += " and no " + missing_.back().second;
    if (!are_all_likely) {
      add_problem(message, "the columns are " + quoted_list(names_) + "; select " + (both ? "them" : "one") + " with " +
                               options + unit);
    } else {
      add_problem(message, "the columns are " + quoted_list(names_) + "; add " + options +
                               (both                                ? " if these are the angles of motor and joint"
                                : missing_.front().first == "alpha" ? " if that is the motor's angle"
                                                                    : " if that is the joint's angle"));
    }
  }

  /// Reports a missing column; an angle without a similar name is left to report_missing_angles().
  void report_missing(const std::string& role, const std::string& wanted) {
    if (const std::vector<std::size_t> angles = ros_angles(names_); !angles.empty())
      return report_missing_ros(role, angles);
    std::vector<std::string> others;
    std::copy_if(names_.begin(), names_.end(), std::back_inserter(others), [](const std::string& name) {
      return std::none_of(column_roles().begin(), column_roles().end(),
                          [&](const auto& known) { return known.second == name; });
    });
    std::string nearest = nearest_word(wanted, others);
    for (const std::string& name : others) {
      if (nearest.empty() && lower(name).find(role) != std::string::npos) nearest = name;
    }
    if (nearest.empty() && options_.columns.count(role) == 0) {
      missing_.emplace_back(role, wanted);
      return;
    }
    const std::string unit = quantity_of(role) == Quantity::angle
                                 ? " (in degrees, or its name ends in its unit: _rad, _turns, _counts)"
                                 : "";
    add_problem("there is no column " + quoted_if_required(wanted),
                nearest.empty()
                    ? "the columns are " + quoted_list(names_) + "; select one with --column " + role + "=NAME" + unit
                    : "the nearest is " + shown(nearest) + ": --column " + role + "=" + shell_argument(nearest) +
                          " takes it" + unit);
  }

  /// Lists the topics and joints of a ROS log.
  void report_missing_ros(const std::string& role, const std::vector<std::size_t>& angles) {
    constexpr std::size_t k_longest_list = 600;
    const auto given = options_.columns.find(role);
    std::string list;
    for (std::size_t i = 0; i < names_.size() && list.size() < k_longest_list; ++i) {
      const bool fits = quantity_of(role) != Quantity::angle || std::count(angles.begin(), angles.end(), i) > 0;
      if (fits && is_ros_name(names_[i])) list += (list.empty() ? "" : ", ") + cleaned_line(names_[i]);
    }
    add_problem(given == options_.columns.end() ? "it is not obvious which joint is " + role +
                                                      (role == "alpha" ? ", the motor's angle" : ", the joint's angle")
                                                : "no topic or joint, or more than one, is " + shown(given->second),
                "give one of these as --column " + role + "=NAME: " + list);
  }

  /// The name for a message, in quotation marks only if the shell requires them.
  static std::string quoted_if_required(const std::string& name) {
    const std::string quoted = shown(name);
    const bool is_plain = shell_argument(name) == name;
    return is_plain ? quoted.substr(1, quoted.size() - 2) : quoted;
  }

  void add_problem(std::string message, std::string hint) {
    header_.problems.push_back({Severity::error, {}, std::move(message), std::move(hint)});
  }

  const std::vector<std::string>& names_;
  const MeasurementOptions& options_;
  Header header_;
  AnglePair by_words_;                                        ///< angles chosen by words of their names
  std::set<std::size_t> noted_;                               ///< columns without a role that a note names
  std::vector<std::pair<std::string, std::string>> missing_;  ///< angles: roles and default names
};

}  // namespace

Quantity quantity_of(const std::string& role) {
  if (role == "time") return Quantity::time;
  if (role == "load" || role == "tension1" || role == "tension2") return Quantity::load;
  if (role == "temperature") return Quantity::temperature;
  return role == "cycle" ? Quantity::none : Quantity::angle;
}

double half_turn(const Column& column) {
  if (column.quantity != Quantity::angle) return 0;
  if (column.ticks_per_turn != 0) return std::abs(column.ticks_per_turn) / 2;
  return column.unit == nullptr || column.unit->is_counts() ? 0 : k_pi / column.unit->factor;
}

double Sample::*member_of(const std::string& role) {
  if (role == "time") return &Sample::time;
  if (role == "alpha") return &Sample::alpha;
  if (role == "theta") return &Sample::theta;
  if (role == "load") return &Sample::load;
  if (role == "temperature") return &Sample::temperature_C;
  if (role == "tension1") return &Sample::tension1;
  if (role == "tension2") return &Sample::tension2;
  return nullptr;  // cycle: determined from α
}

Header find_columns(const std::vector<std::string>& names, const MeasurementOptions& options, bool above_numbers) {
  return ColumnFinder(names, options, above_numbers).find();
}

}  // namespace fusee::measurement
