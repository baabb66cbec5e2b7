/// \file
/// Internal: words and numbers of a text, line by line, each with its place, for all readers of text formats.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "export/mesh_files/mesh_formats.h"

namespace fusee::formats {

/// Reads a number independently of the locale ("+1.5", "-2e-3", "inf", "nan"). False unless all of `word` is a number.
bool parse_number(std::string_view word, double& value);
bool parse_integer(std::string_view word, std::int64_t& value);

/// Blanks separate words. A line ends with \n, \r\n or \r. In a text whose first line ends with \r alone, a \n after a
/// later \r is not part of that line's end, because it may be the first byte of binary values. A byte-order mark at the
/// start is skipped.
class TextScanner {
 public:
  /// `comment` starts a comment that runs to the end of its line; '\0' for formats without comments.
  explicit TextScanner(const Source& source, char comment = '\0');

  /// Goes to the next line with a word; false at the end of the text.
  bool next_line();
  /// The next word of this line; empty at its end.
  std::string_view word();
  /// The next word of the text; empty at its end.
  std::string_view flowing_word();
  /// The remainder of this line, without blanks at its ends.
  std::string_view rest_of_line();

  /// `word` as a number, or an error that names `expected`.
  double number(std::string_view word, std::string_view expected) const;
  std::int64_t integer(std::string_view word, std::string_view expected) const;
  /// The next three numbers of the text.
  Vec3 flowing_point(std::string_view expected);

  const Source& source() const { return source_; }
  /// True if this line ends with a backslash.
  bool is_continued() const;
  /// Number of lines with words after this one, counted up to `enough`.
  std::size_t lines_ahead(std::size_t enough) const;
  /// The place of the last word read.
  Place place() const;
  /// The first byte after the last word read.
  std::size_t offset() const { return cursor_; }
  /// First byte of the next line.
  std::size_t next_line_offset() const { return next_; }

  /// Throws "expected `expected`, found 'word'" with the place of the last word read.
  [[noreturn]] void fail(std::string_view expected) const;

 private:
  const Source& source_;
  char comment_;
  bool ends_with_cr_;     ///< the first line ends with \r alone
  std::size_t next_ = 0;  ///< first byte of the next line
  std::size_t line_start_ = 0;
  std::size_t line_end_ = 0;  ///< end of the line's words, without a comment
  std::size_t cursor_ = 0;    ///< first byte that was not read
  std::size_t word_start_ = 0;
  std::size_t word_end_ = 0;
  int line_ = 0;
};

/// `text` shortened for a message or a line of a file, with unprintable bytes as \xNN. A backslash becomes \x5c: at the
/// end of a line it would continue an OBJ statement.
std::string printable(std::string_view text);

}  // namespace fusee::formats
