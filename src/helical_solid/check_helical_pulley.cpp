#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fusee/helical_solid.h"
#include "fusee/solid.h"
#include "helical_solid/half_planes.h"
#include "solid/euler.h"
#include "solid/place.h"

namespace fusee::helical_solid {
namespace {

// Number of half-planes in which thicknesses are measured.
constexpr std::size_t k_gauge_planes = 360;
// Least depth of a groove. Shallower minima of an outline are chords of other faces.
constexpr double k_least_groove = 0.3;
// Tolerance of a measured thickness, for rounding to float and in file formats. mm
constexpr double k_gauge_tolerance = 1e-4;
// Ribs are measured at this fraction of a groove's depth. Higher up, a chord may lie below the groove edge.
constexpr double k_rib_height_ratio = 0.9;
// Relative tolerance of the volume. It covers the difference between two sums over the same facets.
constexpr double k_volume_tolerance = 1e-5;

// The smallest value and its place.
struct Minimum {
  double value = std::numeric_limits<double>::infinity();
  Vec3 at = Vec3::Zero();

  void consider(double candidate, double angle, double r, double z) {
    if (candidate >= value) return;
    value = candidate;
    at = {r * elementary::cos(angle), r * elementary::sin(angle), z};
  }
  Check check(const std::string& name, double limit) const {
    return at_least(name, value, limit, "mm", value >= limit ? std::string() : "at " + solid::place_of(at));
  }
};

// Measures thicknesses in the finished part's sizes.
class PartGauge {
 public:
  PartGauge(const solid::TriangleMesh& mesh, const HelicalPulley& pulley, const HelicalSection& section)
      : layout_(pulley.layout), section_(section) {
    auto cuts = half_plane_cuts(mesh, k_gauge_planes);
    std::vector<std::vector<OutlinePiece>> outlines;
    // For each half-plane: all floors, and those that belong to a groove.
    std::vector<std::vector<FloorPlace>> floors, groove_floors(k_gauge_planes);
    for (std::vector<OutlinePiece>& cut : cuts) {
      for (OutlinePiece& piece : cut) {
        for (double* size : {&piece.z0, &piece.r0, &piece.z1, &piece.r1}) *size /= layout_.scale;
      }
      outlines.push_back(outermost(cut));
      floors.push_back(floors_of(outlines.back(), k_least_groove));
    }
    for (const FloorTrace& trace : floor_traces(floors)) {
      for (std::size_t k = 0; k < trace.places.size(); ++k)
        groove_floors[(trace.first + k) % k_gauge_planes].push_back(trace.places[k]);
    }
    for (std::size_t k = 0; k < k_gauge_planes; ++k) {
      std::sort(groove_floors[k].begin(), groove_floors[k].end(),
                [](const FloorPlace& a, const FloorPlace& b) { return a.z < b.z; });
      measure(half_plane_angle(k, k_gauge_planes), cuts[k], outlines[k], groove_floors[k]);
    }
  }

  void add_checks(std::vector<Check>& checks, double chord_error_mm) const {
    checks.push_back(rib_.check("rib", section_.rib - k_gauge_tolerance));
    checks.push_back(depth_.check("groove_depth", section_.depth - chord_error_mm));
    checks.push_back(wall_.check("bore_wall", layout_.min_wall - k_gauge_tolerance));
  }

 private:
  void measure(double angle, const std::vector<OutlinePiece>& pieces, const std::vector<OutlinePiece>& outline,
               const std::vector<FloorPlace>& floors) {
    for (std::size_t i = 0; i < floors.size(); ++i) {
      const FloorPlace& floor = floors[i];
      depth_.consider(std::min(floor.low_crest, floor.high_crest) - floor.r, angle, floor.r, floor.z);
      wall_.consider(floor.r - bore_at(pieces, floor.z), angle, floor.r, floor.z);
      if (i > 0) rib_.consider(thickness_between(outline, floors[i - 1], floor), angle, floor.r, floor.z);
    }
  }

  // Thickness of the rib between two floors: the height over which the outline projects beyond most of the groove's
  // depth, from the floor that is nearer to the axis.
  double thickness_between(const std::vector<OutlinePiece>& outline, const FloorPlace& low,
                           const FloorPlace& high) const {
    const double level = std::min(low.r, high.r) + k_rib_height_ratio * section_.depth;
    double thickness = 0;
    for (const OutlinePiece& piece : outline) {
      if (piece.z1 <= low.z || piece.z0 >= high.z) continue;
      const double least = std::min(piece.r0, piece.r1), most = std::max(piece.r0, piece.r1);
      if (most <= level) continue;
      const double share = least >= level ? 1.0 : (most - level) / (most - least);
      thickness += share * (std::min(piece.z1, high.z) - std::max(piece.z0, low.z));
    }
    return thickness;
  }

  // Radius of the bore, or of a horn's hole, at this height.
  double bore_at(const std::vector<OutlinePiece>& pieces, double z) const {
    double reach = layout_.bore.radius;
    for (const Polygon& hole : layout_.bore.screw_holes) reach = std::max(reach, circumradius(hole));
    double furthest = 0;
    for (const OutlinePiece& piece : pieces) {
      const double r = std::max(piece.r0, piece.r1);
      if (piece.z0 <= z && z <= piece.z1 && r <= reach + layout_.min_wall) furthest = std::max(furthest, r);
    }
    return furthest;
  }

  const solid::BodyLayout& layout_;
  const HelicalSection& section_;
  Minimum rib_, depth_, wall_;
};

}  // namespace

std::vector<Check> check_helical_pulley(const solid::TriangleMesh& mesh, const HelicalPulley& pulley,
                                        const HelicalSection& section, double chord_error_mm) {
  std::vector<Check> checks = solid::check_mesh(mesh);
  if (!all_ok(checks)) return checks;
  checks.push_back(exactly("euler_number", solid::euler_number(mesh), pulley.expected_euler, "1"));
  const double deviation = std::abs(solid::enclosed_volume(mesh) - pulley.expected_volume);
  checks.push_back(at_most("volume", deviation, k_volume_tolerance * pulley.expected_volume, "mm³"));
  PartGauge(mesh, pulley, section).add_checks(checks, chord_error_mm);
  return checks;
}

}  // namespace fusee::helical_solid
