#include "mechanism/lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/text.h"

namespace fusee {
namespace {

/// Millimetres of a unit: factor · 10^exponent.
struct UnitName {
  std::string_view name;
  int factor;
  int exponent;
};
constexpr int k_inch = 254;  // · 10^-1 mm
constexpr std::array<UnitName, 12> k_units{{{"mm", 1, 0},
                                            {"cm", 1, 1},
                                            {"m", 1, 3},
                                            {"um", 1, -3},
                                            {"\xC2\xB5m", 1, -3},
                                            {"in", k_inch, -1},
                                            {"in.", k_inch, -1},
                                            {"inch", k_inch, -1},
                                            {"inches", k_inch, -1},
                                            {"\"", k_inch, -1},
                                            {"\xE2\x80\xB3", k_inch, -1},
                                            {"thou", k_inch, -4}}};

/// digits · 10^exponent.
struct Decimal {
  bool negative = false;
  std::string digits;
  int exponent = 0;
};

/// The decimal number of an unsigned text "12.50", "1e-3".
Decimal decimal_of(std::string_view text) {
  Decimal number;
  const std::size_t e = text.find_first_of("eE");
  if (e != std::string_view::npos) {
    std::string_view power = text.substr(e + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    std::from_chars(power.data(), power.data() + power.size(), number.exponent);
    text = text.substr(0, e);
  }
  const std::size_t point = text.find('.');
  for (const char c : text) {
    if (c != '.') number.digits += c;
  }
  if (point != std::string_view::npos) number.exponent -= static_cast<int>(text.size() - point - 1);
  return number;
}

double number_in(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// number · factor · 10^exponent, exact in decimal and rounded once.
double scaled(Decimal number, int factor, int exponent) {
  int carry = 0;
  for (std::size_t i = number.digits.size(); i-- > 0;) {
    carry += factor * (number.digits[i] - '0');
    number.digits[i] = static_cast<char>('0' + carry % 10);
    carry /= 10;
  }
  const double value = number_in((carry > 0 ? std::to_string(carry) : "") + number.digits + "e" +
                                 std::to_string(number.exponent + exponent));
  return number.negative ? -value : value;
}

void skip_blanks(std::string_view& text) { text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size())); }

/// Takes an unsigned number from the front of `text`; "" if there is none.
std::string_view take_number(std::string_view& text) {
  double value = 0;
  if (text.empty() || !((text.front() >= '0' && text.front() <= '9') || text.front() == '.')) return {};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return {};
  const std::string_view taken = text.substr(0, static_cast<std::size_t>(end - text.data()));
  text.remove_prefix(taken.size());
  return taken;
}

/// A whole number below a million, so that the fraction of two of them is exact enough.
std::optional<int> whole(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || value >= 1000000) return std::nullopt;
  return value;
}

/// "12.5", "1/8", "3 1/2" or "3-1/2", without a sign.
std::optional<Decimal> take_mixed_number(std::string_view& text) {
  const std::string_view first = take_number(text);
  if (first.empty()) return std::nullopt;
  std::optional<int> numerator = whole(first), whole_part = 0;
  std::string_view rest = text;
  if (!rest.starts_with('/')) {
    whole_part = numerator;
    if (rest.starts_with('-'))
      rest.remove_prefix(1);
    else
      skip_blanks(rest);
    const std::string_view second = take_number(rest);
    numerator = whole(second);
    if (second.empty() || !rest.starts_with('/')) return decimal_of(first);
  }
  rest.remove_prefix(1);
  const std::optional<int> denominator = whole(take_number(rest));
  if (!whole_part || !numerator || !denominator || *denominator == 0) return std::nullopt;
  text = rest;
  return decimal_of(shortest(*whole_part + static_cast<double>(*numerator) / *denominator));
}

/// The shortest text of `value`, with at most `digits` significant digits, that `read` converts to exactly `mm`; "" if
/// there is none.
template <typename Read>
std::string text_of_digits(double value, double mm, int digits, Read read) {
  for (int count = 1; count <= digits; ++count) {
    const std::string text = shortest(number_in(fmt::format("{:.{}e}", value, count - 1)));
    if (read(text) == mm) return text;
  }
  return {};
}

constexpr int k_short_digits = 6;  ///< enough for every length that is made or measured
constexpr int k_all_digits = 17;   ///< enough for every double

}  // namespace

bool is_length(std::string_view key) {
  if (key.ends_with("[0]") || key.ends_with("[1]")) key.remove_suffix(3);
  return key.ends_with("_mm") && !key.ends_with("_per_mm");
}

std::string_view length_key(const Field& list, const DeclaredMechanism& mechanism, std::size_t item) {
  if (list.table != "optimize") return list.key;
  const std::vector<std::string>& variables = mechanism.optimize.variables;
  return item < variables.size() ? std::string_view(variables[item]) : std::string_view();
}

std::string_view unit_word(LengthUnit unit) { return unit == LengthUnit::inch ? "in" : "mm"; }

std::string_view unit_in_file(const Field& field, LengthUnit unit) {
  return is_length(field.key) ? unit_word(unit) : field.unit;
}

double to_mm(double length, LengthUnit unit) {
  if (unit == LengthUnit::mm || !std::isfinite(length)) return length;
  Decimal number = decimal_of(shortest(std::abs(length)));
  number.negative = length < 0;
  return scaled(std::move(number), k_inch, -1);
}

double from_mm(double mm, LengthUnit unit) { return unit == LengthUnit::mm ? mm : mm / 25.4; }

std::optional<double> parse_length(std::string_view text) {
  skip_blanks(text);
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  std::optional<Decimal> number = take_mixed_number(text);
  if (!number) return std::nullopt;
  number->negative = negative;
  skip_blanks(text);
  text = text.substr(0, text.find_last_not_of(" \t") + 1);
  const auto unit =
      std::find_if(k_units.begin(), k_units.end(), [&text](const UnitName& known) { return known.name == text; });
  if (unit == k_units.end()) return std::nullopt;
  return scaled(*std::move(number), unit->factor, unit->exponent);
}

std::string length_value_text(double mm, LengthUnit unit) {
  if (unit == LengthUnit::mm || !std::isfinite(mm)) return shortest(mm);
  const double inches = from_mm(mm, unit);
  const auto as_number = [](const std::string& text) { return to_mm(number_in(text), LengthUnit::inch); };
  if (const std::string few = text_of_digits(inches, mm, k_short_digits, as_number); !few.empty()) return few;
  if (const std::string few = text_of_digits(mm, mm, k_short_digits, number_in); !few.empty())
    return "\"" + few + " mm\"";
  if (const std::string all = text_of_digits(inches, mm, k_all_digits, as_number); !all.empty()) return all;
  return "\"" + shortest(mm) + " mm\"";  // no number of inches reads back as this length
}

}  // namespace fusee
