/// \file
/// Internal: common parts of both tendons' attachment effects.
#pragma once

#include <string>
#include <string_view>

#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {

/// One coordinate of a tendon's end.
inline EffectParameter attachment_part(std::string_view name, double& (*number)(Imperfections&),
                                       const IdentifiedKey& key, const ManualMeasurement& by_hand,
                                       const SignWords& sign) {
  return {.name = std::string(name),
          .number = number,
          .least = -20,
          .most = 20,
          .step = 1e-2,
          .prior = 1,  // uncertainty of a tied and bent tendon, as for joint_length
          .shown = shown::as_is,
          .key = key,
          .merge_rule = MergeRule::add,
          .by_hand = by_hand,
          .sign = sign};
}

/// Both coordinates are fitted. The tendon's length changes by the displacement along its direction. Over a small range
/// that direction hardly turns in the link's frame, so only one combination is determined and the other keeps its
/// prior's width.
inline Effect attachment_effect(int tendon) {
  Effect effect;
  effect.place = ChainPlace::joint;
  effect.rank = 5 + tendon;
  effect.signature = "smooth in theta where the tendon is free, independent of direction; none where it lies on a drum";
  effect.separating_run = "measure from the joint's axis to the tendon's end, across and along, with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  (tendon == 1 ? effect.needs.end1 : effect.needs.end2) = true;
  return effect;
}

}  // namespace fusee
