#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fusee/helix.h"
#include "helix/spiral_string.h"

namespace fusee::helix {
namespace {

/// A shallow groove. Where a turn overhangs its neighbour, the lead grows with the overhang, for a slope of 45°.
HelixGroove groove() {
  return {0.6, 0.6, [](double step) { return 2.0 + std::abs(step); }};
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

const HelixSide& side_of(const HelixSynthesis& made, transmission::Side side) {
  return made.sides[side == transmission::Side::left ? 0 : 1];
}

struct Variation {
  double length = 0;  ///< variation of the string's length over the stroke, mm
  double fleet = 0;   ///< largest difference of the fleet angles of string and synthesis, rad
};

/// Winds a string at every third point of the synthesised stroke.
Variation variation_of(const Mechanism& m, const HelixSynthesis& made, transmission::Side side) {
  const HelixSide& helix = made.sides[side == transmission::Side::left ? 0 : 1];
  double least = 1e300, most = -1e300;
  Variation variation;
  for (std::size_t i = 0; i < made.stroke.size(); i += 3) {
    const transmission::TransmissionPoint& point = made.stroke[i];
    const StringLength string = string_length(m, side, helix.spiral, helix.attachment_z, point.alpha, point.theta);
    least = std::min(least, string.total);
    most = std::max(most, string.total);
    variation.fleet = std::max(variation.fleet, std::abs(std::abs(string.fleet) - std::abs(helix.stroke[i].fleet)));
  }
  variation.length = most - least;
  return variation;
}

std::string failures(const HelixSynthesis& made) {
  std::string text;
  for (const profile::Condition& condition : made.conditions)
    if (!condition.ok) text += condition.name + ": " + condition.message + "\n";
  return text;
}

/// Expects strings of constant length, up to `limit` (mm), with the reported fleet angles.
void expect_closed(const Mechanism& m, double limit = 0.0002) {
  const HelixSynthesis made = synthesise_helix(m, groove(), {.chord_error_mm = 1e-5});
  ASSERT_TRUE(made.made()) << failures(made);
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const Variation variation = variation_of(m, made, side);
    EXPECT_LT(variation.length, limit) << transmission::pulley_name(side);
    EXPECT_LT(degrees(variation.fleet), 0.001) << transmission::pulley_name(side);
  }
}

TEST(HelixSynthesis, KeepsStringLengthOverStroke) { expect_closed(wrist()); }

TEST(HelixSynthesis, SlopesOnlyTheLowerSpanWithCollars) {
  Mechanism m = wrist();
  m.guides.collar = true;
  expect_closed(m);
}

/// Control of the tests above: the planar spirals under a string held by collars change its length.
TEST(HelixSynthesis, PlanarCurvesChangeLengthWithCollars) {
  Mechanism m = wrist();
  const HelixSynthesis planar = synthesise_helix(m, groove(), {.chord_error_mm = 1e-4});
  m.guides.collar = true;
  const HelixSynthesis sloped = synthesise_helix(m, groove(), {.chord_error_mm = 1e-4});
  ASSERT_TRUE(planar.made() && sloped.made());
  HelixSynthesis mixed = planar;
  mixed.sides[1].attachment_z = sloped.sides[1].attachment_z;
  EXPECT_GT(variation_of(m, mixed, transmission::Side::right).length, 0.02);
  EXPECT_LT(variation_of(m, sloped, transmission::Side::right).length, 0.001);
}

/// Over smooth pins a tendon with the groove's slope is straight when unrolled. The fleet angle is zero and the radii
/// are planar.
TEST(HelixSynthesis, HasNoFleetAngleOverSmoothPins) {
  const Mechanism m = wrist();
  const HelixSynthesis made = synthesise_helix(m, groove(), {});
  ASSERT_TRUE(made.made()) << failures(made);
  const transmission::Transmission planar(m);
  for (const transmission::TransmissionPoint& point : made.stroke) {
    EXPECT_NEAR(point.t1.p, planar.at_alpha(point.alpha).t1.p, 1e-6);
    EXPECT_NEAR(point.t2.p, planar.at_alpha(point.alpha).t2.p, 1e-6);
  }
  EXPECT_LT(degrees(side_of(made, transmission::Side::left).fleet), 1e-6);
  EXPECT_LT(degrees(side_of(made, transmission::Side::right).fleet), 1e-6);
}

TEST(HelixSynthesis, KeepsSlopeAndDistanceOfTurns) {
  const Mechanism m = wrist();
  const HelixSynthesis made = synthesise_helix(m, groove(), {});
  ASSERT_TRUE(made.made()) << failures(made);
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const Spiral& spiral = side_of(made, side).spiral;
    EXPECT_NEAR(side_of(made, side).turns,
                (spiral.rows[spiral.last_used].turn - spiral.rows[spiral.first_used].turn) / k_two_pi, 1e-9);
    EXPECT_NEAR(spiral.rows.back().turn - spiral.rows[spiral.last_used].turn, k_two_pi, 1e-9);
    std::size_t below = 0;
    double chords = 0;
    for (std::size_t i = 1; i < spiral.rows.size(); ++i) {
      const SpiralRow &a = spiral.rows[i - 1], &b = spiral.rows[i];
      EXPECT_GT(b.turn, a.turn);
      EXPECT_NEAR(b.z - a.z, spiral.slope * (b.s - a.s), 1e-9);
      chords += std::hypot(b.x - a.x, b.y - a.y);
      while (spiral.rows[below].turn < b.turn - k_two_pi) ++below;
      // The first row within one turn below is slightly less than one lead away. groove() requires at least 2 mm.
      if (below > 0) {
        EXPECT_GT(b.z - spiral.rows[below].z, 2.0 - 0.1);
      }
    }
    EXPECT_NEAR(chords, spiral.rows.back().s, 1e-3 * spiral.rows.back().s);
  }
}

std::string refused(const Mechanism& m) { return failures(synthesise_helix(m, groove(), {})); }

TEST(HelixSynthesis, ReportsTooManyTurnsAndTooSmallLead) {
  using ::testing::HasSubstr;
  Mechanism many = wrist();
  many.pulley.ratio = 80;
  many.tendon.diameter = 0.2;
  EXPECT_THAT(refused(many), HasSubstr("at most 12 are supported"));
  Mechanism narrow = wrist();
  narrow.body.lead = 1.5;
  EXPECT_THAT(refused(narrow), HasSubstr("body.lead_mm) is too small"));
}

TEST(HelixSynthesis, KeepsStringLengthOfRoundP1) {
  Mechanism m = wrist();
  m.pulley.law = Law::compensate;
  m.pulley.r1 = 9;
  expect_closed(m);
}

}  // namespace
}  // namespace fusee::helix
