#include "measurement/cells.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "base/text.h"
#include "measurement/log_text.h"

namespace fusee::measurement {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// True if `mark` groups three digits: "1,020" and "-12,345,678.5" with the comma. In "0,020" it is a decimal mark.
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

/// The number with a decimal point in place of `mark`, and without the other mark.
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

/// The decimal mark that a cell proves; 0 if it is no number, has no mark, or an ambiguous one as "1,020".
char decimal_mark_of(std::string_view text) {
  double value = 0;
  const std::size_t comma = text.rfind(','), point = text.rfind('.');
  if (comma == std::string_view::npos && point == std::string_view::npos) return 0;
  const bool last_is_comma = point == std::string_view::npos || (comma != std::string_view::npos && comma > point);
  const char mark = last_is_comma ? ',' : '.';
  if (read_number(with_point(text, mark), value) != CellContent::number) return 0;
  const bool both = comma != std::string_view::npos && point != std::string_view::npos;
  return !both && mark == ',' && is_grouped(text, mark) ? 0 : mark;
}

/// "1 020", "12'345.6": marks that group digits in French, Swiss and ISO tables.
constexpr std::string_view k_group_marks[] = {"\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89", "\xE2\x80\x99", " ", "'"};
/// Minus sign and en dash of typeset tables.
constexpr std::string_view k_minus_signs[] = {"\xE2\x88\x92", "\xE2\x80\x93"};

/// The number without group marks and with an ASCII minus sign. Empty if `text` has no group mark and no typeset minus
/// sign, or if its marks do not group three digits.
std::string plain_number(std::string_view text) {
  std::string plain;
  const std::size_t size = text.size();
  for (const std::string_view blank : {std::string_view("\xC2\xA0"), std::string_view("\xE2\x80\xAF")}) {
    while (text.starts_with(blank)) text.remove_prefix(blank.size());
    while (text.ends_with(blank)) text.remove_suffix(blank.size());
  }
  bool is_changed = text.size() < size;
  for (const std::string_view minus : k_minus_signs) {
    if (!text.starts_with(minus)) continue;
    plain = "-";
    text.remove_prefix(minus.size());
    is_changed = true;
  }
  bool has_groups = false;
  while (!text.empty()) {
    const auto mark = std::find_if(std::begin(k_group_marks), std::end(k_group_marks),
                                   [&](std::string_view candidate) { return text.starts_with(candidate); });
    const bool is_mark = mark != std::end(k_group_marks);
    plain += is_mark ? '\'' : text.front();  // one mark for all of them
    text.remove_prefix(is_mark ? mark->size() : 1);
    has_groups = has_groups || is_mark;
  }
  is_changed = is_changed || has_groups;
  if (!is_changed || (has_groups && !is_grouped(plain, '\''))) return {};
  plain.erase(std::remove(plain.begin(), plain.end(), '\''), plain.end());
  return plain;
}

/// Words of loggers and spreadsheets for a missing value, also "#DIV/0!" and, of Microsoft's runtime, "-1.#IND".
bool is_missing(std::string_view text) {
  const std::string word = lower(text);
  constexpr std::string_view k_known[] = {"na",   "n/a", "null", "(null)", "none", "-",   "--",
                                          "<na>", "nat", "?",    "...",    "#n/a", "#nv", "missing"};
  if (std::find(std::begin(k_known), std::end(k_known), word) != std::end(k_known)) return true;
  if (word.size() > 2 && word.front() == '#' && word.back() == '!') return true;
  const std::size_t mark = word.find(".#");
  if (mark == std::string::npos) return false;
  constexpr std::string_view k_kinds[] = {"qnan", "snan", "ind", "inf"};
  return std::any_of(std::begin(k_kinds), std::end(k_kinds),
                     [&](std::string_view kind) { return word.compare(mark + 2, kind.size(), kind) == 0; });
}

}  // namespace

CellContent read_number(std::string_view text, double& value) {
  value = std::numeric_limits<double>::quiet_NaN();
  // from_chars() accepts no plus sign. In "+-1" it stays, so that this is no number.
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  if (text.empty()) return CellContent::missing;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = end == text.data() + text.size();
  if (!whole || (error != std::errc() && error != std::errc::result_out_of_range)) {
    value = std::numeric_limits<double>::quiet_NaN();
    return is_missing(text) ? CellContent::missing : CellContent::text;
  }
  if (error != std::errc() || !std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
  return std::isnan(value) ? CellContent::missing : CellContent::number;
}

void NumberReader::settle_mark(const std::vector<std::string_view>& row) {
  if (mark_ != 0) return;
  bool ambiguous = false;
  for (const std::string_view cell : row) {
    const std::string plain = plain_number(cell);
    mark_ = decimal_mark_of(plain.empty() ? cell : plain);
    if (mark_ != 0) return;
    ambiguous = ambiguous || is_grouped(cell, ',');
  }
  if (ambiguous) mark_ = ',';  // in a row of "1,020" alone, the comma counts as the decimal mark
}

CellContent NumberReader::read(std::string_view text, double& value) const {
  const CellContent content = read_number(text, value);
  const std::string plain = content == CellContent::text ? plain_number(text) : "";
  if (!plain.empty()) return read(plain, value);
  if (mark_ != ',') {
    if (content != CellContent::text || !is_grouped(text, ',')) return content;
    return read_number(with_point(text, '.'), value);
  }
  // With a decimal comma, "1.5" is no number, and "1.020,5" is one.
  const bool has_point = text.find('.') != std::string_view::npos;
  if (content != CellContent::text) return content == CellContent::number && has_point ? CellContent::text : content;
  if (std::count(text.begin(), text.end(), ',') != 1) return CellContent::text;
  if (has_point && !is_grouped(text.substr(0, text.find(',')), '.')) return CellContent::text;
  return read_number(with_point(text, ','), value);
}

namespace {

/// Reads a time stamp from left to right.
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

  /// Skips one character if it is any of these.
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

/// Days since 1970-01-01 in the Gregorian calendar, by days_from_civil() of Howard Hinnant's "chrono-Compatible
/// Low-Level Date Algorithms". An era is 400 years. Years begin in March, so that the leap day is the last of its year.
double days_since_1970(int year, int month, int day) {
  const int y = month <= 2 ? year - 1 : year;
  const int era = y / 400, year_of_era = y - 400 * era;
  const int month_from_march = month + (month > 2 ? -3 : 9);
  const int day_of_year = (153 * month_from_march + 2) / 5 + day - 1;
  return 146097.0 * era + 365 * year_of_era + year_of_era / 4 - year_of_era / 100 + day_of_year - 719468;
}

/// The hour of a clock of 12 hours: 12 AM is midnight. Without "AM" or "PM" the hour remains.
double hour_of_day(double hour, std::string_view rest) {
  const std::string word = lower(trimmed(rest));
  if (word.empty() || (word.front() != 'a' && word.front() != 'p')) return hour;
  return std::fmod(hour, 12) + (word.front() == 'p' ? 12 : 0);
}

/// Skips "AM", "p.m.".
void skip_half_of_day(Scanner& scanner) {
  scanner.take(" ");
  if (!scanner.take("aApP")) return;
  scanner.take(".");
  scanner.take("mM");
  scanner.take(".");
}

/// "10:00", "10:00:00.020", "2:00:00 PM" as s since midnight. "05:00.020" is minutes and seconds, as spreadsheets
/// export times with milliseconds: s since the hour. `compact`: "101500.020" is a time of day, too.
std::optional<double> time_of_day(Scanner& scanner, bool compact) {
  const auto hour = scanner.number(1, 2);
  const bool has_colon = hour && scanner.take(":");
  if (!hour || (!has_colon && !compact)) return std::nullopt;
  const auto minute = scanner.number(2, 2);
  if (!minute || *minute > 59) return std::nullopt;
  if (has_colon && scanner.take(".,"))  // the two numbers were minutes and seconds
    return *hour > 59 ? std::nullopt : std::optional(60 * *hour + *minute + scanner.fraction());
  if (*hour > 24) return std::nullopt;
  double second = 0;
  if (scanner.take(":") || !has_colon) {
    const auto whole = scanner.number(2, 2);
    if (!whole || *whole > 60) return std::nullopt;
    second = *whole + (scanner.take(".,") ? scanner.fraction() : 0);
  }
  const double seconds = 3600 * hour_of_day(*hour, scanner.rest()) + 60 * *minute + second;
  skip_half_of_day(scanner);
  return seconds;
}

/// Number of a month from its English or German name; 0 for none.
int month_of(std::string_view name) {
  constexpr std::string_view k_months[] = {"jan", "feb", "mar", "apr", "may",        "jun", "jul", "aug",
                                           "sep", "oct", "nov", "dec", "m\xC3\xA4r", "mai", "okt", "dez"};
  constexpr int k_numbers[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 3, 5, 10, 12};
  const std::string word = lower(name);
  for (std::size_t i = 0; i < std::size(k_months); ++i) {
    if (word.starts_with(k_months[i])) return k_numbers[i];
  }
  return 0;
}

bool is_date(double month, double day) { return month >= 1 && month <= 12 && day >= 1 && day <= 31; }

/// "2025-03-01T", "2025/3/1 ", "20250301T": s since 1970.
std::optional<double> date_by_year(Scanner& scanner) {
  const auto year = scanner.number(4, 4);
  if (!year) return std::nullopt;
  const bool has_marks = scanner.take("-/");
  const auto month = scanner.number(has_marks ? 1 : 2, 2);
  if (!month || (has_marks && !scanner.take("-/"))) return std::nullopt;
  const auto day = scanner.number(has_marks ? 1 : 2, 2);
  if (!day || (!has_marks && !scanner.rest().starts_with('T') && !scanner.rest().starts_with('t'))) return std::nullopt;
  if (!is_date(*month, *day) || !scanner.take("Tt _")) return std::nullopt;
  return 86400 * days_since_1970(static_cast<int>(*year), static_cast<int>(*month), static_cast<int>(*day));
}

/// "01.03.2025 ", "01-Mar-2025 ": s since 1970. "3/1/2025 " is 0, because day and month may be exchanged; clock.cpp
/// then continues the time of day over midnight.
std::optional<double> date_by_day(Scanner& scanner) {
  const auto day = scanner.number(1, 2);
  if (!day || scanner.rest().empty()) return std::nullopt;
  const char mark = scanner.rest().front();
  if (!scanner.take("./-")) return std::nullopt;
  double month = month_of(scanner.rest());
  const bool has_name = month > 0;
  if (has_name) {
    while (!scanner.rest().empty() && scanner.rest().front() != mark) scanner.take(scanner.rest().substr(0, 1));
  } else {
    month = scanner.number(1, 2).value_or(0);
  }
  if (!scanner.take(std::string_view(&mark, 1))) return std::nullopt;
  auto year = scanner.number(2, 4);
  if (!year) return std::nullopt;
  if (*year < 100) *year += 2000;
  scanner.take(",");
  if (!scanner.take("Tt _")) return std::nullopt;
  if (!has_name && mark != '.') return is_date(month, *day) || is_date(*day, month) ? std::optional(0.0) : std::nullopt;
  if (!is_date(month, *day)) return std::nullopt;
  return 86400 * days_since_1970(static_cast<int>(*year), static_cast<int>(month), static_cast<int>(*day));
}

/// "0 days 00:00:01.5" of pandas.
std::optional<double> days_before_time(Scanner& scanner) {
  const auto days = scanner.number(1, 6);
  if (!days || !scanner.take(" ")) return std::nullopt;
  for (const char letter : std::string_view("day")) {
    if (!scanner.take(std::string_view(&letter, 1))) return std::nullopt;
  }
  scanner.take("s");
  scanner.take(",");
  return scanner.take(" ") ? std::optional(86400 * *days) : std::nullopt;
}

/// Offset from UTC, s: "Z", "+01:00", "+0100", "-05". Empty for other text.
std::optional<double> utc_offset(Scanner& scanner) {
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
  std::string plain(text);
  // No-break spaces, U+00A0 and U+202F.
  for (const std::string_view blank : {std::string_view("\xC2\xA0"), std::string_view("\xE2\x80\xAF")}) {
    for (std::size_t at = plain.find(blank); at != std::string::npos; at = plain.find(blank))
      plain.replace(at, blank.size(), " ");
  }
  Scanner scanner{std::string_view(plain)};
  double date = 0;
  bool has_date = false;
  for (const auto read_date : {date_by_year, date_by_day, days_before_time}) {
    Scanner after_date{std::string_view(plain)};
    const auto found = read_date(after_date);
    if (!found) continue;
    date = *found;
    has_date = true;
    scanner = after_date;
    break;
  }
  const auto seconds_of_day = time_of_day(scanner, has_date);
  if (!seconds_of_day) return std::nullopt;
  scanner.take(" ");
  const auto offset = has_date ? utc_offset(scanner) : 0;
  if (!offset || !scanner.rest().empty()) return std::nullopt;
  return date + *seconds_of_day - *offset;
}

}  // namespace fusee::measurement
