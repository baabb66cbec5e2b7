/// \file
/// Internal: parses the cells of a log as numbers and time stamps.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace fusee::measurement {

enum class CellContent { number, missing, text };

/// Reads "1.5". The value is NaN unless the cell is a number. Text such as "", "nan", "inf" and "n/a" counts as
/// missing: loggers write it for absent values.
CellContent read_number(std::string_view text, double& value);

/// Number parser of one file. A file has one decimal mark, point or comma; the other mark groups thousands: "1,020.5",
/// "1.020,5".
class NumberReader {
 public:
  /// Determines the decimal mark from a row; without effect once a row has determined it. The first cell with a certain
  /// mark decides. In a row whose only marks are ambiguous ("1,020"), the comma counts as the decimal mark. If the
  /// separator is the comma, only quoted cells can hold a comma.
  void settle_mark(const std::vector<std::string_view>& row);
  CellContent read(std::string_view text, double& value) const;
  bool has_decimal_comma() const { return mark_ == ','; }

 private:
  char mark_ = 0;  ///< 0 until a cell determines it
};

/// ISO 8601 ("2025-03-01T10:00:00.020Z", a blank for the T, a comma in the seconds, an offset) or "01.03.2025 10:00:00"
/// as s since 1970; a time of day ("10:00:00.020") as s since midnight; a duration ("2 days 00:00:01.5") in s. Empty
/// for other text.
std::optional<double> read_time_stamp(std::string_view text);

}  // namespace fusee::measurement
