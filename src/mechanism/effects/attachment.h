/// \file
/// Internal: what both tendons' attachments have in common.
#pragma once

#include <string>
#include <string_view>

#include "fusee/mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {

/// One number of where a tendon ends.
inline EffectParameter attachment_part(std::string_view name, double& (*number)(Imperfections&),
                                       const IdentifiedKey& key, const ByHand& by_hand, const SignWords& sign) {
  return {.name = std::string(name),
          .number = number,
          .least = -20,
          .most = 20,
          .step = 1e-2,
          .prior = 1,  // where a tendon is tied and bends, as of joint_length
          .shown = shown::as_is,
          .key = key,
          .again = WhenFoundAgain::added,
          .by_hand = by_hand,
          .sign = sign};
}

/// Both numbers are fitted. A tendon is as much longer as its end moves along it: over a small range, in which its
/// direction seen from the link hardly turns, that is one number, and the other keeps its prior's width.
inline Effect attachment_effect(int tendon) {
  Effect effect;
  effect.place = ChainPlace::joint;
  effect.rank = 5 + tendon;
  effect.signature = "smooth in theta where the tendon is free, no direction; nothing where it lies on a drum";
  effect.separating_run = "measure from the joint's axis to where the tendon is tied, across and along, with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  (tendon == 1 ? effect.needs.end1 : effect.needs.end2) = true;
  return effect;
}

}  // namespace fusee
