// Length of a tendon in space. The pins are smooth cylinders parallel to the axis. Unrolled, the free path is straight
// with planar length L and rise Δ. The wound part has planar length σ and slope tan λ:
//
//   Λ + σ/cos λ = const        Λ = L − L' + √(L'² + Δ²)        Δ = Δ0 ± σ tan λ
//
// L' is the part of L that rises: the span below the guide with collars, else all of it. Hence L + σ = q + const with
//   q = −(Λ − L) − σ (1/cos λ − 1)                                                                    [H1]
// and from d(L + σ) = −m dθ + p dα in the plane, with the moment arms m about the joint's axis and p about the
// pulley's: p = m dθ/dα + dq/dα                                                                         [H2]
// For a round P1 this gives θ(α) = θ_planar(α + q1/r1). q is a few tenths of a mm and is found by fixed-point
// iteration: each round reduces the residual by about the sines of both slopes.
//
// [H2] reads dq = −(1 − cos δ)/(cos λ cos φ) dσ, with φ the slope of the path and δ the fleet angle between path and
// groove. A tendon that leaves its groove in the groove's direction (δ = 0) has its planar radius.

#include <algorithm>
#include <cmath>

#include "helix/winding.h"

namespace fusee::helix {
namespace {

constexpr int k_nodes = 48;  ///< number of nodes of the Chebyshev series of q
/// Directions per turn at which neighbouring turns are compared.
constexpr int k_directions = 72;
constexpr int k_coarse_directions = 18;
/// Margin on the lead: between the sampled directions a pair of turns may need slightly more.
constexpr double k_lead_margin = 1.005;
/// Change of q from round to round at which the iteration ends. mm
constexpr double k_converged = 1e-10;
/// Rounds of the fixed-point iteration.
constexpr int k_rounds = 16;
constexpr int k_coarse_rounds = 2;

/// Sets the slope and the lead that the tightest pair of neighbouring turns requires. `wanted`: the lead that the file
/// declares, 0 for the least one.
void set_lead(HelixGeometry& geometry, const PitchSpiral& curve, transmission::Side side, const MinLead& least_lead,
              double wanted, HelixAccuracy accuracy) {
  const int directions = accuracy == HelixAccuracy::coarse ? k_coarse_directions : k_directions;
  double least_slope = 0, circumference = 1e300;
  for (double psi = curve.begin(); psi + k_two_pi <= curve.end() + 1e-9; psi += k_two_pi / directions) {
    const SpiralPoint here = curve.at(psi), next = curve.at(psi + k_two_pi);
    const double turn_length = next.sigma - here.sigma;
    const double step = transmission::mirror_sign(side) * (next.curve.h - here.curve.h);
    const double needed_slope = least_lead(step) / turn_length;
    circumference = std::min(circumference, turn_length);
    if (needed_slope <= least_slope) continue;
    least_slope = needed_slope;
    geometry.tightest_at = psi;
  }
  geometry.circumference = circumference;
  geometry.needed_lead = k_lead_margin * least_slope * circumference;
  geometry.slope = (wanted > 0 ? wanted : geometry.needed_lead) / circumference;
}

/// One tendon at one point of the stroke: its free path, and σ, the planar length wound since home.
struct WindingPoint {
  FreePath path;
  double sigma = 0;
};

/// HelixGeometry::below with the smallest fleet angles: the largest positive and negative ones are equal. Fleet angles
/// grow with it, so it is bisected.
double below_of_smallest_fleet(HelixGeometry geometry, transmission::Side side,
                               const std::vector<WindingPoint>& points) {
  double low = -1e4, high = 1e4;  // mm, far beyond any part
  for (int i = 0; i < 100; ++i) {
    geometry.below = 0.5 * (low + high);
    double least = 1e9, most = -1e9;  // rad, beyond any angle
    for (const WindingPoint& point : points) {
      const double fleet = helix_point(geometry, side, point.path, point.sigma).fleet;
      least = std::min(least, fleet);
      most = std::max(most, fleet);
    }
    (least + most > 0 ? high : low) = geometry.below;
  }
  return 0.5 * (low + high);
}

/// [H1], with Λ − L = Δ²/(√(L'² + Δ²) + L').
double q_of(const HelixGeometry& geometry, transmission::Side side, const WindingPoint& point) {
  const double up = rise(geometry, side, point.sigma);
  const double sloping_in_space = elementary::hypot(point.path.sloping, up);
  const double secant = std::sqrt(1.0 + geometry.slope * geometry.slope);  // 1/cos λ
  return -up * up / (sloping_in_space + point.path.sloping) - point.sigma * (secant - 1.0);
}

/// One round of the fixed-point iteration for one side.
struct SideIteration {
  HelixGeometry geometry;
  std::vector<double> q;  ///< at the nodes, relative to home, mm
  double change = 0;      ///< largest difference from the previous round's q, relative to home, mm
};

/// `before`: q of the round before, null in the first round.
SideIteration solve_side(const Mechanism& mechanism, const transmission::Transmission& transmission,
                         transmission::Side side, const transmission::ChebyshevSeries* before,
                         const MinLead& least_lead, const std::vector<double>& nodes, HelixAccuracy accuracy) {
  const profile::TakeOffs take_offs(transmission, side);
  const PitchSpiral curve(mechanism, take_offs, before);
  SideIteration round;
  set_lead(round.geometry, curve, side, least_lead, mechanism.body.lead, accuracy);
  const auto point_of = [&](const profile::TakeOff& take_off) {
    return WindingPoint{curve.free_path(take_off), curve.sigma(take_off)};
  };
  std::vector<WindingPoint> points;
  for (const profile::TakeOff& sample : curve.samples()) points.push_back(point_of(sample));
  round.geometry.below = below_of_smallest_fleet(round.geometry, side, points);
  const double home_q = q_of(round.geometry, side, point_of(take_offs.at(0.0)));
  for (const double alpha : nodes) {
    const profile::TakeOff take_off = take_offs.at(transmission::mirror_sign(side) * transmission.theta(alpha));
    round.q.push_back(q_of(round.geometry, side, point_of(take_off)) - home_q);
  }
  // Checked between the nodes too, so that a series too short for the curve shows.
  const double previous_home_q = before != nullptr ? before->at(0.0).d0 : 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double previous = before != nullptr ? before->at(curve.samples()[i].stroke.alpha).d0 - previous_home_q : 0.0;
    round.change = std::max(round.change, std::abs(q_of(round.geometry, side, points[i]) - home_q - previous));
  }
  return round;
}

}  // namespace

HelixPoint helix_point(const HelixGeometry& geometry, transmission::Side side, const FreePath& path, double sigma) {
  HelixPoint point;
  const double up = rise(geometry, side, sigma);
  point.slope = elementary::atan2(up, path.sloping);
  point.fleet = point.slope + helix_sign(side) * elementary::atan(geometry.slope);
  point.free = path.whole - path.sloping + elementary::hypot(path.sloping, up);
  point.wound = sigma * std::sqrt(1.0 + geometry.slope * geometry.slope);
  return point;
}

Windings wind(const Mechanism& mechanism, const MinLead& least_lead, HelixAccuracy accuracy) {
  const int rounds = accuracy == HelixAccuracy::coarse ? k_coarse_rounds : k_rounds;
  Windings windings;
  windings.transmission = std::make_unique<transmission::Transmission>(mechanism);
  for (int i = 0; i < rounds; ++i) {
    const transmission::Transmission& law = *windings.transmission;
    const std::vector<double> nodes = transmission::ChebyshevSeries::nodes(law.alpha_min(), law.alpha_max(), k_nodes);
    const transmission::SlopedPaths* before = windings.paths.get();
    const SideIteration left = solve_side(mechanism, law, transmission::Side::left, before ? &before->q1 : nullptr,
                                          least_lead, nodes, accuracy);
    const SideIteration right = solve_side(mechanism, law, transmission::Side::right, before ? &before->q2 : nullptr,
                                           least_lead, nodes, accuracy);
    const double closure = std::max(left.change, right.change);
    const bool has_stalled = i > 2 && closure > 0.5 * windings.closure;
    windings.geometry = {left.geometry, right.geometry};
    windings.closure = closure;
    if (before != nullptr && (closure < k_converged || has_stalled)) break;
    constexpr double k_least_coefficient = 1e-12;
    windings.paths = std::make_shared<transmission::SlopedPaths>(transmission::SlopedPaths{
        transmission::ChebyshevSeries(law.alpha_min(), law.alpha_max(), left.q, k_least_coefficient),
        transmission::ChebyshevSeries(law.alpha_min(), law.alpha_max(), right.q, k_least_coefficient)});
    windings.transmission = std::make_unique<transmission::Transmission>(mechanism, windings.paths);
  }
  // Coarse curves are not expected to converge.
  if (accuracy == HelixAccuracy::coarse) windings.closure = 0;
  return windings;
}

}  // namespace fusee::helix
