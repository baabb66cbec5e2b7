#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "base/text.h"
#include "mechanism/lengths.h"

namespace fusee {
namespace {

/// A number in a message.
struct NumberInText {
  std::size_t begin = 0;
  std::size_t end = 0;
  double value = 0;
  bool is_length = false;
};

bool is_decimal(char c) { return c >= '0' && c <= '9'; }
bool is_word_part(char c) { return is_decimal(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// All numbers of a text that are not part of a word, such as P1 or M2.5.
std::vector<NumberInText> numbers_in(std::string_view text) {
  std::vector<NumberInText> found;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool signed_digit = text[at] == '-' && at + 1 < text.size() && is_decimal(text[at + 1]);
    if (!is_decimal(text[at]) && !signed_digit) continue;
    NumberInText number;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), number.value);
    number.begin = at;
    number.end = static_cast<std::size_t>(end - text.data());
    const bool in_word = at > 0 && (is_word_part(text[at - 1]) || text[at - 1] == '.' || text[at - 1] == '-');
    if (error == std::errc() && !in_word) found.push_back(number);
    at = number.end - 1;
  }
  return found;
}

/// True if "mm" before this text is the whole unit: not mm², mm/N, mm per N.
bool ends_unit(std::string_view rest) {
  constexpr std::array<std::string_view, 4> k_others{"/", "\xC2\xB7", "\xC2\xB2", "\xC2\xB3"};  // · ² ³
  const bool other = std::any_of(k_others.begin(), k_others.end(), [&](auto sign) { return rest.starts_with(sign); });
  return !other && !rest.starts_with(" per ") && (rest.empty() || !is_word_part(rest.front()));
}

/// The text between a number and its "mm", if mm is the whole unit: a blank, perhaps after "]", or a no-break blank. ""
/// otherwise.
std::string_view gap_before_mm(std::string_view rest) {
  for (const std::string_view gap : {" ", "] ", "\xC2\xA0"}) {
    if (rest.starts_with(gap) && rest.substr(gap.size()).starts_with("mm") && ends_unit(rest.substr(gap.size() + 2)))
      return gap;
  }
  return {};
}

/// True for the text between two lengths of one list.
bool is_list_separator(std::string_view between) {
  constexpr std::string_view k_minus = "\xE2\x88\x92";  // sign of the second number
  if (between.ends_with(k_minus)) between.remove_suffix(k_minus.size());
  constexpr std::array<std::string_view, 8> k_separators{" to ",  " \xC3\x97 ", " x ", " by ",
                                                         " and ", " or ",       ", ",  " \xE2\x80\xA6 "};  // × …
  return std::find(k_separators.begin(), k_separators.end(), between) != k_separators.end();
}

/// True if the text after a number is " in" (but not "in place of") or "°".
bool has_unit_of_its_own(std::string_view rest) {
  if (rest.starts_with("\xC2\xB0")) return true;
  return rest.starts_with(" in") && !rest.starts_with(" in place") && (rest.size() == 3 || !is_word_part(rest[3]));
}

/// True for the value in "pulley.r1_mm = 22", also after ≤, ≥, <= or >=. `before` and `rest`: the text before and after
/// the number.
bool is_value_of_key(std::string_view before, std::string_view rest) {
  if (has_unit_of_its_own(rest)) return false;
  if (before.ends_with('[')) before.remove_suffix(1);
  for (const std::string_view relation : {" = ", " \xE2\x89\xA4 ", " \xE2\x89\xA5 ", " <= ", " >= "}) {
    if (!before.ends_with(relation)) continue;
    before.remove_suffix(relation.size());
    const std::size_t blank = before.find_last_of(" (\"");
    const std::string_view key = before.substr(blank == std::string_view::npos ? 0 : blank + 1);
    return is_length(key) && key.find('.') != std::string_view::npos;  // parameters of effects have no table
  }
  return false;
}

void mark_lengths(std::string_view text, std::vector<NumberInText>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    NumberInText& number = numbers[i];
    const std::string_view before = text.substr(0, number.begin), rest = text.substr(number.end);
    const std::string_view between = i == 0 ? "" : text.substr(numbers[i - 1].end, number.begin - numbers[i - 1].end);
    const bool is_present_value = between == " or less (now " || between == " or more (now " || between == " (now " ||
                                  between == " (now automatic, ";
    const bool is_end_of_interval = between == " to ";
    const bool is_second_of_pair =
        i > 0 && between == ", " && before.substr(0, numbers[i - 1].begin).ends_with("_mm = [");
    // "pulley.r1_mm = 22 or less (now 25)", "joint.attachment1_mm = [3, 40]": both numbers have the key's unit.
    const bool follows =
        i > 0 && numbers[i - 1].is_length && (is_present_value || is_end_of_interval || is_second_of_pair);
    const bool is_quoted = before.ends_with('"');  // a text of the file or an example of one
    number.is_length = !is_quoted && (!gap_before_mm(rest).empty() || is_value_of_key(before, rest) || follows);
  }
  // In a list such as "20 × 30 mm", only the last number has the unit.
  for (std::size_t i = numbers.size(); i-- > 1;) {
    const std::string_view between = text.substr(numbers[i - 1].end, numbers[i].begin - numbers[i - 1].end);
    if (numbers[i].is_length && is_list_separator(between)) numbers[i - 1].is_length = true;
  }
}

/// Significant digits of a written number.
int digits_of(std::string_view number) {
  number = number.substr(0, number.find('e'));
  const std::size_t first = number.find_first_of("123456789");
  if (first == std::string_view::npos) return 1;
  return static_cast<int>(std::count_if(number.begin() + static_cast<std::ptrdiff_t>(first), number.end(), is_decimal));
}

}  // namespace

std::string lengths_in(LengthUnit unit, const std::string& message) {
  if (unit == LengthUnit::mm) return message;
  std::vector<NumberInText> numbers = numbers_in(message);
  mark_lengths(message, numbers);
  std::string text;
  std::size_t from = 0;
  for (const NumberInText& number : numbers) {
    if (!number.is_length) continue;
    // One digit more than in mm, so that the length is no coarser.
    const int digits =
        std::max(3, 1 + digits_of(std::string_view(message).substr(number.begin, number.end - number.begin)));
    text.append(message, from, number.begin - from);
    text += rounded(from_mm(number.value, unit), digits);
    from = number.end;
    const std::string_view gap = gap_before_mm(std::string_view(message).substr(from));
    if (gap.empty()) continue;
    text += std::string(gap) + std::string(unit_word(unit));
    from += gap.size() + 2;
  }
  return text.append(message, from);
}

}  // namespace fusee
