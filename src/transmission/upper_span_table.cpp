#include "transmission/upper_span_table.h"

#include <algorithm>
#include <cmath>

namespace fusee {
namespace {

constexpr std::size_t k_pieces = 1024;

/// The cubic with these values and slopes at the ends of [0, 1].
struct Cubic {
  explicit Cubic(double u) : a(u * u * (2.0 * u - 3.0) + 1.0), b(u * (u - 1.0) * (u - 1.0)), c(u * u * (3.0 - 2.0 * u)), d(u * u * (u - 1.0)) {}
  double operator()(double from, double slope_from, double to, double slope_to) const { return a * from + b * slope_from + c * to + d * slope_to; }
  double a, b, c, d;
};

}  // namespace

UpperSpanTable::UpperSpanTable(const PinPlace& place, double least, double most) : least_(least), step_((most - least) / k_pieces) {
  knots_.reserve(k_pieces + 1);
  for (std::size_t i = 0; i <= k_pieces; ++i) {
    const double theta = least + step_ * static_cast<double>(i);
    const UpperSpan span = upper_span(place, theta);
    knots_.push_back({span.length, span.m, span.dm, span.d2m, span.normal, -place.R * std::cos(theta + span.normal) / span.free});
  }
}

UpperSpanTable::Look UpperSpanTable::at(double theta) const {
  const double place = std::clamp((theta - least_) / step_, 0.0, static_cast<double>(k_pieces));
  const std::size_t i = std::min(static_cast<std::size_t>(place), k_pieces - 1);
  const double u = place - static_cast<double>(i);
  const Cubic cubic(u);
  const Knot& from = knots_[i];
  const Knot& to = knots_[i + 1];
  return {cubic(from.length, -step_ * from.m, to.length, -step_ * to.m),
          cubic(from.m, step_ * from.dm, to.m, step_ * to.dm),
          cubic(from.dm, step_ * from.d2m, to.dm, step_ * to.d2m),
          cubic(from.normal, step_ * from.dnormal, to.normal, step_ * to.dnormal),
          from.dnormal + u * (to.dnormal - from.dnormal)};
}

}  // namespace fusee
