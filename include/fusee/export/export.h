/// \file
/// What comes out: one function a file, bytes in memory; nothing else knows a format. The same input gives the same bytes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/check.h"
#include "fusee/base/files.h"
#include "fusee/joint/as_it_is.h"
#include "fusee/mechanism/file.h"
#include "fusee/profile/rewind.h"
#include "fusee/profile/synthesis.h"
#include "fusee/solid/pulley.h"

namespace fusee {

/// All that is known of a finished pulley.
struct Product {
  MechanismFile file;       ///< as it was read
  JointAsItIs joint;        ///< what was made, and what for
  SynthesisResult synthesis;
  Pulley pulley;
  RewindResult as_built;
  std::vector<Check> checks;
};

enum class DxfVersion { ac1015, r12 };

// Meshes -------------------------------------------------------------------------------------------------------------
std::string stl_bytes(const TriangleMesh& mesh, const std::string& name);    ///< binary, true normals, "mm" in the header
std::string obj_text(const TriangleMesh& mesh, const std::string& name);
std::string threemf_bytes(const TriangleMesh& mesh, const std::string& name);///< unit, named object, metadata
/// Quantised so that no vertex moves by more than `tolerance` (mm).
std::string draco_bytes(const TriangleMesh& mesh, double tolerance);

/// Reads stl (both kinds), obj, 3mf, off, ply (both kinds), drc, told apart by content and, where that does not tell, by the name's ending.
/// The mesh comes as it is (STL vertices welded), however broken. InputError with line or byte offset.
TriangleMesh read_mesh(std::string_view bytes, const std::string& file_name);

// Drawings -----------------------------------------------------------------------------------------------------------
/// One closed or open path of a drawing; arcs and circles come as points within 0.001 mm.
struct DrawingPath {
  std::string layer;
  std::string entity;  ///< "LWPOLYLINE", "CIRCLE" …
  int line = 0;        ///< in the file
  bool closed = false;
  Polygon points;
};
struct Drawing {
  std::string version;     ///< "AC1015", "AC1009" …
  bool millimetres = false;///< $INSUNITS = 4, or absent in R12
  std::vector<DrawingPath> paths;
  std::vector<std::string> ignored;  ///< kinds of entity that were passed over
};
std::string profile_dxf(const Product& product, DxfVersion version);
std::string plates_dxf(const Product& product, DxfVersion version);
Drawing read_dxf(std::string_view bytes, const std::string& file_name);
/// Closed contours, ends that meet, no self-crossing, no duplicate lines, smallest feature: one Check each.
std::vector<Check> check_drawing(const Drawing& drawing);

// Texts --------------------------------------------------------------------------------------------------------------
std::string scad_text(const Product& product);
std::string profile_csv(const Product& product);
std::string transmission_csv(const Product& product);
std::string report_html(const Product& product);
/// `outputs` are the files beside it.
std::string manifest_json(const Product& product, const std::vector<OutputFile>& outputs);

}  // namespace fusee
