// A rubbing cable that straightens under tension, compared with a chain of springs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fusee/joint.h"
#include "joint/rubbing_cable.h"
#include "support/mechanisms.h"
#include "support/rubbed_chain.h"

namespace fusee::joint {
namespace {

using testing::forearm;
using testing::RubbedChain;

/// Both models along the same motor and load paths, and their difference.
struct Routes {
  RubbedChain chain;
  RubbingCable cable;
  double driven = 0, load = 0;
  double chain_at = 0, cable_at = 0;  ///< joint angles, rad

  /// The largest difference along the path.
  double to(double driven_to, double load_to) {
    constexpr int steps = 40;
    double difference = 0;
    const double driven_from = driven, load_from = load;
    for (int i = 1; i <= steps; ++i) {
      driven = driven_from + (driven_to - driven_from) * i / steps;
      load = load_from + (load_to - load_from) * i / steps;
      chain_at = chain.to(driven, load);
      cable_at = cable.to(driven, load);
      difference = std::max(difference, std::abs(chain_at - cable_at));
    }
    return difference;
  }
};

/// Friction of the whole cable is twice its mean along it.
Routes rubbed_without_load(double mean) {
  RatioJointError joint;
  joint.compliance = 1;
  joint.friction.unloaded = mean;
  return {RubbedChain(0, 2 * mean), RubbingCable(joint, 0)};
}

TEST(RubbingCable, AgreesWithChainUnderChangingLoad) {
  constexpr double mean = 0.1, width = 2 * mean;
  Routes routes = rubbed_without_load(mean);
  routes.to(2, 0);
  const double on_the_way_up = routes.cable_at;
  EXPECT_LT(routes.to(2, 0.5), 0.02 * width);
  EXPECT_LT(routes.to(2, 0.3), 0.02 * width);  // slightly unloaded: some of the contacts slip back
  EXPECT_LT(routes.to(2, 0.4), 0.02 * width);
  EXPECT_LT(routes.to(2, 0), 0.02 * width);
  EXPECT_NEAR(routes.cable_at, on_the_way_up, 0.02 * width);
}

TEST(RubbingCable, AgreesWithChainAfterReversal) {
  constexpr double mean = 0.1, width = 2 * mean;
  Routes routes = rubbed_without_load(mean);
  routes.to(2, 0.2);
  for (const double end : {1.0, 2.0, 0.0}) {
    // During a reversal the chain's joint rests until all contacts have slipped, while the cable responds gradually:
    // theory predicts a difference of a quarter of the width.
    EXPECT_LT(routes.to(end, 0.2), 0.27 * width);
    EXPECT_NEAR(routes.cable_at, routes.chain_at, 0.02 * width) << end;
  }
}

TEST(RubbingCable, AgreesWithCapstan) {
  constexpr double exponent = 0.2, load = 3;  // exponent: μφ of the whole cable
  RatioJointError joint;
  joint.compliance = 1;
  joint.friction.share = exponent / 2;
  Routes routes{RubbedChain(exponent, 0), RubbingCable(joint, 0)};
  routes.to(0, load);
  routes.to(4, load);
  const double chain_up = routes.chain_at, cable_up = routes.cable_at;
  routes.to(0, load);
  const double chain_width = routes.chain_at - chain_up + 4, cable_width = routes.cable_at - cable_up + 4;
  // The chain has e^±μφ, the cable 1 ± μφ: the widths differ by (μφ)²/6 of the width.
  EXPECT_NEAR(cable_width, exponent * load, 1e-12);
  EXPECT_NEAR(chain_width, cable_width, 0.02 * cable_width);
}

TEST(RubbingCable, HysteresisShrinksWithStiffness) {
  RatioJointError joint;
  joint.compliance = 0.5;
  joint.waves = {.most = 0.2, .rate = 2};
  joint.friction.unloaded = 0.1;
  const auto width = [&](double load) {
    RubbingCable cable(joint, 0);
    const double up = 5 - cable.to(5, load), down = -5 - cable.to(-5, load);
    return up - down;
  };
  // Waves straighten by 0.2 x/(1 + x) with x = 2 · pull. Eight contacts have a friction of 0.0125 to 0.1875.
  const auto deflection = [](double pull) { return 0.5 * pull + 0.2 * (1 - 1 / (1 + 2 * pull)); };
  double mean = 0;
  for (int i = 0; i < 8; ++i) {
    const double friction = 0.1 * (2 * i + 1) / 8;
    mean += (deflection(1 + friction) - deflection(1 - friction)) / 8;
  }
  EXPECT_NEAR(width(1), mean, 1e-12);
  EXPECT_GT(width(0.3), 1.3 * width(3));
}

TEST(RubbingCable, IsElasticWithoutFriction) {
  RatioJointError joint;
  joint.compliance = 0.3;
  RubbingCable cable(joint, 0);
  EXPECT_EQ(cable.to(0.7, 0.9), 0.7 - 0.3 * 0.9);
  EXPECT_EQ(cable.to(-0.7, 0.9), -0.7 - 0.3 * 0.9);
}

// ---- tendons --------------------------------------------------------------------------------------------------------

/// Without friction at the pins and without sliding in the groove.
JointModel wavy(CableStiffening waves) {
  Mechanism mechanism = forearm();
  mechanism.guides.mu = 0;
  mechanism.pulley.mu = 1e12;
  JointModel model = joint_model(mechanism);
  model.waves = waves;
  return model;
}

/// Loads the joint gradually at home.
std::vector<EquilibriumPoint> loaded(const JointModel& model, double tip_force, int steps) {
  std::vector<JointStep> path;
  for (int i = 0; i <= steps; ++i) path.push_back({0, tip_force * i / steps, 0});
  return follow(model, path);
}

constexpr CableStiffening k_waves{.most = 0.4, .rate = 0.15};

TEST(WavyTendon, LengthensByItsWaves) {
  const std::vector<EquilibriumPoint> straight = loaded(wavy({}), 8, 20), points = loaded(wavy(k_waves), 8, 20);
  EXPECT_GT(std::abs(points.back().theta - straight.back().theta), radians(0.05));
  const EquilibriumPoint& home = points.front();
  for (const auto tendon : {&EquilibriumPoint::t1, &EquilibriumPoint::t2}) {
    const auto straightened = [&](double pull) { return 0.4 - 0.4 / (1 + 0.15 * pull); };
    // Without friction the tension is uniform. The tension at home determines the length of the material.
    const double strained = (home.*tendon).stretch / (home.*tendon).upper;
    for (const EquilibriumPoint& point : points) {
      const TendonState& state = point.*tendon;
      if (state.upper == 0) continue;
      EXPECT_NEAR(state.stretch - state.slack,
                  strained * state.upper + straightened(state.upper) - straightened((home.*tendon).upper), 1e-7);
    }
  }
}

TEST(WavyTendon, StiffensWithTension) {
  const auto compliance_ratio = [](double force) {
    const auto at = [&](double f) { return loaded(wavy(k_waves), f, 40).back().theta; };
    const auto straight = [&](double f) { return loaded(wavy({}), f, 40).back().theta; };
    return (at(force + 0.1) - at(force)) / (straight(force + 0.1) - straight(force));
  };
  EXPECT_GT(compliance_ratio(0.1), 1.1 * compliance_ratio(20));
}

TEST(WavyTendon, ConservesEnergy) {
  const auto missing_work = [](const JointModel& model) {
    const std::vector<EquilibriumPoint> points = loaded(model, 8, 1000);
    double load = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      load += 0.5 * (points[i].load_torque + points[i - 1].load_torque) * (points[i].theta - points[i - 1].theta);
    return -load - points.back().stored;
  };
  const double stored = k_waves.energy(loaded(wavy(k_waves), 8, 20).back().t2.upper);
  EXPECT_GT(stored, 0.1);
  EXPECT_LT(std::abs(missing_work(wavy(k_waves)) - missing_work(wavy({}))), 1e-3 * stored);
}

TEST(WavyTendon, KeepsHome) { EXPECT_NEAR(loaded(wavy(k_waves), 0, 3).back().theta, 0, 1e-12); }

}  // namespace
}  // namespace fusee::joint
