#include "export/drawings/dxf_tag_writer.h"

#include <fmt/format.h>

#include <iterator>

#include "base/text.h"

namespace fusee::formats {

void DxfTagWriter::text(int code, std::string_view value) {
  fmt::format_to(std::back_inserter(out_), "{:>3}\n{}\n", code, value);
}

void DxfTagWriter::integer(int code, int value) {
  fmt::format_to(std::back_inserter(out_), "{:>3}\n{:>6}\n", code, value);
}

void DxfTagWriter::real(int code, double value) {
  const std::string number = trimmed_fixed(value, 9);
  text(code, number.find('.') == std::string::npos ? number + ".0" : number);
}

void DxfTagWriter::handle(int code, int value) { text(code, fmt::format("{:X}", value)); }

void DxfTagWriter::point(int code, const Vec2& p) {
  real(code, p.x());
  real(code + 10, p.y());
}

void DxfTagWriter::point3(int code, double x, double y, double z) {
  real(code, x);
  real(code + 10, y);
  real(code + 20, z);
}

void DxfTagWriter::integers(std::initializer_list<std::pair<int, int>> tags) {
  for (const auto& [code, value] : tags) integer(code, value);
}

void DxfTagWriter::reals(std::initializer_list<std::pair<int, double>> tags) {
  for (const auto& [code, value] : tags) real(code, value);
}

void DxfTagWriter::begin_section(std::string_view name) {
  text(0, "SECTION");
  text(2, name);
}

}  // namespace fusee::formats
