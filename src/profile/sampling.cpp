#include "profile/sampling.h"

#include <algorithm>
#include <cmath>

namespace fusee::profile {
namespace {

/// Spacing of curvature probes: the radius of a nearly straight part doubles within half a degree.
constexpr double k_probe = radians(0.2);
/// Directions closer than this are merged: a strip between them would be a sliver.
constexpr double k_smallest_turn = radians(0.1);
/// Chords with a smaller turn are not halved. On large parts, neither are chords whose half would be shorter than this,
/// mm: next to a bridge of 0.2 m a chord with a turn of 0.02° has a sagitta of 9 µm.
constexpr double k_finest_turn = radians(0.02);
constexpr double k_shortest_half = 0.02;

/// P1's curve in the world: the mirror image of its right-hand image.
CurvePoint mirrored(const PitchCurve& image, double psi) {
  CurvePoint point = image.at(k_pi - psi);
  point.psi = psi;
  point.dh = -point.dh;
  return point;
}

/// Largest number of chords between two ends. A circle of radius half a metre needs as many within a nanometre.
constexpr double k_max_chords = 5e4;

/// The largest turn at ψ that satisfies the tolerance on both curves and their parallels. The sagitta of a chord is
/// chord · turn / 8. No chord exceeds `longest`, which bounds the number of chords.
double allowed_turn(const PitchCurve& left, const PitchCurve& right, double psi, double longest,
                    const SamplingOptions& options) {
  const double radius = std::max(left.radius(k_pi - psi), right.radius(psi)) + options.reach;
  const double of_an_arc = std::sqrt(8.0 * options.chord_error_mm / radius),
               of_a_straight = 8.0 * options.chord_error_mm / longest;
  return std::min(options.largest_turn, std::max(of_an_arc, of_a_straight));
}

/// Upper bound on the length of any chord of both curves and their parallels, with room for points between the sampled
/// ones. mm
double longest_chord(const PitchCurve& left, const PitchCurve& right, const SamplingOptions& options) {
  constexpr int k_directions = 64;
  double furthest = 0;
  for (int i = 0; i < k_directions; ++i) {
    const double psi = k_two_pi * i / k_directions;
    furthest = std::max({furthest, mirrored(left, psi).position().norm(), right.at(psi).position().norm()});
  }
  return 4.0 * furthest + 2.0 * options.reach;
}

/// Part of the tolerance that is kept for rounding to a mesh's floats at distance `reach` from the axis. Rounding moves
/// x and y by up to reach · 2⁻²⁴ each. The first 1e-5 mm of it, all on a pulley of up to 0.23 m in diameter, need no
/// reduction.
double tolerance_lost_to_floats(double reach, double chord_error_mm) {
  constexpr double k_ignored = 1e-5;  // mm
  return std::clamp(reach * 0x1p-24 * std::sqrt(2.0) - k_ignored, 0.0, 0.5 * chord_error_mm);
}

/// Appends directions from `begin` to `end` (exclusive) with the density that the tolerance requires.
void append_directions(std::vector<double>& directions, const PitchCurve& left, const PitchCurve& right, double begin,
                       double end, double longest, const SamplingOptions& options) {
  const int probes = std::max(8, static_cast<int>(std::ceil((end - begin) / k_probe)));
  std::vector<double> count(static_cast<std::size_t>(probes) + 1, 0.0);  // chords needed from `begin` to each probe
  double previous = 1.0 / allowed_turn(left, right, begin, longest, options);
  for (int i = 1; i <= probes; ++i) {
    const double psi = begin + (end - begin) * i / probes;
    const double density = 1.0 / allowed_turn(left, right, psi, longest, options);
    // The denser end of the step counts, so that the bound on the sagitta holds within the step.
    count[static_cast<std::size_t>(i)] =
        count[static_cast<std::size_t>(i) - 1] + std::max(previous, density) * (end - begin) / probes;
    previous = density;
  }
  const int chords = static_cast<int>(std::clamp(std::ceil(count.back()), 1.0, k_max_chords));
  std::size_t probe = 1;
  for (int i = 0; i < chords; ++i) {
    const double wanted = count.back() * i / chords;
    while (count[probe] < wanted) ++probe;
    const double fraction = (wanted - count[probe - 1]) / (count[probe] - count[probe - 1]);
    directions.push_back(begin + (end - begin) * (static_cast<double>(probe - 1) + fraction) / probes);
  }
}

/// The wanted directions within one turn from the first, with near ones merged.
std::vector<double> merge_near(std::vector<double> wanted) {
  const double first = wanted.front();
  for (double& psi : wanted) psi = turned_into(first, psi);
  std::sort(wanted.begin(), wanted.end());
  std::vector<double> apart{first};
  for (const double psi : wanted) {
    if (psi - apart.back() > k_smallest_turn && first + k_two_pi - psi > k_smallest_turn) apart.push_back(psi);
  }
  return apart;
}

OutlinePoint outline_point(const CurvePoint& curve) {
  return {curve.psi, curve.position(), unit(curve.psi), curve.radius};
}

/// Points of both curves in one direction.
struct Pair {
  OutlinePoint left, right;

  double psi() const { return right.psi; }
};
Pair pair_at(const PitchCurve& left, const PitchCurve& right, double psi) {
  return {outline_point(mirrored(left, psi)), outline_point(right.at(psi))};
}

/// Index of the point whose direction is nearest to ψ.
std::size_t nearest(const std::vector<Pair>& points, double psi) {
  const double first = points.front().psi(), wanted = turned_into(first, psi);
  const auto above = std::lower_bound(points.begin(), points.end(), wanted,
                                      [](const Pair& point, double value) { return point.psi() < value; });
  if (above == points.begin()) return 0;
  const auto index = static_cast<std::size_t>(above - points.begin());
  const double above_value = above == points.end() ? first + k_two_pi : above->psi();
  return wanted - (above - 1)->psi() < above_value - wanted ? index - 1 : index % points.size();
}

/// Next to a bridge over a hollow, a drawn curve bends within one probe. Chords there are halved until their sagitta,
/// as an arc, is within the tolerance, or the maximum number of chords is reached.
void halve_coarse_chords(std::vector<Pair>& points, const PitchCurve& left, const PitchCurve& right, double longest,
                         const SamplingOptions& options) {
  constexpr int k_halvings = 12;
  // longest_chord() is about four times the distance of the outermost point from the axis.
  const double reach = 0.25 * longest, finest = std::min(k_finest_turn, 2.0 * k_shortest_half / reach);
  const Pair end = pair_at(left, right, points.front().psi() + k_two_pi);
  for (int pass = 0; pass < k_halvings; ++pass) {
    std::vector<Pair> finer;
    finer.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Pair &here = points[i], &next = i + 1 < points.size() ? points[i + 1] : end;
      finer.push_back(here);
      const double chord = std::max((next.right.position - here.right.position).norm(),
                                    (next.left.position - here.left.position).norm());
      const double turn = next.psi() - here.psi();
      if (turn > finest && chord * turn / 8.0 > options.chord_error_mm)
        finer.push_back(pair_at(left, right, 0.5 * (here.psi() + next.psi())));
    }
    if (finer.size() == points.size() || static_cast<double>(finer.size()) > k_max_chords) return;
    points = std::move(finer);
  }
}

}  // namespace

std::array<Outline, 2> sample(const PitchCurve& left, const PitchCurve& right, const SamplingOptions& requested) {
  const double right_first = right.active_begin(), right_last = right.active_end();
  const double left_first = k_pi - left.active_end(), left_last = k_pi - left.active_begin();
  std::vector<double> wanted{right_first, right_last, left_first, left_last};
  for (const double psi : right.straight_directions())
    wanted.insert(wanted.end(), {psi - k_smallest_turn, psi + k_smallest_turn});
  for (const double psi : left.straight_directions()) {
    wanted.insert(wanted.end(), {k_pi - psi - k_smallest_turn, k_pi - psi + k_smallest_turn});
  }
  const std::vector<double> mandatory = merge_near(std::move(wanted));
  const double longest = longest_chord(left, right, requested);
  const SamplingOptions options{
      requested.chord_error_mm - tolerance_lost_to_floats(0.25 * longest, requested.chord_error_mm), requested.reach,
      requested.largest_turn};
  std::vector<double> directions;
  for (std::size_t i = 0; i < mandatory.size(); ++i) {
    const double end = i + 1 < mandatory.size() ? mandatory[i + 1] : mandatory.front() + k_two_pi;
    append_directions(directions, left, right, mandatory[i], end, longest, options);
  }

  std::vector<Pair> points;
  points.reserve(directions.size());
  for (const double psi : directions) points.push_back(pair_at(left, right, psi));
  halve_coarse_chords(points, left, right, longest, options);

  std::array<Outline, 2> outlines;
  outlines[0] = {transmission::Side::left, {}, nearest(points, left_first), nearest(points, left_last)};
  outlines[1] = {transmission::Side::right, {}, nearest(points, right_first), nearest(points, right_last)};
  for (const Pair& point : points) {
    outlines[0].points.push_back(point.left);
    outlines[1].points.push_back(point.right);
  }
  return outlines;
}

}  // namespace fusee::profile
