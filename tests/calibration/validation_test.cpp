// Answers compared with rows that they were not fitted to.
#include "calibration/validation.h"

#include <gmock/gmock.h>

#include "calibration/linear_joint.h"
#include "fusee/base.h"

namespace fusee::calibration::linear {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A joint with this compliance, rad per N, and noise.
measurement::Measurement stretching(const std::vector<double>& loads, double stretch, unsigned seed) {
  return measured(loads, [stretch, noise = white_noise(k_floor, seed)](const measurement::Sample& sample) mutable {
    return noise(sample) - stretch * sample.load;
  });
}

class Validation : public testing::Test {
 protected:
  static constexpr double k_stretch = 20 * k_floor;
  calibration::Evidence evidence = evidence_of(stretching({0, 1, 2}, k_stretch, 1));
  calibration::FitterPool pool{evidence};
  calibration::Selection selection;

  void SetUp() override {
    selection.none = pool.one().fit({}, {});
    selection.best = pool.one().fit({&named("tendon_stretch")}, {});
    selection.without = {selection.none};
    selection.groups = {{{&named("tendon_stretch")}, 0}};
    calibration::Candidate taken;
    taken.name = "tendon_stretch";
    taken.accepted = true;
    selection.tried = {taken};
  }

  calibration::Estimate found() const { return {selection.best, {}}; }
};

TEST_F(Validation, AcceptsEffectThatPredictsKeptRuns) {
  const calibration::Estimate declared = calibration::declared_estimate(pool, selection);
  EXPECT_EQ(calibration::HeldOutRows(evidence, declared, stretching({3}, k_stretch, 2)).worse_at(found()), "");
  EXPECT_EQ(calibration::HeldOutRows(evidence, declared, {}).worse_at(found()), "");
}

TEST_F(Validation, RejectsEffectThatKeptRunsDoNotHave) {
  const calibration::Estimate declared = calibration::declared_estimate(pool, selection);
  EXPECT_EQ(calibration::HeldOutRows(evidence, declared, stretching({3}, -k_stretch, 2)).worse_at(found()), "all rows");
}

TEST_F(Validation, NamesLevelThatGetsWorse) {
  const calibration::Estimate declared = calibration::declared_estimate(pool, selection);
  measurement::Measurement kept = stretching({4, 2}, k_stretch, 2);
  for (measurement::Sample& sample : kept.runs[1].samples) sample.theta += 2 * k_stretch;  // with the opposite sign
  EXPECT_EQ(calibration::HeldOutRows(evidence, declared, kept).worse_at(found()), "run_2");
}

TEST_F(Validation, RetreatsToDeclaredJoint) {
  const calibration::ValidatedAnswer answer =
      calibration::validate_answer(evidence, pool, stretching({3}, -k_stretch, 2), selection);
  EXPECT_THAT(answer.dropped, ElementsAre("tendon_stretch"));
  EXPECT_THAT(answer.reported.estimate.fit.effects, IsEmpty());
  EXPECT_EQ(answer.reported.estimate.fit.at, answer.declared.fit.at);
  EXPECT_THAT(selection.groups, IsEmpty());
  EXPECT_FALSE(selection.tried.front().accepted);
  EXPECT_NE(selection.tried.front().why, "");
}

TEST_F(Validation, KeepsPredictiveEffects) {
  const calibration::ValidatedAnswer answer =
      calibration::validate_answer(evidence, pool, stretching({3}, k_stretch, 2), selection);
  EXPECT_THAT(answer.dropped, IsEmpty());
  EXPECT_EQ(answer.reported.estimate.fit.effects.size(), 1u);
}

TEST_F(Validation, NumbersLeaveOutJudgedRun) {
  measurement::Measurement odd = stretching({1, 2, 3}, k_stretch, 1);
  for (measurement::Sample& sample : odd.runs[2].samples) sample.theta -= 3 * 10 * k_floor;  // 30 floors per N there
  calibration::Evidence runs = evidence_of(odd);
  runs.run_folds = {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}};
  calibration::FitterPool more(runs);
  const calibration::Estimate all{more.one().fit_least_squares(more.one().fit({&named("tendon_stretch")}, {})), {}};
  const std::vector<Imperfections> without = calibration::estimates_without(runs, all, runs.run_folds);
  const EffectParameter& stretch = named("tendon_stretch").parameters[0];
  ASSERT_EQ(without.size(), 3u);
  EXPECT_NEAR(value_of(without[2], stretch), k_stretch, 0.1 * k_stretch);
  EXPECT_GT(value_of(all.fit.at, stretch), 1.3 * k_stretch);
}

TEST_F(Validation, DeclaredJointFitsFreeOffset) {
  const calibration::Estimate declared = calibration::declared_estimate(pool, selection);
  double mean = 0;
  for (const Eigen::Index row : evidence.rows()) mean += declared.fit.residual[row];
  EXPECT_NEAR(mean / static_cast<double>(evidence.rows_used()), 0, 0.01 * k_floor);
}

}  // namespace
}  // namespace fusee::calibration::linear
