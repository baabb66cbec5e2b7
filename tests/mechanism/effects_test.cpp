// Effects: keys, order, and merging of two calibrations.
#include <gmock/gmock.h>

#include <set>

#include "fusee/mechanism_file.h"
#include "mechanism/effect.h"

namespace fusee {
namespace {

class EveryKind : public ::testing::TestWithParam<JointKind> {};

TEST_P(EveryKind, FollowsOrderOfChain) {
  std::pair<ChainPlace, int> before{ChainPlace::motor_sensor, 0};
  for (const Effect& effect : effects(GetParam())) {
    const std::pair<ChainPlace, int> here{effect.place, effect.rank};
    EXPECT_LT(before, here) << effect.name << " shares its rank with another effect of the " << word(effect.place);
    before = here;
  }
}

TEST_P(EveryKind, HasDistinctParameters) {
  for (const Effect& effect : effects(GetParam())) {
    EXPECT_FALSE(effect.parameters.empty()) << effect.name;
    for (const EffectParameter& parameter : effect.parameters) {
      EXPECT_LT(parameter.least, parameter.most) << effect.name << " " << parameter.name;
      EXPECT_GT(parameter.step, 0) << effect.name << " " << parameter.name;
      EXPECT_EQ(parameter.prior > 0, !parameter.searched) << effect.name << " " << parameter.name;
      if (!parameter.searched && parameter.prior_unit == PriorUnit::own) {
        EXPECT_GT(parameter.prior, parameter.step) << effect.name << " " << parameter.name;
        EXPECT_LE(parameter.prior, parameter.most) << effect.name << " " << parameter.name;
      }
      Imperfections joint;
      set_value(joint, parameter, 0.25);
      EXPECT_EQ(value_of(joint, parameter), 0.25);
      EXPECT_NE(joint, Imperfections{}) << parameter.name << " moves nothing of the joint";
      reset(joint, parameter);
      EXPECT_EQ(joint, Imperfections{});
    }
    for (const std::vector<double>& start : effect.starts) EXPECT_EQ(start.size(), effect.parameters.size());
  }
}

TEST_P(EveryKind, HasKeyInFile) {
  for (const Effect& effect : effects(GetParam())) {
    for (const EffectParameter& parameter : effect.parameters) {
      const Field* field = find_field("identified." + std::string(parameter.key.name));
      ASSERT_NE(field, nullptr) << effect.name << " " << parameter.name;
      DeclaredMechanism mechanism = default_mechanism();
      const double inside = 0.5 * (std::max(field->least, -1.0) + std::min(field->most, 2.0));
      field->set(mechanism, 0, inside);
      EXPECT_NEAR(value_of(mechanism.identified, parameter), parameter.key.from_file(inside), 1e-15) << field->name();
      EXPECT_NEAR(field->get(mechanism, 0), inside, 1e-12) << field->name();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind, ::testing::Values(JointKind::tendons, JointKind::ratio),
                         [](const auto& one) {
                           return std::string(one.param == JointKind::tendons ? "tendons" : "ratio");
                         });

TEST(Identified, HasOnlyKeysOfEffects) {
  std::set<std::string> keys{"mean_load_N"};
  for (const JointKind kind : {JointKind::tendons, JointKind::ratio}) {
    for (const Effect& effect : effects(kind)) {
      for (const EffectParameter& parameter : effect.parameters) keys.insert(std::string(parameter.key.name));
    }
  }
  std::set<std::string> rows;
  for (const Field& field : fields()) {
    if (field.table != "identified") continue;
    EXPECT_TRUE(rows.insert(std::string(field.key)).second) << field.key;
  }
  EXPECT_EQ(rows, keys);
}

TEST(MergeFindings, AddsCompoundsOrReplaces) {
  Imperfections before, found;
  before.pins.radius = 1;
  found.pins.radius = 0.5;
  before.tendon.stretch = 1;
  found.tendon.stretch = 0.5;
  before.shaft.backlash = 0.1;
  found.shaft.backlash = 0.02;
  const Imperfections total = merge_findings(before, found, JointKind::tendons);
  EXPECT_EQ(total.pins.radius, 1.5);
  EXPECT_EQ(total.tendon.stretch, 2);
  EXPECT_EQ(total.shaft.backlash, 0.02);
  const Imperfections beyond = beyond_mechanism(total, JointKind::tendons);
  EXPECT_EQ(beyond.pins, PinError{});
  EXPECT_EQ(beyond.tendon, TendonError{});
  EXPECT_EQ(beyond.shaft.backlash, 0.02);
}

TEST(MergeFindings, KeepsLargerOfTwoHarmonics) {
  Imperfections before, found;
  before.pulley.outline.wave_sin = 0.2;
  found.pulley.outline.wave_sin = 0.1;
  EXPECT_NEAR(merge_findings(before, found, JointKind::tendons).pulley.outline.wave_sin, 0.3, 1e-15);
  found.pulley.outline.wave_order = 3;
  const OutlineError larger = merge_findings(before, found, JointKind::tendons).pulley.outline;
  EXPECT_EQ(larger.wave_sin, 0.2);
  EXPECT_EQ(larger.wave_order, 2);
}

}  // namespace
}  // namespace fusee
