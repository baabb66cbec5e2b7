#include "export/drawings/dxf_file.h"

#include "base/text.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

/// True for group 0 with this value. Such a tag begins a section, a table, a block or an entity, or ends one.
bool is_keyword(const DxfTag& tag, std::string_view keyword) { return tag.code == 0 && tag.value == keyword; }

class DxfFileReader {
 public:
  DxfFileReader(std::string_view bytes, const std::string& name) : name_(name), tags_(bytes, name) {}

  DxfFile read() {
    read_sections();
    if (!has_entities_) fail_in_dxf(name_, 0, "the file has no ENTITIES section", "is it a DXF drawing?");
    if (file_.version.empty()) file_.version = "AC1009";
    return std::move(file_);
  }

 private:
  void read_sections() {
    for (;;) {
      // A file that ends after its entities lacks only EOF.
      const std::optional<DxfTag> next = has_entities_ ? tags_.next() : tags_.required();
      if (!next || is_keyword(*next, "EOF")) return;
      const DxfTag tag = *next;
      // dxflib 2.0 writes header variables after the header's end: values between sections are skipped.
      if (has_section_ && tag.code != 0) continue;
      has_section_ = true;
      if (!is_keyword(tag, "SECTION")) {
        fail_in_dxf(name_, tag.line, "a SECTION or EOF should stand here, not " + quoted_bytes(tag.value),
                    "is it a DXF drawing?");
      }
      const DxfTag name = tags_.required();
      if (name.code != 2) fail_in_dxf(name_, name.line, "the section's name (group 2) should stand here");
      read_section(name.value);
    }
  }

  void read_section(std::string_view name) {
    if (name == "HEADER") {
      read_header();
    } else if (name == "TABLES") {
      read_tables();
    } else if (name == "BLOCKS") {
      read_blocks();
    } else if (name == "ENTITIES") {
      has_entities_ = true;
      read_entities(tags_.required(), file_.entities, "ENDSEC");
    } else {
      while (!is_keyword(tags_.required(), "ENDSEC")) {
      }
    }
  }

  void read_header() {
    std::string_view variable;
    for (DxfTag tag = tags_.required(); !is_keyword(tag, "ENDSEC"); tag = tags_.required()) {
      if (tag.code == 9) variable = tag.value;
      if (variable == "$ACADVER" && tag.code == 1) file_.version = std::string(tag.value.substr(0, 16));
      if (variable == "$INSUNITS" && tag.code == 70) {
        const double value = dxf_number(name_, tag);
        file_.units = value >= 0 && value < 100 ? static_cast<int>(value) : -1;
      }
    }
  }

  /// Finds layers that are off (negative colour) or frozen (bit 1 of group 70).
  void read_tables() {
    for (DxfTag tag = tags_.required(); !is_keyword(tag, "ENDSEC");) {
      const bool is_layer = is_keyword(tag, "LAYER");
      std::vector<DxfTag> record;
      tag = read_tags(record);
      if (!is_layer) continue;
      try {
        const DxfValues values(name_, record);
        const bool is_frozen = (values.integer(70, 0) & 1) != 0;
        if (is_frozen || values.integer(62, 7) < 0) file_.hidden_layers[lower(values.text(2))] = is_frozen;
      } catch (const InputError&) {
        continue;  // a layer with invalid numbers is shown
      }
    }
  }

  /// Reads tags up to the next group 0, which is returned.
  DxfTag read_tags(std::vector<DxfTag>& tags) {
    for (;;) {
      const DxfTag tag = tags_.required();
      if (tag.code == 0) return tag;
      tags.push_back(tag);
    }
  }

  /// Reads entities, the first of which begins with `tag`, up to group 0 `end`.
  void read_entities(DxfTag tag, std::vector<DxfEntity>& entities, std::string_view end) {
    while (!is_keyword(tag, end)) {
      if (tag.code != 0) {
        fail_in_dxf(name_, tag.line, "an entity (group 0) should stand here, not group " + std::to_string(tag.code));
      }
      if (tag.value == "EOF")
        fail_in_dxf(name_, tag.line, "EOF stands where " + std::string(end) + " should", "the file is damaged");
      DxfEntity entity{tag.value, tag.line, {}, {}, 1};
      tag = read_tags(entity.tags);
      entity.size += entity.tags.size();
      if (entity.type == "POLYLINE") {
        while (is_keyword(tag, "VERTEX")) {
          entity.vertices.emplace_back();
          tag = read_tags(entity.vertices.back());
          entity.size += 1 + entity.vertices.back().size();
        }
      }
      if (entity.type != "SEQEND" && entity.type != "ATTRIB") entities.push_back(std::move(entity));
    }
  }

  void read_blocks() {
    for (DxfTag tag = tags_.required(); !is_keyword(tag, "ENDSEC");) {
      if (!is_keyword(tag, "BLOCK"))
        fail_in_dxf(name_, tag.line, "a BLOCK should stand here, not " + quoted_bytes(tag.value));
      std::vector<DxfTag> head;
      tag = read_tags(head);
      const DxfValues values(name_, head);
      DxfBlock block{values.point(10), {}};
      read_entities(tag, block.entities, "ENDBLK");
      file_.blocks.insert_or_assign(lower(values.text(2)), std::move(block));
      std::vector<DxfTag> end;
      tag = read_tags(end);
    }
  }

  const std::string& name_;
  DxfTagReader tags_;
  bool has_section_ = false;
  bool has_entities_ = false;
  DxfFile file_;
};

}  // namespace

double DxfFile::unit_in_mm() const {
  switch (units.value_or(0)) {
    case 1:  // inch
      return 25.4;
    case 2:  // foot
      return 304.8;
    case 5:  // centimetre
      return 10;
    case 6:  // metre
      return 1000;
    case 8:  // microinch
      return 25.4e-6;
    case 9:  // mil
      return 0.0254;
    case 10:  // yard
      return 914.4;
    case 13:  // micrometre
      return 1e-3;
    case 14:  // decimetre
      return 100;
    case 21:  // foot of the US survey: 1200/3937 m
      return 1.2e6 / 3937;
    case 22:  // inch of the US survey
      return 1e5 / 3937;
    default:  // 4: millimetre; no unit, or one in which no part is drawn
      return 1;
  }
}

DxfFile read_dxf_file(std::string_view bytes, const std::string& file) { return DxfFileReader(bytes, file).read(); }

}  // namespace fusee::formats
