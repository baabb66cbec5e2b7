// Tendon in a circular groove against the capstan equation.
#include "rig/groove_chain.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fusee/base.h"

namespace fusee::rig {
namespace {

constexpr double k_radius = 16.0;
constexpr double k_EA = 7070.0;
const Cord k_cord{k_EA, 0.0, 1.0};

const Hull& disc() {
  static const Hull hull = [] {
    Polygon corners;
    for (int i = 0; i < 7200; ++i) corners.push_back(k_radius * unit(k_two_pi * i / 7200));
    return hull_of(corners);
  }();
  return hull;
}

/// From the knot at arc 0 round by `turn`, under `tension`.
GrooveChain wound(double turn, double tension, double friction) {
  return GrooveChain(disc(), 0.0, k_radius * turn, tension, friction, k_cord);
}

/// The take-off stays where it is and its tension goes from `before` to `tension` at once: material given.
double given(GrooveChain& chain, double turn, double before, double tension) {
  chain.reach(k_radius * turn, before, k_cord);
  return -chain.settle(tension);
}

TEST(TurningAngle, IsArcOverRadius) {
  const TurningAngle turning(disc());
  for (const double angle : {-7.0, -0.3, 0.0, 1.0, 3.0, 6.2, 9.9})
    EXPECT_NEAR(turning.at(k_radius * angle) - turning.at(0.0), angle, 2e-6) << angle;
}

/// Material released by a pull: ∫ (T e^(−μφ) − T₀) r dφ / EA up to the angle of equal tensions.
TEST(Groove, PullSlidesByCapstanLaw) {
  for (const double friction : {0.1, 0.2, 0.5}) {
    GrooveChain chain = wound(k_two_pi, 10.0, friction);
    const double front = std::min(k_two_pi, std::log(14.0 / 10.0) / friction);
    const double by_hand =
        k_radius / k_EA * (14.0 * (1.0 - std::exp(-friction * front)) / friction - 10.0 * front) / (1 + 14.0 / k_EA);
    EXPECT_NEAR(given(chain, k_two_pi, 10.0, 14.0), by_hand, 0.004 * by_hand) << friction;
    EXPECT_NEAR(chain.knot_tension(), std::max(10.0, 14.0 * std::exp(-friction * k_two_pi)), 0.06) << friction;
  }
}

/// On unloading only the near part slides back, with twice the friction angle.
TEST(Groove, RemembersLargestPull) {
  const double friction = 0.2;
  GrooveChain chain = wound(k_two_pi, 10.0, friction);
  given(chain, k_two_pi, 10.0, 14.0);
  const double front = std::log(14.0 / 11.0) / (2 * friction);
  const double by_hand = k_radius / k_EA / friction *
                         (14.0 * (1.0 - std::exp(-friction * front)) - 11.0 * (std::exp(friction * front) - 1.0)) /
                         (1 + 11.0 / k_EA);
  EXPECT_NEAR(-given(chain, k_two_pi, 14.0, 11.0), by_hand, 0.01 * by_hand);
  EXPECT_NEAR(given(chain, k_two_pi, 11.0, 11.0), 0.0, 1e-6) << "no change of tension";
}

TEST(Groove, WithoutFrictionIsFreeSpan) {
  GrooveChain chain = wound(4.0, 10.0, 0.0);
  const double material = 4.0 * k_radius / (1.0 + 10.0 / k_EA);
  EXPECT_NEAR(given(chain, 4.0, 10.0, 25.0), material - 4.0 * k_radius / (1.0 + 25.0 / k_EA), 1e-12);
  EXPECT_NEAR(chain.knot_tension(), 25.0, 1e-9);
}

/// Without slip the groove returns material at the strain of winding: last on, first off.
TEST(Groove, WithLargeFrictionKeepsWindingStrain) {
  GrooveChain chain = wound(2.0, 10.0, 1e6);
  chain.reach(k_radius * 2.5, 30.0, k_cord);
  EXPECT_NEAR(chain.settle(30.0), 0.5 * k_radius / (1.0 + 30.0 / k_EA), 1e-12);
  chain.reach(k_radius * 2.0, 0.0, k_cord);
  EXPECT_NEAR(-chain.settle(3.0), 0.5 * k_radius / (1.0 + 30.0 / k_EA), 1e-9);
  chain.reach(k_radius * 1.5, 3.0, k_cord);
  EXPECT_NEAR(-chain.settle(3.0), 0.5 * k_radius / (1.0 + 10.0 / k_EA), 1e-9);
}

/// Cyclic winding under varying tension: a closed hysteresis that dissipates work.
TEST(Groove, CycleYieldsNoWork) {
  for (const double friction : {0.02, 0.2, 1.0, 20.0}) {
    GrooveChain chain = wound(2.0, 10.0, friction);
    double before = 10.0, turn = 2.0;
    double free_material = 0, first_material = 0;
    std::array<double, 4> work{};
    constexpr int steps = 400;
    for (std::size_t cycle = 0; cycle < 4; ++cycle) {
      const double stored = chain.stored();
      for (int i = 1; i <= steps; ++i) {
        const double phase = k_two_pi * i / steps;
        const double next = 2.0 + 1.2 * std::sin(phase);
        const double tension = 10.0 + 6.0 * std::sin(phase + 0.9);
        chain.reach(k_radius * next, before, k_cord);
        const double taken = chain.settle(tension);
        free_material += taken;
        // The tendon moves in by `length` under tension and brings its elastic energy.
        const double middle = 0.5 * (before + tension);
        const double length = taken * (1.0 + middle / k_EA);
        // The motor does the work of moving the groove by the wound length.
        const double motor = middle * k_radius * (next - turn);
        work[cycle] += motor - middle * length + 0.5 * middle * middle / k_EA * taken;
        before = tension;
        turn = next;
      }
      work[cycle] -= chain.stored() - stored;
      if (cycle == 2) first_material = free_material;
    }
    EXPECT_NEAR(free_material, first_material, 1e-5) << friction << ": not periodic";
    EXPECT_NEAR(work[3], work[2], 1e-3) << friction;
    EXPECT_GT(work[3], -2e-4) << friction;
    if (friction == 0.2) {
      EXPECT_GT(work[3], 0.01) << "sliding dissipates";
    }
  }
}

double given_letting_go(GrooveChain& chain, double material) {
  chain.reach(k_radius * 2.0, 10.0, k_cord);
  chain.let_go(material);
  return -chain.settle(10.0);
}

/// Retained material: ∫ T (1 − e^(−μφ)) r dφ / EA.
TEST(Groove, KnotSlipIsReducedByFriction) {
  GrooveChain chain = wound(2.0, 10.0, 0.0);
  EXPECT_NEAR(given_letting_go(chain, 0.2), 0.2, 1e-9);
  GrooveChain rubbing = wound(2.0, 10.0, 0.2);
  const double given = given_letting_go(rubbing, 0.2);
  const double kept = k_radius * 10.0 / k_EA * (2.0 - (1.0 - std::exp(-0.4)) / 0.2);
  EXPECT_NEAR(0.2 - given, kept, 0.03 * kept);
  EXPECT_NEAR(rubbing.knot_tension(), 10.0 * std::exp(-0.4), 0.05);
  GrooveChain little = wound(2.0, 10.0, 0.2);
  EXPECT_NEAR(given_letting_go(little, 0.2 * kept), 0.0, 1e-6) << "a small slip stays at the knot";
}

}  // namespace
}  // namespace fusee::rig
