#include "fusee/mechanism/effect.h"

namespace fusee {
namespace {

double total(double added, const Mechanism& declared) {
  return declared.tendon.pretension + added > 0 ? declared.tendon.pretension + added : 0.0;
}

}  // namespace

Effect slack(JointKind) {
  Effect effect;
  effect.name = "slack";
  effect.place = ChainPlace::tendon;
  effect.rank = 2;
  effect.signature = "lost motion that grows as the moment arm shrinks, taken up by load and gone with pretension";
  effect.separating_run = "repeat one run with twice the pretension: slack goes, backlash stays";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "slack_mm",
       .number = [](Imperfections& at) -> double& { return at.tendon.slack; },
       .least = 0,
       .most = 10,
       .step = 5e-3,
       .prior = 1,  // a knot that draws tight, a tendon tied by hand
       .shown = shown::as_is,
       .key = key::plain("slack_mm", "mm", 0, 1000, "of both tendons together, beyond what pretension takes up")},
      {.name = "pretension_N",
       .number = [](Imperfections& at) -> double& { return at.tendon.pretension; },
       .least = -1000,
       .most = 1000,
       .step = 0.1,
       .prior = 5,  // set by feel
       .shown = total,
       .key = key::plain("pretension_N", "N", -100000, 100000, "added to tendon.pretension_N"),
       .again = WhenFoundAgain::added}};
  effect.starts = {{0.1, 0}, {0.5, 0}, {2.0, 0}};
  return effect;
}

}  // namespace fusee
