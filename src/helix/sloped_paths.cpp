// The length of a tendon in space. The pins are smooth cylinders along the axis: unrolled, the free path is straight,
// of planar length L and rise Δ; what is wound has the planar length σ and the slope tan λ:
//
//   Λ + σ/cos λ = const        Λ = L − L' + √(L'² + Δ²)        Δ = Δ0 ± σ tan λ
//
// with L' the part of L that rises (with collars the span below the guide, else all of it). So L + σ = q + const with
//   q = −(Λ − L) − σ (1/cos λ − 1)                                                                    [H1]
// and from d(L + σ) = −m dθ + p dα in the plane: p = m dθ/dα + dq/dα                                  [H2]
// (for a round P1 the same gives θ(α) = θ_planar(α + q1/r1)). q is found by putting in the curves that it gives: it is
// a few tenths of a mm, and each round brings what is left down by the sines of two slopes.
//
// [H2] is dq = −(1 − cos δ)/(cos λ cos φ) dσ, φ the slope of the path and δ the fleet angle between it and the groove:
// a tendon that leaves its groove in the groove's own direction has its planar radius.

#include <algorithm>
#include <cmath>

#include "helix/winding.h"

namespace fusee {
namespace {

constexpr int k_nodes = 48;
constexpr int k_places_of_turn = 72;
constexpr int k_places_of_brief_turn = 18;
/// Between the places that are looked at a pair of turns may need a little more.
constexpr double k_spare_lead = 1.005;
constexpr double k_settled = 1e-10;  // mm

/// The least height from turn to turn, and what the tightest pair of them needs.
void look_at_turns(Climb& climb, const PitchSpiral& curve, Side side, const LeastLead& least_lead, double wanted,
                   HelixLook closely) {
  const int places = closely == HelixLook::brief ? k_places_of_brief_turn : k_places_of_turn;
  double least_slope = 0, circumference = 1e300;
  for (double psi = curve.begin(); psi + k_two_pi <= curve.end() + 1e-9; psi += k_two_pi / places) {
    const SpiralPoint here = curve.at(psi), next = curve.at(psi + k_two_pi);
    const double around = next.sigma - here.sigma;
    const double step = mirror_sign(side) * (next.curve.h - here.curve.h);
    const double needed = least_lead(step) / around;
    circumference = std::min(circumference, around);
    if (needed <= least_slope) continue;
    least_slope = needed;
    climb.tightest_at = psi;
  }
  climb.circumference = circumference;
  climb.needed_lead = k_spare_lead * least_slope * circumference;
  climb.slope = (wanted > 0 ? wanted : climb.needed_lead) / circumference;
}

struct Place {
  FreePath path;
  double sigma = 0;
};

/// The rise at home with which the largest fleet angles of both signs are the same.
double smallest_fleet(Climb climb, Side side, const std::vector<Place>& places) {
  double low = -1e4, high = 1e4;
  for (int i = 0; i < 100; ++i) {
    climb.below = 0.5 * (low + high);
    double least = 1e9, most = -1e9;
    for (const Place& place : places) {
      const double fleet = helix_point(climb, side, place.path, place.sigma).fleet;
      least = std::min(least, fleet);
      most = std::max(most, fleet);
    }
    (least + most > 0 ? high : low) = climb.below;
  }
  return 0.5 * (low + high);
}

double q_of(const Climb& climb, Side side, const Place& place) {
  const double up = rise(climb, side, place.sigma);
  const double sloping = std::hypot(place.path.sloping, up);
  const double secant = std::sqrt(1.0 + climb.slope * climb.slope);
  return -up * up / (sloping + place.path.sloping) - place.sigma * (secant - 1.0);
}

struct SideRound {
  Climb climb;
  std::vector<double> q;  ///< at the nodes
  double settled = 0;     ///< largest difference from the q that the curves were drawn with, home's apart, mm
};

SideRound look(const Mechanism& mechanism, const Transmission& transmission, Side side, const ChebyshevSeries* before,
               const LeastLead& least_lead, const std::vector<double>& nodes, HelixLook closely) {
  const TakeOffs take_offs(transmission, side);
  const PitchSpiral curve(mechanism, take_offs, before);
  SideRound round;
  look_at_turns(round.climb, curve, side, least_lead, mechanism.body.lead, closely);
  const auto place_of = [&](const TakeOff& take_off) {
    return Place{curve.free_path(take_off), curve.sigma(take_off)};
  };
  std::vector<Place> places;
  for (const TakeOff& sample : curve.samples()) places.push_back(place_of(sample));
  round.climb.below = smallest_fleet(round.climb, side, places);
  const double home = q_of(round.climb, side, place_of(take_offs.at(0.0)));
  for (const double alpha : nodes) {
    const TakeOff take_off = take_offs.at(mirror_sign(side) * transmission.theta(alpha));
    round.q.push_back(q_of(round.climb, side, place_of(take_off)) - home);
  }
  // Between the nodes too: what a series of this length cannot follow is seen here.
  const double drawn_home = before != nullptr ? before->at(0.0).d0 : 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double drawn = before != nullptr ? before->at(curve.samples()[i].stroke.alpha).d0 - drawn_home : 0.0;
    round.settled = std::max(round.settled, std::abs(q_of(round.climb, side, places[i]) - home - drawn));
  }
  return round;
}

}  // namespace

HelixPoint helix_point(const Climb& climb, Side side, const FreePath& path, double sigma) {
  HelixPoint point;
  const double up = rise(climb, side, sigma);
  point.slope = std::atan2(up, path.sloping);
  point.fleet = point.slope + climbing(side) * std::atan(climb.slope);
  point.free = path.whole - path.sloping + std::hypot(path.sloping, up);
  point.wound = sigma * std::sqrt(1.0 + climb.slope * climb.slope);
  return point;
}

Windings wind(const Mechanism& mechanism, const LeastLead& least_lead, HelixLook closely) {
  const int rounds = closely == HelixLook::brief ? 2 : 16;
  Windings windings;
  windings.transmission = std::make_unique<Transmission>(mechanism);
  for (int i = 0; i < rounds; ++i) {
    const Transmission& law = *windings.transmission;
    const std::vector<double> nodes = ChebyshevSeries::nodes(law.alpha_min(), law.alpha_max(), k_nodes);
    const SlopedPaths* before = windings.paths.get();
    const SideRound left = look(mechanism, law, Side::left, before ? &before->q1 : nullptr, least_lead, nodes, closely);
    const SideRound right =
        look(mechanism, law, Side::right, before ? &before->q2 : nullptr, least_lead, nodes, closely);
    const double closure = std::max(left.settled, right.settled);
    const bool no_better = i > 2 && closure > 0.5 * windings.closure;
    windings.climbs = {left.climb, right.climb};
    windings.closure = closure;
    if (before != nullptr && (closure < k_settled || no_better)) break;
    constexpr double k_least_coefficient = 1e-12;
    windings.paths = std::make_shared<SlopedPaths>(
        SlopedPaths{ChebyshevSeries(law.alpha_min(), law.alpha_max(), left.q, k_least_coefficient),
                    ChebyshevSeries(law.alpha_min(), law.alpha_max(), right.q, k_least_coefficient)});
    windings.transmission = std::make_unique<Transmission>(mechanism, windings.paths);
  }
  if (closely == HelixLook::brief) windings.closure = 0;
  return windings;
}

}  // namespace fusee
