#include "fusee/analysis.h"

#include <gmock/gmock.h>

#include "fusee/joint.h"
#include "support/mechanisms.h"

namespace fusee::analysis {
namespace {

using testing::forearm;
using testing::linear_wrist;

AnalysisOptions quick() {
  AnalysisOptions options;
  options.samples = 20;
  return options;
}

TEST(Analysis, RowsCoverRangeAndHome) {
  const AnalysisResult result = analyse(forearm(), quick());
  ASSERT_TRUE(result.exists);
  ASSERT_GE(result.rows.size(), 61u);
  EXPECT_NEAR(result.rows.front().declared.theta, radians(-30), 1e-12);
  EXPECT_NEAR(result.rows.back().declared.theta, radians(30), 1e-12);
  EXPECT_TRUE(std::any_of(result.rows.begin(), result.rows.end(),
                          [](const AnalysisRow& row) { return row.declared.alpha == 0; }));
  for (const AnalysisRow& row : result.rows) {
    EXPECT_EQ(row.rising.alpha, row.declared.alpha);
    EXPECT_EQ(row.falling.alpha, row.declared.alpha);
    EXPECT_EQ(row.rising.status, joint::EquilibriumStatus::held);
  }
}

TEST(Analysis, ModelsAgreeUnderPaperAssumptions) {
  // One slack tendon, stiff, moving one way: T_b, torque and stiffness agree with the paper, except that its tendon
  // ends at the foot of the axis' perpendicular and not at the contact on the pulley.
  Mechanism mechanism = forearm();
  mechanism.tendon.pretension = 0;
  mechanism.tendon.modulus = 1e6;
  mechanism.guides.mu = 0;
  mechanism.pulley.mu = 1e12;  // the wound tendon does not act as a spring
  mechanism.load.tip_force = 10.0;
  const joint::JointModel model = joint::joint_model(mechanism);
  for (const AnalysisRow& row : analyse(mechanism, quick()).rows) {
    const transmission::TendonPoint& tendon = row.declared.t2;
    const double free = 1.0 - (tendon.lower_reach - model.lower(row.declared.alpha)[1].reach) / tendon.length;
    EXPECT_NEAR(row.rising.t2.lower / row.paper.Tb, 1.0, 2e-4);
    EXPECT_NEAR(row.rising.motor_torque / row.paper.motor_torque, 1.0, 2e-4);
    EXPECT_NEAR(free * row.rising.stiffness / row.paper.stiffness, 1.0, 2e-3);
    // [9] omits the wound tendon, which is stretched after a cycle: up to two fifths more tendon here.
    EXPECT_GT((row.declared.theta - row.rising.theta) / row.paper.theta_error, 0.99);
    EXPECT_LT((row.declared.theta - row.rising.theta) / row.paper.theta_error, 1.45);
  }
}

TEST(Analysis, FindsLargestTension) {
  Mechanism mechanism = forearm();
  mechanism.load.tip_force = 10.0;
  const AnalysisResult result = analyse(mechanism, quick());
  double most = 0;
  for (const AnalysisRow& row : result.rows) {
    most = std::max({most, row.rising.t2.upper, row.rising.t2.lower, row.falling.t2.upper, row.falling.t2.lower,
                     row.rising.t1.lower});
  }
  EXPECT_EQ(result.largest_tension.tension, most);
  EXPECT_EQ(result.largest_tension.tendon, transmission::Side::right);
  EXPECT_TRUE(result.largest_tension.below_pin);
  EXPECT_TRUE(result.largest_tension.rising);
  EXPECT_NEAR(result.largest_paper_tension.value, most, 0.02 * most);
}

TEST(Analysis, ReportsSlackRanges) {
  Mechanism mechanism = forearm();
  mechanism.load.tip_force = 10.0;
  const AnalysisResult loaded = analyse(mechanism, quick());
  ASSERT_EQ(loaded.slack1.size(), 1u);
  EXPECT_EQ(loaded.slack1[0].from, loaded.rows.front().declared.alpha);
  EXPECT_TRUE(loaded.slack2.empty());
  EXPECT_TRUE(loaded.untensioned.empty());
  // The minimum pretension that keeps it taut, within 1 %.
  ASSERT_TRUE(loaded.taut_pretension.has_value());
  mechanism.tendon.pretension = *loaded.taut_pretension;
  EXPECT_TRUE(analyse(mechanism, quick()).slack1.empty());
  mechanism.tendon.pretension = 0.97 * *loaded.taut_pretension;
  EXPECT_FALSE(analyse(mechanism, quick()).slack1.empty());
}

TEST(Analysis, ReportsLooseRanges) {
  Mechanism mechanism = forearm();
  mechanism.tendon.pretension = 0;
  const AnalysisResult result = analyse(mechanism, quick());
  ASSERT_EQ(result.untensioned.size(), 1u);
  EXPECT_FALSE(result.lost_at.has_value());
}

TEST(Analysis, ReportsDrumFriction) {
  Mechanism mechanism = testing::finger();
  mechanism.load.tip_force = 20.0;
  const AnalysisResult smooth = analyse(mechanism, quick());
  EXPECT_TRUE(smooth.on_drum.empty());
  mechanism.joint.drum_mu = 0.2;
  const AnalysisResult rough = analyse(mechanism, quick());
  ASSERT_EQ(rough.on_drum.size(), 2u);
  const transmission::PinPlace place =
      transmission::pin_place(mechanism, transmission::Side::right, mechanism.seen_pitch_radius());
  const DrumHold& hold = rough.on_drum[1];
  EXPECT_EQ(hold.tendon, transmission::Side::right);
  EXPECT_NEAR(hold.wrap, transmission::upper_span(place, mechanism.joint.theta_min).on_drum, 1e-9);
  EXPECT_NEAR(hold.ratio, std::exp(0.2 * hold.wrap), 1e-12);
  EXPECT_LT(hold.at_end.value, 0.99 * smooth.largest_at_joint.value);
  EXPECT_GT(hold.at_end.value, smooth.largest_at_joint.value / hold.ratio);
}

TEST(Analysis, ReportsBreakingPoint) {
  Mechanism mechanism = forearm();
  mechanism.load.tip_force = 100.0;
  const AnalysisResult result = analyse(mechanism, quick());
  const double at_joint = result.largest_at_joint.value, most = result.largest_tension.tension;
  ASSERT_LT(at_joint, most);
  // At its knot at C, where the tendon itself would hold.
  mechanism.tendon.knot_efficiency = 0.5;
  mechanism.tendon.strength = 1.9 * at_joint;
  EXPECT_EQ(analyse(mechanism, quick()).breaks_at, result.largest_at_joint.alpha);
  // Below its pin, where the knot would hold.
  mechanism.tendon.knot_efficiency = 1.0;
  mechanism.tendon.strength = 0.5 * (at_joint + most);
  EXPECT_EQ(analyse(mechanism, quick()).breaks_at, result.largest_tension.alpha);
  // Nowhere.
  mechanism.tendon.knot_efficiency = 0.5;
  mechanism.tendon.strength = 2.1 * most;
  EXPECT_FALSE(analyse(mechanism, quick()).breaks_at.has_value());
}

TEST(Analysis, FindsCatalogueStrength) {
  EXPECT_EQ(tendon_strength(forearm().tendon)->source, "hmpe-1.0");
  Tendon other = forearm().tendon;
  other.modulus *= 1.5;
  EXPECT_FALSE(tendon_strength(other).has_value());
  other.strength = 77.0;
  EXPECT_EQ(tendon_strength(other)->tension, 77.0);
}

TEST(Analysis, ReportsObstacles) {
  Mechanism mechanism = forearm();
  mechanism.joint.theta_max = radians(80);
  const AnalysisResult result = analyse(mechanism, quick());
  EXPECT_FALSE(result.exists);
  EXPECT_TRUE(result.rows.empty());
  ASSERT_FALSE(result.obstacles.empty());
  EXPECT_THAT(result.obstacles.front().message, ::testing::HasSubstr("dead centre"));
  EXPECT_FALSE(result.advice.empty());
}

TEST(Analysis, ReportsLostEquilibrium) {
  Mechanism mechanism = forearm();
  mechanism.tendon.modulus = 30.0;
  mechanism.load.tip_force = 200.0;
  const AnalysisResult result = analyse(mechanism, quick());
  ASSERT_TRUE(result.lost_at.has_value());
}

TEST(Analysis, IsReproducible) {
  const AnalysisResult one = analyse(linear_wrist(), quick());
  const AnalysisResult two = analyse(linear_wrist(), quick());
  for (std::size_t i = 0; i < one.tolerances.size(); ++i)
    EXPECT_EQ(one.tolerances[i].theta_by_monte_carlo, two.tolerances[i].theta_by_monte_carlo);
  AnalysisOptions other = quick();
  other.seed = 2;
  EXPECT_NE(analyse(linear_wrist(), other).tolerances[0].theta_by_monte_carlo, one.tolerances[0].theta_by_monte_carlo);
}

}  // namespace
}  // namespace fusee::analysis
