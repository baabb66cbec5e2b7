#include "mechanism/effects/effect.h"

namespace fusee {
namespace {

double total(double added, const Mechanism& declared) {
  return declared.tendon.pretension + added > 0 ? declared.tendon.pretension + added : 0.0;
}

}  // namespace

Effect slack(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "slack";
  effect.place = "tendon";
  effect.signature = "lost motion that grows as the moment arm shrinks, taken up by load and gone with pretension";
  effect.correctable_by = "table";
  effect.separating_run = "repeat one run with twice the pretension: slack goes, backlash stays";
  effect.parameters = {{"slack_mm", &Imperfections::slack, 0, 10, 5e-3, shown::as_is},
                       {"pretension_N", &Imperfections::pretension, -1000, 1000, 0.1, total}};
  effect.starts = {{0.1, 0}, {0.5, 0}, {2.0, 0}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
