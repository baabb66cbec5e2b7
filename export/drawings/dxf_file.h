/// \file
/// Internal: the structure of a DXF file: header, layers, blocks and entities, not yet interpreted.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/drawings/dxf_tags.h"

namespace fusee::formats {

/// One entity of the file, with the vertices of an old POLYLINE.
struct DxfEntity {
  std::string_view type;
  int line = 0;
  std::vector<DxfTag> tags;
  std::vector<std::vector<DxfTag>> vertices;
  std::size_t size = 0;  ///< number of tags, including those of the vertices
};

struct DxfBlock {
  Vec2 base = Vec2::Zero();  ///< placed at the insert's point
  std::vector<DxfEntity> entities;
};

/// Refers to the bytes that it was read from.
struct DxfFile {
  std::string version;       ///< $ACADVER; "AC1009" if missing
  std::optional<int> units;  ///< $INSUNITS; −1 if invalid
  std::vector<DxfEntity> entities;
  std::map<std::string, DxfBlock> blocks;  ///< by lower(name): names do not depend on case
  /// Layers that are not shown, by lower(name); true: frozen, false: off.
  std::map<std::string, bool> hidden_layers;

  /// 1 if the file gives no unit, or one in which no part is drawn (such as kilometres).
  double unit_in_mm() const;
};

/// Throws InputError if the structure is damaged or the ENTITIES section is missing.
DxfFile read_dxf_file(std::string_view bytes, const std::string& file);

}  // namespace fusee::formats
