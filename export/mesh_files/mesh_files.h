/// \file
/// Writes and reads meshes: one function for each format, on bytes in memory. The same mesh gives the same bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"
#include "fusee/solid.h"
#include "fusee/transmission.h"

namespace fusee::formats {

std::string stl_bytes(const solid::TriangleMesh& mesh,
                      const std::string& name);  ///< binary, true normals, "mm" in the header
/// "pulley_p1.stl": name for P1 or P2 where they are printed separately.
std::string part_file_name(transmission::Side side);
std::string obj_text(const solid::TriangleMesh& mesh, const std::string& name);
/// Unit, named object, metadata. `mechanism`: the texts that are kept as metadata. These are the mechanism file and, if
/// its target motion is a table, that table.
std::string threemf_bytes(const solid::TriangleMesh& mesh, const std::string& name,
                          const std::vector<OutputFile>& mechanism = {});
/// The texts that threemf_bytes() kept. The table's name is that in the mechanism file.
struct KeptMechanism {
  std::string text;
  std::optional<std::string> table;
};
/// Reads the kept texts from an untrusted 3MF. Throws InputError if the 3MF keeps no mechanism file.
KeptMechanism read_kept_mechanism(std::string_view bytes, const std::string& file_name);
/// A Draco file, and the mesh that it decodes to.
struct DracoFile {
  std::string bytes;
  solid::TriangleMesh decoded;
  std::vector<Check> checks;  ///< check_mesh() of the decoded mesh
};
/// Quantised so that no vertex moves by more than `tolerance` (mm) and the mesh stays a solid.
DracoFile draco_file(const solid::TriangleMesh& mesh, double tolerance);
std::string draco_bytes(const solid::TriangleMesh& mesh, double tolerance);

/// Reads stl (binary and ASCII), obj, 3mf, off, ply (binary and ASCII) and drc, identified by content or, if that is
/// ambiguous, by the name's ending. Returns the mesh as stored, with all defects. Only vertices of STL and Draco are
/// welded, and unused vertices are removed. Throws InputError with line or byte offset.
solid::TriangleMesh read_mesh(std::string_view bytes, const std::string& file_name);

}  // namespace fusee::formats
