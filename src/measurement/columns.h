/// \file
/// Internal: the role of each column of a log, and the unit of its values.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fusee/measurement.h"
#include "measurement/units.h"

namespace fusee::measurement {

/// Larger values are not angles.
constexpr double k_largest_deg = 1e7;
/// Largest plausible time between rows of a moving joint, s.
constexpr double k_longest_step = 2.0;

/// The quantity that a role measures.
Quantity quantity_of(const std::string& role);

struct Column {
  std::size_t index = 0;
  std::string role;
  std::string name;
  Quantity quantity = Quantity::none;
  const Unit* unit = nullptr;  ///< nullptr: determined from the values, see settle_units()
  bool is_given = false;       ///< by an option
  bool is_unit_stated = true;  ///< false: a load that is taken as N, because no unit is stated
  double ticks_per_turn = 0;   ///< for counts; 0: determined from the values
  double home_reading = 0;     ///< of a sensor of an angle, in the column's own unit
  bool is_date = false;        ///< its cells are time stamps, read as s

  // Statistics of the values, in the column's own unit.
  bool whole = true;  ///< all values are whole numbers
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void take_value(double value) {
    whole = whole && value == std::floor(value);
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

/// Columns of a header line, by names and options.
struct Header {
  std::vector<Column> columns;
  std::vector<std::string> notes;
  std::vector<std::string> unused;   ///< names of columns without a role
  std::vector<Diagnostic> problems;  ///< without file and line
  bool has_angles = false;           ///< every required angle is named, so this line is the header
};

/// Finds the column of each role. `above_numbers`: the line stands above a row of as many numbers, so it is a header.
/// Names that only contain words such as "servo" or "joint" are then angles, too.
Header find_columns(const std::vector<std::string>& names, const MeasurementOptions& options,
                    bool above_numbers = false);

/// Determines the units that neither option nor name states. Converts `samples` to s, rad, °C and N, and loads that are
/// torques to Nm or Nmm (Unit::base). Unwraps counters of 16 and 32 bits. Returns one line about unusual units, or "".
/// Throws InputError (`name`) for units that stay undetermined.
std::string settle_units(std::vector<Column>& columns, std::vector<Sample>& samples, const MeasurementOptions& options,
                         const std::string& name);

/// Half a turn in the unit of the column; 0 if that is unknown.
double half_turn(const Column& column);

/// The member of Sample for a role; nullptr for roles without one.
double Sample::*member_of(const std::string& role);

}  // namespace fusee::measurement
