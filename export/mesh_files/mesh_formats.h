/// \file
/// Internal: the readers behind read_mesh(), one for each format, and their common helpers. Only this folder includes
/// it.
///
/// Every reader returns the mesh as stored, with all defects, or throws InputError with the place (line and column of a
/// text, byte of a binary file) and the expected content. Memory is bounded by the number of bytes read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::formats {

/// The bytes of a file, and its name for messages.
struct Source {
  std::string_view bytes;
  std::string name;
};

solid::TriangleMesh read_stl(const Source& source);  ///< binary and ASCII; vertices welded
solid::TriangleMesh read_obj(const Source& source);
solid::TriangleMesh read_off(const Source& source);      ///< OFF, COFF, NOFF, CNOFF, STOFF … in text
solid::TriangleMesh read_ply(const Source& source);      ///< ascii, binary_little_endian, binary_big_endian
solid::TriangleMesh read_threemf(const Source& source);  ///< in mm, every printable build item at its place
solid::TriangleMesh read_drc(const Source& source);      ///< vertices welded

/// True if the file has exactly the size of a binary STL with the number of facets that its header gives.
bool is_binary_stl(std::string_view bytes);

// Common helpers ----------------------------------------------------------------------------------------------------
[[noreturn]] void fail_at_byte(const Source& source, std::size_t offset, const std::string& message);
/// Fails unless `count` items of at least `least_bytes` each fit into the bytes after `offset`.
void demand_room(const Source& source, std::size_t offset, std::uint64_t count, std::size_t least_bytes,
                 const std::string& things);

}  // namespace fusee::formats
