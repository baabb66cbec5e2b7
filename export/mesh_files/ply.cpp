// PLY (Stanford): a text header that declares elements and their properties, then their values in text or binary.

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "export/mesh_files/mesh_formats.h"
#include "export/mesh_files/polygons.h"
#include "export/mesh_files/text_scanner.h"

namespace fusee::formats {
namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct ScalarName {
  std::string_view name;
  Scalar type;
};
constexpr std::array<ScalarName, 16> k_scalar_names = {{{"char", Scalar::int8},
                                                        {"uchar", Scalar::uint8},
                                                        {"short", Scalar::int16},
                                                        {"ushort", Scalar::uint16},
                                                        {"int", Scalar::int32},
                                                        {"uint", Scalar::uint32},
                                                        {"float", Scalar::float32},
                                                        {"double", Scalar::float64},
                                                        {"int8", Scalar::int8},
                                                        {"uint8", Scalar::uint8},
                                                        {"int16", Scalar::int16},
                                                        {"uint16", Scalar::uint16},
                                                        {"int32", Scalar::int32},
                                                        {"uint32", Scalar::uint32},
                                                        {"float32", Scalar::float32},
                                                        {"float64", Scalar::float64}}};

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 8> k_sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return k_sizes[static_cast<std::size_t>(type)];
}

enum class Encoding { ascii, little_endian, big_endian };

/// The meaning of a property of a vertex or a face for a mesh.
enum class Role { none, x, y, z, corners };

struct Property {
  Role role = Role::none;
  Scalar type = Scalar::float32;
  bool is_list = false;
  Scalar count_type = Scalar::uint8;  ///< of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  Place place;
  std::vector<Property> properties;

  bool has(Role role) const {
    for (const Property& property : properties) {
      if (property.role == role) return true;
    }
    return false;
  }
  /// Least number of bytes of one element.
  std::size_t least_size(Encoding encoding) const {
    std::size_t size = 0;
    for (const Property& p : properties) {
      // In text each value has a digit and a blank at least. No blank follows the last one of the file.
      size += encoding == Encoding::ascii ? 2 : size_of(p.is_list ? p.count_type : p.type);
    }
    return encoding == Encoding::ascii && size > 0 ? size - 1 : size;
  }
};

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::uint64_t vertices = 0;  ///< number of vertices, over all vertex elements
};

// Header -------------------------------------------------------------------------------------------------------------

Encoding read_encoding(TextScanner& text) {
  const std::string_view word = text.word();
  if (word == "ascii") return Encoding::ascii;
  if (word == "binary_little_endian") return Encoding::little_endian;
  if (word == "binary_big_endian") return Encoding::big_endian;
  text.fail("'ascii', 'binary_little_endian' or 'binary_big_endian'");
}

Scalar read_type(const TextScanner& text, std::string_view word) {
  for (const ScalarName& candidate : k_scalar_names) {
    if (word == candidate.name) return candidate.type;
  }
  text.fail("a PLY type ('float', 'uchar', 'int', …)");
}

Role role_of(std::string_view element, std::string_view property, bool is_list) {
  if (element == "vertex" && !is_list) {
    if (property == "x") return Role::x;
    if (property == "y") return Role::y;
    if (property == "z") return Role::z;
  }
  const bool lists_corners = property == "vertex_indices" || property == "vertex_index";
  return element == "face" && is_list && lists_corners ? Role::corners : Role::none;
}

Property read_property(TextScanner& text, const Element& element) {
  Property property;
  std::string_view word = text.word();
  if (word == "list") {
    property.is_list = true;
    property.count_type = read_type(text, text.word());
    word = text.word();
  }
  property.type = read_type(text, word);
  const std::string_view name = text.word();
  if (name.empty()) text.fail("the name of a property");
  property.role = role_of(element.name, name, property.is_list);
  return property;
}

Element read_element_line(TextScanner& text) {
  Element element;
  element.name = text.word();
  element.place = text.place();
  const std::int64_t count = text.integer(text.word(), "the number of elements");
  if (count < 0) text.fail("the number of elements");
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

void check_element(const Source& source, const Header& header, const Element& element, std::size_t body) {
  const auto fail = [&](const std::string& message) {
    throw InputError({Severity::error, element.place, message, {}});
  };
  if (element.name == "vertex" && !(element.has(Role::x) && element.has(Role::y) && element.has(Role::z))) {
    fail("expected the properties x, y and z of a vertex");
  }
  if (element.name == "face" && !element.has(Role::corners))
    fail("expected the property list vertex_indices of a face");
  if (element.name == "tristrips") fail("expected faces, found triangle strips; write the mesh with faces");
  demand_room(source, body, element.count, element.least_size(header.encoding),
              "elements '" + printable(element.name) + "'");
}

Header read_header(const Source& source, TextScanner& text) {
  Header header;
  text.next_line();
  if (text.word() != "ply") text.fail("'ply'");
  std::string_view first;
  do {
    text.next_line();
    first = text.word();
  } while (first == "comment" || first == "obj_info");
  if (first != "format") text.fail("'format'");
  header.encoding = read_encoding(text);
  while (true) {
    if (!text.next_line()) text.fail("'end_header'");
    const std::string_view word = text.word();
    if (word == "end_header") break;
    if (word == "element") {
      header.elements.push_back(read_element_line(text));
      if (header.elements.back().name == "vertex") header.vertices += header.elements.back().count;
    } else if (word == "property") {
      if (header.elements.empty()) text.fail("an element before its properties");
      header.elements.back().properties.push_back(read_property(text, header.elements.back()));
    } else if (word != "comment" && word != "obj_info") {
      text.fail("'element', 'property', 'comment', 'obj_info' or 'end_header'");
    }
  }
  for (const Element& element : header.elements) check_element(source, header, element, text.next_line_offset());
  return header;
}

// ---- Values: two sources of the same numbers ------------------------------------------------------------------------

/// The format counts words, not lines. If each row has a line of its own, undeclared values at its end are skipped.
class AsciiValues {
 public:
  AsciiValues(TextScanner& text, std::uint64_t rows)
      : text_(text), has_one_row_per_line_(text.lines_ahead(rows + 1) == rows) {}
  void begin_row(const Element& element) {
    if (has_one_row_per_line_ && !text_.next_line()) text_.fail("an element '" + printable(element.name) + "'");
  }
  double value(Scalar) { return text_.number(has_one_row_per_line_ ? text_.word() : text_.flowing_word(), "a number"); }
  [[noreturn]] void fail(const std::string& expected) const { text_.fail(expected); }

 private:
  TextScanner& text_;
  bool has_one_row_per_line_;
};

/// Number of rows of values. Elements without properties take no space in the text.
std::uint64_t rows_of(const Header& header) {
  std::uint64_t rows = 0;
  for (const Element& element : header.elements) rows += element.properties.empty() ? 0 : element.count;
  return rows;
}

/// The number of this type whose bytes are the lowest ones of `bits`.
template <class Number>
double as_number(std::uint64_t bits) {
  if constexpr (sizeof(Number) == 8) {
    return std::bit_cast<double>(bits);
  } else if constexpr (std::is_same_v<Number, float>) {
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  } else {
    return static_cast<double>(static_cast<Number>(bits));
  }
}

class BinaryValues {
 public:
  BinaryValues(const Source& source, std::size_t offset, bool big_endian)
      : source_(source), offset_(offset), big_endian_(big_endian) {}
  void begin_row(const Element&) {}

  double value(Scalar type) {
    switch (const std::uint64_t bits = next_bits(size_of(type)); type) {
      case Scalar::int8:
        return as_number<std::int8_t>(bits);
      case Scalar::uint8:
        return as_number<std::uint8_t>(bits);
      case Scalar::int16:
        return as_number<std::int16_t>(bits);
      case Scalar::uint16:
        return as_number<std::uint16_t>(bits);
      case Scalar::int32:
        return as_number<std::int32_t>(bits);
      case Scalar::uint32:
        return as_number<std::uint32_t>(bits);
      case Scalar::float32:
        return as_number<float>(bits);
      case Scalar::float64:
        return as_number<double>(bits);
    }
    return 0;
  }
  [[noreturn]] void fail(const std::string& expected) const {
    fail_at_byte(source_, value_start_, "expected " + expected);
  }

 private:
  std::uint64_t next_bits(std::size_t size) {
    if (source_.bytes.size() - offset_ < size) fail_at_byte(source_, offset_, "expected a value, the file ends here");
    value_start_ = offset_;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const auto byte = static_cast<unsigned char>(source_.bytes[offset_ + (big_endian_ ? size - 1 - i : i)]);
      bits |= std::uint64_t{byte} << (8 * i);
    }
    offset_ += size;
    return bits;
  }

  const Source& source_;
  std::size_t offset_;
  bool big_endian_;
  std::size_t value_start_ = 0;
};

// Elements -----------------------------------------------------------------------------------------------------------

/// Fails unless `value` is an integer in [0, limit). `meaning`: for the message.
template <class Values>
std::uint64_t whole(const Values& values, double value, double limit, std::string_view meaning) {
  if (!(value >= 0 && value < limit && value == std::floor(value))) {
    values.fail(fmt::format("{} from 0 to {:.0f}", meaning, limit - 1));
  }
  return static_cast<std::uint64_t>(value);
}

template <class Values>
class ElementReader {
 public:
  ElementReader(const Source& source, Values values, const Header& header)
      : values_(std::move(values)), header_(header), polygons_(source, mesh_) {}

  solid::TriangleMesh read() {
    for (const Element& element : header_.elements) {
      // Elements without properties take no space in any number.
      if (element.properties.empty()) continue;
      if (element.name == "vertex") mesh_.vertices.reserve(mesh_.vertices.size() + element.count);
      if (element.name == "face") mesh_.triangles.reserve(mesh_.triangles.size() + element.count);
      for (std::uint64_t i = 0; i < element.count; ++i) read_row(element);
    }
    polygons_.split_concave();
    return std::move(mesh_);
  }

 private:
  void read_row(const Element& element) {
    values_.begin_row(element);
    Vec3 position = Vec3::Zero();
    for (const Property& property : element.properties) {
      if (property.is_list) {
        read_list(property);
        continue;
      }
      const double value = values_.value(property.type);
      switch (property.role) {
        case Role::x:
          position.x() = value;
          break;
        case Role::y:
          position.y() = value;
          break;
        case Role::z:
          position.z() = value;
          break;
        case Role::none:
        case Role::corners:
          break;
      }
    }
    if (element.name == "vertex") mesh_.vertices.push_back(position);
  }

  void read_list(const Property& property) {
    constexpr double k_length_limit = 4294967296.0;  // 2³²: the largest integer type is uint
    const std::uint64_t size =
        whole(values_, values_.value(property.count_type), k_length_limit, "the length of a list");
    if (property.role != Role::corners) {
      for (std::uint64_t i = 0; i < size; ++i) values_.value(property.type);
      return;
    }
    if (size == 0) values_.fail("a face of at least 1 corner");
    corners_.clear();
    for (std::uint64_t i = 0; i < size; ++i) {
      const double index = values_.value(property.type);
      corners_.push_back(
          static_cast<std::uint32_t>(whole(values_, index, static_cast<double>(header_.vertices), "a vertex number")));
    }
    if (const auto expected = polygons_.add(corners_)) values_.fail(*expected);
  }

  Values values_;
  const Header& header_;
  solid::TriangleMesh mesh_;
  PolygonSplitter polygons_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

solid::TriangleMesh read_ply(const Source& source) {
  TextScanner text(source);
  const Header header = read_header(source, text);
  if (header.encoding == Encoding::ascii)
    return ElementReader(source, AsciiValues(text, rows_of(header)), header).read();
  const bool big_endian = header.encoding == Encoding::big_endian;
  return ElementReader(source, BinaryValues(source, text.next_line_offset(), big_endian), header).read();
}

}  // namespace fusee::formats
