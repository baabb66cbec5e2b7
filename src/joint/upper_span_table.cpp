#include "joint/upper_span_table.h"

#include <algorithm>
#include <cmath>

namespace fusee {
namespace {

constexpr std::size_t k_pieces = 160;

/// A curve's value, slope and curvature at an end of a piece, by pieces.
struct End {
  double value, slope, bend;
};

/// The quintic with these ends on [0, 1].
struct Quintic {
  Quintic(const End& from, const End& to) : c0(from.value), c1(from.slope), c2(0.5 * from.bend) {
    const double value = to.value - from.value - from.slope - 0.5 * from.bend;
    const double slope = to.slope - from.slope - from.bend;
    const double bend = to.bend - from.bend;
    c3 = 10.0 * value - 4.0 * slope + 0.5 * bend;
    c4 = -15.0 * value + 7.0 * slope - bend;
    c5 = 6.0 * value - 3.0 * slope + 0.5 * bend;
  }
  double at(double u) const { return c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5)))); }
  double slope(double u) const { return c1 + u * (2.0 * c2 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5))); }
  double c0, c1, c2, c3, c4, c5;
};

}  // namespace

// With f the free length, ψ the normal and a = R cos(θ + ψ): ψ' = −a/f, f' = −m − ρψ', and as a' = −m (1 + ψ'), ψ'' =
// (m (1 + ψ') − ψ' f')/f.
UpperSpanTable::UpperSpanTable(const PinPlace& place, double least, double most)
    : least_(least), step_((most - least) / k_pieces) {
  knots_.reserve(k_pieces + 1);
  for (std::size_t i = 0; i <= k_pieces; ++i) {
    const double theta = least + step_ * static_cast<double>(i);
    const UpperSpan span = upper_span(place, theta);
    const double dnormal = -place.R * std::cos(theta + span.normal) / span.free;
    const double dfree = -span.m - place.rho * dnormal;
    knots_.push_back({span.length, span.m, span.dm, span.d2m, span.normal, dnormal,
                      (span.m * (1.0 + dnormal) - dnormal * dfree) / span.free});
  }
}

UpperSpanTable::Look UpperSpanTable::at(double theta) const {
  const double place = std::clamp((theta - least_) / step_, 0.0, static_cast<double>(k_pieces));
  const std::size_t i = std::min(static_cast<std::size_t>(place), k_pieces - 1);
  const double u = place - static_cast<double>(i);
  const double h = step_;
  const Knot& from = knots_[i];
  const Knot& to = knots_[i + 1];
  const Quintic length({from.length, -h * from.m, -h * h * from.dm}, {to.length, -h * to.m, -h * h * to.dm});
  const Quintic m({from.m, h * from.dm, h * h * from.d2m}, {to.m, h * to.dm, h * h * to.d2m});
  const Quintic normal({from.normal, h * from.dnormal, h * h * from.d2normal},
                       {to.normal, h * to.dnormal, h * h * to.d2normal});
  return {length.at(u), m.at(u), m.slope(u) / h, normal.at(u), normal.slope(u) / h};
}

}  // namespace fusee
