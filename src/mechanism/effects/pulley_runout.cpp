#include "fusee/mechanism/effect.h"

namespace fusee {

Effect pulley_runout(JointKind) {
  Effect effect;
  effect.name = "pulley_runout";
  effect.place = ChainPlace::pulley;
  effect.rank = 3;
  effect.signature = "once per turn of the pulley, whichever way and load";
  effect.separating_run = "turn the pulley on its shaft by a quarter turn and repeat the slow unloaded run";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "x_mm",
       .number = [](Imperfections& at) -> double& { return at.pulley.outline.runout_x; },
       .least = -2,
       .most = 2,
       .step = 2e-3,
       .prior = 0.3,  // a printed bore over a shaft with its play and set screw
       .shown = shown::as_is,
       .key = key::plain("runout_x_mm", "mm", -100, 100, "centre of the made curves off the axis, at home"),
       .again = WhenFoundAgain::added},
      {.name = "y_mm",
       .number = [](Imperfections& at) -> double& { return at.pulley.outline.runout_y; },
       .least = -2,
       .most = 2,
       .step = 2e-3,
       .prior = 0.3,  // a printed bore over a shaft with its play and set screw
       .shown = shown::as_is,
       .key = key::plain("runout_y_mm", "mm", -100, 100, "the same across"),
       .again = WhenFoundAgain::added}};
  return effect;
}

}  // namespace fusee
