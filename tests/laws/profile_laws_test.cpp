#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fusee/profile.h"
#include "laws/random_mechanism.h"
#include "transmission/load.h"

namespace fusee {
namespace {

using testing::expect_law;

bool is_convex(const Polygon& polygon) {
  const std::size_t count = polygon.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2& here = polygon[i];
    const Vec2& next = polygon[(i + 1) % count];
    if (cross(next - here, polygon[(i + 2) % count] - next) <= 0) return false;
  }
  return true;
}

TEST(ProfileLaws, AcceptedProfilesRewindToLaw) {
  expect_law(400, [](const Mechanism& mechanism) {
    const profile::SynthesisResult result = profile::synthesise(mechanism, {.advice = false});
    if (!result.made()) return false;
    const double half = 0.5 * mechanism.tendon.diameter;
    const Polygon floor1 = profile::parallel(result.p1, -half);
    const Polygon floor2 = profile::parallel(result.p2, -half);
    RC_ASSERT(is_convex(floor1));
    RC_ASSERT(is_convex(floor2));
    const profile::RewindResult wound = profile::rewind(mechanism, floor1, floor2);
    RC_ASSERT(degrees(wound.max_theta_error) < 0.05);
    RC_ASSERT(wound.max_excess < 0.05);
    return true;
  });
}

/// Returns whether the mechanism is feasible. If so, both profiles must be convex and rewind to the law.
bool rewinds_to_its_law(const Mechanism& mechanism) {
  const profile::SynthesisResult result = profile::synthesise(mechanism, {.advice = false});
  for (const profile::Condition& condition : result.conditions) RC_ASSERT(condition.ok == condition.message.empty());
  if (!result.made()) return false;
  const double half = 0.5 * mechanism.tendon.diameter;
  const Polygon floor1 = profile::parallel(result.p1, -half), floor2 = profile::parallel(result.p2, -half);
  RC_ASSERT(is_convex(floor1));
  RC_ASSERT(is_convex(floor2));
  // A drum's moment arm is a fifth of the lever's, so that position errors move the joint five times as far.
  const profile::RewindResult wound = profile::rewind(mechanism, floor1, floor2);
  RC_ASSERT(degrees(wound.max_theta_error) < 0.02);
  RC_ASSERT(wound.max_excess < 0.005 * mechanism.joint.R);
  return true;
}

TEST(ProfileLaws, DrumsAndAttachmentsRewindToLaw) {
  expect_law(300, rewinds_to_its_law, testing::random_wide_mechanism);
}

TEST(ProfileLaws, SheathedJointsRewindToLaw) {
  expect_law(300, rewinds_to_its_law, testing::random_sheathed_mechanism);
}

/// Work against tip force, weight and spring from home to `theta`, N·mm: the integral of the load torque.
double work_of_load(const Mechanism& mechanism, double theta) {
  const Load& load = mechanism.load;
  const Spring& spring = mechanism.spring;
  const double weight_torque = load.mass_kg * 9.80665 * load.lever, deflection = theta - spring.free;
  return load.tip_force * mechanism.joint.R * theta +
         weight_torque * (std::cos(load.tilt - theta) - std::cos(load.tilt)) + spring.preload * theta +
         0.5 * spring.stiffness * (deflection * deflection - spring.free * spring.free);
}

// With a constant motor torque, the motor's work along the rewound law equals the load's. The tolerance is the work of the
// load over 0.02 deg of the joint.
TEST(ProfileLaws, TorqueLawsRewindToLaw) {
  expect_law(
      300,
      [](const Mechanism& mechanism) {
        const profile::SynthesisResult result = profile::synthesise(mechanism, {.advice = false});
        for (const profile::Condition& condition : result.conditions)
          RC_ASSERT(condition.ok == condition.message.empty());
        if (!result.made()) return false;
        const double half = 0.5 * mechanism.tendon.diameter;
        const profile::RewindResult wound =
            profile::rewind(mechanism, profile::parallel(result.p1, -half), profile::parallel(result.p2, -half));
        RC_ASSERT(degrees(wound.max_theta_error) < 0.02);
        for (const profile::RewindPoint& point : wound.points) {
          if (mechanism.pulley.motor_torque == 0) break;
          const double work = mechanism.pulley.motor_torque * point.alpha;
          const double torque = transmission::load_torque(mechanism, point.theta);
          RC_ASSERT(std::abs(work - work_of_load(mechanism, point.theta)) < radians(0.02) * torque);
        }
        return true;
      },
      testing::random_torque_mechanism);
}

TEST(ProfileLaws, RejectionsHaveReasons) {
  expect_law(400, [](const Mechanism& mechanism) {
    const profile::SynthesisResult result = profile::synthesise(mechanism, {.advice = false});
    const auto failed = std::count_if(result.conditions.begin(), result.conditions.end(),
                                      [](const profile::Condition& c) { return !c.ok; });
    RC_ASSERT(result.made() == (failed == 0));
    for (const profile::Condition& condition : result.conditions) {
      RC_ASSERT(condition.ok == condition.message.empty());
      RC_ASSERT(std::isfinite(condition.alpha));
      if (condition.ok) RC_ASSERT(std::isfinite(condition.value));
    }
    return result.made();
  });
}

TEST(ProfileLaws, TendonsClearClosingArc) {
  expect_law(200, [](const Mechanism& mechanism) {
    const profile::SynthesisResult result = profile::synthesise(mechanism, {.advice = false});
    if (!result.made()) return false;
    for (const transmission::TransmissionPoint& at : result.stroke) {
      const Vec2 normal1 = unit(at.t1.lower_normal + at.alpha);
      const Vec2 normal2 = unit(at.t2.lower_normal + at.alpha);
      for (const profile::OutlinePoint& point : result.p1.points)
        RC_ASSERT(point.position.dot(normal1) <= at.t1.p + 1e-9 * mechanism.joint.R);
      for (const profile::OutlinePoint& point : result.p2.points)
        RC_ASSERT(point.position.dot(normal2) <= at.t2.p + 1e-9 * mechanism.joint.R);
    }
    return true;
  });
}

/// Largest distance by which the outline lies inside a much finer sample of the same curve, mm, along the normals of the
/// finer one.
double largest_chord_error(const profile::Outline& outline, const profile::Outline& fine) {
  double largest = 0;
  std::size_t corner = 0;
  for (const profile::OutlinePoint& point : fine.points) {
    // The supporting corner is the outline's furthest one along the normal. Both polygons run in the same direction, so
    // that it is near that of the previous normal.
    const auto support = [&](std::size_t i) {
      return outline.points[i % outline.points.size()].position.dot(point.normal);
    };
    while (support(corner + 1) > support(corner)) ++corner;
    while (corner > 0 && support(corner - 1) > support(corner)) --corner;
    largest = std::max(largest, point.position.dot(point.normal) - support(corner));
  }
  return largest;
}

TEST(ProfileLaws, ChordsAreWithinTolerance) {
  expect_law(100, [](const Mechanism& mechanism) {
    constexpr double tolerance = 0.01;
    const profile::SynthesisResult result =
        profile::synthesise(mechanism, {.chord_error_mm = tolerance, .advice = false});
    if (!result.made()) return false;
    const profile::SynthesisResult fine = profile::synthesise(mechanism, {.chord_error_mm = 1e-5, .advice = false});
    RC_ASSERT(largest_chord_error(result.p1, fine.p1) <= tolerance);
    RC_ASSERT(largest_chord_error(result.p2, fine.p2) <= tolerance);
    return true;
  });
}

}  // namespace
}  // namespace fusee
