/// \file
/// Internal: which column of a log has which role, and the unit that its values are in.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fusee/measurement/measurement.h"
#include "measurement/units.h"

namespace fusee {

constexpr double k_largest_deg = 1e7;
/// s between rows beyond which nobody logs a moving joint.
constexpr double k_longest_step = 2.0;

/// What the values of a role measure.
Quantity quantity_of(const std::string& role);

struct Column {
  std::size_t index = 0;
  std::string role;
  std::string name;
  Quantity quantity = Quantity::none;
  const Unit* unit = nullptr;  ///< nullptr: to be found from the values, see settle_units()
  bool is_given = false;       ///< by an option
  double ticks_per_turn = 0;   ///< of counts; 0: to be found
  double zero_ticks = 0;
  bool is_date = false;  ///< time stamps, in s

  // Of the values that were read, in the column's own unit.
  bool whole = true;
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};

/// What the names of a header are, under the options.
struct Header {
  std::vector<Column> columns;
  std::vector<std::string> notes;
  std::vector<Diagnostic> problems;  ///< without place
  bool has_angles = false;           ///< every angle that is needed: this line is the header
};

Header find_columns(const std::vector<std::string>& names, const MeasurementOptions& options);

/// Finds the units that no option and no name states, converts `samples` from the units of their columns to s, rad, N,
/// Nm or Nmm and °C, and unwraps counters of 16 and 32 bits. One line of words on what is not the usual unit, "" for
/// none; an InputError (`name`) says which units stay unknown.
std::string settle_units(std::vector<Column>& columns, std::vector<Sample>& samples, const MeasurementOptions& options,
                         const std::string& name);

/// The number that a role has in a sample; nullptr for what is no number of it.
double Sample::*member_of(const std::string& role);

}  // namespace fusee
