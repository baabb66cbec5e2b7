#include "fusee/mechanism/effect.h"

namespace fusee {

Effect frame_compliance(JointKind) {
  Effect effect;
  effect.name = "frame_compliance";
  effect.place = ChainPlace::pins;
  effect.rank = 4;
  effect.signature = "in proportion to the tension, where the tendons turn most over their pins; the same both ways";
  effect.separating_run = "hold a dial gauge against a guide pin and hang the load on the joint";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.tendons = true};
  effect.parameters = {{.name = "mm_per_N",
                        .number = [](Imperfections& at) -> double& { return at.pins.give; },
                        .least = 0,
                        .most = 1,
                        .step = 2e-4,
                        .prior = 0.005,  // a printed bracket of some centimetres: 50 to 1000 N/mm
                        .shown = shown::as_is,
                        .key = key::plain("guide_give_mm_per_N", "mm_per_N", 0, 10,
                                          "each pin moves by this along the tendon's force on it")}};
  effect.starts = {{0.002}, {0.02}};
  return effect;
}

}  // namespace fusee
