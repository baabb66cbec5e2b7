// Length of a tendon in space. The pins are smooth cylinders parallel to the axis. Unrolled, the free path is straight
// with planar length L and rise Δ. The wound part has planar length σ and slope tan λ:
//
//   Λ + σ/cos λ = const        Λ = L − L' + √(L'² + Δ²)        Δ = Δ0 ± σ tan λ
//
// L' is the part of L that rises: the span below the guide with collars, else all of it. Hence L + σ = q + const with
//   q = −(Λ − L) − σ (1/cos λ − 1)                                                                    [H1]
// and from d(L + σ) = −m dθ + p dα in the plane: p = m dθ/dα + dq/dα                                  [H2]
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

constexpr int k_nodes = 48;
constexpr int k_places_of_turn = 72;
constexpr int k_places_of_coarse_turn = 18;
/// Margin on the lead: between the sampled places a pair of turns may need slightly more.
constexpr double k_lead_margin = 1.005;
constexpr double k_converged = 1e-10;  // mm

/// Finds the least height from turn to turn, and the lead that the tightest pair requires.
void set_lead(HelixGeometry& geometry, const PitchSpiral& curve, transmission::Side side, const MinLead& least_lead,
              double wanted, HelixAccuracy accuracy) {
  const int places = accuracy == HelixAccuracy::coarse ? k_places_of_coarse_turn : k_places_of_turn;
  double least_slope = 0, circumference = 1e300;
  for (double psi = curve.begin(); psi + k_two_pi <= curve.end() + 1e-9; psi += k_two_pi / places) {
    const SpiralPoint here = curve.at(psi), next = curve.at(psi + k_two_pi);
    const double around = next.sigma - here.sigma;
    const double step = transmission::mirror_sign(side) * (next.curve.h - here.curve.h);
    const double needed = least_lead(step) / around;
    circumference = std::min(circumference, around);
    if (needed <= least_slope) continue;
    least_slope = needed;
    geometry.tightest_at = psi;
  }
  geometry.circumference = circumference;
  geometry.needed_lead = k_lead_margin * least_slope * circumference;
  geometry.slope = (wanted > 0 ? wanted : geometry.needed_lead) / circumference;
}

/// A free path, and the wound length at its take-off.
struct WindingPlace {
  FreePath path;
  double sigma = 0;
};

/// Bisects the rise at home at which the largest positive and negative fleet angles are equal.
double smallest_fleet(HelixGeometry geometry, transmission::Side side, const std::vector<WindingPlace>& places) {
  double low = -1e4, high = 1e4;
  for (int i = 0; i < 100; ++i) {
    geometry.below = 0.5 * (low + high);
    double least = 1e9, most = -1e9;
    for (const WindingPlace& place : places) {
      const double fleet = helix_point(geometry, side, place.path, place.sigma).fleet;
      least = std::min(least, fleet);
      most = std::max(most, fleet);
    }
    (least + most > 0 ? high : low) = geometry.below;
  }
  return 0.5 * (low + high);
}

double q_of(const HelixGeometry& geometry, transmission::Side side, const WindingPlace& place) {
  const double up = rise(geometry, side, place.sigma);
  const double sloping = elementary::hypot(place.path.sloping, up);
  const double secant = std::sqrt(1.0 + geometry.slope * geometry.slope);
  return -up * up / (sloping + place.path.sloping) - place.sigma * (secant - 1.0);
}

struct SideIteration {
  HelixGeometry geometry;
  std::vector<double> q;  ///< at the nodes
  double change = 0;      ///< largest difference from the previous round's q, relative to home, mm
};

SideIteration solve_side(const Mechanism& mechanism, const transmission::Transmission& transmission,
                         transmission::Side side, const transmission::ChebyshevSeries* before,
                         const MinLead& least_lead, const std::vector<double>& nodes, HelixAccuracy accuracy) {
  const profile::TakeOffs take_offs(transmission, side);
  const PitchSpiral curve(mechanism, take_offs, before);
  SideIteration round;
  set_lead(round.geometry, curve, side, least_lead, mechanism.body.lead, accuracy);
  const auto place_of = [&](const profile::TakeOff& take_off) {
    return WindingPlace{curve.free_path(take_off), curve.sigma(take_off)};
  };
  std::vector<WindingPlace> places;
  for (const profile::TakeOff& sample : curve.samples()) places.push_back(place_of(sample));
  round.geometry.below = smallest_fleet(round.geometry, side, places);
  const double home = q_of(round.geometry, side, place_of(take_offs.at(0.0)));
  for (const double alpha : nodes) {
    const profile::TakeOff take_off = take_offs.at(transmission::mirror_sign(side) * transmission.theta(alpha));
    round.q.push_back(q_of(round.geometry, side, place_of(take_off)) - home);
  }
  // Checked between the nodes too, which shows a series too short for the curve.
  const double previous_home = before != nullptr ? before->at(0.0).d0 : 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double previous = before != nullptr ? before->at(curve.samples()[i].stroke.alpha).d0 - previous_home : 0.0;
    round.change = std::max(round.change, std::abs(q_of(round.geometry, side, places[i]) - home - previous));
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
  const int rounds = accuracy == HelixAccuracy::coarse ? 2 : 16;
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
    const bool no_better = i > 2 && closure > 0.5 * windings.closure;
    windings.geometry = {left.geometry, right.geometry};
    windings.closure = closure;
    if (before != nullptr && (closure < k_converged || no_better)) break;
    constexpr double k_least_coefficient = 1e-12;
    windings.paths = std::make_shared<transmission::SlopedPaths>(transmission::SlopedPaths{
        transmission::ChebyshevSeries(law.alpha_min(), law.alpha_max(), left.q, k_least_coefficient),
        transmission::ChebyshevSeries(law.alpha_min(), law.alpha_max(), right.q, k_least_coefficient)});
    windings.transmission = std::make_unique<transmission::Transmission>(mechanism, windings.paths);
  }
  if (accuracy == HelixAccuracy::coarse) windings.closure = 0;
  return windings;
}

}  // namespace fusee::helix
