#include "helical_solid/half_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fusee/base.h"

namespace fusee::helical_solid {
namespace {

// Pieces shorter than this along the axis count as level, mm.
constexpr double k_level = 1e-7;
// Largest variation of the radius within a floor (mm), from float rounding in a large part.
constexpr double k_floor_variation = 1e-3;

// Adds the cut of a facet by the half-plane in direction (c, s).
void cut(const std::array<const Vec3*, 3>& corners, double c, double s, std::vector<OutlinePiece>& pieces) {
  std::array<double, 3> aside{};  // distances of the corners to the left of the half-plane
  for (std::size_t k = 0; k < 3; ++k) aside[k] = c * corners[k]->y() - s * corners[k]->x();
  OutlinePiece piece;
  int ends = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t n = (k + 1) % 3;
    if ((aside[k] < 0) == (aside[n] < 0)) continue;
    const Vec3 at = *corners[k] + aside[k] / (aside[k] - aside[n]) * (*corners[n] - *corners[k]);
    (ends == 0 ? piece.r0 : piece.r1) = c * at.x() + s * at.y();
    (ends == 0 ? piece.z0 : piece.z1) = at.z();
    ++ends;
  }
  if (ends != 2 || piece.r0 < 0 || piece.r1 < 0) return;
  if (piece.z0 > piece.z1) {
    std::swap(piece.z0, piece.z1);
    std::swap(piece.r0, piece.r1);
  }
  if (piece.z1 - piece.z0 > k_level) pieces.push_back(piece);
}

double radius_at(const OutlinePiece& piece, double z) {
  return piece.r0 + (piece.r1 - piece.r0) * (z - piece.z0) / (piece.z1 - piece.z0);
}

// Largest step of a floor between neighbouring half-planes, in addition to the arc between them. A floor that rises at
// 45° makes a step of the arc's length. mm
constexpr double k_additional_step = 0.4;
// A groove's end wall stands across the groove, and a half-plane may cut it at an angle. This angle at each end is
// omitted.
constexpr double k_end_of_groove = radians(4);

// Joins the floors of neighbouring half-planes to traces.
class FloorJoiner {
 public:
  explicit FloorJoiner(const std::vector<std::vector<FloorPlace>>& floors) : floors_(floors), planes_(floors.size()) {
    for (const auto& in_plane : floors_) {
      next_.emplace_back(in_plane.size(), k_none);
      has_previous_.emplace_back(in_plane.size(), false);
    }
    for (std::size_t k = 0; k < planes_; ++k) join(k, (k + 1) % planes_);
  }

  std::vector<FloorTrace> traces() const {
    std::vector<FloorTrace> traces;
    for (std::size_t k = 0; k < planes_; ++k) {
      for (std::size_t i = 0; i < floors_[k].size(); ++i) {
        if (has_previous_[k][i]) continue;
        FloorTrace trace = trace_from(k, i);
        if (trace.places.size() >= planes_ / 2) traces.push_back(without_ends(std::move(trace)));
      }
    }
    std::sort(traces.begin(), traces.end(), [](const FloorTrace& a, const FloorTrace& b) {
      return a.places.front().z + a.places.back().z < b.places.front().z + b.places.back().z;
    });
    return traces;
  }

 private:
  static constexpr std::size_t k_none = std::numeric_limits<std::size_t>::max();

  // Joins each floor of a half-plane to the nearest one of the next.
  void join(std::size_t here, std::size_t there) {
    for (std::size_t i = 0; i < floors_[here].size(); ++i) {
      double nearest = k_additional_step + k_two_pi / static_cast<double>(planes_) * floors_[here][i].r;
      for (std::size_t j = 0; j < floors_[there].size(); ++j) {
        const FloorPlace &a = floors_[here][i], &b = floors_[there][j];
        const double step = elementary::hypot(a.z - b.z, a.r - b.r);
        if (step >= nearest || has_previous_[there][j]) continue;
        nearest = step;
        next_[here][i] = j;
      }
      if (next_[here][i] != k_none) has_previous_[there][next_[here][i]] = true;
    }
  }

  FloorTrace trace_from(std::size_t plane, std::size_t floor) const {
    FloorTrace trace{plane, {}};
    while (floor != k_none) {
      trace.places.push_back(floors_[plane][floor]);
      floor = next_[plane][floor];
      plane = (plane + 1) % planes_;
    }
    return trace;
  }

  FloorTrace without_ends(FloorTrace trace) const {
    const auto ends = static_cast<std::ptrdiff_t>(std::ceil(k_end_of_groove / k_two_pi * static_cast<double>(planes_)));
    trace.places.erase(trace.places.end() - ends, trace.places.end());
    trace.places.erase(trace.places.begin(), trace.places.begin() + ends);
    trace.first = (trace.first + static_cast<std::size_t>(ends)) % planes_;
    return trace;
  }

  const std::vector<std::vector<FloorPlace>>& floors_;
  std::size_t planes_;
  // For each floor of each half-plane: the floor in the next half-plane that continues it, and whether it continues
  // one.
  std::vector<std::vector<std::size_t>> next_;
  std::vector<std::vector<bool>> has_previous_;
};

}  // namespace

double half_plane_angle(std::size_t k, std::size_t count) {
  return k_two_pi * (static_cast<double>(k) + 0.3719) / static_cast<double>(count);
}

std::vector<std::vector<OutlinePiece>> half_plane_cuts(const solid::TriangleMesh& mesh, std::size_t count) {
  std::vector<std::vector<OutlinePiece>> cuts(count);
  std::vector<Vec2> directions;
  for (std::size_t k = 0; k < count; ++k) directions.push_back(unit(half_plane_angle(k, count)));
  const double first = half_plane_angle(0, count), step = k_two_pi / static_cast<double>(count);
  for (const auto& triangle : mesh.triangles) {
    const std::array<const Vec3*, 3> corners{&mesh.vertices[triangle[0]], &mesh.vertices[triangle[1]],
                                             &mesh.vertices[triangle[2]]};
    const double start = elementary::atan2(corners[0]->y(), corners[0]->x());
    double low = start, high = start;
    for (const Vec3* corner : {corners[1], corners[2]}) {
      const double angle = start + std::remainder(elementary::atan2(corner->y(), corner->x()) - start, k_two_pi);
      low = std::min(low, angle);
      high = std::max(high, angle);
    }
    // Half-planes that the facet may reach, not yet reduced to one turn.
    const auto from = static_cast<long>(std::floor((low - first) / step)),
               to = static_cast<long>(std::ceil((high - first) / step));
    const auto one_turn = static_cast<long>(count);
    for (long k = from; k <= to && k < from + one_turn; ++k) {
      const auto plane = static_cast<std::size_t>(((k % one_turn) + one_turn) % one_turn);
      cut(corners, directions[plane].x(), directions[plane].y(), cuts[plane]);
    }
  }
  return cuts;
}

std::vector<OutlinePiece> outermost(std::vector<OutlinePiece> pieces) {
  std::sort(pieces.begin(), pieces.end(), [](const OutlinePiece& a, const OutlinePiece& b) { return a.z0 < b.z0; });
  std::vector<double> heights;
  for (const OutlinePiece& piece : pieces) {
    heights.push_back(piece.z0);
    heights.push_back(piece.z1);
  }
  std::sort(heights.begin(), heights.end());
  std::vector<OutlinePiece> outline;
  std::vector<const OutlinePiece*> here;  // pieces at the present height
  auto next = pieces.begin();
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    const double low = heights[k], high = heights[k + 1], middle = 0.5 * (low + high);
    if (high - low <= k_level) continue;
    while (next != pieces.end() && next->z0 < middle) here.push_back(&*next++);
    std::erase_if(here, [middle](const OutlinePiece* piece) { return piece->z1 < middle; });
    const OutlinePiece* outer = nullptr;
    for (const OutlinePiece* piece : here) {
      if (outer == nullptr || radius_at(*piece, middle) > radius_at(*outer, middle)) outer = piece;
    }
    if (outer != nullptr) outline.push_back({low, radius_at(*outer, low), high, radius_at(*outer, high)});
  }
  return outline;
}

std::vector<FloorPlace> floors_of(const std::vector<OutlinePiece>& outline, double least_rise) {
  std::vector<FloorPlace> floors;
  if (outline.empty()) return floors;
  // Follows the outline upwards from each crest to the least radius after it. A rise of at least `least_rise` from that
  // radius ends a floor.
  double crest = outline.front().r0, crest_z = outline.front().z0;
  double least = crest, from = crest_z, to = crest_z;  // least radius since the crest, and the heights that have it
  bool is_in_groove = false;
  const auto follow = [&](double z, double r) {
    if (r < least - k_floor_variation) {
      least = r;
      from = to = z;
    } else if (r <= least + k_floor_variation) {
      least = std::min(least, r);
      to = z;
    }
    if (!is_in_groove) {
      if (r >= crest - k_floor_variation) {
        crest = std::max(crest, r);
        crest_z = z;
        least = r;
        from = to = z;
      }
      is_in_groove = r < crest - least_rise;
    }
    if (is_in_groove && r > least + least_rise) {
      floors.push_back({0.5 * (from + to), least, crest, r, crest_z, z});
      is_in_groove = false;
      crest = least = r;
      crest_z = from = to = z;
    } else if (!is_in_groove && !floors.empty() && floors.back().high_crest < r) {
      floors.back().high_crest = r;
      floors.back().high_crest_z = z;
    }
  };
  for (const OutlinePiece& piece : outline) {
    follow(piece.z0, piece.r0);
    follow(piece.z1, piece.r1);
  }
  return floors;
}

std::vector<FloorTrace> floor_traces(const std::vector<std::vector<FloorPlace>>& floors) {
  return FloorJoiner(floors).traces();
}

}  // namespace fusee::helical_solid
