#include "joint/joint_effects.h"

#include "fusee/transmission.h"

namespace fusee::joint {
namespace {

/// Contact of a tendon with the joint's drum over the range.
struct DrumContact {
  bool somewhere = false;
  bool everywhere = false;
};

DrumContact drum_contact(const Mechanism& mechanism, transmission::Side side) {
  if (!(mechanism.joint.drum_radius > 0)) return {};
  const auto leaves = transmission::lift_off(transmission::pin_place(mechanism, side, mechanism.seen_pitch_radius()));
  if (!leaves) return {};
  // The left tendon is seen in its mirror image, in which θ has the opposite sign.
  const double least = side == transmission::Side::right ? mechanism.joint.theta_min : -mechanism.joint.theta_max;
  const double most = side == transmission::Side::right ? mechanism.joint.theta_max : -mechanism.joint.theta_min;
  return {*leaves > least, *leaves >= most};
}

/// True for an attachment of its own that is not hidden behind the drum over the whole range.
bool has_free_end(const Mechanism& mechanism, transmission::Side side) {
  const auto& attachment = side == transmission::Side::left ? mechanism.joint.attachment1 : mechanism.joint.attachment2;
  return attachment && !drum_contact(mechanism, side).everywhere;
}

}  // namespace

bool has_part(const Mechanism& mechanism, const Needs& needs) {
  if (mechanism.transmission)
    return !(needs.tendons || needs.drum || needs.end1 || needs.end2 || needs.pins || needs.idlers || needs.sheath);
  const bool is_idler = mechanism.guides.kind == GuideKind::idler;
  if (needs.ratio) return false;
  if (needs.pins && is_idler) return false;
  if (needs.idlers && !is_idler) return false;
  if (needs.sheath && !mechanism.sheath.is_there()) return false;
  if (needs.drum && !drum_contact(mechanism, transmission::Side::left).somewhere &&
      !drum_contact(mechanism, transmission::Side::right).somewhere)
    return false;
  if (needs.end1 && !has_free_end(mechanism, transmission::Side::left)) return false;
  if (needs.end2 && !has_free_end(mechanism, transmission::Side::right)) return false;
  return true;
}

std::vector<const Effect*> effects_of(const Mechanism& mechanism) {
  std::vector<const Effect*> all;
  for (const Effect& effect : effects(kind_of(mechanism))) {
    if (effect.is_tested && has_part(mechanism, effect.needs)) all.push_back(&effect);
  }
  return all;
}

}  // namespace fusee::joint
