#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/text.h"
#include "solid/bridging.h"
#include "solid/nearest_float.h"
#include "solid/overhangs.h"
#include "solid/place.h"
#include "solid/print.h"

namespace fusee::solid {
namespace {

// Reasons for the usual limits. A line of plastic is about 0.45 mm wide and is safe on half of the line below: at
// layers of 0.2 mm that is 45°, the rule of every slicer. The step, 0.3 mm, is two thirds of a line. Bridges sag above
// about 5 mm. The first layer is up to 0.3 mm thick and is pressed onto the bed.
//
// A face drawn exactly at the limit is rounded to floats, and its facets cut the curve's corners. Both effects are much
// smaller than this tolerance.
constexpr double k_slope_tolerance = radians(0.1);

PrintLimits with_tolerances(PrintLimits limits) {
  limits.overhang -= k_slope_tolerance;
  limits.step += k_float_grain;
  limits.bridge += k_float_grain;
  return limits;
}

// The worst of many values, and the extent of all that exceed the limit.
struct WorstPlace {
  double value = 0;
  Vec3 at = Vec3::Zero();
  int places = 0;
  double area = 0;

  void consider(double candidate, const Vec3& place) {
    if (candidate > value) std::tie(value, at) = std::pair(candidate, place);
  }
  void count(const OverhangPatch& patch) {
    ++places;
    area += patch.area;
  }
  std::string where() const {
    return fmt::format("{}; {} mm² in {} place{}", place_of(at), rounded(area, 3), places, places == 1 ? "" : "s");
  }
};

bool is_measurable(const TriangleMesh& mesh) {
  const auto known = [&mesh](const std::array<std::uint32_t, 3>& triangle) {
    return std::max({triangle[0], triangle[1], triangle[2]}) < mesh.vertices.size();
  };
  return !mesh.triangles.empty() && std::all_of(mesh.triangles.begin(), mesh.triangles.end(), known) &&
         std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const Vec3& v) { return v.allFinite(); });
}

Check island_check(const TriangleMesh& mesh, const PrintLimits& limits) {
  const std::vector<Vec3> regions = find_unsupported_regions(mesh, limits.first_layer);
  return exactly("island", static_cast<double>(regions.size()), 0, "1",
                 regions.empty() ? std::string() : "begins in mid-air at " + place_of(regions.front()));
}

std::vector<Check> checks_within(const PrintLimits& limits, const TriangleMesh& mesh) {
  if (!is_measurable(mesh)) {
    const std::string why = "not checked: the mesh is not a valid solid";
    return {{"overhang", 0, degrees(limits.overhang), "deg", false, why},
            {"unsupported_step", 0, limits.step, "mm", false, why},
            {"bridge", 0, limits.bridge, "mm", false, why},
            {"island", 0, 0, "1", false, why}};
  }
  const Overhangs overhangs = find_overhangs(mesh, limits.overhang, limits.first_layer);
  // Slopes are negated, because the worst is the least.
  WorstPlace flatness{-overhangs.flattest_other, overhangs.flattest_other_at}, step, bridge;
  for (const OverhangPatch& patch : overhangs.patches) {
    const SupportGaps gaps = support_gaps_of(patch, limits);
    step.consider(gaps.step, gaps.step_at);
    bridge.consider(gaps.bridge, gaps.bridge_at);
    if (gaps.step > limits.step) step.count(patch);
    if (gaps.bridge > limits.bridge) bridge.count(patch);
    if (gaps.within(limits)) continue;
    flatness.consider(-patch.flattest, patch.flattest_at);
    flatness.count(patch);
  }
  return {at_least("overhang", degrees(-flatness.value), degrees(limits.overhang), "deg", flatness.where()),
          at_most("unsupported_step", step.value, limits.step, "mm", step.where()),
          at_most("bridge", bridge.value, limits.bridge, "mm", bridge.where()), island_check(mesh, limits)};
}

}  // namespace

std::vector<Check> check_print(const TriangleMesh& mesh, const PrintLimits& limits) {
  return checks_within(with_tolerances(limits), mesh);
}

}  // namespace fusee::solid
