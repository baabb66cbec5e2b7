#include "measurement/cells.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "measurement/words.h"

namespace fusee::measurement {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "1,020" and "-12,345,678.5" with `mark` ','.
bool is_grouped(std::string_view text, char mark) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  std::size_t digits = 0, groups = 0;
  for (const char c : text) {
    if (is_digit(c)) {
      ++digits;
    } else if (c == mark && digits > 0 && (groups == 0 ? digits <= 3 : digits == 3)) {
      ++groups;
      digits = 0;
    } else {
      if (c == mark) return false;
      break;
    }
  }
  return groups > 0 && digits == 3 && text.front() != '0';
}

/// Removes the other mark's groups and writes the decimal point for `mark`.
std::string with_point(std::string_view text, char mark) {
  std::string plain;
  for (const char c : text) {
    if (c == mark) {
      plain += '.';
    } else if (c != ',' && c != '.') {
      plain += c;
    }
  }
  return plain;
}

/// The decimal mark that a cell proves; 0 if it is ambiguous.
char decimal_mark_of(std::string_view text) {
  double value = 0;
  const std::size_t comma = text.rfind(','), point = text.rfind('.');
  if (comma == std::string_view::npos && point == std::string_view::npos) return 0;
  const bool last_is_comma = point == std::string_view::npos || (comma != std::string_view::npos && comma > point);
  const char mark = last_is_comma ? ',' : '.';
  if (read_number(with_point(text, mark), value) != Cell::number) return 0;
  const bool both = comma != std::string_view::npos && point != std::string_view::npos;
  return !both && mark == ',' && is_grouped(text, mark) ? 0 : mark;
}

}  // namespace

Cell read_number(std::string_view text, double& value) {
  value = std::numeric_limits<double>::quiet_NaN();
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  if (text.empty()) return Cell::missing;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = end == text.data() + text.size();
  if (!whole || (error != std::errc() && error != std::errc::result_out_of_range)) {
    value = std::numeric_limits<double>::quiet_NaN();
    const std::string_view known[] = {"na", "n/a", "null", "none", "-"};
    return std::find(std::begin(known), std::end(known), lower(text)) != std::end(known) ? Cell::missing : Cell::text;
  }
  if (error != std::errc() || !std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
  return std::isnan(value) ? Cell::missing : Cell::number;
}

void NumberReader::settle_mark(const std::vector<std::string_view>& row) {
  if (mark_ != 0) return;
  bool ambiguous = false;
  for (const std::string_view cell : row) {
    mark_ = decimal_mark_of(cell);
    if (mark_ != 0) return;
    ambiguous = ambiguous || is_grouped(cell, ',');
  }
  if (ambiguous) mark_ = ',';  // only commas: three decimals
}

Cell NumberReader::read(std::string_view text, double& value) const {
  const Cell cell = read_number(text, value);
  if (mark_ != ',') {
    if (cell != Cell::text || !is_grouped(text, ',')) return cell;
    return read_number(with_point(text, '.'), value);
  }
  const bool has_point = text.find('.') != std::string_view::npos;
  if (cell != Cell::text) return cell == Cell::number && has_point ? Cell::text : cell;
  if (std::count(text.begin(), text.end(), ',') != 1) return Cell::text;
  if (has_point && !is_grouped(text.substr(0, text.find(',')), '.')) return Cell::text;
  return read_number(with_point(text, ','), value);
}

namespace {

/// Reads the digits of a time stamp from left to right.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  std::optional<double> number(std::size_t least_digits, std::size_t most_digits) {
    std::size_t digits = 0;
    double value = 0;
    while (digits < most_digits && digits < rest_.size() && is_digit(rest_[digits]))
      value = 10 * value + (rest_[digits++] - '0');
    if (digits < least_digits) return std::nullopt;
    rest_.remove_prefix(digits);
    return value;
  }

  bool take(std::string_view any_of) {
    if (rest_.empty() || any_of.find(rest_.front()) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }

  /// Digits after a decimal mark.
  double fraction() {
    double value = 0, unit = 0.1;
    for (; !rest_.empty() && is_digit(rest_.front()); unit /= 10) {
      value += unit * (rest_.front() - '0');
      rest_.remove_prefix(1);
    }
    return value;
  }

  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

/// Days since 1970-01-01 in the Gregorian calendar.
double days_since_1970(int year, int month, int day) {
  const int y = month <= 2 ? year - 1 : year;
  const int era = y / 400, of_era = y - 400 * era;
  const int of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return 146097.0 * era + 365 * of_era + of_era / 4 - of_era / 100 + of_year - 719468;
}

/// "10:00", "10:00:00.020": s since midnight.
std::optional<double> time_of_day(Scanner& scanner) {
  const auto hour = scanner.number(1, 2);
  if (!hour || !scanner.take(":")) return std::nullopt;
  const auto minute = scanner.number(2, 2);
  if (!minute || *hour > 24 || *minute > 59) return std::nullopt;
  double seconds = 3600 * *hour + 60 * *minute;
  if (!scanner.take(":")) return seconds;
  const auto second = scanner.number(2, 2);
  if (!second || *second > 60) return std::nullopt;
  seconds += *second;
  if (scanner.take(".,")) seconds += scanner.fraction();
  return seconds;
}

/// Offset from UTC, s: "Z", "+01:00", "+0100", "-05".
std::optional<double> zone(Scanner& scanner) {
  if (scanner.rest().empty() || scanner.take("zZ")) return 0;
  const bool west = scanner.rest().front() == '-';
  if (!scanner.take("+-")) return std::nullopt;
  const auto hours = scanner.number(2, 2);
  if (!hours) return std::nullopt;
  scanner.take(":");
  const double minutes = scanner.number(2, 2).value_or(0);
  return (west ? -1 : 1) * (3600 * *hours + 60 * minutes);
}

}  // namespace

std::optional<double> read_time_stamp(std::string_view text) {
  Scanner scanner(text);
  double date = 0;
  const bool has_date = text.size() > 10 && (text[4] == '-' || text[4] == '/');
  if (has_date) {
    const auto year = scanner.number(4, 4);
    if (!year || !scanner.take("-/")) return std::nullopt;
    const auto month = scanner.number(1, 2);
    if (!month || !scanner.take("-/")) return std::nullopt;
    const auto day = scanner.number(1, 2);
    if (!day || !scanner.take("Tt _") || *month < 1 || *month > 12 || *day < 1 || *day > 31) return std::nullopt;
    date = 86400 * days_since_1970(static_cast<int>(*year), static_cast<int>(*month), static_cast<int>(*day));
  }
  const auto of_day = time_of_day(scanner);
  if (!of_day) return std::nullopt;
  scanner.take(" ");
  const auto ahead = has_date ? zone(scanner) : 0;
  if (!ahead || !scanner.rest().empty()) return std::nullopt;
  return date + *of_day - *ahead;
}

}  // namespace fusee::measurement
