#include "export/drawings/fitted_arcs.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"

namespace fusee::formats {
namespace {

constexpr double k_most_turn = 1.5;          // rad, of one biarc
constexpr std::size_t k_longest_span = 200;  // points of an outline for one biarc

struct Knot {
  Vec2 place;
  Vec2 tangent;
};

struct Arc {
  Vec2 from, to;
  double bulge = 0;  ///< tan of a quarter of the turn

  /// Distance of a point from the whole circle, or from the line through both ends if the bulge is 0.
  double distance(const Vec2& point) const {
    const Vec2 chord = to - from;
    if (std::abs(bulge) < 1e-9) return std::abs(cross(chord, point - from)) / chord.norm();
    const Vec2 centre = 0.5 * (from + to) + turned_left(chord) * ((1 - bulge * bulge) / (4 * bulge));
    return std::abs((point - centre).norm() - (from - centre).norm());
  }
};

/// The arc that leaves `from` along its tangent. Its bulge is tan(turn / 4), and tangent and chord enclose turn / 2.
Arc arc_between(const Knot& from, const Vec2& to) {
  const Vec2 chord = to - from.place;
  return {from.place, to,
          elementary::tan(0.5 * elementary::atan2(cross(from.tangent, chord), from.tangent.dot(chord)))};
}

/// Two arcs that leave `from` and reach `to` along their tangents and meet tangentially at a third point.
struct Biarc {
  Arc first, second;
  Vec2 middle_tangent;

  double distance(const Vec2& point) const {
    return ((point - first.to).dot(middle_tangent) < 0 ? first : second).distance(point);
  }
};

/// The biarc whose four tangents have the same length d (Bolton 1975). From end to end lead d t₀, a segment of length
/// 2 d along the middle tangent, and d t₁. So |c − d (t₀ + t₁)| = 2 d with the chord c, which gives
/// 2 (1 − t₀ · t₁) d² + 2 c · (t₀ + t₁) d − c² = 0. The positive root is computed in the form without cancellation.
std::optional<Biarc> biarc_between(const Knot& from, const Knot& to) {
  const Vec2 chord = to.place - from.place;
  const double along = chord.dot(from.tangent + to.tangent), chord_squared = chord.squaredNorm();
  if (!(along > 0)) return std::nullopt;
  const double bend = 2 * (1 - from.tangent.dot(to.tangent));
  const double d = chord_squared / (along + std::sqrt(along * along + bend * chord_squared));
  const Vec2 middle_tangent = (chord - d * (from.tangent + to.tangent)).normalized();
  const Vec2 middle = from.place + d * (from.tangent + middle_tangent);
  return Biarc{arc_between(from, middle), arc_between({middle, middle_tangent}, to.place), middle_tangent};
}

class ArcFit {
 public:
  ArcFit(const profile::Outline& outline, double distance, double tolerance)
      : outline_(outline), points_(profile::parallel(outline, distance)), tolerance_(tolerance) {}

  std::vector<BulgeVertex> fit() const {
    std::vector<BulgeVertex> vertices;
    for (std::size_t i = 0; i < points_.size();) {
      std::size_t last = i + 1;
      std::optional<Biarc> longest = biarc_over(i, last);
      while (longest && last < points_.size() && last < i + k_longest_span) {
        const std::optional<Biarc> longer = biarc_over(i, last + 1);
        if (!longer) break;
        longest = longer;
        ++last;
      }
      vertices.push_back({points_[i], longest ? longest->first.bulge : 0});
      if (longest) vertices.push_back({longest->first.to, longest->second.bulge});
      i = last;
    }
    return vertices;
  }

 private:
  Knot knot(std::size_t i) const {
    const std::size_t k = i % points_.size();
    return {points_[k], turned_left(outline_.points[k].normal)};
  }

  /// The biarc from one point to another, if it is convex and within the tolerance of the points between.
  std::optional<Biarc> biarc_over(std::size_t from, std::size_t to) const {
    const Knot start = knot(from), end = knot(to);
    const double turn = elementary::atan2(cross(start.tangent, end.tangent), start.tangent.dot(end.tangent));
    if (!(turn >= 0) || turn > k_most_turn) return std::nullopt;
    const std::optional<Biarc> biarc = biarc_between(start, end);
    // The outline is convex, so its arcs must be convex too.
    if (!biarc || !(biarc->first.bulge >= 0 && biarc->second.bulge >= 0)) return std::nullopt;
    for (std::size_t i = from + 1; i < to; ++i) {
      if (!(biarc->distance(points_[i]) <= tolerance_)) return std::nullopt;
    }
    return biarc;
  }

  const profile::Outline& outline_;
  Polygon points_;
  double tolerance_;
};

}  // namespace

std::optional<solid::RoundHole> circle_about_axis(const Polygon& points) {
  constexpr double k_round = 1e-6;  // mm
  if (points.empty()) return std::nullopt;
  const double radius = points.front().norm();
  const bool is_round = std::all_of(points.begin(), points.end(),
                                    [radius](const Vec2& point) { return std::abs(point.norm() - radius) <= k_round; });
  return is_round ? std::optional<solid::RoundHole>({Vec2::Zero(), 2 * radius}) : std::nullopt;
}

std::vector<BulgeVertex> fitted_arcs(const profile::Outline& outline, double distance, double tolerance) {
  return ArcFit(outline, distance, tolerance).fit();
}

}  // namespace fusee::formats
