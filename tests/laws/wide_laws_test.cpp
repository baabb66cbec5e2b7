// Closed forms for random wide joints, compared with independent numerics: strings laid by brute force, energy over a
// cycle, and joints with known results. FUSEE_LAW_CASES: number of cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fusee/joint.h"
#include "fusee/profile.h"
#include "fusee/transmission.h"
#include "laws/random_mechanism.h"
#include "support/brute_string.h"

namespace fusee {
namespace {

using testing::BruteString;
using testing::expect_law;

/// Expects one tendon's length over the range, and its moment arm (−dl/dθ), to equal those of the brute-force string.
void expect_string_agrees(const Mechanism& mechanism, const transmission::Transmission& law, transmission::Side side) {
  transmission::PinPlace place = transmission::pin_place(mechanism, side, mechanism.seen_pitch_radius());
  // Without a drum the string is laid round a tiny circle at the axis, which it never touches while there is an arm.
  if (place.drum == 0) place.drum = 1e-3 * place.R;
  const double sign = transmission::mirror_sign(side), R = place.R;
  const auto leaves = transmission::lift_off(place);
  if (!leaves) return;
  BruteString string(place);
  double length_before = 0, formula_before = 0;  // 0: there is no previous point to compare with
  for (int i = 0; i <= 8; ++i) {
    const transmission::TransmissionPoint at = law.at_alpha(std::lerp(law.alpha_min(), law.alpha_max(), i / 8.0));
    const double theta = sign * at.theta;
    const transmission::TendonPoint& tendon = side == transmission::Side::left ? at.t1 : at.t2;
    const transmission::UpperSpan span = transmission::upper_span(place, theta);
    // At lift-off the last touching point is arbitrary. The string is coarse where the end is within a few polygon
    // points of the pin.
    if (std::abs(theta - *leaves) < 0.02 || (span.on_drum == 0 && span.free < 0.5 * R)) {
      length_before = 0;
      continue;
    }
    const double length = string.length(theta);
    if (length_before != 0) RC_ASSERT(std::abs((length - length_before) - (span.length - formula_before)) < 1e-6 * R);
    RC_ASSERT(std::abs(tendon.m - span.m) <= 1e-12 * R);
    const double step = 0.005;
    const double arm = -(string.length(theta + step) - string.length(theta - step)) / (2 * step);
    const double formula =
        -(transmission::upper_span(place, theta + step).length - transmission::upper_span(place, theta - step).length) /
        (2 * step);
    RC_ASSERT(std::abs(arm - formula) < 1e-4 * R);
    // The arm itself changes over the difference's step, so that this limit is wider.
    RC_ASSERT(std::abs(arm - tendon.m) < 0.02 * R);
    string.length(theta);  // back to this angle: the string counts turns by following the joint
    length_before = length;
    formula_before = span.length;
  }
}

TEST(WideLaws, LengthsAgreeWithBruteForceString) {
  expect_law(
      400,
      [](const Mechanism& mechanism) {
        const transmission::Transmission law(mechanism);
        if (law.dead_centre()) return false;
        expect_string_agrees(mechanism, law, transmission::Side::left);
        expect_string_agrees(mechanism, law, transmission::Side::right);
        return true;
      },
      testing::random_wide_mechanism);
}

/// The load is applied at home in 200 steps. Then the motor turns to the upper end, to the lower end and home, twice, in
/// `steps` steps for each of these strokes.
std::vector<joint::JointStep> round_trip(const transmission::Transmission& law, double tip_force, int steps) {
  std::vector<joint::JointStep> steps_taken;
  for (int i = 0; i <= 200; ++i) steps_taken.push_back({0.0, tip_force * i / 200, 0.0});
  const auto run = [&](double from, double to) {
    for (int i = 1; i <= steps; ++i) steps_taken.push_back({std::lerp(from, to, double(i) / steps), tip_force, 0.0});
  };
  for (int round = 0; round < 2; ++round) {
    run(0.0, law.alpha_max());
    run(law.alpha_max(), law.alpha_min());
    run(law.alpha_min(), 0.0);
  }
  return steps_taken;
}

/// Expects the energy balance: the motor's work is the sum of the load's work, the stored energy and the friction losses.
/// Returns false for a joint to which the balance does not apply.
bool loses_no_energy(Mechanism mechanism) {
  using testing::detail::between;
  const double R = mechanism.joint.R;
  mechanism.load = {};
  mechanism.spring = {};
  // The elastic model does not cover tendons off their pins, nor concave pulleys.
  if (!profile::synthesise(mechanism, {.advice = false}).made()) return false;
  const transmission::Transmission law(mechanism);
  mechanism.tendon.pretension = *between(5.0, 40.0);
  mechanism.tendon.modulus = *between(5000.0, 50000.0);
  mechanism.guides.mu = *between(0.0, 0.3);
  mechanism.pulley.mu = *between(0.0, 0.3);
  if (mechanism.joint.drum_radius > 0) mechanism.joint.drum_mu = *between(0.0, 0.4);
  if (*rc::gen::element(true, false) && mechanism.guides.radius > 0) {
    mechanism.guides.kind = GuideKind::idler;
    mechanism.guides.bearing_radius = 0.4 * mechanism.guides.radius;
    mechanism.guides.bearing_friction = *between(0.001, 0.3);
  }
  const double force = *between(-5.0, 5.0);
  const std::vector<joint::EquilibriumPoint> points =
      joint::follow(joint::joint_model(mechanism), round_trip(law, force, 1500));
  double motor_work = 0, load_work = 0, largest_torque = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    // A very soft joint can snap through and lose energy within one step. A loose joint has no torque.
    if (points[i].status != joint::EquilibriumStatus::held) return false;
    if (std::abs(points[i].theta - law.theta(points[i].alpha)) > radians(5)) return false;
    motor_work += 0.5 * (points[i].motor_torque + points[i - 1].motor_torque) * (points[i].alpha - points[i - 1].alpha);
    load_work += 0.5 * (points[i].load_torque + points[i - 1].load_torque) * (points[i].theta - points[i - 1].theta);
    largest_torque = std::max(largest_torque, std::abs(points[i].motor_torque));
  }
  const joint::EquilibriumPoint& end = points.back();
  const double missing = motor_work - load_work - end.stored - end.friction - end.groove_friction;
  RC_LOG() << write_mechanism(DeclaredMechanism(mechanism)) << "missing " << missing << " friction " << end.friction
           << " groove " << end.groove_friction << " stored " << end.stored << " force " << force << " R " << R;
  const double scale = end.friction + std::abs(end.groove_friction) + std::abs(end.stored) + largest_torque;
  RC_ASSERT(end.friction >= 0 && end.groove_friction >= -1e-4 * scale);
  RC_ASSERT(std::abs(missing) < 1e-4 * scale);
  return true;
}

TEST(WideLaws, EnergyIsConserved) { expect_law(80, loses_no_energy, testing::random_wide_mechanism); }

TEST(WideLaws, EnergyIsConservedThroughSheaths) { expect_law(60, loses_no_energy, testing::random_sheathed_mechanism); }

// Both tendons end on the drum, at angles at which neither leaves it within the range. Their arms are then the drum's pitch
// radius. With a linear law, both pulleys are round with that radius over the ratio, up to the rounding of a few products.
TEST(WideLaws, PermanentDrumWrapMakesRoundPulleys) {
  expect_law(
      1000,
      [](Mechanism mechanism) {
        using testing::detail::between;
        if (mechanism.joint.drum_radius == 0) return false;
        const double rho = mechanism.drum_pitch_radius();
        mechanism.pulley.law = Law::linear;
        mechanism.pulley.ratio = *between(0.5, 4.0);
        // At its end of the range each end is still 20° above the horizontal, so that its tendon has not lifted off.
        const double low = mechanism.joint.theta_min, high = mechanism.joint.theta_max;
        const double end1 = radians(90.0) + low - radians(20.0), end2 = -(radians(90.0) - high - radians(20.0));
        mechanism.joint.attachment1 = Attachment{rho * std::sin(-end1), rho * std::cos(end1)};
        mechanism.joint.attachment2 = Attachment{rho * std::sin(-end2), rho * std::cos(end2)};
        const transmission::Transmission law(mechanism);
        if (law.dead_centre()) return false;
        for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
          const transmission::PinPlace place = transmission::pin_place(mechanism, side, mechanism.seen_pitch_radius());
          const auto leaves = transmission::lift_off(place);
          const double furthest = side == transmission::Side::right ? high : -low;
          if (!leaves || *leaves < furthest) return false;
        }
        const double radius = rho / mechanism.pulley.ratio;
        for (int i = 0; i <= 20; ++i) {
          const transmission::TransmissionPoint at =
              law.at_alpha(std::lerp(law.alpha_min(), law.alpha_max(), i / 20.0));
          RC_ASSERT(at.t1.m == rho && at.t2.m == rho);
          RC_ASSERT(std::abs(at.t1.p - radius) <= 4e-16 * radius);
          RC_ASSERT(std::abs(at.t2.p - radius) <= 4e-16 * radius);
          RC_ASSERT(std::abs(at.theta - at.alpha / mechanism.pulley.ratio) <= 4e-16 * std::abs(at.theta));
        }
        return true;
      },
      testing::random_wide_mechanism);
}

}  // namespace
}  // namespace fusee
