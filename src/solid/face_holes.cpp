#include "solid/face_holes.h"

#include <algorithm>

namespace fusee::solid {
namespace {

// The slot begins this many tendon diameters past the end of the active arc, as a channel does.
constexpr double k_lap_ratio = 1.6;
// Flange thickness below the countersink, which bears the knot's pull.
constexpr double k_least_ground = 0.5;
// Clearance of the slot's round end from the floor, so that no face of it coincides with the groove's.
constexpr double k_off_floor = 0.03;
// The slot ends this far outside the rim. If its round end lies beyond the rim already, it ends this far outside the
// centre of that end, because a slot of negative length would be inverted.
constexpr double k_beyond_rim = 0.5;

class FaceHoleSearch {
 public:
  FaceHoleSearch(const AnchorSite& site, const BodyLayout& layout, bool wound_end, double wanted)
      : site_(site), layout_(layout), wound_end_(wound_end), wanted_(wanted), radius_(0.5 * layout.channel_width) {}

  std::optional<FaceHole> run(const LapRange& laps) const {
    // The closing arc has the same length from either end.
    const double last = std::min(laps.most, site_.ground.arc(true).length() - radius_ - site_.tendon_diameter);
    double lap = std::max(laps.least, k_lap_ratio * site_.tendon_diameter + radius_);
    if (layout_.flange_thickness < k_least_ground) return std::nullopt;
    for (; lap <= last; lap += radius_) {
      if (auto hole = at(lap)) return hole;
    }
    return std::nullopt;
  }

 private:
  std::optional<FaceHole> at(double lap) const {
    const Station station = site_.ground.arc(wound_end_).at(lap);
    const double above_pitch = k_off_floor + radius_ - 0.5 * site_.tendon_diameter;
    FaceHole hole{.start = station.position,
                  .normal = station.normal,
                  .hole = station.position + above_pitch * station.normal,
                  .hole_radius = radius_,
                  .room = radius_,
                  .lap = station.lap,
                  .wrap = station.wrap};
    hole.length = k_beyond_rim + std::max(0.0, support_of(*site_.rim, hole.normal) - hole.hole.dot(hole.normal));
    if (!is_free(hole.bars(layout_.channel_width).front())) return std::nullopt;
    // The largest countersink that fits; without one, the slot alone.
    for (const double share : {1.0, 0.75, 0.5, 0.25}) {
      FaceHole sunk = hole;
      sunk.room = radius_ + share * std::max(0.0, wanted_ - radius_);
      const bool deep_enough = countersink_depth(layout_, sunk) <= layout_.flange_thickness - k_least_ground;
      if (deep_enough && is_free({sunk.pocket(), sunk.pocket(), sunk.room})) return sunk;
    }
    return hole;
  }

  static double support_of(const Polygon& rim, const Vec2& direction) {
    double most = 0;
    for (const Vec2& point : rim) most = std::max(most, point.dot(direction));
    return most;
  }

  bool is_free(const Bar& bar) const {
    return std::all_of(site_.holes.begin(), site_.holes.end(),
                       [&](const Bar& other) { return gap(bar, other) >= site_.wall; });
  }

  const AnchorSite& site_;
  const BodyLayout& layout_;
  bool wound_end_;
  double wanted_;
  double radius_;
};

}  // namespace

std::optional<FaceHole> find_face_hole(const AnchorSite& site, const BodyLayout& layout, bool wound_end, double wanted,
                                       const LapRange& laps) {
  return FaceHoleSearch(site, layout, wound_end, wanted).run(laps);
}

// The circles of countersink and slot touch on the outer side. The cone is therefore widest on the inner side, by the
// difference of both diameters.
double countersink_depth(const BodyLayout& layout, const FaceHole& hole) {
  return rise_of(layout, 2.0 * (hole.room - hole.hole_radius));
}

}  // namespace fusee::solid
