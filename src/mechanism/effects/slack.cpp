#include <algorithm>

#include "mechanism/effect.h"

namespace fusee {
namespace {

double total_pretension(double added, const Mechanism& declared) {
  return declared.tendon.pretension + added > 0 ? declared.tendon.pretension + added : 0.0;
}

/// Within the ramp of pretension_share() there is no slack: the tendons keep a share of the pretension.
void without_ramp(Imperfections& joint, const Mechanism& declared) {
  const double share = joint.tendon.pretension_share();
  if (joint.tendon.slack == 0 || share == 0) return;
  const double total = share * std::max(0.0, declared.tendon.pretension + joint.tendon.pretension);
  joint.tendon.pretension = total - declared.tendon.pretension;
  joint.tendon.slack = 0;
}

bool has_no_pretension(const Imperfections& joint) { return joint.tendon.pretension_share() == 0; }

/// Parameters for a joint declared by a ratio. A wavy cable spans less than its length, and the difference acts as
/// play. Tension straightens the cable: the amplitude of its waves is divided by 1 + T/T0, as for a bent beam under
/// tension, and so is the play. The hysteresis therefore shrinks with load, unlike that of backlash and stretch.
std::vector<EffectParameter> slack_of_cable() {
  return {
      {.name = "width_deg",
       .number = [](Imperfections& at) -> double& { return at.ratio_joint.slack; },
       .least = 0,
       .most = 0.5,
       .step = 2e-3,
       .prior = radians(2.0),  // as for backlash
       .shown = shown::in_degrees,
       .key =
           key::in_degrees("slack_deg", 0, 360, "joint declared by a ratio: play of alpha without load, full width")},
      {.name = "taken_up_per_load",
       .number = [](Imperfections& at) -> double& { return at.ratio_joint.slack_taken_up; },
       .least = 0,
       .most = 1e6,
       .step = 1e-2,
       .prior = 1,  // at the largest load: half of the play
       .prior_unit = PriorUnit::at_largest_load,
       .shown = shown::as_is,
       .key = key::plain("slack_taken_up", "", 0, 1e6, "the play is divided by 1 + slack_taken_up times the load")}};
}

}  // namespace

Effect slack(JointKind kind) {
  Effect effect;
  effect.name = "slack";
  effect.place = ChainPlace::tendon;
  effect.rank = 2;
  effect.signature = "lost motion that grows as the moment arm shrinks, reduced by load and absent with pretension";
  effect.separating_run = "repeat one run with twice the pretension: slack vanishes, backlash does not";
  effect.correctable_by = CorrectableBy::table;
  if (kind == JointKind::ratio) {
    effect.signature = "hysteresis that shrinks as the load grows";
    effect.separating_run = "repeat one run at twice the load: slack vanishes, backlash does not";
    effect.needs = {.load = true};
    effect.parameters = slack_of_cable();
    for (const double width : {1.5, 5.0}) {
      for (const double taken_up : {0.02, 0.3, 5.0, 80.0}) effect.starts.push_back({radians(width), taken_up});
    }
    return effect;
  }
  effect.parameters = {
      {.name = "slack_mm",
       .number = [](Imperfections& at) -> double& { return at.tendon.slack; },
       .least = 0,
       .most = 10,
       .step = 5e-3,
       .prior = 1,  // a knot that draws tight, a tendon tied by hand
       .shown = shown::as_is,
       .key = key::plain("slack_mm", "mm", 0, 1000,
                         "slack of both tendons together, beyond the length that pretension takes up")},
      {.name = "pretension_N",
       .number = [](Imperfections& at) -> double& { return at.tendon.pretension; },
       .least = -1000,
       .most = 1000,
       .step = 0.1,
       .prior = 5,  // set by feel
       .shown = total_pretension,
       .key = key::plain("pretension_N", "N", -100000, 100000,
                         "added to tendon.pretension_N; without effect on tendons with slack"),
       .merge_rule = MergeRule::add,
       .idle = has_no_pretension}};
  effect.loosens = true;
  effect.settle = without_ramp;
  effect.starts = {{0.1, 0}, {0.5, 0}, {2.0, 0}};
  return effect;
}

}  // namespace fusee
