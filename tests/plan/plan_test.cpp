// Laws of a plan that hold for every joint.
#include "fusee/plan.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "base/text.h"
#include "fusee/joint.h"
#include "mechanism/effect.h"
#include "plan/candidates.h"
#include "plan/separation.h"
#include "support/mechanisms.h"

namespace fusee::plan {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

DeclaredMechanism ratio_joint() {
  DeclaredMechanism joint;
  joint.name = "geared";
  joint.transmission = RatioTransmission{4.0};
  return joint;
}

const PlannedCause& cause(const Plan& plan, const std::string& name) {
  const auto found =
      std::find_if(plan.causes.begin(), plan.causes.end(), [&](const PlannedCause& c) { return c.name == name; });
  if (found == plan.causes.end()) throw std::runtime_error("no cause " + name);
  return *found;
}

// With θ proportional to α both offsets are one number: no run resolves them.
TEST(Plan, GroupsIndistinguishableCauses) {
  PlanOptions one_run;
  one_run.minutes = 1.9;  // enough for the slow run of 1.5 min alone
  const Plan plan = plan_runs(testing::linear_wrist(), one_run);
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_THAT(cause(plan, "motor_offset").rivals, Contains("zero_offset"));
  EXPECT_FALSE(cause(plan, "motor_offset").smallest_alone);
  EXPECT_THAT(plan.groups, Contains(::testing::AllOf(Contains("motor_offset"), Contains("zero_offset"))));
}

// The rms response to play is half its width over the ratio.
TEST(Plan, PredictsResponseToPlay) {
  const DeclaredMechanism joint = testing::linear_wrist();
  const Plan plan = plan_runs(joint);
  const PlannedCause& play = cause(plan, "backlash");
  EXPECT_NEAR(play.usual, 0.5 * radians(2.0) / joint.pulley.ratio, 0.15 * play.usual);
  ASSERT_TRUE(play.smallest_alone);
  EXPECT_LT(play.smallest, *play.smallest_alone + 1e-12);
  EXPECT_EQ(play.key, "backlash_deg");
  EXPECT_NEAR(play.smallest_key / 2.0, play.smallest / play.usual, 1e-9);
}

TEST(Plan, NoiseRaisesDetectionLimit) {
  PlanOptions quiet, loud;
  loud.noise = 5 * quiet.noise;
  const Plan one = plan_runs(ratio_joint(), quiet), other = plan_runs(ratio_joint(), loud);
  EXPECT_GT(cause(other, "backlash").smallest, 2 * cause(one, "backlash").smallest);
}

TEST(Plan, BeginsWithTheSlowUnloadedRun) {
  const Plan plan = plan_runs(ratio_joint());
  ASSERT_TRUE(plan.steps.front().run);
  EXPECT_EQ(plan.steps.front().run->load, 0);
  EXPECT_EQ(plan.steps.front().run->speed, plan.slow);
  EXPECT_EQ(plan.steps.front().run->change, BenchChange::none);
}

TEST(Plan, StaysWithinItsMinutes) {
  for (const double minutes : {2.0, 5.0, 15.0}) {
    PlanOptions options;
    options.minutes = minutes;
    const Plan plan = plan_runs(ratio_joint(), options);
    ASSERT_THAT(plan.steps, Not(IsEmpty()));
    EXPECT_LE(plan.minutes, minutes);
    double by = 0;
    for (const PlanStep& step : plan.steps) EXPECT_DOUBLE_EQ(step.end_minute, by += step.minutes);
  }
}

TEST(Plan, WithoutTimeListsFurtherSteps) {
  PlanOptions options;
  options.minutes = 0.1;
  const Plan plan = plan_runs(ratio_joint(), options);
  EXPECT_THAT(plan.steps, IsEmpty());
  ASSERT_THAT(plan.beyond, Not(IsEmpty()));
  EXPECT_THAT(plan.beyond.front().detects, Not(IsEmpty()));
}

TEST(Plan, WithoutLoadOmitsLoadEffects) {
  PlanOptions options;
  options.loads = {0};
  const Plan plan = plan_runs(ratio_joint(), options);
  std::vector<std::string> names;
  for (const auto& [name, why] : plan.left_out) names.push_back(name);
  EXPECT_THAT(names, Contains("tendon_stretch"));
  EXPECT_THAT(plan.causes, Each(::testing::Field(&PlannedCause::name, Not("tendon_stretch"))));
}

TEST(Plan, ReportsTheLoadBeyondWhichATendonSlackens) {
  const DeclaredMechanism mechanism = testing::forearm();
  PlanOptions options;
  options.loads = {0, 40, -40};
  const Plan plan = plan_runs(mechanism, options);
  ASSERT_TRUE(plan.taut_load);
  EXPECT_THAT(plan.slack_words(),
              ::testing::StartsWith("a tendon slackens at loads beyond " + rounded(*plan.taut_load, 2) + " N"));
  // Loads below it keep both tendons taut.
  options.loads = {0, 0.99 * *plan.taut_load, -0.99 * *plan.taut_load};
  EXPECT_FALSE(plan_runs(mechanism, options).taut_load);
  EXPECT_EQ(plan_runs(mechanism, options).slack_words(), "");
}

TEST(Plan, FalsePositivesAreRare) {
  const Plan plan = plan_runs(testing::forearm());
  // 2 % of 250 data sets.
  EXPECT_LE(plan.nothing.wrong, 5);
  EXPECT_LE(plan.one.wrong, 5);
  EXPECT_GT(plan.one.alone, plan.one.samples / 2);
}

TEST(Plan, OmitsKnownReadings) {
  DeclaredMechanism known = testing::forearm();
  const auto requested_keys = [](const DeclaredMechanism& joint) {
    std::vector<std::string> keys;
    for (const fusee::EffectParameter* reading : unread_numbers(joint)) keys.emplace_back(reading->key.name);
    return keys;
  };
  EXPECT_THAT(requested_keys(known), Contains("pulley_scale_percent"));
  known.prior.pulley_scale = {1.0, 0.001};
  EXPECT_THAT(requested_keys(known), Not(Contains("pulley_scale_percent")));
}

// ---- the algebra ----------------------------------------------------------------------------------------------------

class Separations : public ::testing::Test {
 protected:
  DeclaredMechanism joint = testing::forearm();
  PlanOptions options;
  Bench bench = bench_of(joint, options);
  Signatures signatures{joint, bench, options.noise};

  Information after(std::size_t runs) const {
    Information known = Information::none(signatures.columns());
    const std::vector<PlannedRun> all = candidate_runs(bench);
    for (std::size_t i = 0; i < runs; ++i) known = known.with(*signatures.of(all[i]));
    return known;
  }
  const Cause& named(const std::string& name) const {
    for (const Cause& cause : signatures.causes()) {
      if (cause.effect->name == name) return cause;
    }
    throw std::runtime_error("no cause " + name);
  }
};

TEST_F(Separations, CauseIsNotResolvedFromItself) {
  const Information known = after(2);
  for (const Cause& cause : signatures.causes())
    EXPECT_LT(margin(signatures, known, cause, &cause), 0.5) << cause.effect->name;
}

TEST_F(Separations, RivalIsNoEasierThanDetection) {
  const Information known = after(3);
  for (const Cause& cause : signatures.causes()) {
    const double seen = margin(signatures, known, cause, nullptr);
    for (const Cause& rival : signatures.causes())
      EXPECT_LE(margin(signatures, known, cause, &rival), seen * (1 + 1e-9))
          << cause.effect->name << rival.effect->name;
  }
}

TEST_F(Separations, MoreRunsRaiseMargins) {
  const Information few = after(1), more = after(4);
  for (const Cause& cause : signatures.causes())
    EXPECT_GE(margin(signatures, more, cause, nullptr), margin(signatures, few, cause, nullptr) * (1 - 1e-9));
}

// y = s x + n with n rows: the standard error of x is σ/√(Σ s²).
TEST_F(Separations, ConstantHasErrorOfMean) {
  const Information known = after(1);
  const Cause& zero = named("zero_offset");
  const double rows = known.rows;
  EXPECT_NEAR(usual_rms(known, zero) * options.noise, radians(2.0), 1e-9);
  const double alone = radians(2.0) / options.noise * std::sqrt(rows) / 4.1;  // PlanThresholds::resolved_distance
  EXPECT_NEAR(margin(signatures, known, zero, nullptr), alone, 0.05 * alone);
}

TEST_F(Separations, CaliperResolvesScaleFromOffset) {
  const Cause& scale = named("pulley_scale");
  const Cause& offset = named("radius_offset");
  const Information runs = after(4);
  const Information read =
      runs.with(signatures.of(*scale.numbers.front())).with(signatures.of(*offset.numbers.front()));
  EXPECT_GT(margin(signatures, read, scale, &offset), margin(signatures, runs, scale, &offset));
}

}  // namespace
}  // namespace fusee::plan
