/// \file
/// Meshes out and in: one function a format, bytes in memory; nothing else knows a format. The same mesh gives the same
/// bytes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/solid/mesh.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

std::string stl_bytes(const TriangleMesh& mesh, const std::string& name);  ///< binary, true normals, "mm" in the header
/// "pulley_p1.stl": of P1 or P2 where they are printed apart.
std::string part_file_name(Side side);
std::string obj_text(const TriangleMesh& mesh, const std::string& name);
std::string threemf_bytes(const TriangleMesh& mesh, const std::string& name);  ///< unit, named object, metadata
/// A Draco file, and what reading it back gave.
struct DracoFile {
  std::string bytes;
  TriangleMesh decoded;
  std::vector<Check> checks;  ///< check_mesh() of that
};
/// Quantised so that no vertex moves by more than `tolerance` (mm), and so finely that it is a solid still.
DracoFile draco_file(const TriangleMesh& mesh, double tolerance);
std::string draco_bytes(const TriangleMesh& mesh, double tolerance);

/// Reads stl (both kinds), obj, 3mf, off, ply (both kinds), drc, told apart by content and, where that does not tell,
/// by the name's ending. The mesh comes as it is (STL vertices welded), however broken. InputError with line or byte
/// offset.
TriangleMesh read_mesh(std::string_view bytes, const std::string& file_name);

}  // namespace fusee
