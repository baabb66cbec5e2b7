/// \file
/// Internal: lengths of a mechanism file in its unit (`units = "inch"`) or in a unit of their own ("3 1/2 in").
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fusee/mechanism_file.h"

namespace fusee {

/// True for keys that end in _mm. Their numbers are in the file's unit; compound units (mm_per_N, N_per_mm) are always
/// metric.
bool is_length(std::string_view key);

/// The key whose unit an item of a list of numbers has: for bounds of [optimize] that of the variable, else the list's.
std::string_view length_key(const Field& list, const DeclaredMechanism& mechanism, std::size_t item);

/// "mm" or "in".
std::string_view unit_word(LengthUnit unit);
/// The unit of a key's number in a file of `unit`: "in" for lengths of an inch file, else Field::unit.
std::string_view unit_in_file(const Field& field, LengthUnit unit);

/// A number of the file in mm. It is rounded once, so that 1.1 in is the same as 27.94 mm.
double to_mm(double length, LengthUnit unit);
/// mm in the file's unit, for display and search. It may miss the number that reads back as `mm` by one bit.
double from_mm(double mm, LengthUnit unit);

/// A length with its unit, in mm: "45 mm", "4.5 cm", "0.1 m", "200 um", "3.5 in", "3 1/2 in", "3-1/2\"", "1/8 inch",
/// "10 thou". Nullopt for any other text.
std::optional<double> parse_length(std::string_view text);

/// TOML value that reads back as exactly `mm`: a number of the file's unit; in an inch file "5 mm" for lengths that
/// have at most six digits in mm and more in inches.
std::string length_value_text(double mm, LengthUnit unit);

/// A message with its lengths in the file's unit: numbers before "mm", also in lists ("20 × 30 mm", "1 to 5 mm"), and
/// numbers of keys that end in _mm ("pulley.r1_mm = 22 or less (now 25)"), which can then be typed into the file.
std::string lengths_in(LengthUnit unit, const std::string& message);

}  // namespace fusee
