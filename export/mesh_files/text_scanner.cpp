#include "export/mesh_files/text_scanner.h"

#include <fmt/format.h>

#include <charconv>

namespace fusee::formats {
namespace {

constexpr std::string_view k_byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view k_line_ends = "\r\n";

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || c == '\n'; }

template <class Number>
bool parse(std::string_view word, Number& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

/// "20,5" and "-0,25e3": a number with a decimal comma.
bool has_decimal_comma(std::string_view word) {
  std::string with_point(word);
  const std::size_t comma = with_point.find(',');
  if (comma == std::string::npos) return false;
  with_point[comma] = '.';
  double value = 0;
  return parse(with_point, value);
}

}  // namespace

bool parse_number(std::string_view word, double& value) { return parse(word, value); }
bool parse_integer(std::string_view word, std::int64_t& value) { return parse(word, value); }

TextScanner::TextScanner(const Source& source, char comment) : source_(source), comment_(comment) {
  if (source.bytes.starts_with(k_byte_order_mark)) next_ = k_byte_order_mark.size();
  const std::size_t end = source.bytes.find_first_of(k_line_ends);
  ends_with_cr_ = end != std::string_view::npos && source.bytes.substr(end, 2) != "\r\n" && source.bytes[end] == '\r';
}

bool TextScanner::next_line() {
  const std::string_view text = source_.bytes;
  while (next_ < text.size()) {
    const std::size_t end = std::min(text.find_first_of(k_line_ends, next_), text.size());
    const std::size_t end_size = !ends_with_cr_ && text.substr(end, 2) == "\r\n" ? 2 : 1;
    line_start_ = cursor_ = next_;
    line_end_ = end;
    next_ = std::min(end + end_size, text.size());
    ++line_;
    if (comment_ != '\0') {
      const std::string_view with_comment = text.substr(line_start_, end - line_start_);
      line_end_ = line_start_ + std::min(with_comment.find(comment_), with_comment.size());
    }
    while (cursor_ < line_end_ && is_blank(text[cursor_])) ++cursor_;
    word_start_ = word_end_ = cursor_;
    if (cursor_ < line_end_) return true;
  }
  line_start_ = line_end_ = cursor_ = word_start_ = word_end_ = text.size();
  return false;
}

std::string_view TextScanner::word() {
  const std::string_view text = source_.bytes;
  while (cursor_ < line_end_ && is_blank(text[cursor_])) ++cursor_;
  word_start_ = cursor_;
  while (cursor_ < line_end_ && !is_blank(text[cursor_])) ++cursor_;
  word_end_ = cursor_;
  return text.substr(word_start_, word_end_ - word_start_);
}

std::string_view TextScanner::flowing_word() {
  std::string_view found = word();
  while (found.empty() && next_line()) found = word();
  return found;
}

std::string_view TextScanner::rest_of_line() {
  const std::string_view text = source_.bytes;
  while (cursor_ < line_end_ && is_blank(text[cursor_])) ++cursor_;
  word_start_ = cursor_;
  word_end_ = line_end_;
  while (word_end_ > word_start_ && is_blank(text[word_end_ - 1])) --word_end_;
  cursor_ = line_end_;
  return text.substr(word_start_, word_end_ - word_start_);
}

double TextScanner::number(std::string_view word, std::string_view expected) const {
  double value = 0;
  if (!parse_number(word, value)) fail(expected);
  return value;
}

std::int64_t TextScanner::integer(std::string_view word, std::string_view expected) const {
  std::int64_t value = 0;
  if (!parse_integer(word, value)) fail(expected);
  return value;
}

Vec3 TextScanner::flowing_point(std::string_view expected) {
  Vec3 point;
  for (double& coordinate : point) coordinate = number(flowing_word(), expected);
  return point;
}

bool TextScanner::is_continued() const {
  std::size_t end = line_end_;
  while (end > line_start_ && is_blank(source_.bytes[end - 1])) --end;
  return end > line_start_ && source_.bytes[end - 1] == '\\';
}

std::size_t TextScanner::lines_ahead(std::size_t enough) const {
  TextScanner ahead = *this;
  std::size_t lines = 0;
  while (lines < enough && ahead.next_line()) ++lines;
  return lines;
}

Place TextScanner::place() const {
  constexpr std::size_t k_most_columns = 1'000'000'000;  // so that it fits into an int
  return {source_.name, line_, static_cast<int>(std::min(word_start_ - line_start_ + 1, k_most_columns))};
}

void TextScanner::fail(std::string_view expected) const {
  const std::string_view found = source_.bytes.substr(word_start_, word_end_ - word_start_);
  const bool at_end = found.empty() && next_ >= source_.bytes.size();
  std::string finding = at_end ? "the file ends here" : "the line ends here";
  if (!found.empty()) finding = fmt::format("found '{}'", printable(found));
  const char* hint = has_decimal_comma(found) ? "it has a decimal comma: write decimal points in the whole file" : "";
  throw InputError({Severity::error, place(), fmt::format("expected {}, {}", expected, finding), hint});
}

std::string printable(std::string_view text) {
  constexpr std::size_t k_longest = 40;
  std::string shown;
  for (const char c : text.substr(0, k_longest)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_printable = byte >= 0x20 && byte < 0x7f && c != '\\';
    shown += is_printable ? std::string(1, c) : fmt::format("\\x{:02x}", byte);
  }
  return text.size() > k_longest ? shown + "…" : shown;
}

}  // namespace fusee::formats
