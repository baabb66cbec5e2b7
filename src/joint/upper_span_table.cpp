#include "joint/upper_span_table.h"

#include <algorithm>
#include <cmath>

namespace fusee::joint {
namespace {

constexpr std::size_t k_intervals = 160;

/// Value, slope and curvature at the end of an interval, in units of the interval.
struct End {
  double value, slope, bend;
};

/// The quintic with these ends on [0, 1].
std::array<double, 6> quintic(const End& from, const End& to) {
  const double value = to.value - from.value - from.slope - 0.5 * from.bend;
  const double slope = to.slope - from.slope - from.bend;
  const double bend = to.bend - from.bend;
  return {from.value,
          from.slope,
          0.5 * from.bend,
          10.0 * value - 4.0 * slope + 0.5 * bend,
          -15.0 * value + 7.0 * slope - bend,
          6.0 * value - 3.0 * slope + 0.5 * bend};
}

double value_at(const std::array<double, 6>& c, double u) {
  return c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * (c[4] + u * c[5]))));
}

double slope_at(const std::array<double, 6>& c, double u) {
  return c[1] + u * (2.0 * c[2] + u * (3.0 * c[3] + u * (4.0 * c[4] + u * 5.0 * c[5])));
}

/// The tabulated quantities of a span at a node, in units of the interval. Node::length has −m as its slope.
struct Node {
  End length, m, normal;
};

/// Lengthens the path; the moment arm is minus its derivative by θ.
transmission::UpperSpan made_longer(transmission::UpperSpan span, double theta, const PathError& added) {
  span.length += (added.slope + (added.square + added.cube * theta) * theta) * theta;
  span.m -= added.slope + (2.0 * added.square + 3.0 * added.cube * theta) * theta;
  span.dm -= 2.0 * added.square + 6.0 * added.cube * theta;
  span.d2m -= 6.0 * added.cube;
  return span;
}

Node node_at(const transmission::PinPlace& place, double theta, double h, const PathError& longer) {
  const transmission::UpperSpan span = made_longer(transmission::upper_span(place, theta), theta, longer);
  return {{span.length, -h * span.m, -h * h * span.dm},
          {span.m, h * span.dm, h * h * span.d2m},
          {span.normal, h * span.dnormal, h * h * span.d2normal}};
}

}  // namespace

// No interval contains the lift-off angle, where the arm has a kink. Below it the span is linear in θ, or, for an
// eccentric drum, has its own intervals.
UpperSpanTable::UpperSpanTable(const transmission::PinPlace& place, double least, double most,
                               const PathError& longer) {
  if (const auto leaves = transmission::lift_off(place); leaves && *leaves > least) {
    // The free branch begins slightly beyond, with its own slopes.
    constexpr double k_past_lift_off = 1e-12;  // rad
    on_drum_until_ = std::min(*leaves, most);
    on_drum_ = transmission::upper_span(place, least);
    on_drum_from_ = least;
    wound_up_ = on_drum_.on_drum + on_drum_.normal + least;
    if (place.drum_offset != 0) over_drum_ = pieces(place, least, on_drum_until_ - k_past_lift_off, longer);
    least = *leaves + k_past_lift_off;
    if (least >= most) return;
  }
  free_ = pieces(place, least, most, longer);
}

UpperSpanTable::Pieces UpperSpanTable::pieces(const transmission::PinPlace& place, double least, double most,
                                              const PathError& longer) {
  Pieces all;
  all.least = least;
  all.step = (most - least) / k_intervals;
  all.curves.reserve(k_intervals);
  Node from = node_at(place, least, all.step, longer);
  for (std::size_t i = 1; i <= k_intervals; ++i) {
    const Node to = node_at(place, least + all.step * static_cast<double>(i), all.step, longer);
    all.curves.push_back({quintic(from.length, to.length), quintic(from.m, to.m), quintic(from.normal, to.normal)});
    from = to;
  }
  return all;
}

UpperSpanTable::Values UpperSpanTable::at(double theta) const {
  const bool on_drum = theta <= on_drum_until_ || free_.curves.empty();
  if (on_drum && over_drum_.curves.empty()) {
    const double turned = std::clamp(theta, on_drum_from_, on_drum_until_) - on_drum_from_;
    return {on_drum_.length - on_drum_.m * turned, on_drum_.m, 0, on_drum_.normal, 0, on_drum_.on_drum - turned};
  }
  const Pieces& pieces = on_drum ? over_drum_ : free_;
  const double position = std::clamp((theta - pieces.least) / pieces.step, 0.0, static_cast<double>(k_intervals));
  const std::size_t i = std::min(static_cast<std::size_t>(position), k_intervals - 1);
  const double u = position - static_cast<double>(i);
  const Piece& piece = pieces.curves[i];
  const double normal = value_at(piece.normal, u);
  const double clamped_theta = pieces.least + pieces.step * (static_cast<double>(i) + u);
  return {value_at(piece.length, u),
          value_at(piece.m, u),
          slope_at(piece.m, u) / pieces.step,
          normal,
          slope_at(piece.normal, u) / pieces.step,
          on_drum ? std::max(0.0, wound_up_ - clamped_theta - normal) : 0.0};
}

}  // namespace fusee::joint
