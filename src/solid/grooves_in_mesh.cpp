#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::solid {
namespace {

// Least and largest number of sections for a part of any height.
constexpr double k_least_sections = 16;
constexpr double k_most_sections = 1500;
// Samples of the two steps about a valley, and bisection steps for the ends of its floor.
constexpr int k_fine_samples = 33;
constexpr int k_bisections = 30;
// Relative growth of the radius that ends a floor: 5 µm at 16 mm, the effect of a channel entry.
constexpr double k_floor_rise = 3e-4;

/// Radius of the circle with the area of the outline's hull; 0 without an outline.
double mean_radius(const TriangleMesh& mesh, double z) {
  const std::optional<Polygon> outline = outline_at(mesh, z);
  return outline ? std::sqrt(std::max(0.0, signed_area(convex_hull(*outline))) / k_pi) : 0.0;
}

struct Slice {
  double z = 0;
  double radius = 0;
};

std::vector<Slice> slices(const TriangleMesh& mesh, double low, double high, int count) {
  std::vector<Slice> all;
  for (int k = 0; k < count; ++k) {
    const double z = low + (high - low) * (k + 0.5) / count;
    all.push_back({z, mean_radius(mesh, z)});
  }
  return all;
}

/// Index of the narrowest slice of each valley. In a valley the radius falls and rises by at least the fraction
/// `least_depth`.
std::vector<std::size_t> valleys_of(const std::vector<Slice>& all, double least_depth) {
  std::vector<std::size_t> found;
  bool is_down = false;
  double high = 0;
  std::size_t narrowest = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double radius = all[k].radius;
    if (!is_down) {
      high = std::max(high, radius);
      is_down = radius < high * (1 - least_depth);
      narrowest = k;
    } else {
      if (radius < all[narrowest].radius) narrowest = k;
      if (radius * (1 - least_depth) <= all[narrowest].radius) continue;
      found.push_back(narrowest);
      is_down = false;
      high = radius;
    }
  }
  return found;
}

/// The height at which a floor ends, by bisection between `inside`, a height on it, and `outside`, where the radius
/// exceeds `most`.
double floor_end(const TriangleMesh& mesh, double inside, double outside, double most) {
  for (int i = 0; i < k_bisections; ++i) {
    const double middle = 0.5 * (inside + outside);
    (mean_radius(mesh, middle) <= most ? inside : outside) = middle;
  }
  return inside;
}

/// The middle of the floor whose narrowest slice is all[at].
double floor_middle(const TriangleMesh& mesh, const std::vector<Slice>& all, std::size_t at) {
  const double below = all[at - 1].z, above = all[at + 1].z;
  Slice narrowest = all[at];
  for (const Slice& slice : slices(mesh, below, above, k_fine_samples)) {
    if (slice.radius < narrowest.radius) narrowest = slice;
  }
  const double most = narrowest.radius * (1 + k_floor_rise);
  std::size_t low = at, high = at;
  while (low > 0 && all[low].radius <= most) --low;
  while (high + 1 < all.size() && all[high].radius <= most) ++high;
  const double from = low == at ? below : all[low].z, to = high == at ? above : all[high].z;
  return 0.5 * (floor_end(mesh, narrowest.z, from, most) + floor_end(mesh, narrowest.z, to, most));
}

}  // namespace

std::optional<Polygon> outline_at(const TriangleMesh& mesh, double z) {
  std::vector<Polygon> loops = section(mesh, z);
  if (loops.empty()) return std::nullopt;
  const auto largest = std::max_element(loops.begin(), loops.end(), [](const Polygon& a, const Polygon& b) {
    return std::abs(signed_area(a)) < std::abs(signed_area(b));
  });
  if (convex_hull(*largest).size() < 3) return std::nullopt;
  if (signed_area(*largest) < 0) std::reverse(largest->begin(), largest->end());
  return std::move(*largest);
}

std::vector<GrooveInMesh> find_grooves(const TriangleMesh& mesh, double least_depth, double step) {
  const Bounds box = bounds(mesh);
  const double height = box.high.z() - box.low.z();
  if (!(height > 0) || !std::isfinite(height)) return {};
  const int count = static_cast<int>(std::clamp(height / step, k_least_sections, k_most_sections));
  const std::vector<Slice> all = slices(mesh, box.low.z(), box.high.z(), count);
  std::vector<GrooveInMesh> grooves;
  for (const std::size_t at : valleys_of(all, least_depth)) {
    const double z = floor_middle(mesh, all, at);
    if (std::optional<Polygon> floor = outline_at(mesh, z)) grooves.push_back({z, std::move(*floor)});
  }
  return grooves;
}

}  // namespace fusee::solid
