/// \file
/// A DXF file as it is laid out: what its header says, its blocks, its entities, none of them understood yet.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/drawings/dxf_tags.h"

namespace fusee {

/// One entity as it stands in the file; the vertices of an old POLYLINE are with it.
struct DxfEntity {
  std::string_view type;
  int line = 0;
  std::vector<DxfTag> tags;
  std::vector<std::vector<DxfTag>> vertices;
  std::size_t size = 0;  ///< tags in all
};

struct DxfBlock {
  Vec2 base = Vec2::Zero();  ///< lies on the insert's point
  std::vector<DxfEntity> entities;
};

/// Points into the bytes that it was read from.
struct DxfFile {
  std::string version;       ///< $ACADVER; "AC1009" where the file does not say
  std::optional<int> units;  ///< $INSUNITS; −1 for what is none
  std::vector<DxfEntity> entities;
  std::map<std::string, DxfBlock> blocks;

  /// 1 where the file does not say.
  double unit_in_mm() const;
};

/// Throws InputError where the layout is broken, or where there is no ENTITIES section.
DxfFile read_dxf_file(std::string_view bytes, const std::string& file);

}  // namespace fusee
