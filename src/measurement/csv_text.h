/// \file
/// Internal: decodes a file in blocks into the records of a CSV text (RFC 4180) in UTF-8.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace fusee::measurement {

constexpr std::size_t k_longest_record = std::size_t{1} << 16;  // bytes
constexpr std::size_t k_most_columns = 1000;

/// A record: one line, or several if a quoted cell holds line ends.
struct Record {
  std::string_view text;    ///< UTF-8, with LF for line ends inside
  long long line = 1;       ///< number of its first line
  bool open_quote = false;  ///< the file ends within a quoted cell
};

/// Lines end with LF, CR LF or CR. UTF-16 with a byte order mark and Latin-1 become UTF-8; the mark of UTF-8 is
/// dropped.
class RecordSplitter {
 public:
  /// Calls `take` for each record. Calls `refuse`, which must throw, for a record longer than k_longest_record;
  /// `open_quote` says that an unclosed quotation mark is the cause.
  RecordSplitter(std::function<void(const Record&)> take, std::function<void(long long line, bool open_quote)> refuse);

  void add(std::string_view bytes);
  void finish();

 private:
  enum class Encoding { unknown, bytes, utf16_little, utf16_big };

  void detect_encoding();
  void add_utf16(std::string_view bytes);
  void append_utf8(unsigned long character);
  void add_bytes(std::string_view bytes);
  void append(std::string_view piece);
  void end_line();
  void end_record(bool open_quote);
  void check_length() const;

  std::function<void(const Record&)> take_;
  std::function<void(long long, bool)> refuse_;
  Encoding encoding_ = Encoding::unknown;
  std::string start_;          ///< first bytes, until the encoding is known; then an incomplete UTF-16 code unit
  std::string decoded_;        ///< UTF-16 text as UTF-8
  std::string record_;         ///< complete lines within an open quote
  std::string line_;           ///< the current line so far
  unsigned long high_ = 0;     ///< first half of a surrogate pair
  bool after_return_ = false;  ///< the last line ended with CR, so that LF belongs to it
  bool in_record_ = false;     ///< a quoted cell is open across lines
  long long lines_ = 0;        ///< complete lines so far
  long long first_line_ = 1;   ///< of the current record
};

/// Splits a record into cells, without surrounding blanks and quotation marks; a quotation mark inside a quoted cell
/// stays doubled. `separator` ' ' means any number of blanks. Stops after more than k_most_columns.
void split_cells(std::string_view record, char separator, std::vector<std::string_view>& cells);

}  // namespace fusee::measurement
