/// \file
/// Internal: the units that a log's columns come in, and the unit that a column's name states.
#pragma once

#include <string>
#include <string_view>

namespace fusee {

enum class Quantity { time, angle, load, temperature, none };

/// value in the base unit = raw · factor + offset. Base units: s, rad, N or Nmm or Nm, °C.
struct Unit {
  std::string_view name;       ///< in messages: "ms"
  std::string_view spellings;  ///< lower case, without marks between letters, separated by blanks
  Quantity quantity = Quantity::none;
  std::string_view base;  ///< of loads: "N" or a torque, "Nmm", "Nm"
  double factor = 1;      ///< 0 for counts, whose size is the encoder's
  double offset = 0;

  bool is_counts() const { return factor == 0; }
};

/// The unit of that quantity with this spelling, in upper or lower case; nullptr if there is none.
const Unit* find_unit(Quantity quantity, std::string_view spelling);
/// The unit of a column that keeps to column_roles(): s, deg, N, °C.
const Unit* usual_unit(Quantity quantity);
/// "s, ms, us, …": every unit of the quantity, for hints.
std::string unit_names(Quantity quantity);

/// A column's name taken apart: "alpha [rad]" is "alpha" in "rad".
struct ColumnName {
  std::string base;            ///< lower case, without the unit
  const Unit* unit = nullptr;  ///< nullptr: the name states none that is known
  std::string unknown_unit;    ///< what stands where a unit would, and is none
  bool states_unit = false;    ///< by its form (brackets, "in …"), known or not
};

/// Forms: "load [kg]", "load (kg)", "Motor, deg", "Zeit in s", "load_kg", "load kg", "timeMs", "millis".
ColumnName parse_column_name(std::string_view name, Quantity quantity);

}  // namespace fusee
