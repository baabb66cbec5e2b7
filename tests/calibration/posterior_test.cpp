// Credible groups, compared with explicit sums over all sets.
#include "calibration/posterior.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "calibration/catalogue.h"
#include "calibration/linear_joint.h"
#include "calibration/thresholds.h"

namespace fusee::calibration::linear {
namespace {

std::array<Effect, 5> letter_effects() {
  std::array<Effect, 5> all;
  for (std::size_t i = 0; i < all.size(); ++i) all[i].name = std::string(1, static_cast<char>('a' + i));
  return all;
}

std::string names(const calibration::EffectSet& effects) {
  std::string text;
  for (const Effect* effect : effects) text += effect->name;
  return text;
}

double rms(const Eigen::VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

class Groups : public ::testing::Test {
 protected:
  calibration::WeightedSet set(const std::string& letters, double weight) const {
    return {of(letters), std::log(weight)};
  }
  calibration::EffectSet of(const std::string& letters) const {
    calibration::EffectSet set;
    for (const char letter : letters) set.push_back(&all_[static_cast<std::size_t>(letter - 'a')]);
    return set;
  }
  calibration::CredibleGroup group(const std::vector<calibration::WeightedSet>& sets, const std::string& best,
                                   char named) const {
    return calibration::credible_group(sets, of(best), *of(std::string(1, named)).front(), 0.02);
  }

  std::array<Effect, 5> all_ = letter_effects();
};

TEST_F(Groups, ContainOneMemberWithoutAlternatives) {
  const calibration::CredibleGroup found = group({set("", 1), set("a", 99), set("b", 1e-6)}, "a", 'a');
  EXPECT_EQ(names(found.members), "a");
  EXPECT_NEAR(found.absence_probability, 0.01, 1e-7);
}

TEST_F(Groups, HoldEffectsThatReplaceNamedOne) {
  const calibration::CredibleGroup found = group({set("a", 60), set("b", 39), set("c", 0.5), set("", 0.5)}, "a", 'a');
  EXPECT_EQ(names(found.members), "ab");
  EXPECT_NEAR(found.absence_probability, 0.01, 1e-12);
}

TEST_F(Groups, HoldOneOfTwoReplacements) {
  const calibration::CredibleGroup found = group({set("a", 70), set("bc", 30)}, "a", 'a');
  EXPECT_EQ(found.members.size(), 2u);
  EXPECT_NEAR(found.absence_probability, 0, 1e-12);
}

TEST_F(Groups, KeepAbsenceProbabilityWithoutReplacement) {
  const calibration::CredibleGroup found = group({set("ab", 90), set("b", 10)}, "ab", 'a');
  EXPECT_EQ(names(found.members), "a");
  EXPECT_NEAR(found.absence_probability, 0.1, 1e-12);
}

TEST_F(Groups, HoldMembersThatReduceAbsenceProbability) {
  const std::vector<calibration::WeightedSet> sets = {set("a", 60), set("b", 30), set("c", 1), set("d", 1), set("", 8)};
  EXPECT_EQ(names(group(sets, "a", 'a').members), "abcd");
  const calibration::CredibleGroup found = calibration::credible_group(sets, of("a"), *of("a").front(), 0.02, 0.2);
  EXPECT_EQ(names(found.members), "ab");
  EXPECT_NEAR(found.absence_probability, 0.1, 1e-12);
}

TEST_F(Groups, DoNotHoldOtherMembersOfTheSet) {
  const calibration::CredibleGroup found = group({set("ab", 50), set("bc", 50)}, "ab", 'a');
  EXPECT_EQ(names(found.members), "ac");
}

TEST_F(Groups, IgnoreUnitOfWeights) {
  std::vector<calibration::WeightedSet> sets = {set("a", 60), set("b", 39), set("", 1)};
  const calibration::CredibleGroup before = group(sets, "a", 'a');
  for (calibration::WeightedSet& one : sets) one.log_weight += 5000;
  const calibration::CredibleGroup after = group(sets, "a", 'a');
  EXPECT_EQ(before.members, after.members);
  EXPECT_NEAR(before.absence_probability, after.absence_probability, 1e-12);
}

TEST_F(Groups, MatchWeightOfSetsWithoutMembers) {
  std::mt19937 dice(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<calibration::WeightedSet> sets;
    for (int bits = 0; bits < 32; ++bits) {
      std::string letters;
      for (int i = 0; i < 5; ++i) letters += (bits >> i) % 2 == 1 ? std::string(1, static_cast<char>('a' + i)) : "";
      sets.push_back(set(letters, std::exp(std::uniform_real_distribution<double>(-12, 0)(dice))));
    }
    const calibration::CredibleGroup found = group(sets, "ab", 'a');
    double all = 0, without = 0;
    for (const calibration::WeightedSet& one : sets) {
      all += std::exp(one.log_weight);
      const std::string letters = names(one.effects);
      if (letters.find_first_of(names(found.members)) == std::string::npos) without += std::exp(one.log_weight);
    }
    EXPECT_NEAR(found.absence_probability, without / all, 1e-12);
    EXPECT_TRUE(found.absence_probability <= 0.02 || found.members.size() == 4u) << names(found.members);  // all but b
  }
}

TEST(ExpectedSizes, LimitReadingToObservedError) {
  const double size = 40 * k_floor;
  calibration::Evidence evidence =
      evidence_of(measured({0, 5}, [&](const measurement::Sample& sample) { return size * std::sin(sample.alpha); }));
  calibration::FitterPool pool(evidence);
  const calibration::EffectSet all = {&named("tendon_stretch"), &named("joint_sensor_gain")};
  evidence.sizes = calibration::expected_sizes(all, evidence, pool);
  const calibration::Fit none = pool.one().fit({}, {});
  const double seen = calibration::k_thresholds.most_expected * rms(calibration::tangent_of(evidence, none).residual);
  // The prior of the stretch, five degrees at the largest load, exceeds the observed error and is reduced to it. That
  // of the gain is smaller already.
  for (const Effect* effect : all) {
    const calibration::Tangent wider = calibration::tangent_of(evidence, pool.one().add_chords(none, *effect));
    const Eigen::Index k = wider.x.size() - 1;
    const double moved = wider.prior[k] * rms(wider.J.col(k));
    if (evidence.sizes.count(&effect->parameters.front())) {
      EXPECT_NEAR(moved, seen, 1e-6 * seen) << effect->name;
    } else {
      EXPECT_LE(moved, seen) << effect->name;
    }
  }
  EXPECT_EQ(evidence.sizes.size(), 1u);
}

TEST(ExpectedSizes, ShrinkWithObservedSize) {
  const auto size_of_stretch = [](double error) {
    calibration::Evidence evidence =
        evidence_of(measured({0, 5}, [&](const measurement::Sample& sample) { return error * sample.alpha; }));
    calibration::FitterPool pool(evidence);
    const Effect& stretch = named("tendon_stretch");
    return calibration::expected_sizes({&stretch}, evidence, pool).at(&stretch.parameters.front());
  };
  EXPECT_LT(2 * size_of_stretch(0.0), size_of_stretch(0.02));
}

TEST(StartsInTime, LieBetweenTwoRowsOfStep) {
  constexpr std::size_t k_run = 3, k_row = 33;
  measurement::Measurement measurement = measured({0, 5, 0, 5, 0, 5, 0, 5}, white_noise(k_floor, 3));
  for (std::size_t r = k_run; r < measurement.runs.size(); ++r) {
    std::vector<measurement::Sample>& samples = measurement.runs[r].samples;
    for (std::size_t i = r == k_run ? k_row : 0; i < samples.size(); ++i) samples[i].theta += 10 * k_floor;
  }
  const calibration::Evidence evidence = evidence_of(measurement);
  calibration::FitterPool pool(evidence);
  const double row = joint::bench_clock(evidence.log)[k_run] + measurement.runs[k_run].samples[k_row].time;
  const double time = calibration::starts_of(evidence, pool.one().fit({}, {}), named("tendon_slip")).front().back();
  EXPECT_GT(time, row - 1);
  EXPECT_LT(time, row);
}

}  // namespace
}  // namespace fusee::calibration::linear
