/// \file
/// Internal: writes the tags of a DXF file.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "fusee/base.h"

namespace fusee::formats {

class DxfTagWriter {
 public:
  void text(int code, std::string_view value);
  void integer(int code, int value);
  /// Nine decimals without trailing zeros. The value is exact to 1e-9 mm, and no exponent appears.
  void real(int code, double value);
  void handle(int code, int value);
  /// x under `code`, y ten above.
  void point(int code, const Vec2& p);
  void point3(int code, double x, double y, double z);
  void integers(std::initializer_list<std::pair<int, int>> tags);
  void reals(std::initializer_list<std::pair<int, double>> tags);
  void begin_section(std::string_view name);
  void end_section() { text(0, "ENDSEC"); }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

}  // namespace fusee::formats
