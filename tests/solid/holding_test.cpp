// Loads of the knots, compared with tendons laid over polygons step by step.
#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "fusee/mechanism_file.h"
#include "fusee/solid.h"
#include "support/mechanisms.h"
#include "support/shapes.h"

namespace fusee::solid {
namespace {

using ::testing::HasSubstr;

/// A joint whose body is the file's default one.
DeclaredMechanism loaded_forearm() {
  DeclaredMechanism mechanism = testing::forearm();
  mechanism.body = testing::plain_mechanism().body;
  mechanism.material = testing::plain_mechanism().material;
  mechanism.pulley.mu = 0.2;
  mechanism.load.tip_force = 20;
  mechanism.tendon.strength = 2000;
  mechanism.tendon.knot_efficiency = 0.5;
  return mechanism;
}

struct TiedPulley {
  explicit TiedPulley(const DeclaredMechanism& declared)
      : mechanism(declared),
        synthesis(profile::synthesise(declared)),
        pulley(make_pulley(declared, synthesis)),
        holding(tendon_holding(declared, synthesis, pulley)) {}

  DeclaredMechanism mechanism;
  profile::SynthesisResult synthesis;
  Pulley pulley;
  Holding holding;
};

/// The tension that remains at `exit` of a taut string over the turned pitch polygon, after friction at each corner.
/// The take-off is the last corner that the line from the pin touches.
double left_at(const TiedPulley& held, transmission::Side side, double alpha, double tension, const Vec2& exit) {
  const Mechanism& m = held.mechanism;
  const profile::Outline& outline = side == transmission::Side::left ? held.synthesis.p1 : held.synthesis.p2;
  const double outward = side == transmission::Side::left ? -1.0 : 1.0;
  const Vec2 pin(side == transmission::Side::left ? -m.guides.EB : m.guides.ED, m.pulley.EF);
  const double rho = m.guide_pitch_radius();
  const std::size_t n = outline.points.size();
  const auto place = [&](std::size_t i) { return turned(outline.points[i % n].position, -alpha); };
  const auto inclination = [&](std::size_t i) {
    const Vec2 up = pin - place(i);
    // To the outer side of the pin.
    return std::atan2(up.x() * outward, up.y()) + std::asin(rho / up.norm());
  };
  std::size_t take_off = 0;
  double best = -10;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 p = place(i);
    // The outermost line: its distance from the axis on the outer side.
    const double a = inclination(i) * outward;
    const double distance = outward * cross(Vec2(std::sin(a), std::cos(a)), p) * -1.0;
    if (distance > best) best = distance, take_off = i;
  }
  const std::size_t step = side == transmission::Side::left ? 1 : n - 1;
  for (std::size_t i = take_off; (outline.points[i].position - exit).norm() > 0.6; i = (i + step) % n) {
    const std::size_t j = (i + step) % n, k = (j + step) % n;
    const Vec2 in = outline.points[j].position - outline.points[i].position,
               out = outline.points[k].position - outline.points[j].position;
    const double corner = std::abs(std::atan2(cross(in, out), in.dot(out)));
    // The force at a corner is 2 T sin(corner/2), and friction is μ times that.
    tension -= 2.0 * tension * std::sin(0.5 * corner) * m.pulley.mu;
  }
  return tension;
}

TEST(Holding, KnotLoadMatchesStringOnPolygon) {
  const TiedPulley held(loaded_forearm());
  ASSERT_TRUE(held.pulley.made()) << held.pulley.brief();
  ASSERT_EQ(held.holding.knots.size(), 2u);
  Mechanism unloaded = held.mechanism;
  unloaded.load = {};
  for (const KnotHold& knot : held.holding.knots) {
    std::optional<Vec2> exit;
    for (const Anchor& anchor : held.pulley.anchors) {
      if (anchor.side == knot.side && anchor.wound_end) exit = anchor.exit;
    }
    ASSERT_TRUE(exit.has_value());
    double most = 0;
    for (const Mechanism& moved : {static_cast<const Mechanism&>(held.mechanism), unloaded}) {
      analysis::AnalysisOptions quick;
      quick.samples = 10;
      for (const analysis::AnalysisRow& row : analysis::analyse(moved, quick).rows) {
        for (const joint::EquilibriumPoint& point : {row.rising, row.falling}) {
          const double tension = (knot.side == transmission::Side::left ? point.t1 : point.t2).lower;
          most = std::max(most, left_at(held, knot.side, point.alpha, tension, *exit));
        }
      }
    }
    // The polygon's take-off is a corner, and its exit the nearest one.
    EXPECT_NEAR(knot.at_knot, most, 0.02 * most) << transmission::pulley_name(knot.side);
    EXPECT_NEAR(knot.at_knot, knot.tension * std::exp(-0.2 * knot.wrap_left), 1e-9);
  }
}

TEST(Holding, KnotCarriesFullTensionWithoutFriction) {
  DeclaredMechanism mechanism = loaded_forearm();
  mechanism.pulley.mu = 0;
  const TiedPulley held(mechanism);
  const double most = analysis::analyse(mechanism, {.samples = 10}).largest_tension.tension;
  double bears = 0;
  for (const KnotHold& knot : held.holding.knots) bears = std::max(bears, knot.at_knot);
  // The largest value lies between two places of the analysis.
  EXPECT_NEAR(bears, most, 1e-2 * most);
}

/// The load pulls at tendon 2 and relieves tendon 1, which carries its pretension without the load.
TEST(Holding, RelievedTendonKeepsPretension) {
  const TiedPulley held(loaded_forearm());
  const KnotHold& first = held.holding.knots.front();
  ASSERT_EQ(first.side, transmission::Side::left);
  EXPECT_GT(first.tension, held.mechanism.tendon.pretension);
}

TEST(Holding, WarnsAboveHalfStrengthWithAdvice) {
  DeclaredMechanism mechanism = loaded_forearm();
  EXPECT_TRUE(TiedPulley(mechanism).holding.warnings.empty());
  mechanism.body.wrap = radians(6);
  TiedPulley held(mechanism);
  const double worst_knot = std::max(held.holding.knots[0].at_knot, held.holding.knots[1].at_knot);
  // A tenth more than half of the strength.
  mechanism.tendon.strength = worst_knot / 0.55 / 0.5;
  held = TiedPulley(mechanism);
  ASSERT_EQ(held.holding.warnings.size(), 1u);
  const std::string& warning = held.holding.warnings.front();
  EXPECT_THAT(warning, HasSubstr("tendon 2"));
  EXPECT_THAT(warning, HasSubstr("55 %"));
  EXPECT_THAT(warning, HasSubstr("tendon.strength_N"));
  // The advice must hold.
  const std::size_t at = warning.find("body.wrap_deg = ");
  ASSERT_NE(at, std::string::npos) << warning;
  DeclaredMechanism advised = mechanism;
  advised.body.wrap = radians(std::stod(warning.substr(at + 16)));
  EXPECT_TRUE(TiedPulley(advised).holding.warnings.empty());
  advised = mechanism;
  const std::size_t bears = warning.find("a tendon with a strength of ");
  ASSERT_NE(bears, std::string::npos) << warning;
  advised.tendon.strength = std::stod(warning.substr(bears + 28));
  EXPECT_TRUE(TiedPulley(advised).holding.warnings.empty());
}

TEST(Holding, ReportsUnknownStrength) {
  DeclaredMechanism mechanism = loaded_forearm();
  mechanism.tendon.strength = 0;
  mechanism.tendon.modulus = 12345;
  mechanism.load.tip_force = 500;
  const TiedPulley held(mechanism);
  EXPECT_FALSE(held.holding.share(held.holding.knots[0]).has_value());
  EXPECT_TRUE(held.holding.warnings.empty());
}

class Profile : public ::testing::TestWithParam<const char*> {};

/// The previous wraps of the profiles, near the active arc: 4 to 30 degrees, except the optimum's P1.
TEST_P(Profile, WrapsFurtherAndHoldsTendons) {
  const MechanismFile file = read_mechanism(std::string(FUSEE_SOURCE_DIR) + "/profiles/" + GetParam() + ".toml");
  const TiedPulley held(file.mechanism);
  ASSERT_TRUE(held.pulley.made()) << held.pulley.brief();
  EXPECT_TRUE(held.holding.warnings.empty());
  const bool thick = std::string(GetParam()) == "paper_optimum";
  for (const KnotHold& knot : held.holding.knots)
    EXPECT_GE(degrees(knot.wrap_left), thick ? 19 : 35) << transmission::pulley_name(knot.side);
}
INSTANTIATE_TEST_SUITE_P(All, Profile,
                         ::testing::Values("finger", "forearm", "gripper", "linear_wrist", "paper_optimum",
                                           "unsymmetric", "wrist_exo"));

}  // namespace
}  // namespace fusee::solid
