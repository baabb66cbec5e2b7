/// \file
/// Random joints: from finger to arm, symmetric or not, feasible or not, by each law except law = "table".
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fusee/mechanism_file.h"
#include "transmission/load.h"

namespace fusee::testing {

namespace detail {

/// A number between two bounds, uniform in steps of a millionth.
inline rc::Gen<double> between(double low, double high) {
  return rc::gen::map(rc::gen::resize(1000000, rc::gen::inRange(0, 1000001)),
                      [low, high](int step) { return low + (high - low) * step / 1e6; });
}

}  // namespace detail

/// A joint of the paper's class: both tendons end at C and run over pins. Lengths are shares of R.
inline Mechanism random_mechanism() {
  using detail::between;
  Mechanism mechanism = default_mechanism();
  mechanism.name = "random";
  const double R = std::exp(*between(std::log(20.0), std::log(300.0)));
  mechanism.joint = {R, radians(-*between(8.0, 38.0)), radians(*between(8.0, 38.0))};  // R, range of θ
  mechanism.guides.EB = R * *between(0.3, 0.75);
  mechanism.guides.ED = *rc::gen::element(true, false) ? mechanism.guides.EB : R * *between(0.3, 0.75);
  mechanism.guides.OE = R * *between(-0.5, 0.2);
  mechanism.pulley.EF = R * *between(0.5, 1.6);
  mechanism.tendon.diameter = R * *between(0.004, 0.02);
  mechanism.guides.radius = mechanism.tendon.diameter * *between(0.0, 3.0);
  if (*rc::gen::element(true, true, false)) {
    mechanism.pulley.r1 = R * *between(0.11, 0.2);
  } else {
    mechanism.pulley.law = Law::linear;
    mechanism.pulley.ratio = *between(2.4, 4.5);
  }
  return mechanism;
}

/// With a drum, separate attachments, or both: fingers, ankles and elbows of any range.
inline Mechanism random_wide_mechanism() {
  using detail::between;
  Mechanism mechanism = random_mechanism();
  const double R = mechanism.joint.R;
  const double low = *between(5.0, 100.0), high = *between(5.0, 130.0);
  mechanism.joint.theta_min = radians(-low);
  mechanism.joint.theta_max = radians(high);
  // Pins below the joint, as far as the drum permits.
  mechanism.guides.OE = R * *between(0.3, 3.0);
  mechanism.guides.EB = R * *between(0.4, 1.6);
  mechanism.guides.ED = R * *between(0.4, 1.6);
  mechanism.pulley.EF = R * *between(2.0, 5.0);
  const bool has_drum = *rc::gen::element(true, true, true, false);
  if (has_drum) mechanism.joint.drum_radius = R * *between(0.3, 1.0);
  // Sometimes on the drum's pitch circle, or just outside. `sign` mirrors it for tendon 1.
  const auto attachment = [&](double sign) {
    const double distance = has_drum && *rc::gen::element(true, false)
                                ? mechanism.drum_pitch_radius() * *between(1.0, 1.02)
                                : R * *between(0.6, 1.4);
    const double angle = radians(sign * *between(has_drum ? -100.0 : -10.0, 80.0));
    return Attachment{distance * std::sin(angle), distance * std::cos(angle)};
  };
  if (!has_drum || *rc::gen::element(true, false)) mechanism.joint.attachment1 = attachment(-1.0);
  if (!has_drum || *rc::gen::element(true, true, false)) mechanism.joint.attachment2 = attachment(1.0);
  const double ratio = std::min(300.0 / (low + high), *between(0.8, 3.0));
  if (mechanism.pulley.law == Law::linear) {
    mechanism.pulley.ratio = ratio;
  } else {
    mechanism.pulley.r1 = 0.8 * R / ratio;
  }
  return mechanism;
}

/// A joint of either class above, with the motor behind sheaths.
inline Mechanism random_sheathed_mechanism() {
  using detail::between;
  Mechanism mechanism = *rc::gen::element(true, false) ? random_mechanism() : random_wide_mechanism();
  const double arm = mechanism.joint.is_plain() ? 0.55 * mechanism.joint.R : mechanism.joint.R;
  const double pulley_radius = mechanism.pulley.law == Law::linear ? arm / mechanism.pulley.ratio : mechanism.pulley.r1;
  mechanism.sheath = {*between(50.0, 2000.0),               // length
                      radians(*between(0.0, 540.0)),        // bend
                      *between(0.0, 0.3),                   // friction
                      0,                                    // stiffness: rigid
                      pulley_radius * *between(0.2, 2.5),   // exits across
                      pulley_radius * *between(1.2, 7.0)};  // and above
  return mechanism;
}

/// A torque law on a wide joint: a weight, a force and a spring, and a constant or variable torque of the motor.
/// Sometimes the motor torque has the wrong sign, or the load changes its sign within the range.
inline Mechanism random_torque_mechanism() {
  using detail::between;
  Mechanism mechanism = random_wide_mechanism();
  mechanism.pulley.law = Law::torque;
  const double R = mechanism.joint.R;
  mechanism.load.mass_kg = *between(0.1, 3.0);
  mechanism.load.lever = R * *between(0.5, 2.0);
  mechanism.load.tilt = radians(*between(60.0, 180.0));
  const double weight_torque =
      mechanism.load.mass_kg * 9.80665 * mechanism.load.lever;  // with the arm horizontal, N·mm
  if (*rc::gen::element(true, false)) mechanism.load.tip_force = weight_torque / R * *between(-0.1, 1.0);
  if (*rc::gen::element(true, false))
    mechanism.spring = {weight_torque * *between(0.0, 0.5), weight_torque * *between(0.0, 0.5),
                        radians(*between(-90.0, 0.0))};
  // Usually the range ends before the link is upright.
  if (*rc::gen::element(true, true, true, false))
    mechanism.joint.theta_max = std::min(mechanism.joint.theta_max, mechanism.load.tilt - radians(20.0));
  const double low = mechanism.joint.theta_min, high = mechanism.joint.theta_max;
  double mean_torque = 0;  // of the load, over the range
  for (int i = 0; i <= 20; ++i)
    mean_torque += transmission::law_load_torque(mechanism, low + (high - low) * i / 20).value / 21;
  const double sign = *between(0.0, 1.0) < 0.05 ? -1.0 : 1.0;
  // Equal work over the range: the motor then turns by 1.2 to 4 rad.
  const double torque = sign * mean_torque * (high - low) / *between(1.2, 4.0);
  if (*rc::gen::element(true, false)) {
    mechanism.pulley.motor_torque = torque;
    return mechanism;
  }
  const double variation = *between(-0.3, 0.3);
  for (int i = 0; i <= 12; ++i) {
    const double theta = low + (high - low) * i / 12;
    mechanism.pulley.torque_rows.push_back({theta, torque * (1.0 + variation * std::sin(theta))});
  }
  return mechanism;
}

/// Checks `property(mechanism)` on reproducible random mechanisms: `usual_cases` of them, or the number in the environment
/// variable FUSEE_LAW_CASES. A property asserts with RC_ASSERT and returns whether it applied, such as to a feasible
/// mechanism. It must apply to more than an eighth of the mechanisms and not to all.
template <typename Property>
void expect_law(int usual_cases, Property property, Mechanism (*draw)() = random_mechanism) {
  const char* wanted_cases = std::getenv("FUSEE_LAW_CASES");
  rc::detail::TestParams params;
  params.seed = 20251120;
  params.maxSuccess = wanted_cases == nullptr ? usual_cases : std::atoi(wanted_cases);
  params.disableShrinking = true;  // a smaller mechanism is not easier to understand
  int applied = 0;
  int cases = 0;
  const auto result = rc::detail::checkTestable(
      [&] {
        const Mechanism mechanism = draw();
        RC_LOG() << write_mechanism(DeclaredMechanism(mechanism));
        ++cases;
        if (property(mechanism)) ++applied;
      },
      rc::detail::TestMetadata(), params);
  std::ostringstream message;
  rc::detail::printResultMessage(result, message);
  EXPECT_TRUE(result.template is<rc::detail::SuccessResult>()) << message.str();
  EXPECT_GT(applied, cases / 8);
  EXPECT_LT(applied, cases);
}

}  // namespace fusee::testing
