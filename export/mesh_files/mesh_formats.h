/// \file
/// The readers behind read_mesh(), one a format, and what they share. Nothing outside this folder includes it.
///
/// Every reader returns the mesh as it stands in the file, however broken, or throws InputError saying where (line and
/// column of a text, byte of a binary file) and what was expected there. None allocates more than the bytes can
/// justify.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "fusee/base/diagnostics.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// The bytes of a file and the name that stands in the messages.
struct Source {
  std::string_view bytes;
  std::string name;
};

TriangleMesh read_stl(const Source& source);  ///< binary and ASCII; vertices welded
TriangleMesh read_obj(const Source& source);
TriangleMesh read_off(const Source& source);      ///< OFF, COFF, NOFF, CNOFF, STOFF … in text
TriangleMesh read_ply(const Source& source);      ///< ascii, binary_little_endian, binary_big_endian
TriangleMesh read_threemf(const Source& source);  ///< in mm, every build item at its place
TriangleMesh read_drc(const Source& source);      ///< vertices welded

/// A binary STL says how many facets follow and is exactly that long.
bool is_binary_stl(std::string_view bytes);

// What the readers share ---------------------------------------------------------------------------------------------
[[noreturn]] void fail_at_byte(const Source& source, std::size_t offset, const std::string& message);
/// Fails unless `count` things of at least `least_bytes` each fit into what is left after `offset`.
void demand_room(const Source& source, std::size_t offset, std::uint64_t count, std::size_t least_bytes,
                 const std::string& things);

/// Adds a polygon as a fan of triangles about its first corner. One of two corners is a line, one of one a point: no
/// facet. Nothing is added, and what was expected in its place is returned,
/// - where it has more than two corners for each of the vertices that it can name: an outline bridged to a hole passes
///   a vertex twice, none more often;
/// - where the mesh would have more facets than the file has bytes for. A closed mesh of V vertices has 2 V facets and
///   3 V corners or more, which take over 12 bytes a vertex in any of these formats once V needs two bytes.
[[nodiscard]] std::optional<std::string> add_fan(const Source& source, TriangleMesh& mesh,
                                                 std::span<const std::uint32_t> corners);

}  // namespace fusee
