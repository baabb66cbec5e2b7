// Each verdict, from fits with given figures.
#include "calibration/verdict.h"

#include <gmock/gmock.h>

#include "calibration/catalogue.h"
#include "calibration/explanation.h"
#include "calibration/linear_joint.h"
#include "calibration/next_measurements.h"
#include "calibration/thresholds.h"
#include "calibration/words.h"

namespace fusee::calibration::linear {
namespace {

using testing::HasSubstr;

class Conclusion : public testing::Test {
 protected:
  calibration::Evidence evidence = evidence_of(measured({0, 5}, [](const measurement::Sample&) { return 0.0; }));
  calibration::Selection selection;
  calibration::Calibration calibration;

  /// Sets a residual of `squares` floors² whose sign alternates from row to row.
  void leave(double squares) {
    calibration::Fit& fit = selection.best;
    fit.residual.resize(evidence.theta.size());
    for (Eigen::Index i = 0; i < fit.residual.size(); ++i)
      fit.residual[i] = (i % 2 == 0 ? 1 : -1) * std::sqrt(squares) * k_floor;
    fit.loose = Eigen::VectorXd::Zero(fit.residual.size());
  }

  void find(const std::vector<std::vector<std::string>>& groups) {
    for (const std::vector<std::string>& group : groups) {
      calibration::FoundEffect effect;
      effect.name = group.front();
      effect.group = group;
      calibration.effects.push_back(effect);
    }
  }

  calibration::CalibrationVerdict verdict() {
    calibration::Amplitudes any = evidence.evidence_model->without_discrepancy();
    any.families.setConstant(k_floor);
    selection.best.posterior = evidence.evidence_model->best(calibration::tangent_of(evidence, selection.best), any);
    selection.groups.resize(calibration.effects.size());
    selection.best.effects.clear();
    for (const calibration::FoundEffect& effect : calibration.effects)
      selection.best.effects.push_back(find_effect(effect.name, JointKind::tendons));
    selection.without.resize(calibration.effects.size());
    calibration::ValidatedAnswer answer;
    answer.reported.estimate.fit = selection.best;
    answer.unmodelled = answer.residual = calibration::describe_discrepancy(evidence, selection.best);
    calibration::conclude(evidence, selection, answer, calibration);
    if (calibration.next.empty()) calibration.next = calibration::next_measurements(evidence, selection, calibration);
    calibration::summarize(evidence, selection, calibration);
    return calibration.verdict;
  }

  std::vector<std::string> next_words() const {
    std::vector<std::string> words;
    for (const plan::NextMeasurement& next : calibration.next) words.push_back(next.words);
    return words;
  }
};

TEST_F(Conclusion, ReportsNoEffectWithoutResidual) {
  leave(1);
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::no_effect);
  EXPECT_EQ(calibration.unexplained_rms, 0);
  EXPECT_EQ(calibration.unexplained_where, "");
}

TEST_F(Conclusion, ReportsSingleCauseAsExplained) {
  leave(1.1);
  find({{"backlash"}});
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::explained);
  EXPECT_THAT(calibration.summary, HasSubstr("explained by backlash."));
}

TEST_F(Conclusion, ReportsTwoMembersAsAmbiguous) {
  leave(1);
  find({{"backlash"}, {"zero_offset", "motor_offset"}});
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::confounded);
  EXPECT_THAT(calibration.summary,
              HasSubstr("backlash, one of {zero_offset, motor_offset}, but do not decide between the alternatives"));
}

TEST_F(Conclusion, RejectsRepeatsFarBeyondScatterWithinStroke) {
  leave(1);
  find({{"backlash"}});
  calibration.noise.from_repeats = true;
  calibration.noise.rms = radians(2);
  calibration.noise.within_stroke = radians(0.02);
  calibration.noise.levels = {{0, radians(10), radians(1), 100, 0}, {5, radians(60), radians(2), 100, radians(12)}};
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::not_repeatable);
  EXPECT_THAT(calibration.summary,
              HasSubstr("100 times the scatter within a stroke, most at alpha 12°, load 5 N, 60°/s"));
  EXPECT_EQ(calibration.noise_varies, "Noise is 1° at load 0 N, 10°/s and 2° at load 5 N, 60°/s.");
  calibration.noise.within_stroke = radians(0.5);
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::explained);
}

TEST(Scatter, SensorThatHoldsReadingIsNoNoise) {
  const auto noise = white_noise(radians(0.02), 1);
  const auto held = white_noise(radians(2), 2);
  double holds = 0;
  int row = 0;
  const measurement::Measurement holding = measured({0, 5}, [&](const measurement::Sample& sample) {
    if (row++ % 10 == 0) holds = held(sample);
    return holds + noise(sample);
  });
  EXPECT_TRUE(calibration::is_scattering(measurement::noise_floor(holding)));
  EXPECT_FALSE(calibration::is_scattering(measurement::noise_floor(measured({0, 5}, noise))));
}

/// Effect with these log odds against the best unmodelled cause.
calibration::FoundEffect ahead_by(double nats) {
  calibration::FoundEffect effect;
  effect.name = "backlash";
  effect.group = {"backlash"};
  effect.unmodelled = {nats, "a jump at 50 % of the range", "approach from both sides"};
  return effect;
}

TEST_F(Conclusion, SmallLeadAddsUnmodelled) {
  leave(1);
  calibration.effects = {ahead_by(calibration::k_thresholds.ahead_of_unmodelled - 1)};
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::confounded);
  EXPECT_THAT(calibration.effects.front().group, testing::ElementsAre("backlash", "unmodelled"));
  EXPECT_THAT(next_words(), testing::Contains("approach from both sides"));
  EXPECT_THAT(calibration.summary,
              testing::StartsWith("Measure this first: approach from both sides. The data are explained by "
                                  "backlash or an unmodelled cause with the same effect"));
}

TEST_F(Conclusion, LargeLeadNamesEffectAlone) {
  leave(1);
  calibration.effects = {ahead_by(calibration::k_thresholds.ahead_of_unmodelled + 1)};
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::explained);
  EXPECT_THAT(calibration.next, testing::IsEmpty());
}

TEST_F(Conclusion, EffectsInTimeNeedLargerLead) {
  for (const char* name : {"thermal_expansion", "tendon_slip"}) {
    for (const double more : {-1.0, 1.0}) {
      leave(1);
      calibration = {};
      calibration.effects = {ahead_by(calibration::k_thresholds.ahead_without_shape + more)};
      calibration.effects.front().name = calibration.effects.front().group.front() = name;
      EXPECT_EQ(verdict(),
                more < 0 ? calibration::CalibrationVerdict::confounded : calibration::CalibrationVerdict::explained)
          << name;
      EXPECT_EQ(calibration.effects.front().group.size(), more < 0 ? 2u : 1u) << name;
    }
  }
}

TEST_F(Conclusion, LooseEffectsNeedLargerLead) {
  const Effect& play = *find_effect("slack", JointKind::tendons);
  selection.catalogue = {&play};
  const std::vector<std::vector<std::string>> groups = {{"slack"}, {"backlash", "slack"}};
  for (const std::vector<std::string>& group : groups) {
    for (const double more : {-1.0, 1.0}) {
      leave(1);
      calibration = {};
      calibration.effects = {ahead_by(calibration::k_thresholds.ahead_without_shape + more)};
      calibration.effects.front().name = group.front();
      calibration.effects.front().group = group;
      verdict();
      EXPECT_EQ(calibration.effects.front().group.size(), group.size() + (more < 0 ? 1 : 0)) << group.front();
    }
  }
}

TEST_F(Conclusion, AbsenceProbabilityAddsUnmodelledAtAnyLead) {
  leave(1);
  calibration.effects = {ahead_by(calibration::k_thresholds.ahead_of_unmodelled + 1),
                         ahead_by(calibration::k_thresholds.ahead_of_unmodelled + 1)};
  selection.groups = {{{}, calibration::k_thresholds.most_false_positives / 2},
                      {{}, calibration::k_thresholds.most_false_positives * 2}};
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::confounded);
  EXPECT_THAT(calibration.effects.front().group, testing::ElementsAre("backlash"));
  EXPECT_THAT(calibration.effects.back().group, testing::ElementsAre("backlash", "unmodelled"));
}

TEST_F(Conclusion, UnmodelledCauseJoinsEveryGroup) {
  leave(5);
  calibration.effects = {ahead_by(1000)};
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::unexplained);
  EXPECT_THAT(calibration.effects.front().group, testing::ElementsAre("backlash", "unmodelled"));
}

TEST_F(Conclusion, LikelierUnmodelledCauseJoinsEveryGroup) {
  leave(1);
  calibration.effects = {ahead_by(-1), ahead_by(1000)};
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::confounded);
  EXPECT_EQ(calibration.effects.back().group.size(), 2u);
}

TEST_F(Conclusion, AmbiguousPairBeginsWithNextMeasurement) {
  leave(1);
  find({{"zero_offset", "motor_offset"}});
  calibration.next = {plan::next_inspection("drive the joint to a mark"), plan::next_inspection("something else")};
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::confounded);
  EXPECT_THAT(calibration.summary,
              testing::StartsWith("Measure this first: drive the joint to a mark. The data are explained by one of {"));
  // A single cause requires no measurement first.
  calibration.effects.clear();
  find({{"backlash"}});
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::explained);
  EXPECT_THAT(calibration.summary, testing::StartsWith("The data are explained by backlash"));
}

TEST_F(Conclusion, ResidualAboveNoiseHasPlace) {
  leave(5);
  find({{"zero_offset", "motor_offset"}});
  // The largest mean is in the last twelfth of the falling strokes.
  for (std::size_t row = k_rows; row < k_rows + 2; ++row)
    selection.best.residual[static_cast<Eigen::Index>(row)] = 0.05;
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::unexplained);
  EXPECT_GT(calibration.unexplained_rms, 1.5 * k_floor);
  EXPECT_THAT(calibration.unexplained_where, HasSubstr("falling"));
  EXPECT_THAT(calibration.unexplained_where, HasSubstr("57.3°"));
  EXPECT_THAT(calibration.next.back().words, HasSubstr("quarter turn"));
  EXPECT_THAT(calibration.summary, HasSubstr("° rms remain, of which noise is 0.0573°"));
}

TEST_F(Conclusion, ResidualOfEffectsDiffersFromAnswer) {
  for (const bool more : {false, true}) {
    leave(5);
    calibration = {};
    find({{"backlash"}});
    if (more) calibration.effects.front().beside = {{"joint_sensor_gain", {}}};
    verdict();
    EXPECT_EQ(calibration.summary.find("with these alone") != std::string::npos, more) << calibration.summary;
  }
}

TEST_F(Conclusion, ResidualIsDescribedByFactors) {
  leave(1);
  for (const calibration::Block& block : evidence.blocks) {
    const int direction = evidence.measurement.runs[block.run].strokes[block.stroke].direction;
    for (const std::size_t row : block.rows)
      selection.best.residual[static_cast<Eigen::Index>(row)] += 5 * k_floor * direction;
  }
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::unexplained);
  ASSERT_FALSE(calibration.discrepancy.empty());
  EXPECT_EQ(calibration.discrepancy.front().factor, "direction");
  EXPECT_NEAR(calibration.discrepancy.front().rms, 5 * k_floor, 0.5 * k_floor);
  // The component is drawn for rising α, independent of the direction of its largest row.
  EXPECT_THAT(calibration.discrepancy.front().theta, testing::Each(testing::DoubleNear(5 * k_floor, 1.5 * k_floor)));
  EXPECT_THAT(calibration.summary, HasSubstr("depends on direction"));
}

TEST_F(Conclusion, StrokesThatDoNotRepeatComeFirst) {
  leave(1);
  for (const calibration::Block& block : evidence.blocks) {
    for (const std::size_t row : block.rows)
      selection.best.residual[static_cast<Eigen::Index>(row)] += block.stroke < 2 ? 3 * k_floor : -3 * k_floor;
  }
  find({{"backlash"}});
  EXPECT_EQ(verdict(), calibration::CalibrationVerdict::not_repeatable);
  EXPECT_THAT(calibration.next.front().words, HasSubstr("tighten"));
}

TEST(Verdicts, HaveDocumentedWords) {
  const std::vector<std::pair<calibration::CalibrationVerdict, std::string_view>> words = {
      {calibration::CalibrationVerdict::not_testable, "not_testable"},
      {calibration::CalibrationVerdict::not_repeatable, "not_repeatable"},
      {calibration::CalibrationVerdict::unexplained, "unexplained"},
      {calibration::CalibrationVerdict::confounded, "confounded"},
      {calibration::CalibrationVerdict::explained, "explained"},
      {calibration::CalibrationVerdict::no_effect, "no_effect"}};
  for (const auto& [verdict, expected] : words) EXPECT_EQ(calibration::word(verdict), expected);
}

TEST(Verdicts, TorqueForForceIsRefused) {
  measurement::Measurement measurement = measured({0, 5}, [](const measurement::Sample&) { return 0.0; });
  measurement.load_unit = "Nm";
  const DeclaredMechanism tendons = read_mechanism(std::string(FUSEE_SOURCE_DIR) + "/profiles/forearm.toml").mechanism;
  const calibration::Calibration found = calibration::calibrate(tendons, measurement);
  EXPECT_EQ(found.verdict, calibration::CalibrationVerdict::not_testable);
  EXPECT_THAT(found.summary, HasSubstr("a torque in Nm"));
}

TEST(RmsDrop, IsNeverNegative) {
  const calibration::Evidence evidence = evidence_of(measured({0, 5}, white_noise(k_floor, 1)));
  calibration::FitterPool pool(evidence);
  calibration::Selection selection;
  selection.catalogue = calibration::catalogue(joint(), evidence.measurement);
  const Effect& stretch = named("tendon_stretch");
  selection.none = pool.one().fit({}, {});
  selection.without = {selection.none};
  selection.best = pool.one().fit({&stretch}, {});
  selection.groups = {{{&stretch}, 0.0}};
  selection.best.by_factor.mean_square =
      2 * selection.none.by_factor.mean_square;  // the effect increases the held-out error
  const std::vector<calibration::FoundEffect> found = calibration::found_effects(evidence, selection, selection.best);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rms_drop, 0);
}

TEST(Rivals, GroupsHaveNoIdleMembers) {
  calibration::Selection selection;
  const Effect &gain = named("joint_sensor_gain"), &lag = named("sensor_lag");
  const auto likely = [](const calibration::EffectSet& effects, double log_evidence) {
    calibration::Fit fit;
    fit.effects = effects;
    fit.log_evidence = log_evidence;
    fit.usable = true;
    return fit;
  };
  selection.best = likely({&gain}, 10);
  selection.without = {likely({}, 8)};
  selection.rivals = {{&gain, &lag, likely({&lag}, 9)}};
  EXPECT_TRUE(calibration::equally_likely_rivals(selection).empty()) << "rarer than none, and hardly likelier";
  selection.without = {likely({}, 2)};
  EXPECT_EQ(calibration::equally_likely_rivals(selection).size(), 1u);
  selection.rivals.front().fit.log_evidence = 5;
  EXPECT_TRUE(calibration::equally_likely_rivals(selection).empty());
  selection.rivals = {{&lag, &gain, likely({&gain}, 9)}};
  EXPECT_TRUE(calibration::equally_likely_rivals(selection).empty()) << "what it stands for is not in the set";
}

TEST(FoundEffects, DescribeTheirSign) {
  const calibration::Evidence evidence = evidence_of(measured({0, 5}, white_noise(k_floor, 1)));
  calibration::FitterPool pool(evidence);
  calibration::Selection selection;
  selection.catalogue = calibration::catalogue(joint(), evidence.measurement);
  selection.none = pool.one().fit({}, {});
  selection.without = {selection.none};
  for (const auto& [gain, words] : {std::pair(-0.01, "the sensor reads too little"),
                                    std::pair(0.01, "the sensor reads too much"), std::pair(0.0, "")}) {
    selection.best = pool.one().fit({&named("joint_sensor_gain")}, {});
    selection.groups = {{{&named("joint_sensor_gain")}, 0.0}};
    selection.best.at.sensor.gain = gain;
    selection.best.x[1] = gain / named("joint_sensor_gain").parameters[0].step;
    const std::vector<calibration::FoundEffect> found = calibration::found_effects(evidence, selection, selection.best);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].parameters[0].sense, words);
  }
}

TEST(Effects, CaliperEffectsAskForReading) {
  const std::vector<std::pair<std::string, std::string>> words = {
      {"guide_radius", "diameter with a caliper and enter half of it as prior.guide_radius_mm"},
      {"radius_offset",
       "add what each is larger than declared (negative: smaller), and enter half of the sum as "
       "prior.radius_offset_mm"},
      {"guide_position", "the right pin is below the joint's axis (above it: negative) and enter it as prior.OE2_mm"}};
  for (const auto& [name, expected] : words) {
    const Effect* effect = find_effect(name, JointKind::tendons);
    ASSERT_NE(effect, nullptr);
    EXPECT_THAT(std::string(effect->parameters.back().by_hand.words), HasSubstr(expected));
  }
}

TEST(Selections, CopyOutlivesOriginal) {
  calibration::Selection copy;
  {
    calibration::Selection selection;
    const measurement::Measurement measurement = measured({0, 5}, [](const measurement::Sample&) { return 0.0; });
    selection.catalogue = calibration::catalogue(joint(), measurement);
    selection.best.effects = {&named("backlash")};
    copy = selection;
  }
  EXPECT_EQ(copy.best.effects.front()->name, "backlash");
  EXPECT_TRUE(calibration::contains(copy.catalogue, *copy.best.effects.front()));
}

}  // namespace
}  // namespace fusee::calibration::linear
