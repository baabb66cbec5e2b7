// 3MF: a zip of XML parts, core specification 1.3. The reader also follows the paths of the production extension
// (objects in other parts), and rejects models that require an extension with its own geometry.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <memory>
#include <new>
#include <pugixml.hpp>
#include <vector>

#include "base/text.h"
#include "base/zip.h"
#include "export/mesh_files/mesh_files.h"
#include "export/mesh_files/mesh_formats.h"
#include "export/mesh_files/text_scanner.h"
#include "export/tool.h"

namespace fusee::formats {
namespace {

// Writing ------------------------------------------------------------------------------------------------------------

constexpr std::string_view k_content_types = R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";

constexpr std::string_view k_relationships = R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";

// Texts kept as metadata. Names outside the core specification carry a namespace of their own.
constexpr std::string_view k_namespace = "urn:fusee:mechanism:1";
constexpr std::array<std::string_view, 2> k_kept_texts{"mechanism", "table"};

/// Text of an XML element. Line ends of Windows would be read back as those of Unix.
std::string element_text(std::string_view bytes) {
  std::string text = escape_html(bytes);
  for (std::size_t at = text.find('\r'); at != std::string::npos; at = text.find('\r', at))
    text.replace(at, 1, "&#13;");
  return text;
}

/// A table may have bytes that XML forbids: all but ASCII text is written as %XX.
std::string percent_encoded(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto code = static_cast<unsigned char>(c);
    const bool is_plain = c == '\n' || c == '\t' || (code >= 0x20 && code < 0x7f && c != '%');
    text += is_plain ? std::string(1, c) : fmt::format("%{:02X}", code);
  }
  return text;
}

std::optional<std::string> percent_decoded(std::string_view text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = static_cast<unsigned char>(text[i]);
    if (text[i] == '%') {
      if (i + 3 > text.size()) return std::nullopt;
      const auto [end, error] = std::from_chars(text.data() + i + 1, text.data() + i + 3, code, 16);
      if (error != std::errc() || end != text.data() + i + 3) return std::nullopt;
      i += 2;
    }
    bytes += static_cast<char>(code);
  }
  return bytes;
}

/// Elements for the texts of a mechanism file and its table.
std::string kept_xml(const std::vector<OutputFile>& mechanism) {
  std::string xml;
  for (std::size_t i = 0; i < mechanism.size(); ++i) {
    const std::string& bytes = mechanism[i].bytes;
    xml += fmt::format(" <metadata name=\"fusee:{}\" preserve=\"1\" type=\"xs:string\">{}</metadata>\n",
                       k_kept_texts.at(i), element_text(i == 0 ? bytes : percent_encoded(bytes)));
  }
  return xml;
}

std::string model_xml(const solid::TriangleMesh& mesh, const std::string& name,
                      const std::vector<OutputFile>& mechanism) {
  fmt::memory_buffer xml;
  xml.reserve(1024 + 60 * mesh.vertices.size() + 48 * mesh.triangles.size());
  const auto put = [&xml](fmt::string_view format, const auto&... values) {
    fmt::vformat_to(std::back_inserter(xml), format, fmt::make_format_args(values...));
  };
  const std::string title = escape_html(printable(name));
  const std::string declared = mechanism.empty() ? "" : fmt::format(" xmlns:fusee=\"{}\"", k_namespace);
  put(R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"{2}>
 <metadata name="Title">{0}</metadata>
 <metadata name="Application">{1}</metadata>
 <metadata name="Description">Compound pulley {0}: P1 below P2, z along the axis, x and y as the joint stands at home.</metadata>
{3} <resources>
  <object id="1" type="model" name="{0}">
   <mesh>
    <vertices>
)",
      title, k_tool, declared, kept_xml(mechanism));
  for (const Vec3& v : mesh.vertices) {
    // Adding zero removes the sign of a negative zero. The shortest text that reads back as the same float has at most
    // 9 digits.
    put("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", float(v.x()) + 0.0F, float(v.y()) + 0.0F, float(v.z()) + 0.0F);
  }
  put("    </vertices>\n    <triangles>\n");
  for (const auto& t : mesh.triangles) put("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", t[0], t[1], t[2]);
  put("    </triangles>\n   </mesh>\n  </object>\n </resources>\n <build>\n  <item objectid=\"1\"/>\n "
      "</build>\n</model>\n");
  return fmt::to_string(xml);
}

// Reading ------------------------------------------------------------------------------------------------------------

/// A model of 128 MiB has about two million triangles.
constexpr std::uint64_t k_largest_part = std::uint64_t{128} << 20;
/// Text of coordinates is compressed 5 to 20 times. A part that expands to more than this many times the file is a zip
/// bomb.
constexpr std::uint64_t k_most_inflation = 100;
constexpr std::uint64_t k_always_unpacked = std::uint64_t{1} << 20;  // bytes that parts may have beyond that ratio
/// Elements that are allowed in addition to one for each byte.
constexpr std::uint64_t k_always_added = k_always_unpacked;
/// Deepest nesting of components.
constexpr int k_deepest = 32;

/// Extensions that add nothing to the geometry except paths, which are followed.
constexpr auto k_known_extensions =
    std::to_array<std::string_view>({"http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
                                     "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
                                     "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
                                     "http://schemas.3mf.io/3dmanufacturing/trianglesets/2021/07"});

/// The text without blanks at its ends, which XML Schema permits around numbers.
std::string_view collapsed(std::string_view text) {
  constexpr std::string_view k_blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(k_blanks);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(k_blanks) - first + 1);
}

std::string_view local_name(std::string_view name) { return name.substr(name.find(':') + 1); }

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  return node.find_child([&](const pugi::xml_node& candidate) { return local_name(candidate.name()) == name; });
}

/// Visits only children of this name, with any prefix.
template <class Visit>
void for_children(const pugi::xml_node& node, std::string_view name, const Visit& visit) {
  for (const pugi::xml_node& candidate : node.children()) {
    if (local_name(candidate.name()) == name) visit(candidate);
  }
}

/// An affine placement: p → linear · p + shift.
struct Placement {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vec3 shift = Vec3::Zero();

  Placement after(const Placement& first) const { return {linear * first.linear, linear * first.shift + shift}; }
  bool mirrors() const { return linear.determinant() < 0; }
};

/// One part of the archive, whose attributes are read with their place.
struct ModelPart {
  std::string path;
  std::string text;  ///< pugixml points into it
  pugi::xml_document xml;
  double unit = 1;  ///< mm
  std::map<std::int64_t, pugi::xml_node> objects;
};

class ThreemfReader {
 public:
  explicit ThreemfReader(const Source& source);
  solid::TriangleMesh read();
  KeptMechanism kept_mechanism();

 private:
  std::string unpacked(const std::string& path);
  void parse(const std::string& path, std::string& text, pugi::xml_document& xml) const;
  std::string model_path();
  ModelPart& part(const std::string& path);
  double unit_of(const ModelPart& part, const pugi::xml_node& model) const;
  void refuse_unknown_extensions(const ModelPart& part, const pugi::xml_node& model) const;
  bool is_part_of_solid(const ModelPart& part, const pugi::xml_node& object) const;
  void refuse_other_geometry(const ModelPart& part, const pugi::xml_node& object) const;

  [[noreturn]] void fail(const ModelPart& part, const pugi::xml_node& node, const std::string& message) const {
    fail_in_entry(source_.name, part.path, node.offset_debug(), message);
  }
  double number(const ModelPart& part, const pugi::xml_node& node, const char* attribute) const;
  std::int64_t integer(const ModelPart& part, const pugi::xml_node& node, const char* attribute) const;
  Placement placement(const ModelPart& part, const pugi::xml_node& node) const;

  /// Adds the object named by an item of the build or a component, at its place.
  void add_reference(ModelPart& part, const pugi::xml_node& reference, const Placement& outer, int depth);
  void add_object(ModelPart& part, const pugi::xml_node& object, const Placement& place, int depth);
  void add_vertices(ModelPart& part, const pugi::xml_node& mesh, const Placement& place);
  void add_triangles(ModelPart& part, const pugi::xml_node& mesh, const Placement& place, std::size_t first);
  /// Counts a vertex, triangle or placed object. Fails if the mesh would be far larger than the file.
  void count_element(ModelPart& part, const pugi::xml_node& node);

  const Source& source_;
  ZipArchive archive_;
  std::map<std::string, std::unique_ptr<ModelPart>> parts_;
  std::uint64_t remaining_bytes_;         ///< that further parts may have
  std::uint64_t remaining_elements_ = 0;  ///< vertices, triangles and objects that may still be added
  std::size_t omitted_objects_ = 0;       ///< objects that are not part of the solid
  solid::TriangleMesh mesh_;
};

ThreemfReader::ThreemfReader(const Source& source)
    : source_(source),
      archive_(source.bytes, source.name, "a zip archive with a 3MF model"),
      remaining_bytes_(
          std::min<std::uint64_t>(k_largest_part, k_always_unpacked + k_most_inflation * source.bytes.size())) {}

std::string ThreemfReader::unpacked(const std::string& path) {
  std::optional<std::size_t> entry = archive_.find(path);
  if (!entry) {
    if (const auto decoded = percent_decoded(path)) entry = archive_.find(*decoded);  // "/3D/my%20part.model"
  }
  if (!entry) fail_in_entry(source_.name, path, -1, "expected this part in the archive");
  return archive_.unpacked(
      *entry, remaining_bytes_,
      fmt::format("parts may have {} MiB and {} times the file's bytes", k_largest_part >> 20, k_most_inflation));
}

void ThreemfReader::parse(const std::string& path, std::string& text, pugi::xml_document& xml) const {
  const pugi::xml_parse_result result = xml.load_buffer_inplace(text.data(), text.size());
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result) fail_in_entry(source_.name, path, result.offset, std::string("expected XML: ") + result.description());
}

/// The part that the package's relationships name as its 3-D model.
std::string ThreemfReader::model_path() {
  const std::string path = "_rels/.rels";
  std::string text = unpacked(path);
  pugi::xml_document xml;
  parse(path, text, xml);
  std::string target;
  for_children(child(xml, "Relationships"), "Relationship", [&](const pugi::xml_node& relationship) {
    if (std::string_view(relationship.attribute("Type").value()).ends_with("/3dmodel")) {
      target = relationship.attribute("Target").value();
    }
  });
  if (target.empty()) fail_in_entry(source_.name, path, -1, "expected a relationship of type …/3dmodel");
  return target;
}

ModelPart& ThreemfReader::part(const std::string& path) {
  const std::string name = path.starts_with('/') ? path.substr(1) : path;
  std::unique_ptr<ModelPart>& slot = parts_[name];
  if (slot != nullptr) return *slot;
  slot = std::make_unique<ModelPart>();
  slot->path = name;
  slot->text = unpacked(name);
  remaining_elements_ += slot->text.size();
  parse(name, slot->text, slot->xml);
  const pugi::xml_node model = child(slot->xml, "model");
  if (!model) fail_in_entry(source_.name, name, 0, "expected the element 'model'");
  refuse_unknown_extensions(*slot, model);
  slot->unit = unit_of(*slot, model);
  for_children(child(model, "resources"), "object",
               [&](const pugi::xml_node& object) { slot->objects[integer(*slot, object, "id")] = object; });
  return *slot;
}

/// Without a required extension the mesh would be another body, or none.
void ThreemfReader::refuse_unknown_extensions(const ModelPart& part, const pugi::xml_node& model) const {
  const Source required{model.attribute("requiredextensions").value(), source_.name};
  TextScanner words(required);
  for (std::string prefix(words.flowing_word()); !prefix.empty(); prefix = words.flowing_word()) {
    const pugi::xml_attribute declared = model.attribute(("xmlns:" + prefix).c_str());
    const std::string_view extension = declared.value();
    if (std::find(k_known_extensions.begin(), k_known_extensions.end(), extension) != k_known_extensions.end())
      continue;
    fail(part, model,
         fmt::format(
             "requires the extension {}, which fusee does not read: export the object as a plain mesh",
             declared ? "'" + std::string(extension) + "'" : "of the undeclared prefix '" + printable(prefix) + "'"));
  }
}

/// Supports and other auxiliary objects are not part of the solid.
bool ThreemfReader::is_part_of_solid(const ModelPart& part, const pugi::xml_node& object) const {
  const std::string_view type = collapsed(object.attribute("type").value());
  if (type.empty() || type == "model" || type == "surface") return true;
  if (type == "support" || type == "solidsupport" || type == "other") return false;
  fail(part, object,
       fmt::format("expected an object of the type model, surface, support, solidsupport or other, found '{}'",
                   printable(type)));
}

/// Without triangles, an extension that the file does not require may hold the object's whole geometry.
void ThreemfReader::refuse_other_geometry(const ModelPart& part, const pugi::xml_node& object) const {
  const pugi::xml_node mesh = child(object, "mesh");
  if (child(object, "components") || child(child(mesh, "triangles"), "triangle")) return;
  constexpr auto k_no_geometry =
      std::to_array<std::string_view>({"mesh", "metadatagroup", "vertices", "triangles", "trianglesets"});
  for (const pugi::xml_node& holder : {object, mesh}) {
    for (const pugi::xml_node& other : holder.children()) {
      const std::string_view name = local_name(other.name());
      if (name.empty() || std::find(k_no_geometry.begin(), k_no_geometry.end(), name) != k_no_geometry.end()) continue;
      fail(part, object,
           fmt::format("an object has no triangles, but a '{}', which fusee does not read: export it as a plain mesh",
                       printable(name)));
    }
  }
}

double ThreemfReader::unit_of(const ModelPart& part, const pugi::xml_node& model) const {
  const std::string_view unit = collapsed(model.attribute("unit").value());
  if (unit.empty() || unit == "millimeter") return 1;
  if (unit == "micron") return 0.001;
  if (unit == "centimeter") return 10;
  if (unit == "inch") return 25.4;
  if (unit == "foot") return 304.8;
  if (unit == "meter") return 1000;
  fail(part, model,
       fmt::format("expected the unit micron, millimeter, centimeter, inch, foot or meter, found '{}'",
                   printable(unit)));
}

double ThreemfReader::number(const ModelPart& part, const pugi::xml_node& node, const char* attribute) const {
  const std::string_view text = collapsed(node.attribute(attribute).value());
  double value = 0;
  if (!parse_number(text, value))
    fail(part, node, fmt::format("expected a number {}, found '{}'", attribute, printable(text)));
  return value;
}

std::int64_t ThreemfReader::integer(const ModelPart& part, const pugi::xml_node& node, const char* attribute) const {
  const std::string_view text = collapsed(node.attribute(attribute).value());
  std::int64_t value = 0;
  if (!parse_integer(text, value)) {
    fail(part, node, fmt::format("expected a whole number {}, found '{}'", attribute, printable(text)));
  }
  return value;
}

/// "m00 m01 m02 m10 … m32": the rows are the images of x, y, z and of the origin.
Placement ThreemfReader::placement(const ModelPart& part, const pugi::xml_node& node) const {
  Placement place;
  const pugi::xml_attribute attribute = node.attribute("transform");
  if (!attribute) return place;
  const Source text{attribute.value(), source_.name};
  TextScanner words(text);
  for (int row = 0; row < 4; ++row) {
    Vec3 image;
    for (double& coordinate : image) {
      if (!parse_number(words.flowing_word(), coordinate)) fail(part, node, "expected 12 numbers of a transform");
    }
    if (row < 3) {
      place.linear.col(row) = image;
    } else {
      place.shift = image;
    }
  }
  return place;
}

/// Objects may be placed many times, in components of components. Each byte of the unpacked parts allows one element.
void ThreemfReader::count_element(ModelPart& part, const pugi::xml_node& node) {
  if (remaining_elements_ == 0)
    fail(part, node, "places its objects too often: the mesh would be far larger than the file");
  --remaining_elements_;
}

void ThreemfReader::add_reference(ModelPart& part, const pugi::xml_node& reference, const Placement& outer, int depth) {
  std::string_view path;
  for (const pugi::xml_attribute& attribute : reference.attributes()) {
    if (local_name(attribute.name()) == "path") path = attribute.value();
  }
  ModelPart& owner = path.empty() ? part : this->part(std::string(path));
  const auto object = owner.objects.find(integer(part, reference, "objectid"));
  if (object == owner.objects.end()) {
    fail(part, reference, fmt::format("expected an object of the id {}", reference.attribute("objectid").value()));
  }
  add_object(owner, object->second, outer.after(placement(part, reference)), depth);
}

void ThreemfReader::add_object(ModelPart& part, const pugi::xml_node& object, const Placement& place, int depth) {
  if (depth > k_deepest) fail(part, object, fmt::format("components within components, deeper than {}", k_deepest));
  count_element(part, object);
  if (!is_part_of_solid(part, object)) {
    ++omitted_objects_;
    return;
  }
  refuse_other_geometry(part, object);
  if (const pugi::xml_node mesh = child(object, "mesh")) {
    const std::size_t first = mesh_.vertices.size();
    add_vertices(part, mesh, place);
    add_triangles(part, mesh, place, first);
  }
  for_children(child(object, "components"), "component",
               [&](const pugi::xml_node& component) { add_reference(part, component, place, depth + 1); });
}

void ThreemfReader::add_vertices(ModelPart& part, const pugi::xml_node& mesh, const Placement& place) {
  for_children(child(mesh, "vertices"), "vertex", [&](const pugi::xml_node& vertex) {
    count_element(part, vertex);
    const Vec3 position(number(part, vertex, "x"), number(part, vertex, "y"), number(part, vertex, "z"));
    mesh_.vertices.push_back(part.unit * (place.linear * position + place.shift));
  });
}

void ThreemfReader::add_triangles(ModelPart& part, const pugi::xml_node& mesh, const Placement& place,
                                  std::size_t first) {
  const auto count = static_cast<std::int64_t>(mesh_.vertices.size() - first);
  for_children(child(mesh, "triangles"), "triangle", [&](const pugi::xml_node& triangle) {
    count_element(part, triangle);
    std::array<std::uint32_t, 3> corners{};
    constexpr std::array<const char*, 3> k_names = {"v1", "v2", "v3"};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t index = integer(part, triangle, k_names[k]);
      if (index < 0 || index >= count)
        fail(part, triangle, fmt::format("expected {} from 0 to {}, found {}", k_names[k], count - 1, index));
      corners[k] = static_cast<std::uint32_t>(first + static_cast<std::size_t>(index));
    }
    // A mirror image would face inward.
    if (place.mirrors()) std::swap(corners[1], corners[2]);
    mesh_.triangles.push_back(corners);
  });
}

solid::TriangleMesh ThreemfReader::read() {
  remaining_elements_ = k_always_added;
  ModelPart& root = part(model_path());
  const pugi::xml_node model = child(root.xml, "model");
  bool is_empty = true;
  int unprintable = 0;
  for_children(child(model, "build"), "item", [&](const pugi::xml_node& item) {
    is_empty = false;
    if (collapsed(item.attribute("printable").value()) == "0") {
      ++unprintable;
      return;
    }
    add_reference(root, item, {}, 0);
  });
  if (is_empty) fail(root, model, "the build is empty: place the object on the plate and export it again");
  if (mesh_.triangles.empty() && unprintable > 0)
    fail(root, model, "no part of the build is marked as printable: mark it so and export it again");
  if (mesh_.triangles.empty() && omitted_objects_ > 0)
    fail(root, model, "the build holds supports and auxiliary objects alone, no part: export the part with them");
  return std::move(mesh_);
}

/// A program that opens the file and saves it again may keep the texts, or not.
KeptMechanism ThreemfReader::kept_mechanism() {
  ModelPart& root = part(model_path());
  const pugi::xml_node model = child(root.xml, "model");
  std::array<std::optional<std::string>, k_kept_texts.size()> texts;
  for_children(model, "metadata", [&](const pugi::xml_node& metadata) {
    const std::string name = metadata.attribute("name").value();
    const std::size_t colon = name.find(':');
    if (colon == std::string::npos) return;
    const std::string_view space = model.attribute(("xmlns:" + name.substr(0, colon)).c_str()).value();
    const auto known = std::find(k_kept_texts.begin(), k_kept_texts.end(), std::string_view(name).substr(colon + 1));
    if (space != k_namespace || known == k_kept_texts.end()) return;
    texts.at(static_cast<std::size_t>(known - k_kept_texts.begin())) = metadata.text().get();
  });
  if (!texts[0]) {
    throw InputError(source_.name, "it keeps no mechanism file",
                     "choose a 3MF that fusee wrote since 0.2 and no other program has saved again");
  }
  std::optional<std::string> table;
  if (texts[1]) {
    table = percent_decoded(*texts[1]);
    if (!table) fail(root, model, "the kept table has a % that two hexadecimal digits do not follow");
  }
  return {*std::move(texts[0]), std::move(table)};
}

}  // namespace

KeptMechanism read_kept_mechanism(std::string_view bytes, const std::string& file_name) {
  return ThreemfReader({bytes, file_name}).kept_mechanism();
}

std::string threemf_bytes(const solid::TriangleMesh& mesh, const std::string& name,
                          const std::vector<OutputFile>& mechanism) {
  const std::string model = model_xml(mesh, name, mechanism);
  return zip_bytes(
      {{"[Content_Types].xml", k_content_types}, {"_rels/.rels", k_relationships}, {"3D/3dmodel.model", model}});
}

solid::TriangleMesh read_threemf(const Source& source) { return ThreemfReader(source).read(); }

}  // namespace fusee::formats
