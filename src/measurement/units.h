/// \file
/// Internal: units of columns, and the unit that a column's name states.
#pragma once

#include <string>
#include <string_view>

namespace fusee::measurement {

enum class Quantity { time, angle, load, temperature, none };

/// value in the base unit = raw · factor + offset. Base units: s, rad, N or Nmm or Nm, °C.
struct Unit {
  std::string_view name;       ///< for messages, such as "ms"
  std::string_view spellings;  ///< lower case, without punctuation, separated by blanks
  Quantity quantity = Quantity::none;
  std::string_view base;  ///< for loads: "N", or a torque "Nmm", "Nm"
  double factor = 1;      ///< 0 for counts: their size depends on the encoder
  double offset = 0;

  bool is_counts() const { return factor == 0; }
};

/// The unit of that quantity with this spelling, in any case; nullptr if there is none.
const Unit* find_unit(Quantity quantity, std::string_view spelling);
/// The unit of a column with its default name in column_roles(): s, deg, N, °C.
const Unit* usual_unit(Quantity quantity);
/// All units of the quantity, for hints: "s, ms, us, …".
std::string unit_names(Quantity quantity);

/// A column's name, parsed: "alpha [rad]" is "alpha" in "rad".
struct ColumnName {
  std::string base;            ///< lower case, without the unit
  const Unit* unit = nullptr;  ///< nullptr: no known unit is stated
  std::string unknown_unit;    ///< text in a unit's place that is not a unit
  bool states_unit = false;    ///< the form states a unit (brackets, "in …"), known or not
};

/// Accepted forms: "load [kg]", "load (kg)", "Motor, deg", "Zeit in s", "load_kg", "load kg", "timeMs", "millis".
ColumnName parse_column_name(std::string_view name, Quantity quantity);

}  // namespace fusee::measurement
