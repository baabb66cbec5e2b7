#include "joint/wound_profile.h"

#include <gtest/gtest.h>

namespace fusee {
namespace {

TEST(WoundProfile, GivesBackWhatWasWoundLastFirst) {
  WoundProfile profile(10.0, 0.9);
  profile.wind(12.0, 0.8, 0.6);
  profile.wind(13.0, 0.6, 0.5);
  EXPECT_DOUBLE_EQ(profile.material_above(12.0), 0.55);
  EXPECT_DOUBLE_EQ(profile.material_above(11.0), 0.55 + 0.65);
  EXPECT_DOUBLE_EQ(profile.material_above(8.0), 0.55 + 1.4 + 1.8);
  const std::vector<WoundPiece> paid = profile.pay_out(11.0);
  ASSERT_EQ(paid.size(), 2u);
  EXPECT_DOUBLE_EQ(paid[0].material(), 0.55);
  EXPECT_DOUBLE_EQ(paid[1].density_from, 0.7);
  EXPECT_DOUBLE_EQ(paid[1].material(), 0.65);
  EXPECT_DOUBLE_EQ(profile.arc(), 11.0);
  EXPECT_DOUBLE_EQ(profile.material_above(10.0), 0.75);
}

TEST(WoundProfile, KeepsAJumpWhereItWasWoundOnAgain) {
  WoundProfile profile(0.0, 1.0);
  profile.wind(2.0, 0.5, 0.5);
  profile.pay_out(1.0);
  profile.wind(2.0, 0.9, 0.9);
  EXPECT_DOUBLE_EQ(profile.material_above(0.0), 0.5 + 0.9);
}

TEST(WoundProfile, GoesOnBelowItsBeginning) {
  WoundProfile profile(5.0, 0.8);
  const std::vector<WoundPiece> paid = profile.pay_out(3.0);
  ASSERT_EQ(paid.size(), 1u);
  EXPECT_DOUBLE_EQ(paid[0].material(), 1.6);
  EXPECT_DOUBLE_EQ(profile.arc(), 3.0);
}

}  // namespace
}  // namespace fusee
