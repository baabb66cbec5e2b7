#include "solid/face_holes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fusee/base/units.h"
#include "solid/tie_off_tools.h"

namespace fusee {
namespace {

// The mouth begins this many tendon diameters past the arc that the tendon leaves from, as a channel does.
constexpr double k_lap_ratio = 1.6;
// What is left of the flange outside the hole: a line of a nozzle of 0.4 mm; less at a chamfer.
constexpr double k_least_rim = 0.4;
constexpr double k_rim_at_chamfer = 0.2;
// What the countersink leaves of the flange's thickness for the knot to pull on.
constexpr double k_least_ground = 0.5;

double depth_for(const BodyLayout& layout, double width) {
  return layout.roof_slope > 0 ? rise_of(layout, width) : width;
}

class FaceHoleSearch {
 public:
  FaceHoleSearch(const AnchorSite& site, const BodyLayout& layout, bool wound_end, double wanted)
      : site_(site), layout_(layout), wound_end_(wound_end), wanted_(wanted), radius_(0.5 * layout.channel_width) {}

  std::optional<FaceHole> run(const LapRange& laps) const {
    const double last = std::min(laps.most, closing_length(site_.outline) - radius_ - site_.tendon_diameter);
    double lap = std::max(laps.least, k_lap_ratio * site_.tendon_diameter + radius_);
    if (above_floor() + radius_ < 0.5 * site_.tendon_diameter || !thick_enough()) return std::nullopt;
    for (; lap <= last; lap += radius_) {
      if (auto hole = at(lap)) return hole;
    }
    return std::nullopt;
  }

 private:
  bool thick_enough() const { return layout_.flange_thickness >= k_least_ground; }

  // Of the hole's axis: the tendon's own height where the flange reaches far enough, else lower, the floor notched.
  double above_floor() const { return std::min(0.5 * site_.tendon_diameter, reach() - radius_); }

  // From the floor to the furthest that a hole may go.
  double reach() const {
    return layout_.groove_depth - std::max(k_least_rim, layout_.elephant_foot + k_rim_at_chamfer);
  }

  // Within the lip; its sides stand at 22° to the direction in which the roof grows where there is room for that.
  double point() const {
    if (layout_.roof_slope <= 0 || on_bed(layout_, site_.outline.side)) return 0.0;
    const double tip = std::min(radius_ / std::sin(radians(22)), reach() - above_floor());
    return tip > 1.05 * radius_ ? tip : 0.0;
  }

  std::optional<FaceHole> at(double lap) const {
    const Station station = closing_station(site_.outline, wound_end_, lap);
    const double below_pitch = 0.5 * site_.tendon_diameter - above_floor();
    FaceHole hole{station.position, station.normal, station.position - below_pitch * station.normal, radius_, radius_,
                  station.lap,      station.wrap,
                  point()};
    if (!is_free({hole.hole, hole.hole, radius_})) return std::nullopt;
    for (const double share : {1.0, 0.75, 0.5, 0.25}) {
      FaceHole sunk = hole;
      sunk.room = radius_ + share * std::max(0.0, wanted_ - radius_);
      const bool deep_enough = countersink_depth(layout_, sunk) <= layout_.flange_thickness - k_least_ground;
      if (deep_enough && is_free({sunk.pocket(), sunk.pocket(), sunk.room})) return sunk;
    }
    return hole;
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

double countersink_depth(const BodyLayout& layout, const FaceHole& hole) {
  return depth_for(layout, 2.0 * (hole.room - hole.hole_radius));
}

}  // namespace fusee
