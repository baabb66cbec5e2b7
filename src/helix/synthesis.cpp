#include <algorithm>
#include <cmath>

#include "fusee/helix.h"
#include "helix/conditions.h"
#include "helix/draw_spiral.h"
#include "helix/winding.h"
#include "profile/feasibility.h"
#include "transmission/alpha_range.h"

namespace fusee::helix {
namespace {

HelixSide make_helix_side(const Mechanism& mechanism, const Windings& windings, transmission::Side side,
                          const std::vector<transmission::TransmissionPoint>& stroke, const SpiralDrawing& drawing) {
  const std::size_t i = side == transmission::Side::left ? 0 : 1;
  const HelixGeometry& geometry = windings.geometry[i];
  const profile::TakeOffs take_offs(*windings.transmission, side);
  const PitchSpiral curve(mechanism, take_offs, i == 0 ? &windings.paths->q1 : &windings.paths->q2);
  HelixSide helix;
  helix.spiral = draw_spiral(curve, side, geometry.slope, drawing);
  helix.turns = (curve.working_end() - curve.working_begin()) / k_two_pi;
  helix.circumference = geometry.circumference;
  helix.lead = geometry.slope * geometry.circumference;
  // σ of the spiral's first row. P1 is drawn from the end of its mirrored curve.
  const double sigma0 = curve.at(side == transmission::Side::left ? curve.end() : curve.begin()).sigma;
  const double home_z = -helix_sign(side) * geometry.slope * sigma0;
  helix.attachment_z = home_z - geometry.below;
  for (const transmission::TransmissionPoint& point : stroke) {
    const profile::TakeOff take_off = take_offs.at(transmission::mirror_sign(side) * point.theta);
    const double sigma = curve.sigma(take_off);
    HelixPoint at = helix_point(geometry, side, curve.free_path(take_off), sigma);
    at.z = home_z + helix_sign(side) * geometry.slope * sigma;
    helix.stroke.push_back(at);
    if (std::abs(at.fleet) <= helix.fleet) continue;
    helix.fleet = std::abs(at.fleet);
    helix.fleet_at = point.alpha;
  }
  return helix;
}

bool all_hold(const std::vector<profile::Condition>& conditions) {
  return std::all_of(conditions.begin(), conditions.end(),
                     [](const profile::Condition& condition) { return condition.ok; });
}

void append(std::vector<profile::Condition>& conditions, std::vector<profile::Condition> more) {
  std::move(more.begin(), more.end(), std::back_inserter(conditions));
}

/// Fills `result` up to the first group of conditions that fails.
void synthesise_into(HelixSynthesis& result, const Mechanism& mechanism, const HelixGroove& groove,
                     const profile::SynthesisOptions& options, HelixAccuracy accuracy) {
  const transmission::Transmission planar(mechanism);
  result.conditions = profile::attempt(mechanism, planar, profile::Turns::many).conditions;
  if (!all_hold(result.conditions)) return;
  append(result.conditions, turn_conditions(mechanism, planar));
  if (!all_hold(result.conditions)) return;
  const Windings windings = wind(mechanism, groove.least_lead, accuracy);
  const transmission::Transmission& law = *windings.transmission;
  // Sloping paths change the law slightly, so all conditions are tested again.
  const profile::Attempt tried = profile::attempt(mechanism, law, profile::Turns::many);
  result.conditions = tried.conditions;
  append(result.conditions, turn_conditions(mechanism, law));
  if (!all_hold(result.conditions)) return;
  result.closure = windings.closure;
  result.stroke = transmission::stroke_over_range(law, options.stroke_steps);
  SpiralDrawing drawing{.chord_error_mm = options.chord_error_mm,
                        .reach = groove.groove_edge + mechanism.tendon.diameter + std::max(0.0, options.drawn_out)};
  constexpr double k_coarse_turn = radians(5);
  if (accuracy == HelixAccuracy::coarse) drawing.largest_turn = k_coarse_turn;
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right})
    result.sides[side == transmission::Side::left ? 0 : 1] =
        make_helix_side(mechanism, windings, side, result.stroke, drawing);
  append(result.conditions, helix_conditions(mechanism, result, windings, groove));
  if (!all_hold(result.conditions)) return;
  result.warnings = profile::bend_warnings(mechanism, tried);
  for (std::string& warning : helix_warnings(result)) result.warnings.push_back(std::move(warning));
  result.status = profile::SynthesisStatus::made;
}

}  // namespace

HelixSynthesis synthesise_helix(const Mechanism& mechanism, const HelixGroove& groove,
                                const profile::SynthesisOptions& options, HelixAccuracy accuracy) {
  HelixSynthesis result;
  synthesise_into(result, mechanism, groove, options, accuracy);
  return result;
}

}  // namespace fusee::helix
