#include "optimize/sharp.h"

// Upper line: with n = (cos γ, sin γ), t = n' and C − P = (x, y) in the link's frame, (C − P)·n = ρ and (C − P)·t = f.
// Differentiated: f dγ = dρ − cos γ dx − sin γ dy. With x = −(e cos θ + oe sin θ) and y = R + oe cos θ − e sin θ:
//   f ∂γ = ∂ρ − sin γ ∂R + cos(γ − θ) ∂e − sin(γ − θ) ∂oe + (e sin(γ − θ) + oe cos(γ − θ)) ∂θ.
// Lower line: (e, ef)·n = p − ρ with n = (cos ν, sin ν) gives  w ∂ν = ∂p − ∂ρ − cos ν ∂e − sin ν ∂ef.
//
// Call only while a RoundingUp exists.

namespace fusee {
namespace {

using Arguments = std::array<Interval, 4>;

/// The arguments at which a function with these slopes has its minimum or maximum.
Arguments at_end(const Arguments& arguments, const Arguments& slopes, bool largest) {
  Arguments ends = arguments;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (slopes[i].lower() >= 0) ends[i] = largest ? arguments[i].upper() : arguments[i].lower();
    if (slopes[i].upper() <= 0) ends[i] = largest ? arguments[i].lower() : arguments[i].upper();
  }
  return ends;
}

/// Tightens `value` by evaluating at the ends. Only the signs of the slopes are used.
template <typename Value, typename Slopes>
Interval between_ends(const Arguments& arguments, Interval value, Value value_of, Slopes slopes_of) {
  constexpr int k_rounds = 3;  // a tighter value gives tighter slopes
  const auto is_number = [](const Interval& argument) { return argument.lower() == argument.upper(); };
  if (std::all_of(arguments.begin(), arguments.end(), is_number)) return value;
  for (int round = 0; round < k_rounds; ++round) {
    const Arguments slopes = slopes_of(value);
    const Interval least = value_of(at_end(arguments, slopes, false)),
                   largest = value_of(at_end(arguments, slopes, true));
    const double low = std::max(value.lower(), least.lower()), high = std::min(value.upper(), largest.upper());
    if (!(low <= high) || (low == value.lower() && high == value.upper())) break;
    value = {low, high};
  }
  return value;
}

/// Direction and length of C − P, and whether C lies outside the pin's circle everywhere.
struct TangentLine {
  Interval normal, reach;
  Domain domain;
};

TangentLine upper_of(const Interval& x, const Interval& y, const Interval& rho) {
  TangentLine seen;
  const Interval distance = sqrt(squared(x) + squared(y));
  const Interval towards = direction(Jet(x), Jet(y), seen.domain).value;
  seen.normal = towards - acos(unit_part(rho / distance, seen.domain));
  seen.reach = sqrt(positive_part(squared(x) + squared(y) - squared(rho), seen.domain));
  return seen;
}

TangentLine lower_of(const Interval& p, const Interval& rho, const Interval& e, const Interval& ef) {
  TangentLine seen;
  const Interval beyond = p - rho, square = squared(e) + squared(ef);
  const Interval towards = direction(Jet(e), Jet(ef), seen.domain).value;
  seen.normal = towards - acos(unit_part(beyond / sqrt(square), seen.domain));
  seen.reach = sqrt(positive_part(square - squared(beyond), seen.domain));
  return seen;
}

int count_of(std::initializer_list<const Jet*> jets) {
  int count = 0;
  for (const Jet* jet : jets) count = std::max(count, jet->count);
  return count;
}

}  // namespace

SharpLine sharp_upper_line(const Jet& R, const Jet& e, const Jet& oe, const Jet& rho, const RotationAngle<Jet>& theta,
                           Domain& domain) {
  const Interval sine = theta.sine.value, cosine = theta.cosine.value, angle = theta.angle.value;
  const auto seen_from = [&](const Arguments& a) {
    return upper_of(-(a[1] * cosine + a[2] * sine), a[0] + a[2] * cosine - a[1] * sine, a[3]);
  };
  const Arguments arguments{R.value, e.value, oe.value, rho.value};
  const TangentLine crude = seen_from(arguments);
  domain.possible = domain.possible && crude.domain.possible;
  domain.whole = domain.whole && crude.domain.whole;
  if (!crude.domain.possible || !crude.domain.whole) return {Jet(crude.normal), Jet(crude.reach)};
  // Slopes times f, which is positive.
  const auto slopes_at = [&](const Interval& gamma) {
    return Arguments{-sin(gamma), cos(gamma - angle), -sin(gamma - angle), Interval(1.0)};
  };
  const Interval gamma = between_ends(
      arguments, crude.normal, [&](const Arguments& a) { return seen_from(a).normal; }, slopes_at);
  const int count = count_of({&R, &e, &oe, &rho, &theta.angle});
  if (count == 0) return {Jet(gamma), Jet(crude.reach)};
  const Arguments slopes = slopes_at(gamma);
  const Interval by_angle = e.value * -slopes[2] + oe.value * slopes[1];
  SharpLine line{Jet(gamma), Jet(crude.reach)};
  line.normal.count = line.reach.count = count;
  // Derivatives of the line's length: C moves along the line, or the tangent point moves round the pin.
  const Interval along_R = cos(gamma);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const Interval turned = slopes[0] * R.slope[i] + slopes[1] * e.slope[i] + slopes[2] * oe.slope[i] + rho.slope[i] +
                            by_angle * theta.angle.slope[i];
    line.normal.slope[i] = turned / crude.reach;
    // f = (C − P)·t: dx t_x + dy t_y − ρ dγ
    const Interval moved = along_R * R.slope[i] + -slopes[2] * e.slope[i] + slopes[1] * oe.slope[i] +
                           (-(oe.value * slopes[2]) - e.value * slopes[1]) * theta.angle.slope[i];
    line.reach.slope[i] = moved - rho.value * line.normal.slope[i];
  }
  return line;
}

SharpLine sharp_lower_line(const Jet& p, const Jet& rho, const Jet& e, const Jet& ef, Domain& domain) {
  const auto seen_from = [](const Arguments& a) { return lower_of(a[0], a[1], a[2], a[3]); };
  const Arguments arguments{p.value, rho.value, e.value, ef.value};
  const TangentLine crude = seen_from(arguments);
  domain.possible = domain.possible && crude.domain.possible;
  domain.whole = domain.whole && crude.domain.whole;
  if (!crude.domain.possible || !crude.domain.whole) return {Jet(crude.normal), Jet(crude.reach)};
  const auto slopes_at = [](const Interval& normal) {
    return Arguments{Interval(1.0), Interval(-1.0), -cos(normal), -sin(normal)};
  };
  const Interval normal = between_ends(
      arguments, crude.normal, [&](const Arguments& a) { return seen_from(a).normal; }, slopes_at);
  const int count = count_of({&p, &rho, &e, &ef});
  if (count == 0) return {Jet(normal), Jet(crude.reach)};
  const Arguments slopes = slopes_at(normal);
  SharpLine line{Jet(normal), Jet(crude.reach)};
  line.normal.count = line.reach.count = count;
  const Interval beyond = p.value - rho.value;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    line.normal.slope[i] = (p.slope[i] - rho.slope[i] + slopes[2] * e.slope[i] + slopes[3] * ef.slope[i]) / crude.reach;
    line.reach.slope[i] =
        (e.value * e.slope[i] + ef.value * ef.slope[i] - beyond * (p.slope[i] - rho.slope[i])) / crude.reach;
  }
  return line;
}

}  // namespace fusee
