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

HelixSide make_side(const Mechanism& mechanism, const Windings& windings, transmission::Side which,
                    const std::vector<transmission::TransmissionPoint>& stroke, const SpiralDrawing& drawing) {
  const std::size_t i = which == transmission::Side::left ? 0 : 1;
  const HelixGeometry& geometry = windings.geometry[i];
  const profile::TakeOffs take_offs(*windings.transmission, which);
  const PitchSpiral curve(mechanism, take_offs, i == 0 ? &windings.paths->q1 : &windings.paths->q2);
  HelixSide side;
  side.spiral = draw_spiral(curve, which, geometry.slope, drawing);
  side.turns = (curve.working_end() - curve.working_begin()) / k_two_pi;
  side.circumference = geometry.circumference;
  side.lead = geometry.slope * geometry.circumference;
  // σ of the spiral's first row. P1 is drawn from the end of its mirrored curve.
  const double sigma0 = curve.at(which == transmission::Side::left ? curve.end() : curve.begin()).sigma;
  const double home = -helix_sign(which) * geometry.slope * sigma0;
  side.attachment_z = home - geometry.below;
  for (const transmission::TransmissionPoint& point : stroke) {
    const profile::TakeOff take_off = take_offs.at(transmission::mirror_sign(which) * point.theta);
    const double sigma = curve.sigma(take_off);
    HelixPoint at = helix_point(geometry, which, curve.free_path(take_off), sigma);
    at.z = home + helix_sign(which) * geometry.slope * sigma;
    side.stroke.push_back(at);
    if (std::abs(at.fleet) <= side.fleet) continue;
    side.fleet = std::abs(at.fleet);
    side.fleet_at = point.alpha;
  }
  return side;
}

bool all_hold(const std::vector<profile::Condition>& conditions) {
  return std::all_of(conditions.begin(), conditions.end(),
                     [](const profile::Condition& condition) { return condition.ok; });
}

void append(std::vector<profile::Condition>& conditions, std::vector<profile::Condition> more) {
  std::move(more.begin(), more.end(), std::back_inserter(conditions));
}

void synthesise_into(HelixSynthesis& result, const Mechanism& mechanism, const HelixGroove& groove,
                     const profile::SynthesisOptions& options, HelixAccuracy accuracy) {
  const transmission::Transmission planar(mechanism);
  result.conditions = profile::attempt(mechanism, planar, profile::Turns::many).conditions;
  if (!all_hold(result.conditions)) return;
  append(result.conditions, turn_conditions(mechanism, planar));
  if (!all_hold(result.conditions)) return;
  const Windings windings = wind(mechanism, groove.least_lead, accuracy);
  const transmission::Transmission& law = *windings.transmission;
  const profile::Attempt tried = profile::attempt(mechanism, law, profile::Turns::many);
  result.conditions = tried.conditions;
  append(result.conditions, turn_conditions(mechanism, law));
  if (!all_hold(result.conditions)) return;
  result.closure = windings.closure;
  result.stroke = transmission::stroke_over_range(law, options.stroke_steps);
  SpiralDrawing drawing{.chord_error_mm = options.chord_error_mm,
                        .reach = groove.groove_edge + mechanism.tendon.diameter + std::max(0.0, options.drawn_out)};
  if (accuracy == HelixAccuracy::coarse) drawing.largest_turn = radians(5);
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right})
    result.sides[side == transmission::Side::left ? 0 : 1] =
        make_side(mechanism, windings, side, result.stroke, drawing);
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
