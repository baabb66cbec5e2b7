/// \file
/// Internal: cells of a log to numbers.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace fusee {

enum class Cell { number, missing, text };

/// "1.5". "", "nan", "inf", "n/a" and the like are missing: what loggers write when there is nothing to write.
Cell read_number(std::string_view text, double& value);

/// Numbers of one file, which has one decimal mark, point or comma. A comma beside decimal points, or a point beside
/// decimal commas, groups thousands: "1,020.5", "1.020,5".
class NumberReader {
 public:
  /// Of a file whose separator is the comma, only quoted cells can hold one.
  void settle_mark(const std::vector<std::string_view>& row);
  Cell read(std::string_view text, double& value) const;
  bool has_decimal_comma() const { return mark_ == ','; }

 private:
  char mark_ = 0;  ///< 0 until a cell decides
};

/// ISO 8601 ("2025-03-01T10:00:00.020Z", a blank for the T, a comma in the seconds, an offset) or a time of day
/// ("10:00:00.020"): s since 1970, or since midnight. Nothing for other text.
std::optional<double> read_time_stamp(std::string_view text);

}  // namespace fusee
