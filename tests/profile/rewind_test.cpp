#include <gtest/gtest.h>

#include "fusee/base.h"
#include "fusee/profile.h"
#include "support/mechanisms.h"

namespace fusee::profile {
namespace {

using testing::forearm;
using testing::linear_wrist;
using testing::unsymmetric;

/// Half the thickness of forearm's tendon: from the pitch curve to the groove floor. mm
constexpr double k_to_floor = -0.5;

RewindResult wound(const Mechanism& mechanism, const SynthesisResult& made) {
  const double to_floor = -0.5 * mechanism.tendon.diameter;
  return rewind(mechanism, parallel(made.p1, to_floor), parallel(made.p2, to_floor));
}

// Independent verification: the analytic envelope agrees with a string wound on its polygon, and better with a finer
// polygon.
TEST(Rewind, ReproducesTargetMotion) {
  for (const Mechanism& mechanism : {forearm(), linear_wrist(), unsymmetric()}) {
    const SynthesisResult fine = synthesise(mechanism, {.chord_error_mm = 1e-6});
    ASSERT_TRUE(fine.made()) << fine.brief();
    const RewindResult result = wound(mechanism, fine);
    EXPECT_LT(degrees(result.max_theta_error), 2e-6);
    EXPECT_LT(result.max_excess, 2e-6);
  }
}

TEST(Rewind, ErrorFollowsChordLength) {
  const SynthesisResult coarse = synthesise(forearm(), {.chord_error_mm = 0.01});
  const RewindResult result = wound(forearm(), coarse);
  EXPECT_GT(degrees(result.max_theta_error), 1e-4);
  EXPECT_LT(degrees(result.max_theta_error), 0.01);
}

TEST(Rewind, DetectsWrongTurningSense) {
  // A profile drawn with the wrong turning sense looks plausible but is wrong.
  const SynthesisResult made = synthesise(forearm());
  Polygon wrong;
  for (const Vec2& point : parallel(made.p2, k_to_floor)) wrong.insert(wrong.begin(), Vec2(-point.x(), point.y()));
  const RewindResult result = rewind(forearm(), parallel(made.p1, k_to_floor), wrong);
  EXPECT_GT(result.max_excess, 1.0);
}

TEST(Rewind, DetectsScaledAndTurnedPulley) {
  const SynthesisResult made = synthesise(forearm());
  Polygon larger = parallel(made.p1, k_to_floor);
  for (Vec2& point : larger) point *= 1.02;
  EXPECT_GT(degrees(rewind(forearm(), larger, parallel(made.p2, k_to_floor)).max_theta_error), 0.4);
  Polygon turned = parallel(made.p2, k_to_floor);
  const Vec2 rotation = unit(radians(3));
  for (Vec2& point : turned)
    point =
        Vec2(rotation.x() * point.x() - rotation.y() * point.y(), rotation.y() * point.x() + rotation.x() * point.y());
  EXPECT_GT(rewind(forearm(), parallel(made.p1, k_to_floor), turned).max_excess, 0.05);
}

TEST(Rewind, DetectsMovedSheathExit) {
  Mechanism mechanism = testing::sheathed_wrist();
  const SynthesisResult made = synthesise(mechanism);
  ASSERT_TRUE(made.made()) << made.brief();
  const Polygon floor1 = parallel(made.p1, k_to_floor), floor2 = parallel(made.p2, k_to_floor);
  EXPECT_LT(degrees(rewind(mechanism, floor1, floor2).max_theta_error), 0.005);
  mechanism.pulley.EF = 1000.0;
  EXPECT_LT(degrees(rewind(mechanism, floor1, floor2).max_theta_error), 0.005);
  mechanism.sheath.exit_across += 5.0;
  EXPECT_GT(degrees(rewind(mechanism, floor1, floor2).max_theta_error), 0.05);  // more than the limit of build's check
}

TEST(Rewind, CountsFullTurns) {
  // A round pulley of 4 mm on both sides needs more than a turn each way; θ must follow the compensating law.
  Mechanism mechanism = forearm();
  mechanism.pulley.r1 = 4.0;
  Polygon circle;
  for (int i = 0; i < 2000; ++i) circle.push_back((4.0 + k_to_floor) * unit(k_two_pi * i / 2000));
  EXPECT_LT(degrees(rewind(mechanism, circle, circle, 400).max_theta_error), 1e-4);
}

TEST(Rewind, BridgesHollows) {
  const SynthesisResult made = synthesise(forearm());
  Polygon notched = parallel(made.p1, k_to_floor);
  notched[notched.size() / 2] *= 0.8;
  EXPECT_LT(degrees(rewind(forearm(), notched, parallel(made.p2, k_to_floor)).max_theta_error), 0.1);
}

TEST(Rewind, RejectsInvalidFloors) {
  const SynthesisResult made = synthesise(forearm());
  const Polygon floor = parallel(made.p1, k_to_floor);
  Polygon aside = floor;
  for (Vec2& point : aside) point.x() += 30.0;
  EXPECT_THROW(rewind(forearm(), aside, floor), InputError);
  EXPECT_THROW(rewind(forearm(), floor, Polygon{{1, 0}, {0, 1}}), InputError);
  Polygon huge = floor;
  for (Vec2& point : huge) point *= 12.0;
  EXPECT_THROW(rewind(forearm(), huge, floor), InputError);
}

}  // namespace
}  // namespace fusee::profile
