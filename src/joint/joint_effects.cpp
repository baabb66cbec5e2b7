#include "joint/joint_effects.h"

#include "fusee/transmission.h"

namespace fusee::joint {
namespace {

struct DrumContact {
  bool somewhere = false;
  bool everywhere = false;
};

DrumContact on_drum(const Mechanism& mechanism, transmission::Side side) {
  if (!(mechanism.joint.drum_radius > 0)) return {};
  const auto leaves = transmission::lift_off(transmission::pin_place(mechanism, side, mechanism.seen_pitch_radius()));
  if (!leaves) return {};
  const double least = side == transmission::Side::right ? mechanism.joint.theta_min : -mechanism.joint.theta_max;
  const double most = side == transmission::Side::right ? mechanism.joint.theta_max : -mechanism.joint.theta_min;
  return {*leaves > least, *leaves >= most};
}

bool has_free_end(const Mechanism& mechanism, transmission::Side side) {
  const auto& own = side == transmission::Side::left ? mechanism.joint.attachment1 : mechanism.joint.attachment2;
  return own && !on_drum(mechanism, side).everywhere;
}

}  // namespace

bool has_part(const Mechanism& mechanism, const Needs& needs) {
  if (mechanism.transmission)
    return !(needs.tendons || needs.drum || needs.end1 || needs.end2 || needs.pins || needs.idlers || needs.sheath);
  const bool is_idler = mechanism.guides.kind == GuideKind::idler;
  return !needs.ratio && !(needs.pins && is_idler) && !(needs.idlers && !is_idler) &&
         !(needs.sheath && !mechanism.sheath.is_there()) &&
         !(needs.drum && !on_drum(mechanism, transmission::Side::left).somewhere &&
           !on_drum(mechanism, transmission::Side::right).somewhere) &&
         !(needs.end1 && !has_free_end(mechanism, transmission::Side::left)) &&
         !(needs.end2 && !has_free_end(mechanism, transmission::Side::right));
}

std::vector<const Effect*> effects_of(const Mechanism& mechanism) {
  std::vector<const Effect*> all;
  for (const Effect& effect : effects(kind_of(mechanism))) {
    if (effect.is_tested && has_part(mechanism, effect.needs)) all.push_back(&effect);
  }
  return all;
}

}  // namespace fusee::joint
