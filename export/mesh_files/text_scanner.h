/// \file
/// Words and numbers of a text, line by line, each with its place. All readers of text formats share it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "export/mesh_files/mesh_formats.h"

namespace fusee {

/// Reads a number the same in every locale ("+1.5", "-2e-3", "inf", "nan"). False unless all of `word` is one.
bool parse_number(std::string_view word, double& value);
bool parse_integer(std::string_view word, std::int64_t& value);

/// Blanks separate words. A line ends with \n, \r\n or \r. In a text whose first line ends with \r alone, a \n after a
/// later \r is not part of that line's end: it may be the first byte of binary values. A byte-order mark at the start
/// is skipped.
class TextScanner {
 public:
  /// `comment` starts a comment that runs to the end of its line; '\0': none does.
  explicit TextScanner(const Source& source, char comment = '\0');

  /// Goes to the next line that holds a word; false at the end of the text.
  bool next_line();
  /// The next word of this line; empty at its end.
  std::string_view word();
  /// The next word of the text; empty at its end.
  std::string_view flowing_word();
  /// The remainder of this line, without blanks at its ends.
  std::string_view rest_of_line();

  /// `word` as a number, or an error that says `expected`.
  double number(std::string_view word, std::string_view expected) const;
  std::int64_t integer(std::string_view word, std::string_view expected) const;
  /// The next three numbers of the text.
  Vec3 flowing_point(std::string_view expected);

  const Source& source() const { return source_; }
  /// This line ends with a backslash.
  bool is_continued() const;
  /// How many lines with words follow this one; it stops counting at `enough`.
  std::size_t lines_ahead(std::size_t enough) const;
  /// Of the word read last.
  Place place() const;
  /// First byte behind the word read last.
  std::size_t offset() const { return cursor_; }
  /// First byte of the next line.
  std::size_t next_line_offset() const { return next_; }

  /// "expected `expected`, found 'word'" at the word read last.
  [[noreturn]] void fail(std::string_view expected) const;

 private:
  const Source& source_;
  char comment_;
  bool ends_with_cr_;     ///< the first line ends with \r alone
  std::size_t next_ = 0;  ///< first byte of the next line
  std::size_t line_start_ = 0;
  std::size_t line_end_ = 0;  ///< of the words: without comment
  std::size_t cursor_ = 0;
  std::size_t word_start_ = 0;
  std::size_t word_end_ = 0;
  int line_ = 0;
};

/// `text` fit for a message and for a line of a file: short, and with what is not printable as \xNN. A backslash is
/// \x5c: at the end of a line it would carry an OBJ statement on to the next one.
std::string printable(std::string_view text);

}  // namespace fusee
