#include "optimize/sharp.h"

// Upper line: with n = (cos γ, sin γ), t = n' and C − P = (x, y) in the link's frame, (C − P)·n = ρ and (C − P)·t = f.
// Differentiated: f dγ = dρ − cos γ dx − sin γ dy. With x = −(e cos θ + oe sin θ) and y = R + oe cos θ − e sin θ:
//   f ∂γ = ∂ρ − sin γ ∂R + cos(γ − θ) ∂e − sin(γ − θ) ∂oe + (e sin(γ − θ) + oe cos(γ − θ)) ∂θ.
// Lower line: (e, ef)·n = p − ρ with n = (cos ν, sin ν) gives  w ∂ν = ∂p − ∂ρ − cos ν ∂e − sin ν ∂ef.
//
// Call only while a RoundingUp exists.

namespace fusee::optimize {
namespace {

using Arguments = std::array<transmission::Interval, 4>;

/// The arguments at which a function with these slopes has its minimum or maximum. An argument whose slope has no
/// constant sign stays an interval.
Arguments at_extreme(const Arguments& arguments, const Arguments& slopes, bool largest) {
  Arguments ends = arguments;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (slopes[i].lower() >= 0) ends[i] = largest ? arguments[i].upper() : arguments[i].lower();
    if (slopes[i].upper() <= 0) ends[i] = largest ? arguments[i].lower() : arguments[i].upper();
  }
  return ends;
}

/// Tightens `value` by evaluating at the ends. Only the signs of the slopes are used.
template <typename Value, typename Slopes>
transmission::Interval between_ends(const Arguments& arguments, transmission::Interval value, Value value_of,
                                    Slopes slopes_of) {
  constexpr int k_rounds = 3;  // a tighter value gives tighter slopes
  const auto is_number = [](const transmission::Interval& argument) { return argument.lower() == argument.upper(); };
  if (std::all_of(arguments.begin(), arguments.end(), is_number)) return value;
  for (int round = 0; round < k_rounds; ++round) {
    const Arguments slopes = slopes_of(value);
    const transmission::Interval least = value_of(at_extreme(arguments, slopes, false)),
                                 largest = value_of(at_extreme(arguments, slopes, true));
    const double low = std::max(value.lower(), least.lower()), high = std::min(value.upper(), largest.upper());
    if (!(low <= high) || (low == value.lower() && high == value.upper())) break;
    value = {low, high};
  }
  return value;
}

/// Normal and length of a tangent line, and whether its start lies outside the circle everywhere.
struct TangentLine {
  transmission::Interval normal, reach;
  transmission::Domain domain;
};

TangentLine upper_of(const transmission::Interval& x, const transmission::Interval& y,
                     const transmission::Interval& rho) {
  TangentLine line;
  const transmission::Interval distance = transmission::sqrt(transmission::squared(x) + transmission::squared(y));
  const transmission::Interval towards =
      transmission::direction(transmission::Jet(x), transmission::Jet(y), line.domain).value;
  line.normal = towards - transmission::acos(transmission::unit_part(rho / distance, line.domain));
  line.reach = transmission::sqrt(transmission::positive_part(
      transmission::squared(x) + transmission::squared(y) - transmission::squared(rho), line.domain));
  return line;
}

TangentLine lower_of(const transmission::Interval& p, const transmission::Interval& rho,
                     const transmission::Interval& e, const transmission::Interval& ef) {
  TangentLine line;
  const transmission::Interval beyond = p - rho, square = transmission::squared(e) + transmission::squared(ef);
  const transmission::Interval towards =
      transmission::direction(transmission::Jet(e), transmission::Jet(ef), line.domain).value;
  line.normal = towards - transmission::acos(transmission::unit_part(beyond / transmission::sqrt(square), line.domain));
  line.reach = transmission::sqrt(transmission::positive_part(square - transmission::squared(beyond), line.domain));
  return line;
}

int count_of(std::initializer_list<const transmission::Jet*> jets) {
  int count = 0;
  for (const transmission::Jet* jet : jets) count = std::max(count, jet->count);
  return count;
}

}  // namespace

SharpLine sharp_upper_line(const transmission::Jet& R, const transmission::Jet& e, const transmission::Jet& oe,
                           const transmission::Jet& rho, const transmission::RotationAngle<transmission::Jet>& theta,
                           transmission::Domain& domain) {
  const transmission::Interval sine = theta.sine.value, cosine = theta.cosine.value, angle = theta.angle.value;
  const auto line_at = [&](const Arguments& a) {
    return upper_of(-(a[1] * cosine + a[2] * sine), a[0] + a[2] * cosine - a[1] * sine, a[3]);
  };
  const Arguments arguments{R.value, e.value, oe.value, rho.value};
  const TangentLine crude = line_at(arguments);
  domain.possible = domain.possible && crude.domain.possible;
  domain.whole = domain.whole && crude.domain.whole;
  if (!crude.domain.possible || !crude.domain.whole)
    return {transmission::Jet(crude.normal), transmission::Jet(crude.reach)};
  // Slopes times f, which is positive.
  const auto slopes_at = [&](const transmission::Interval& gamma) {
    return Arguments{-transmission::sin(gamma), transmission::cos(gamma - angle), -transmission::sin(gamma - angle),
                     transmission::Interval(1.0)};
  };
  const transmission::Interval gamma = between_ends(
      arguments, crude.normal, [&](const Arguments& a) { return line_at(a).normal; }, slopes_at);
  const int count = count_of({&R, &e, &oe, &rho, &theta.angle});
  if (count == 0) return {transmission::Jet(gamma), transmission::Jet(crude.reach)};
  const Arguments slopes = slopes_at(gamma);
  const transmission::Interval by_angle = e.value * -slopes[2] + oe.value * slopes[1];
  SharpLine line{transmission::Jet(gamma), transmission::Jet(crude.reach)};
  line.normal.count = line.reach.count = count;
  // Derivatives of the line's length: C moves along the line, or the tangent point moves round the pin.
  const transmission::Interval along_R = transmission::cos(gamma);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const transmission::Interval turned = slopes[0] * R.slope[i] + slopes[1] * e.slope[i] + slopes[2] * oe.slope[i] +
                                          rho.slope[i] + by_angle * theta.angle.slope[i];
    line.normal.slope[i] = turned / crude.reach;
    // f = (C − P)·t: dx t_x + dy t_y − ρ dγ
    const transmission::Interval moved = along_R * R.slope[i] + -slopes[2] * e.slope[i] + slopes[1] * oe.slope[i] +
                                         (-(oe.value * slopes[2]) - e.value * slopes[1]) * theta.angle.slope[i];
    line.reach.slope[i] = moved - rho.value * line.normal.slope[i];
  }
  return line;
}

SharpLine sharp_lower_line(const transmission::Jet& p, const transmission::Jet& rho, const transmission::Jet& e,
                           const transmission::Jet& ef, transmission::Domain& domain) {
  const auto line_at = [](const Arguments& a) { return lower_of(a[0], a[1], a[2], a[3]); };
  const Arguments arguments{p.value, rho.value, e.value, ef.value};
  const TangentLine crude = line_at(arguments);
  domain.possible = domain.possible && crude.domain.possible;
  domain.whole = domain.whole && crude.domain.whole;
  if (!crude.domain.possible || !crude.domain.whole)
    return {transmission::Jet(crude.normal), transmission::Jet(crude.reach)};
  const auto slopes_at = [](const transmission::Interval& normal) {
    return Arguments{transmission::Interval(1.0), transmission::Interval(-1.0), -transmission::cos(normal),
                     -transmission::sin(normal)};
  };
  const transmission::Interval normal = between_ends(
      arguments, crude.normal, [&](const Arguments& a) { return line_at(a).normal; }, slopes_at);
  const int count = count_of({&p, &rho, &e, &ef});
  if (count == 0) return {transmission::Jet(normal), transmission::Jet(crude.reach)};
  const Arguments slopes = slopes_at(normal);
  SharpLine line{transmission::Jet(normal), transmission::Jet(crude.reach)};
  line.normal.count = line.reach.count = count;
  const transmission::Interval beyond = p.value - rho.value;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    line.normal.slope[i] = (p.slope[i] - rho.slope[i] + slopes[2] * e.slope[i] + slopes[3] * ef.slope[i]) / crude.reach;
    line.reach.slope[i] =
        (e.value * e.slope[i] + ef.value * ef.slope[i] - beyond * (p.slope[i] - rho.slope[i])) / crude.reach;
  }
  return line;
}

}  // namespace fusee::optimize
