#include "export/drawings/dxf_tags.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"

namespace fusee::formats {

void fail_in_dxf(const std::string& file, int line, std::string message, std::string hint) {
  throw InputError(Diagnostic{Severity::error, {file, line, 0}, std::move(message), std::move(hint)});
}

std::string quoted_bytes(std::string_view text) {
  std::string plain = "'";
  for (const char c : text.substr(0, 40)) plain += c >= ' ' && c <= '~' ? c : '?';
  return plain + "'";
}

std::optional<DxfTag> DxfTagReader::next() {
  for (;;) {
    const auto code_line = next_line();
    if (!code_line) return std::nullopt;
    const std::string_view text = trimmed(*code_line);
    if (text.empty() && position_ >= bytes_.size()) return std::nullopt;
    int code = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), code);
    if (error != std::errc{} || end != text.data() + text.size() || code < -5 || code > 1071) {
      fail_in_dxf(file_, line_, "a group code (a whole number) should stand here, not " + quoted_bytes(text),
                  "the file is no DXF, or damaged from here on");
    }
    const auto value = next_line();
    if (!value) {
      fail_in_dxf(file_, line_, "the file ends where the value of group " + std::to_string(code) + " should stand",
                  "it was cut short: export it again");
    }
    if (code != 999) return DxfTag{code, trimmed(*value), line_};
  }
}

DxfTag DxfTagReader::required() {
  const auto tag = next();
  if (!tag) fail_in_dxf(file_, last_line_, "the file ends without EOF", "it was cut short: export it again");
  last_line_ = tag->line;
  return *tag;
}

std::optional<std::string_view> DxfTagReader::next_line() {
  if (position_ >= bytes_.size()) return std::nullopt;
  const std::size_t end = std::min(bytes_.find(line_end_, position_), bytes_.size());
  const std::string_view line = bytes_.substr(position_, end - position_);
  position_ = end + 1;
  ++line_;
  return line;
}

namespace {

/// True for the text of a number that no double holds, if its magnitude is below 1: it is too small, not too large.
bool is_below_one(std::string_view text) {
  const std::size_t mark = std::min(text.find_first_of("eE"), text.size());
  const std::string_view digits = text.substr(0, mark);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  // Digits between the first one that counts and the point; negative behind the point.
  const auto order = static_cast<long long>(point) - static_cast<long long>(first);
  std::string_view power = text.substr(std::min(mark + 1, text.size()));
  if (power.starts_with('+')) power.remove_prefix(1);
  long long exponent = 0;
  if (std::from_chars(power.data(), power.data() + power.size(), exponent).ec == std::errc::result_out_of_range)
    return power.starts_with('-');
  return exponent < -order;
}

}  // namespace

double dxf_number(const std::string& file, const DxfTag& tag) {
  std::string_view text = tag.value;
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = end == text.data() + text.size();
  const bool underflows = is_whole && error == std::errc::result_out_of_range && is_below_one(text);
  if (!underflows && (error != std::errc{} || !is_whole || !std::isfinite(value))) {
    fail_in_dxf(file, tag.line,
                "a number should stand here (group " + std::to_string(tag.code) + "), not " + quoted_bytes(tag.value));
  }
  return underflows ? 0 : value;
}

const DxfTag* DxfValues::find(int code) const {
  const auto found = std::find_if(tags_.begin(), tags_.end(), [code](const DxfTag& t) { return t.code == code; });
  return found == tags_.end() ? nullptr : &*found;
}

std::string_view DxfValues::text(int code) const {
  const DxfTag* tag = find(code);
  return tag ? tag->value : std::string_view{};
}

double DxfValues::real(int code, double fallback) const {
  const DxfTag* tag = find(code);
  return tag ? dxf_number(file_, *tag) : fallback;
}

int DxfValues::integer(int code, int fallback) const {
  const DxfTag* tag = find(code);
  if (!tag) return fallback;
  const double value = dxf_number(file_, *tag);
  if (value != std::floor(value) || std::abs(value) > 1e9) {
    fail_in_dxf(
        file_, tag->line,
        "a whole number should stand here (group " + std::to_string(code) + "), not " + quoted_bytes(tag->value));
  }
  return static_cast<int>(value);
}

}  // namespace fusee::formats
