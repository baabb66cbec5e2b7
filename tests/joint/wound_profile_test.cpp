// The wound tendon on a round pulley, compared with closed formulas.
#include "joint/wound_profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fusee::joint {
namespace {

constexpr double k_radius = 10.0;
constexpr double k_home = 4e-3;  // strain

GroovePlace at(double turn) { return {turn, k_radius * turn}; }

/// A tendon that is tied 5 mm beyond turn 0 and whose home is at `turn`.
WoundProfile wound(double turn, double friction) {
  std::vector<GroovePlace> along;
  for (int i = 0; i <= 30; ++i) along.push_back(at(0.1 * i));
  const auto groove = std::make_shared<const GrooveArc>(along, 5.0);
  return {groove, friction, at(turn), 1.0 / (1.0 + k_home)};
}

/// Turns to a position and pulls there by a strain; returns the released material.
double pulled(WoundProfile& profile, double turn, double strain) {
  const TurnedPulley turned = profile.turned_to(at(turn), 1.0);
  const Slide slide = profile.slide(turned, strain, 1.0);
  EXPECT_NEAR(-profile.accept(turned, slide, 1.0).material, slide.freed, 1e-13);
  return slide.freed;
}

/// Material of an arc over which the strain decays from `strain` by e^{fall φ}, over `turn`.
double sliding(double strain, double fall, double turn) {
  return -k_radius / fall * std::log((std::exp(-fall * turn) + strain) / (1.0 + strain));
}

// 0.1 rad is 1 mm of arc; the density along a wound arc varies linearly.
TEST(WoundProfile, PaysOutLastFirstWithoutSliding) {
  WoundProfile profile = wound(1.0, 1e12);
  const double density[] = {1 / 1.004, 1 / 1.006, 1 / 1.001};
  EXPECT_NEAR(pulled(profile, 1.2, 6e-3), -(density[0] + density[1]), 1e-13);
  EXPECT_NEAR(pulled(profile, 1.3, 1e-3), -0.5 * (density[1] + density[2]), 1e-13);
  EXPECT_NEAR(pulled(profile, 1.2, 8e-3), 0.5 * (density[1] + density[2]), 1e-13);
  EXPECT_NEAR(pulled(profile, 1.0, 2e-3), density[0] + density[1], 1e-13);
  EXPECT_NEAR(pulled(profile, 0.4, 2e-3), 6.0 * density[0], 1e-13);
}

// The arc from the knot to the take-off at the turn t is 5 mm + 10 mm · t.
TEST(WoundProfile, IsSpringWithoutFriction) {
  WoundProfile profile = wound(1.0, 0.0);
  EXPECT_NEAR(pulled(profile, 1.0, 6e-3), 15.0 / 1.004 - 15.0 / 1.006, 1e-13);
  EXPECT_NEAR(pulled(profile, 1.7, 2e-3), 15.0 / 1.006 - 22.0 / 1.002, 1e-13);
  EXPECT_NEAR(pulled(profile, 0.2, 2e-3), (22.0 - 7.0) / 1.002, 1e-13);
  const Slide slide = profile.slide(profile.turned_to(at(0.2), 1.0), 5e-3, 1.0);
  EXPECT_NEAR(slide.length, 7.0, 1e-13);
}

TEST(WoundProfile, FollowsCapstanLaw) {
  for (const double friction : {0.05, 0.2, 0.6}) {
    WoundProfile profile = wound(3.0, friction);
    const double pull = k_home * std::exp(friction * 2.0);  // reaches 2 rad deep
    EXPECT_NEAR(pulled(profile, 3.0, pull), 20.0 / (1 + k_home) - sliding(pull, -friction, 2.0), 1e-7 * 20 * pull);
    // Slightly less: only the part near the take-off releases, up to the intersection of both bounds.
    const double less = pull * std::exp(-friction);
    EXPECT_NEAR(pulled(profile, 3.0, less), sliding(pull, -friction, 0.5) - sliding(less, friction, 0.5),
                1e-7 * 20 * pull);
    // Pulling again as before restores the state.
    EXPECT_NEAR(pulled(profile, 3.0, pull), sliding(less, friction, 0.5) - sliding(pull, -friction, 0.5),
                1e-7 * 20 * pull);
    EXPECT_NEAR(pulled(profile, 3.0, pull), 0.0, 1e-13);
  }
}

TEST(WoundProfile, WindingMovesOnlyBeyondFriction) {
  // Friction over 0.1 rad balances a growth of the strain by e^{0.02}. A smaller growth moves no wound tendon; a larger
  // one moves the new arc and the tendon behind it.
  WoundProfile profile = wound(1.0, 0.2);
  const double balanced = k_home * std::exp(0.015);
  EXPECT_NEAR(pulled(profile, 1.1, balanced), -0.5 * (1 / (1 + k_home) + 1 / (1 + balanced)), 1e-13);
  profile = wound(1.0, 0.2);
  const double pull = k_home * std::exp(0.06);  // 0.3 rad
  const double at_former_take_off = k_home * std::exp(0.04);
  EXPECT_NEAR(pulled(profile, 1.1, pull),
              2.0 / (1 + k_home) - sliding(at_former_take_off, -0.2, 0.2) -
                  0.5 * (1 / (1 + at_former_take_off) + 1 / (1 + pull)),
              1e-11);
}

TEST(WoundProfile, RatesAgreeWithDifferences) {
  // Cycles first divide the profile into several pieces.
  WoundProfile profile = wound(1.0, 0.2);
  const double path[][2] = {{1.5, 5e-3}, {2.0, 3e-3}, {1.8, 6e-3}, {2.4, 4e-3}, {2.1, 4.5e-3}};
  double from[] = {1.0, k_home};
  for (const auto& [turn, strain] : path) {
    for (int i = 1; i <= 50; ++i)
      pulled(profile, from[0] + (turn - from[0]) * i / 50, from[1] + (strain - from[1]) * i / 50);
    from[0] = turn;
    from[1] = strain;
  }
  for (const double turn : {1.2, 1.9, 2.1, 2.2, 2.9}) {
    const TurnedPulley turned = profile.turned_to(at(turn), 1.0);
    for (const double strain : {1e-4, 2e-3, 4.4e-3, 4.6e-3, 7e-3}) {
      const double step = 1e-4 * strain;
      const double slope =
          (profile.slide(turned, strain + step, 1.0).freed - profile.slide(turned, strain - step, 1.0).freed) /
          (2 * step);
      const double length = profile.slide(turned, strain, 1.0).length;
      EXPECT_NEAR(length / ((1 + strain) * (1 + strain)), slope, 1e-4 * slope + 1e-6) << turn << " " << strain;
    }
  }
}

TEST(WoundProfile, ReleasesAllWithoutTension) {
  WoundProfile profile = wound(2.0, 0.2);
  EXPECT_NEAR(pulled(profile, 2.0, 0.0), 25.0 / (1 + k_home) - 25.0, 1e-12);
  EXPECT_NEAR(pulled(profile, 2.0, 1e-3), 25.0 - sliding(1e-3, -0.2, 2.5), 1e-9);
}

TEST(WoundProfile, ContinuesBeyondKnot) {
  WoundProfile profile = wound(0.5, 0.2);
  EXPECT_NEAR(pulled(profile, -0.8, k_home), 13.0 / (1 + k_home), 1e-13);
  EXPECT_NEAR(pulled(profile, -0.6, k_home), -2.0 / (1 + k_home), 1e-13);
}

TEST(WoundProfile, DissipatesFrictionWork) {
  // A pull-release cycle: the area of the hysteresis is the work of friction, so it is never negative.
  WoundProfile profile = wound(3.0, 0.3);
  pulled(profile, 3.0, 8e-3);
  double work = 0;
  double before = 8e-3;
  const auto to = [&](double strain) {
    const double freed = pulled(profile, 3.0, strain);
    work += 0.5 * (before + 0.5 * before * before + strain + 0.5 * strain * strain) * freed;
    before = strain;
  };
  for (int i = 1; i <= 400; ++i) to(8e-3 - 6e-3 * i / 400);
  for (int i = 1; i <= 400; ++i) to(2e-3 + 6e-3 * i / 400);
  EXPECT_GT(work, 1e-6);
  EXPECT_LT(work, 6e-3 * 30 * 6e-3);
}

}  // namespace
}  // namespace fusee::joint
