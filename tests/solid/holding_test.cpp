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
double tension_at(const TiedPulley& tied, transmission::Side side, double alpha, double tension, const Vec2& exit) {
  const Mechanism& m = tied.mechanism;
  const profile::Outline& outline = side == transmission::Side::left ? tied.synthesis.p1 : tied.synthesis.p2;
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
    if (distance > best) {
      best = distance;
      take_off = i;
    }
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
  const TiedPulley tied(loaded_forearm());
  ASSERT_TRUE(tied.pulley.made()) << tied.pulley.brief();
  ASSERT_EQ(tied.holding.knots.size(), 2u);
  Mechanism unloaded = tied.mechanism;
  unloaded.load = {};
  for (const KnotHold& knot : tied.holding.knots) {
    std::optional<Vec2> exit;
    for (const Anchor& anchor : tied.pulley.anchors) {
      if (anchor.side == knot.side && anchor.wound_end) exit = anchor.exit;
    }
    ASSERT_TRUE(exit.has_value());
    double most = 0;
    for (const Mechanism& moved : {static_cast<const Mechanism&>(tied.mechanism), unloaded}) {
      analysis::AnalysisOptions quick;
      quick.samples = 10;
      for (const analysis::AnalysisRow& row : analysis::analyse(moved, quick).rows) {
        for (const joint::EquilibriumPoint& point : {row.rising, row.falling}) {
          const double tension = (knot.side == transmission::Side::left ? point.t1 : point.t2).lower;
          most = std::max(most, tension_at(tied, knot.side, point.alpha, tension, *exit));
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
  const TiedPulley tied(mechanism);
  const double most = analysis::analyse(mechanism, {.samples = 10}).largest_tension.tension;
  double at_knot = 0;
  for (const KnotHold& knot : tied.holding.knots) at_knot = std::max(at_knot, knot.at_knot);
  // The largest value lies between two places of the analysis.
  EXPECT_NEAR(at_knot, most, 1e-2 * most);
}

/// The load pulls at tendon 2 and relieves tendon 1, which carries its pretension without the load.
TEST(Holding, RelievedTendonKeepsPretension) {
  const TiedPulley tied(loaded_forearm());
  const KnotHold& first = tied.holding.knots.front();
  ASSERT_EQ(first.side, transmission::Side::left);
  EXPECT_GT(first.tension, tied.mechanism.tendon.pretension);
}

TEST(Holding, WarnsAboveHalfStrengthWithAdvice) {
  DeclaredMechanism mechanism = loaded_forearm();
  EXPECT_TRUE(TiedPulley(mechanism).holding.warnings.empty());
  mechanism.body.wrap = radians(6);
  TiedPulley tied(mechanism);
  const double worst_knot = std::max(tied.holding.knots[0].at_knot, tied.holding.knots[1].at_knot);
  // The knot carries a tenth more than half of its strength, which is half of the tendon's.
  mechanism.tendon.strength = worst_knot / 0.55 / 0.5;
  tied = TiedPulley(mechanism);
  ASSERT_EQ(tied.holding.warnings.size(), 1u);
  const std::string& warning = tied.holding.warnings.front();
  EXPECT_THAT(warning, HasSubstr("tendon 2"));
  EXPECT_THAT(warning, HasSubstr("55 %"));
  EXPECT_THAT(warning, HasSubstr("tendon.strength_N"));
  // The advice must hold.
  const std::string wrap_words = "body.wrap_deg = ", strength_words = "a tendon with a strength of ";
  const std::size_t at = warning.find(wrap_words);
  ASSERT_NE(at, std::string::npos) << warning;
  DeclaredMechanism advised = mechanism;
  advised.body.wrap = radians(std::stod(warning.substr(at + wrap_words.size())));
  EXPECT_TRUE(TiedPulley(advised).holding.warnings.empty());
  advised = mechanism;
  const std::size_t strength = warning.find(strength_words);
  ASSERT_NE(strength, std::string::npos) << warning;
  advised.tendon.strength = std::stod(warning.substr(strength + strength_words.size()));
  EXPECT_TRUE(TiedPulley(advised).holding.warnings.empty());
}

TEST(Holding, ReportsUnknownStrength) {
  DeclaredMechanism mechanism = loaded_forearm();
  mechanism.tendon.strength = 0;
  mechanism.tendon.modulus = 12345;
  mechanism.load.tip_force = 500;
  const TiedPulley tied(mechanism);
  EXPECT_FALSE(tied.holding.share(tied.holding.knots[0]).has_value());
  EXPECT_TRUE(tied.holding.warnings.empty());
}

class Profile : public ::testing::TestWithParam<const char*> {};

/// Tie-offs near the active arc had wraps of 4° to 30° on these profiles (except P1 of the optimum). The wraps must
/// exceed that. The optimum's thick tendon leaves less space.
TEST_P(Profile, WrapsFurtherAndHoldsTendons) {
  const MechanismFile file = read_mechanism(std::string(FUSEE_SOURCE_DIR) + "/profiles/" + GetParam() + ".toml");
  const TiedPulley tied(file.mechanism);
  ASSERT_TRUE(tied.pulley.made()) << tied.pulley.brief();
  EXPECT_TRUE(tied.holding.warnings.empty());
  const bool is_thick = std::string(GetParam()) == "paper_optimum";
  for (const KnotHold& knot : tied.holding.knots)
    EXPECT_GE(degrees(knot.wrap_left), is_thick ? 19 : 35) << transmission::pulley_name(knot.side);
}
INSTANTIATE_TEST_SUITE_P(All, Profile,
                         ::testing::Values("finger", "forearm", "gripper", "linear_wrist", "paper_optimum",
                                           "unsymmetric", "wrist_exo"));

}  // namespace
}  // namespace fusee::solid
