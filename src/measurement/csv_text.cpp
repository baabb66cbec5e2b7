#include "measurement/csv_text.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "measurement/log_text.h"

namespace fusee::measurement {
namespace {

bool is_comment(std::string_view line) { return !line.empty() && trimmed(line).substr(0, 1) == "#"; }

/// True if a quoted cell is open at the end of `text`; `quoted`: one is open at its beginning. Only a quotation mark at
/// the beginning of a cell opens one.
bool ends_in_quotes(std::string_view text, bool quoted) {
  bool cell_begins = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"') continue;
      if (i + 1 < text.size() && text[i + 1] == '"') {
        ++i;
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = cell_begins;
      cell_begins = false;
    } else if (c == ',' || c == ';' || c == '\t') {
      cell_begins = true;
    } else if (c != ' ') {
      cell_begins = false;
    }
  }
  return quoted;
}

std::string_view unquoted(std::string_view text) {
  text = trimmed(text);
  return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

/// Index of the separator outside quotation marks that ends the first cell of `text`; npos if none.
std::size_t cell_end(std::string_view text, std::string_view separators) {
  const std::size_t start = text.find_first_not_of(' ');
  if (start == std::string_view::npos || text[start] != '"') return text.find_first_of(separators);
  std::size_t i = start + 1;
  while (i < text.size()) {
    if (text[i] != '"') {
      ++i;
    } else if (i + 1 < text.size() && text[i + 1] == '"') {
      i += 2;
    } else {
      return text.find_first_of(separators, i + 1);
    }
  }
  return std::string_view::npos;
}

}  // namespace

void split_cells(std::string_view record, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  const std::string_view separators = separator == ' ' ? std::string_view(" \t") : std::string_view(&separator, 1);
  while (cells.size() <= k_most_columns) {
    const std::size_t end = cell_end(record, separators);
    cells.push_back(unquoted(record.substr(0, end)));
    if (end == std::string_view::npos) break;
    record.remove_prefix(end + 1);
    if (separator == ' ') record.remove_prefix(std::min(record.find_first_not_of(separators), record.size()));
  }
}

RecordSplitter::RecordSplitter(std::function<void(const Record&)> take, std::function<void(long long, bool)> refuse)
    : take_(std::move(take)), refuse_(std::move(refuse)) {}

void RecordSplitter::add(std::string_view bytes) {
  if (encoding_ == Encoding::unknown) {
    start_ += bytes;
    if (start_.size() < 3) return;
    const std::string start = std::move(start_);
    start_ = start.substr(0, 3);  // which detect_encoding() reads
    detect_encoding();
    start_.clear();
    const bool has_utf8_mark = start.compare(0, 3, "\xEF\xBB\xBF") == 0;
    const std::size_t mark_size = encoding_ != Encoding::bytes ? 2 : has_utf8_mark ? 3 : 0;
    return add(std::string_view(start).substr(mark_size));
  }
  if (encoding_ == Encoding::bytes) return add_bytes(bytes);
  add_utf16(bytes);
}

void RecordSplitter::detect_encoding() {
  const std::string_view mark = std::string_view(start_).substr(0, 2);
  encoding_ = mark == "\xFF\xFE" ? Encoding::utf16_little : mark == "\xFE\xFF" ? Encoding::utf16_big : Encoding::bytes;
}

void RecordSplitter::add_utf16(std::string_view bytes) {
  decoded_.clear();
  for (const char c : bytes) {
    start_ += c;
    if (start_.size() < 2) continue;
    const auto first = static_cast<unsigned char>(start_[0]), second = static_cast<unsigned char>(start_[1]);
    start_.clear();
    const unsigned long unit = encoding_ == Encoding::utf16_little ? first | (second << 8U) : second | (first << 8U);
    // A surrogate pair is a high code unit, then a low one (RFC 2781). A low one alone becomes the replacement
    // character.
    const bool is_high = unit >= 0xD800 && unit < 0xDC00, is_low = unit >= 0xDC00 && unit < 0xE000;
    if (is_high) {
      high_ = unit;
    } else if (is_low && high_ != 0) {
      append_utf8(0x10000 + ((high_ - 0xD800) << 10U) + (unit - 0xDC00));
    } else {
      append_utf8(is_low ? 0xFFFD : unit);
    }
  }
  add_bytes(decoded_);
}

void RecordSplitter::append_utf8(unsigned long character) {
  high_ = 0;
  const auto put = [this](unsigned long byte) { decoded_ += static_cast<char>(byte); };
  if (character < 0x80) return put(character);
  if (character < 0x800) {
    put(0xC0 | (character >> 6U));
  } else if (character < 0x10000) {
    put(0xE0 | (character >> 12U));
    put(0x80 | ((character >> 6U) & 0x3F));
  } else {
    put(0xF0 | (character >> 18U));
    put(0x80 | ((character >> 12U) & 0x3F));
    put(0x80 | ((character >> 6U) & 0x3F));
  }
  put(0x80 | (character & 0x3F));
}

void RecordSplitter::add_bytes(std::string_view bytes) {
  while (!bytes.empty()) {
    if (after_return_ && bytes.front() == '\n') bytes.remove_prefix(1);
    after_return_ = false;
    const std::size_t end = bytes.find_first_of("\r\n");
    append(bytes.substr(0, end));
    check_length();
    if (end == std::string_view::npos) return;
    after_return_ = bytes[end] == '\r';
    end_line();
    bytes.remove_prefix(end + 1);
  }
}

/// A log that was not closed may end with very many zero bytes: one of them is enough.
void RecordSplitter::append(std::string_view piece) {
  constexpr char k_zero = '\0';
  const std::size_t last = piece.find_last_not_of(k_zero);
  if (last == std::string_view::npos && !line_.empty() && line_.back() == k_zero) return;
  line_.append(piece.substr(0, last == std::string_view::npos ? 1 : last + 2));
}

void RecordSplitter::check_length() const {
  if (record_.size() + line_.size() > k_longest_record) refuse_(in_record_ ? first_line_ : lines_ + 1, in_record_);
}

void RecordSplitter::end_line() {
  ++lines_;
  if (!in_record_) {
    first_line_ = lines_;
    if (line_.find('"') == std::string::npos || is_comment(line_) || !ends_in_quotes(line_, false)) {
      std::swap(record_, line_);  // record_ was empty: the line becomes the record without a copy
      return end_record(false);
    }
    record_.clear();
  }
  in_record_ = ends_in_quotes(line_, in_record_);
  record_ += line_;
  line_.clear();
  if (!in_record_) return end_record(false);
  record_ += '\n';
}

void RecordSplitter::end_record(bool open_quote) {
  if (!is_utf8(record_)) record_ = to_utf8(record_);
  take_({record_, first_line_, open_quote});
  record_.clear();
  line_.clear();
  in_record_ = false;
}

void RecordSplitter::finish() {
  if (encoding_ == Encoding::unknown) {
    encoding_ = Encoding::bytes;
    add_bytes(std::exchange(start_, {}));
  }
  if (!line_.empty()) end_line();
  if (in_record_) end_record(true);
}

}  // namespace fusee::measurement
