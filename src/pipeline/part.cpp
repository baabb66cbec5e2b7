#include <algorithm>
#include <cctype>
#include <cmath>

#include "fusee/base/text.h"
#include "fusee/export/drawings.h"
#include "fusee/export/mesh_files.h"
#include "fusee/joint/as_it_is.h"
#include "fusee/pipeline.h"

namespace fusee {
namespace {

/// A binary STL of ten million triangles; nobody prints more.
constexpr std::size_t k_largest_file = std::size_t{512} << 20;

bool has_ending(std::string name, std::string_view ending) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

/// An ASCII DXF starts with group code 0 (SECTION) or 999 (a comment) on a line of its own; no mesh format does.
bool is_drawing(std::string_view bytes, const std::string& name) {
  if (has_ending(name, ".dxf")) return true;
  const std::string_view first = bytes.substr(0, std::min(bytes.find('\n'), std::size_t{8}));
  std::string code;
  for (const char c : first) {
    if (c != ' ' && c != '\r') code += c;
  }
  return code == "0" || code == "999";
}

/// The closed path of a layer that surrounds most; null when there is none.
const DrawingPath* largest_path(const Drawing& drawing, const std::string& layer) {
  const DrawingPath* largest = nullptr;
  double largest_area = 0;
  for (const DrawingPath& path : drawing.paths) {
    if (path.layer != layer || !path.closed) continue;
    const double area = std::abs(signed_area(path.points));
    if (area > largest_area) {
      largest = &path;
      largest_area = area;
    }
  }
  return largest;
}

Polygon counter_clockwise(Polygon polygon) {
  if (signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

/// On floors as they were drawn, of a joint that has its declared pins and tendon.
RewindResult rewind_drawn(const JointAsItIs& joint, Polygon floor1, Polygon floor2) {
  return rewind(with_inset(joint), as_made(std::move(floor1), joint.outline), as_made(std::move(floor2), joint.outline));
}

RewindResult rewind_drawing(const JointAsItIs& joint, const Drawing& drawing) {
  const DrawingPath* floor1 = largest_path(drawing, "P1_FLOOR");
  const DrawingPath* floor2 = largest_path(drawing, "P2_FLOOR");
  if (floor1 && floor2) return rewind_drawn(joint, counter_clockwise(floor1->points), counter_clockwise(floor2->points));
  const DrawingPath* pitch1 = largest_path(drawing, "P1_PITCH");
  const DrawingPath* pitch2 = largest_path(drawing, "P2_PITCH");
  if (!pitch1 || !pitch2) {
    throw InputError(
        "", "the drawing has no closed contours on the layers P1_FLOOR and P2_FLOOR (nor on P1_PITCH and P2_PITCH)",
        "name the layers of the two groove floors so; 'fusee build' writes such a profile.dxf");
  }
  // A centre line that lies on the pitch curve: a tendon without thickness, over pins thicker by its radius.
  JointAsItIs centre_line = joint;
  centre_line.mechanism.guides.radius = joint.mechanism.guide_pitch_radius();
  centre_line.mechanism.tendon.diameter = 0;
  return rewind_drawn(centre_line, counter_clockwise(pitch1->points), counter_clockwise(pitch2->points));
}

/// The loops of a mesh that is inside out, as if it were not.
std::vector<Polygon> outward(std::vector<Polygon> loops) {
  const auto by_size = [](const Polygon& a, const Polygon& b) {
    return std::abs(signed_area(a)) < std::abs(signed_area(b));
  };
  if (signed_area(*std::max_element(loops.begin(), loops.end(), by_size)) >= 0) return loops;
  for (Polygon& loop : loops) std::reverse(loop.begin(), loop.end());
  return loops;
}

/// The mesh is larger than the part by the material's shrinkage.
Polygon floor_in_section(const TriangleMesh& mesh, double z, double scale) {
  const std::vector<Polygon> loops = section(mesh, z * scale);
  if (loops.empty()) {
    throw InputError("",
                     "the mesh has no section at z = " + rounded(z * scale) + " mm, where the mechanism has a groove",
                     "z must run along the pulley's axis from the bed at 0, in mm");
  }
  Polygon floor = outer_loop(outward(loops));
  for (Vec2& point : floor) point /= scale;
  return floor;
}

RewindResult rewind_mesh(const JointAsItIs& joint, const TriangleMesh& mesh) {
  const SynthesisResult synthesis = synthesise(joint.mechanism, {.advice = false});
  if (!synthesis.made()) throw InputError("", "no pulley of this mechanism can be made: " + synthesis.brief());
  const BodyLayout layout = resolve_layout(joint.mechanism, synthesis);
  return rewind_drawn(joint, floor_in_section(mesh, layout.z_p1, layout.scale), floor_in_section(mesh, layout.z_p2, layout.scale));
}

}  // namespace

Part read_part(const std::filesystem::path& path) {
  const std::string bytes = read_file(path, k_largest_file);
  if (is_drawing(bytes, path.string())) return read_dxf(bytes, path.string());
  return read_mesh(bytes, path.string());
}

std::vector<Check> check_part(const Part& part) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&part)) return check_mesh(*mesh);
  return check_drawing(std::get<Drawing>(part));
}

RewindResult rewind_part(const JointAsItIs& joint, const Part& part) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&part)) return rewind_mesh(joint, *mesh);
  return rewind_drawing(joint, std::get<Drawing>(part));
}

std::vector<Check> as_built_checks(const Mechanism& mechanism, const RewindResult& as_built,
                                   const AsBuiltLimits& limits) {
  const double error = degrees(as_built.max_theta_error);
  const std::string error_at = "at alpha = " + rounded(degrees(as_built.max_theta_error_at)) + " deg";
  const std::string slack_at = "at alpha = " + rounded(degrees(as_built.max_slack_at)) + " deg";
  if (mechanism.pulley.method == Method::paper) {
    return {at_most("theta_error_reported", error, 180.0, "deg", error_at),
            at_most("slack_reported", as_built.max_slack, mechanism.joint.R, "mm", slack_at)};
  }
  return {at_most("theta_error", error, limits.theta_error, "deg", error_at),
          at_most("slack", as_built.max_slack, limits.slack, "mm", slack_at)};
}

}  // namespace fusee
