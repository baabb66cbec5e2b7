#include "fusee/helix/synthesis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "helix/spiral_string.h"

namespace fusee {
namespace {

/// A shallow groove, and 45° wherever a turn stands out over its neighbour.
HelixGroove groove() {
  return {0.6, [](double step) { return 2.0 + std::abs(step); }};
}

Mechanism wrist() {
  Mechanism m;
  m.joint.R = 180;
  m.joint.theta_min = radians(-40);
  m.joint.theta_max = radians(40);
  m.guides.EB = m.guides.ED = 120;
  m.guides.OE = -60;
  m.guides.radius = 3;
  m.pulley.EF = 160;
  m.pulley.law = Law::linear;
  m.pulley.ratio = 13.5;
  m.tendon.diameter = 0.6;
  m.tendon.modulus = 40000;
  m.tendon.bend_ratio = 8;
  return m;
}

struct Variation {
  double length = 0, fleet = 0;
};

/// Of a string's length along the stroke: α of the law, θ of the synthesis.
Variation variation_of(const Mechanism& m, const HelixSynthesis& made, Side side) {
  const HelixSide& helix = made.sides[side == Side::left ? 0 : 1];
  double least = 1e300, most = -1e300;
  Variation variation;
  for (std::size_t i = 0; i < made.stroke.size(); i += 3) {
    const TransmissionPoint& point = made.stroke[i];
    const StringLength string =
        string_length(m, side, helix.spiral, helix.attachment_z, point.alpha, point.theta);
    least = std::min(least, string.total);
    most = std::max(most, string.total);
    variation.fleet = std::max(variation.fleet, std::abs(std::abs(string.fleet) - std::abs(helix.stroke[i].fleet)));
  }
  variation.length = most - least;
  return variation;
}

std::string failures(const HelixSynthesis& made) {
  std::string text;
  for (const Condition& condition : made.conditions)
    if (!condition.ok) text += condition.name + ": " + condition.message + "\n";
  return text;
}

void expect_closed(const Mechanism& m, double limit = 0.004) {
  const HelixSynthesis made = synthesise_helix(m, groove(), {.tolerance = 1e-5});
  ASSERT_TRUE(made.made()) << failures(made);
  for (const Side side : {Side::left, Side::right}) {
    const Variation variation = variation_of(m, made, side);
    printf("%s turns %.3f lead %.3f fleet %.3f deg closure %.2e variation %.5f fleetdiff %.4f rows %zu\n",
           pulley_name(side).data(), made.sides[side == Side::left ? 0 : 1].turns,
           made.sides[side == Side::left ? 0 : 1].lead, degrees(made.sides[side == Side::left ? 0 : 1].fleet),
           made.closure, variation.length, degrees(variation.fleet), made.sides[0].spiral.rows.size());
    EXPECT_LT(variation.length, limit) << pulley_name(side);
  }
}

TEST(HelixSynthesis, AStringInSpaceHasTheSameLengthOverTheStroke) { expect_closed(wrist()); }

TEST(HelixSynthesis, WithCollarsItsLowerSpanAloneSlopes) {
  Mechanism m = wrist();
  m.guides.collar = true;
  expect_closed(m);
}

TEST(HelixSynthesis, ARoundP1TurnsTheJointByWhatItsSlopedTendonLeaves) {
  Mechanism m = wrist();
  m.pulley.law = Law::compensate;
  m.pulley.r1 = 9;
  expect_closed(m);
}

}  // namespace
}  // namespace fusee
