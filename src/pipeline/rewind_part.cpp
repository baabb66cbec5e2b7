#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/golden_section.h"
#include "base/text.h"
#include "fusee/export.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "fusee/profile.h"
#include "fusee/solid.h"
#include "pipeline/multi_turn.h"

namespace fusee::pipeline {
namespace {

/// The closed path of a layer with the largest area; null if there is none.
const formats::DrawingPath* largest_path(const formats::Drawing& drawing, const std::string& layer) {
  const formats::DrawingPath* largest = nullptr;
  double largest_area = 0;
  for (const formats::DrawingPath& path : drawing.paths) {
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

/// Winds tendons on drawn floors, with the declared pins and tendon.
profile::RewindResult rewind_drawn(const joint::IdentifiedJoint& joint, Polygon floor1, Polygon floor2) {
  return profile::rewind(joint::with_inset(joint), joint::as_made(std::move(floor1), joint.outline),
                         joint::as_made(std::move(floor2), joint.outline));
}

profile::RewindResult rewind_drawing(const joint::IdentifiedJoint& joint, const formats::Drawing& drawing) {
  const formats::DrawingPath* floor1 = largest_path(drawing, "P1_FLOOR");
  const formats::DrawingPath* floor2 = largest_path(drawing, "P2_FLOOR");
  if (floor1 && floor2)
    return rewind_drawn(joint, counter_clockwise(floor1->points), counter_clockwise(floor2->points));
  const formats::DrawingPath* pitch1 = largest_path(drawing, "P1_PITCH");
  const formats::DrawingPath* pitch2 = largest_path(drawing, "P2_PITCH");
  if (!pitch1 || !pitch2) {
    throw InputError(
        "", "the drawing has no closed contours on the layers P1_FLOOR and P2_FLOOR (nor on P1_PITCH and P2_PITCH)",
        "draw the two groove floors on these layers, as in profile.dxf of 'fusee build'");
  }
  // A drawn centre line is the pitch curve: a tendon without thickness, over pins thicker by its radius.
  joint::IdentifiedJoint centre_line = joint;
  centre_line.mechanism.guides.radius = joint.mechanism.guide_pitch_radius();
  centre_line.mechanism.joint.drum_radius = joint.mechanism.drum_pitch_radius();
  centre_line.mechanism.tendon.diameter = 0;
  return rewind_drawn(centre_line, counter_clockwise(pitch1->points), counter_clockwise(pitch2->points));
}

/// The outline of the part after the material has shrunk: the mesh is `scale` times as large.
Polygon shrunk(Polygon outline, double scale) {
  for (Vec2& point : outline) point /= scale;
  return outline;
}

Polygon floor_in_section(const solid::TriangleMesh& mesh, double z, double scale) {
  const std::optional<Polygon> floor = solid::outline_at(mesh, z * scale);
  if (!floor) {
    throw InputError("",
                     "the mesh has no section at z = " + rounded(z * scale) + " mm, where the mechanism has a groove",
                     "z must run along the pulley's axis from the bed at 0, in mm");
  }
  return shrunk(*floor, scale);
}

/// The expected part: groove heights of the part, and groove floors in the size of the mesh.
struct ExpectedPart {
  solid::BodyLayout layout;
  solid::GrooveFloors floors;
};

profile::SynthesisResult declared_curves(const joint::IdentifiedJoint& joint) {
  return profile::synthesise(joint.mechanism, {.advice = false});
}

ExpectedPart expected_part(const joint::IdentifiedJoint& joint) {
  profile::SynthesisResult synthesis = declared_curves(joint);
  if (!synthesis.made()) throw InputError("", "no pulley is feasible for this mechanism: " + synthesis.brief());
  joint::draw_for_making(synthesis, joint.outline);
  const solid::BodyLayout layout = solid::resolve_layout(joint.mechanism, synthesis);
  const double tendon_radius = 0.5 * joint.mechanism.tendon.diameter;
  const auto floor_in_mesh = [&](const profile::Outline& pitch_curve) {
    return shrunk(profile::parallel(pitch_curve, -tendon_radius), 1.0 / layout.scale);
  };
  return {layout, {floor_in_mesh(synthesis.p1), floor_in_mesh(synthesis.p2)}};
}

profile::RewindResult rewind_mesh(const joint::IdentifiedJoint& joint, const solid::BodyLayout& layout,
                                  const solid::TriangleMesh& mesh) {
  return rewind_drawn(joint, floor_in_section(mesh, layout.z_p1, layout.scale),
                      floor_in_section(mesh, layout.z_p2, layout.scale));
}

// ---- moved parts ----------------------------------------------------------------------------------------------------

/// A part whose floors deviate by at most this, mm, was not moved. Half of the default chord error of facets.
constexpr double k_as_made = 0.005;
/// A move is accepted if it reduces the deviation to this share. Parts with other faults fit badly at every position.
constexpr double k_clearly_better = 0.5;
/// A file with more bodies is not a pulley on a print bed.
constexpr std::size_t k_most_bodies = 20;

/// Deviation of the floors at the part's present position; infinite without a section there.
double deviation_in_place(const solid::TriangleMesh& mesh, const solid::BodyLayout& layout,
                          const solid::GrooveFloors& expected) {
  const std::optional<Polygon> floor1 = solid::outline_at(mesh, layout.z_p1 * layout.scale);
  const std::optional<Polygon> floor2 = solid::outline_at(mesh, layout.z_p2 * layout.scale);
  if (!floor1 || !floor2) return std::numeric_limits<double>::infinity();
  return solid::outline_deviation({*floor1, *floor2}, expected);
}

/// P1 and P2 printed separately and placed side by side: each is searched among the remaining bodies.
std::vector<solid::PlacementResult> find_apart(const solid::TriangleMesh& mesh, solid::GrooveFloors expected,
                                               double tendon_diameter) {
  std::vector<solid::PlacementResult> found;
  const std::vector<solid::TriangleMesh> bodies = solid::bodies_of(mesh);
  if (bodies.size() < 2 || bodies.size() > k_most_bodies) return found;
  for (const solid::TriangleMesh& body : bodies) {
    if (found.size() == 2) break;
    const solid::PlacementResult result = solid::find_placement(body, expected, tendon_diameter);
    if (result.status != solid::PlacementStatus::found || result.placement.grooves.size() != 1) continue;
    const bool is_p1 = result.placement.grooves.front().side == transmission::Side::left;
    (is_p1 ? expected.p1 : expected.p2).clear();
    found.push_back(result);
  }
  return found;
}

/// One placement for the whole part, or one each for parts printed separately.
std::vector<solid::PlacementResult> find_all(const solid::TriangleMesh& mesh, const solid::GrooveFloors& expected,
                                             double tendon_diameter) {
  const solid::PlacementResult whole = solid::find_placement(mesh, expected, tendon_diameter);
  if (whole.placement.grooves.size() == 2) return {whole};
  const std::vector<solid::PlacementResult> apart = find_apart(mesh, expected, tendon_diameter);
  return apart.size() == 2 ? apart : std::vector{whole};
}

/// Explains a scale by a unit, such as 0.0394 by inches.
std::string unit_words(double scale) {
  struct Unit {
    double scale;
    const char* words;
  };
  static constexpr Unit k_units[] = {{1 / 25.4, "its numbers are inches: scale it by 25.4"},
                                     {0.1, "its numbers are centimetres: scale it by 10"},
                                     {0.001, "its numbers are metres: scale it by 1000"},
                                     {25.4, "millimetres were read as inches: scale it by 1/25.4"},
                                     {10, "millimetres were read as centimetres: scale it by 0.1"},
                                     {1000, "millimetres were read as metres: scale it by 0.001"}};
  for (const Unit& unit : k_units) {
    if (std::abs(scale / unit.scale - 1) < 0.02) return unit.words;
  }
  return "scale it by " + rounded(1 / scale, 4) + ", or check whether it was made for another pulley.r1_mm";
}

/// Throws InputError for a part of another size or a mirrored one.
void refuse_scaled_or_mirrored(const solid::PlacementResult& result) {
  if (result.status == solid::PlacementStatus::scaled)
    throw InputError("", "the part is " + rounded(result.scale, 4) + " times the size of this mechanism's pulley",
                     unit_words(result.scale) + " (--as-is winds it in its present position)");
  if (result.status == solid::PlacementStatus::mirrored)
    throw InputError("", "the part is the mirror image of this mechanism's pulley",
                     "undo the mirroring (--as-is winds it in its present position)");
}

const solid::PlacedGroove* groove_of(const std::vector<solid::Placement>& placements, transmission::Side side) {
  for (const solid::Placement& placement : placements) {
    for (const solid::PlacedGroove& groove : placement.grooves) {
      if (groove.side == side) return &groove;
    }
  }
  return nullptr;
}

RewoundPart rewind_placed(const joint::IdentifiedJoint& joint, std::vector<solid::Placement> placements, double scale) {
  const solid::PlacedGroove* p1 = groove_of(placements, transmission::Side::left);
  const solid::PlacedGroove* p2 = groove_of(placements, transmission::Side::right);
  RewoundPart result{{}, PartPlace::found, {}};
  if (p1 && p2) {
    result.as_built = rewind_drawn(joint, shrunk(p1->floor, scale), shrunk(p2->floor, scale));
  } else {
    const solid::PlacedGroove& only = p1 ? *p1 : *p2;
    result.alone = only.side;
    result.as_built = profile::rewind_one(joint::with_inset(joint), only.side,
                                          joint::as_made(shrunk(only.floor, scale), joint.outline));
  }
  result.placements = std::move(placements);
  return result;
}

// ---- helical parts --------------------------------------------------------------------------------------------------

bool is_helical(const joint::IdentifiedJoint& joint) {
  return profile::needs_multi_turn(declared_curves(joint)) && !profile::kept_to_one_turn(joint.mechanism);
}

profile::RewindResult rewind_helical_part(const joint::IdentifiedJoint& joint, const Part& part) {
  const auto* mesh = std::get_if<solid::TriangleMesh>(&part);
  if (mesh == nullptr)
    throw InputError("", "the grooves of this mechanism's pulley are helical: tendons cannot be wound on a drawing",
                     "use the mesh: pulley.stl");
  formats::Product expected;
  expected.joint = joint;
  if (!design_multi_turn(expected, BuildOptions().chord_error_mm, {})) {
    std::string why = expected.synthesis.made() ? "" : expected.synthesis.brief();
    for (const profile::Condition& condition : expected.pulley.conditions)
      if (!condition.ok && why.empty()) why = condition.message;
    throw InputError("", "no pulley is feasible for this mechanism: " + why);
  }
  return rewind_multi_turn(expected, *mesh).result;
}

/// Winds on the part in its present position, axis along z: the search for a move needs grooves of constant height.
RewoundPart rewind_helical_in_place(const joint::IdentifiedJoint& joint, const Part& part) {
  constexpr double k_most_error = radians(0.5);  // of θ, for a part that is recognised
  RewoundPart result{rewind_helical_part(joint, part), PartPlace::as_made, {}};
  if (!(result.as_built.max_theta_error < k_most_error)) result.place = PartPlace::not_recognised;
  return result;
}

bool is_finite(const solid::TriangleMesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const Vec3& vertex) { return vertex.allFinite(); });
}

/// Winds on a part that is recognised nowhere. It may have no groove at its present position either: then InputError.
RewoundPart rewind_unrecognised(const joint::IdentifiedJoint& joint, const solid::BodyLayout& layout,
                                const solid::TriangleMesh& mesh) {
  try {
    return {rewind_mesh(joint, layout, mesh), PartPlace::not_recognised, {}};
  } catch (const InputError& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    diagnostics.front().hint =
        "nor do its grooves fit anywhere else: is it this mechanism's pulley, closed, its axis along z, in mm?";
    throw InputError(std::move(diagnostics));
  }
}

/// Scale of the part at which its floors fit the declared ones best, within 5 %, if that at least halves their
/// deviation. Otherwise 1, also for a part with one groove only.
double scale_of(const std::vector<solid::Placement>& placements, const solid::GrooveFloors& expected) {
  solid::GrooveFloors found, declared;
  for (const auto side : {transmission::Side::left, transmission::Side::right}) {
    const solid::PlacedGroove* groove = groove_of(placements, side);
    if (groove == nullptr) continue;
    const bool is_left = side == transmission::Side::left;
    (is_left ? found.p1 : found.p2) = groove->floor;
    (is_left ? declared.p1 : declared.p2) = is_left ? expected.p1 : expected.p2;
  }
  if (found.p1.empty() || found.p2.empty()) return 1;
  const auto deviation_at = [&](double scale) {
    return solid::outline_deviation({shrunk(found.p1, scale), shrunk(found.p2, scale)}, declared);
  };
  constexpr double k_largest_change = 0.05;
  const double scale = golden_section({1 - k_largest_change, 1 + k_largest_change}, 30, deviation_at).middle();
  return deviation_at(scale) < k_clearly_better * deviation_at(1) ? scale : 1;
}

RewoundPart rewind_moved_mesh(const joint::IdentifiedJoint& joint, const solid::TriangleMesh& mesh) {
  const auto [layout, expected] = expected_part(joint);
  if (!is_finite(mesh)) return rewind_unrecognised(joint, layout, mesh);
  const double in_place = deviation_in_place(mesh, layout, expected);
  if (in_place <= k_as_made) return {rewind_mesh(joint, layout, mesh), PartPlace::as_made, {}};
  const std::vector<solid::PlacementResult> found =
      find_all(mesh, expected, joint.mechanism.tendon.diameter * layout.scale);
  if (found.front().status == solid::PlacementStatus::unknown) return rewind_unrecognised(joint, layout, mesh);
  std::vector<solid::Placement> placements;
  double worst = 0;
  for (const solid::PlacementResult& result : found) {
    worst = std::max(worst, result.placement.deviation);
    placements.push_back(result.placement);
  }
  RewoundPart part{{}, PartPlace::as_made, {}};
  if (worst < k_clearly_better * in_place) {
    for (const solid::PlacementResult& result : found) refuse_scaled_or_mirrored(result);
    part = rewind_placed(joint, placements, layout.scale);
  } else {
    part.as_built = rewind_mesh(joint, layout, mesh);
  }
  part.scale = scale_of(placements, expected);
  return part;
}

}  // namespace

profile::RewindResult rewind_part(const joint::IdentifiedJoint& joint, const Part& part) {
  if (is_helical(joint)) return rewind_helical_part(joint, part);
  if (const auto* mesh = std::get_if<solid::TriangleMesh>(&part))
    return rewind_mesh(joint, expected_part(joint).layout, *mesh);
  return rewind_drawing(joint, std::get<formats::Drawing>(part));
}

profile::RewindResult rewind_made(const joint::IdentifiedJoint& joint, const solid::BodyLayout& layout,
                                  const solid::TriangleMesh& mesh) {
  return rewind_mesh(joint, layout, mesh);
}

profile::RewindResult rewind_floors(const joint::IdentifiedJoint& joint, const solid::BodyLayout& layout,
                                    const Polygon& floor1, const Polygon& floor2) {
  return rewind_drawn(joint, shrunk(floor1, layout.scale), shrunk(floor2, layout.scale));
}

RewoundPart rewind_moved_part(const joint::IdentifiedJoint& joint, const Part& part) {
  if (is_helical(joint)) return rewind_helical_in_place(joint, part);
  if (const auto* mesh = std::get_if<solid::TriangleMesh>(&part)) return rewind_moved_mesh(joint, *mesh);
  return {rewind_drawing(joint, std::get<formats::Drawing>(part)), PartPlace::as_made, {}};
}

std::vector<Check> as_built_checks(const Mechanism& mechanism, const profile::RewindResult& as_built,
                                   const AsBuiltLimits& limits) {
  const double error = degrees(as_built.max_theta_error);
  const std::string error_at = "at alpha = " + rounded(degrees(as_built.max_theta_error_at)) + " deg";
  const std::string excess_at = "at alpha = " + rounded(degrees(as_built.max_excess_at)) + " deg";
  if (mechanism.pulley.method == Method::paper) {
    // No limits: a larger value would be a bug of the rewinding.
    const double whole_mechanism = mechanism.joint.R + mechanism.pulley.EF;
    return {at_most("theta_error_reported", error, 180.0, "deg", error_at),
            at_most("excess_length_reported", as_built.max_excess, whole_mechanism, "mm", excess_at)};
  }
  return {at_most("theta_error", error, limits.theta_error_deg, "deg", error_at),
          at_most("excess_length", as_built.max_excess, limits.excess, "mm", excess_at)};
}

}  // namespace fusee::pipeline
