/// \file
/// Internal: polygons of OBJ, OFF and PLY as triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "export/mesh_files/mesh_formats.h"

namespace fusee::formats {

/// Adds polygons to a mesh. Faces may precede their vertices in a file, so polygons are added as fans about their first
/// corner, and split_concave() divides those that a fan does not cover.
class PolygonSplitter {
 public:
  PolygonSplitter(const Source& source, solid::TriangleMesh& mesh) : source_(source), mesh_(mesh) {}

  /// Polygons of one or two corners have no facets. Nothing is added, and the expected content is returned,
  /// - if the polygon has more than two corners for each vertex that it can name (an outline bridged to a hole passes a
  ///   vertex twice, none more often);
  /// - if the mesh would have more facets than the file has bytes for. A closed mesh of V vertices has 2 V facets and at
  ///   least 3 V corners, which take over 12 bytes a vertex in any of these formats once V needs two bytes.
  [[nodiscard]] std::optional<std::string> add(std::span<const std::uint32_t> corners);

  /// Divides concave polygons, and those with corners on a line, by clipping ears. All corners must be vertices.
  void split_concave();

 private:
  /// The facets of a polygon of four or more corners: index of the first in the mesh, and their number.
  struct Fan {
    std::size_t first = 0, facets = 0;
  };

  const Source& source_;
  solid::TriangleMesh& mesh_;
  std::vector<Fan> fans_;
};

}  // namespace fusee::formats
