/// \file
/// Internal: DXF tags, which are a group code and a value on a line each. Every error names its line.
///
/// Group codes that recur in reader and writers: 0 type of what begins here, 2 name, 5 handle, 8 layer, 9 header
/// variable, 10 + 20 + 30 point, 42 bulge, 62 colour, 67 paper space, 70 flags or count, 210 + 220 + 230 normal of the
/// entity's plane, 330 handle of the owner.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"

namespace fusee::formats {

struct DxfTag {
  int code = 0;
  std::string_view value;  ///< without blanks at its ends; points into the file's bytes
  int line = 0;            ///< line of the value
};

/// Throws InputError. Line 0 stands for the whole file.
[[noreturn]] void fail_in_dxf(const std::string& file, int line, std::string message, std::string hint = {});
/// The first 40 bytes of a file's text in quotes, for a message. Bytes other than printable ASCII become '?'.
std::string quoted_bytes(std::string_view text);

/// Splits the bytes into tags. Lines end with \n, with \r\n, or in a file without any \n with \r.
class DxfTagReader {
 public:
  DxfTagReader(std::string_view bytes, const std::string& file)
      : bytes_(bytes), file_(file), line_end_(bytes.find('\n') == std::string_view::npos ? '\r' : '\n') {}

  /// The next tag, skipping comments (999). Empty at the end of the bytes.
  std::optional<DxfTag> next();
  /// The next tag. Fails at the end of the bytes.
  DxfTag required();

 private:
  std::optional<std::string_view> next_line();

  std::string_view bytes_;
  const std::string& file_;
  char line_end_;
  std::size_t position_ = 0;
  int line_ = 0;
  int last_line_ = 0;  ///< line of the last required tag
};

/// The value as a finite number.
double dxf_number(const std::string& file, const DxfTag& tag);

/// The first value of each group code among some tags. Numbers are checked on access.
class DxfValues {
 public:
  DxfValues(const std::string& file, const std::vector<DxfTag>& tags) : file_(file), tags_(tags) {}

  std::string_view text(int code) const;
  double real(int code, double fallback) const;
  int integer(int code, int fallback) const;
  /// x under `code`, y ten above.
  Vec2 point(int code) const { return {real(code, 0), real(code + 10, 0)}; }

 private:
  const DxfTag* find(int code) const;

  const std::string& file_;
  const std::vector<DxfTag>& tags_;
};

}  // namespace fusee::formats
