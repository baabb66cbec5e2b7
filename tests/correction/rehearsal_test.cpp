// Each slider of the report shows the effect's influence, compared with independent equations where they exist.
#include <gmock/gmock.h>

#include <cmath>

#include "fusee/base.h"
#include "fusee/correction.h"
#include "fusee/mechanism_file.h"
#include "fusee/transmission.h"
#include "support/mechanisms.h"

namespace fusee::correction {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

DeclaredMechanism stiff() {
  DeclaredMechanism declared;
  static_cast<Mechanism&>(declared) = testing::forearm();
  declared.load = {};
  declared.guides.mu = declared.pulley.mu = 0;
  declared.tendon.modulus = 1e6;
  return declared;
}

calibration::Calibration with_play(double width) {
  calibration::Calibration calibration;
  calibration.effects.push_back({});
  calibration.effects.back().name = "backlash";
  calibration.identified.shaft.backlash = width;
  return calibration;
}

TEST(Rehearse, PlayLagsByHalfItsWidth) {
  const double width = radians(2);
  const Rehearsal rehearsal = rehearse(stiff(), {}, with_play(width));
  ASSERT_THAT(rehearsal.effects, SizeIs(1));
  const transmission::Transmission law(stiff());
  const auto& stroke = rehearsal.synthesis.stroke;
  for (std::size_t s = 0; s < k_rehearsed_shares.size(); ++s) {
    const RehearsedShare& share = rehearsal.effects[0].shares[s];
    EXPECT_NEAR(share.parameters.at(0).value, degrees(k_rehearsed_shares[s] * width), 1e-9);
    // At the ends the motor reverses and play is taken up.
    for (std::size_t i = 5; i + 5 < stroke.size(); ++i) {
      const double half = 0.5 * k_rehearsed_shares[s] * width;
      EXPECT_NEAR(share.rising.at(0)[i], law.theta(stroke[i].alpha - half) - stroke[i].theta, radians(2e-3));
      EXPECT_NEAR(share.falling.at(0)[i], law.theta(stroke[i].alpha + half) - stroke[i].theta, radians(2e-3));
    }
  }
}

// Regression: the slider showed "slack 0.004 mm, pretension 5 N" for a joint identified without pretension.
TEST(Rehearse, InertEffectShowsZero) {
  calibration::Calibration calibration = with_play(0);
  calibration.effects.back().name = "slack";
  calibration.identified.tendon.slack = 0.3;
  const Rehearsal rehearsal = rehearse(stiff(), {}, calibration);
  ASSERT_THAT(rehearsal.effects, SizeIs(1));
  for (std::size_t s = 0; s < k_rehearsed_shares.size(); ++s) {
    const auto& numbers = rehearsal.effects[0].shares[s].parameters;
    EXPECT_NEAR(numbers.at(0).value, k_rehearsed_shares[s] * 0.3, 1e-9);
    EXPECT_EQ(numbers.at(1).value, k_rehearsed_shares[s] > 0 ? 0.0 : stiff().tendon.pretension);
  }
}

TEST(Rehearse, UsesLoggedLoads) {
  measurement::Measurement measurement;
  measurement.load_unit = "N";
  fusee::measurement::Run run;
  run.has_load = true;
  for (const double load : {0.0, 4.0, 12.0}) {
    measurement::Sample sample;
    sample.load = load;
    run.samples.push_back(sample);
  }
  measurement.runs.push_back(run);
  const Rehearsal rehearsal = rehearse(stiff(), measurement, with_play(radians(1)));
  ASSERT_THAT(rehearsal.strokes, SizeIs(2));
  EXPECT_EQ(rehearsal.strokes[0].load, 0);
  EXPECT_EQ(rehearsal.strokes[1].load, 12);
  EXPECT_GT(rehearsal.strokes[1].points[30].rising.t2.upper, rehearsal.strokes[0].points[30].rising.t2.upper + 1);
  EXPECT_THAT(rehearsal.effects[0].shares[2].rising, SizeIs(2));
  // A torque is not a tip force.
  measurement.load_unit = "Nmm";
  EXPECT_THAT(rehearse(stiff(), measurement, with_play(radians(1))).strokes, SizeIs(1));
}

TEST(Rehearse, IsEmptyWithoutMotionOrPulley) {
  EXPECT_THAT(rehearse(stiff(), {}, {}).effects, IsEmpty());
  EXPECT_THAT(rehearse(stiff(), {}, with_play(radians(1e-4))).effects, IsEmpty());
  const DeclaredMechanism jaw =
      parse_mechanism("schema = 1\nname = \"jaw\"\n[transmission]\nkind = \"ratio\"\nratio = -1.1\n", "jaw.toml");
  EXPECT_THAT(rehearse(jaw, {}, with_play(radians(2))).effects, IsEmpty());
}

}  // namespace
}  // namespace fusee::correction
