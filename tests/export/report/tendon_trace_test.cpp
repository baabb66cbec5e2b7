// The drawn tendon is a taut string: tangent to the pin and to the pulley, and of constant length over the stroke.
#include "export/report/tendon_trace.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "fusee/base.h"
#include "fusee/profile.h"
#include "support/mechanisms.h"

namespace fusee::formats {
namespace {

struct Case {
  Mechanism mechanism;
  profile::SynthesisResult synthesis;
};

Case made(const Mechanism& mechanism, double tolerance = 0.002) {
  profile::SynthesisOptions options;
  options.chord_error_mm = tolerance;
  options.advice = false;
  Case result{mechanism, profile::synthesise(mechanism, options)};
  EXPECT_TRUE(result.synthesis.made()) << result.synthesis.brief();
  return result;
}

std::vector<Case> cases() {
  return {made(testing::forearm()), made(testing::linear_wrist()), made(testing::unsymmetric()),
          made(testing::mirrored(testing::unsymmetric()))};
}

const profile::Outline& outline_of(const Case& c, transmission::Side side) {
  return side == transmission::Side::left ? c.synthesis.p1 : c.synthesis.p2;
}

Vec2 pin_of(const Mechanism& mechanism, transmission::Side side) {
  return {side == transmission::Side::left ? -mechanism.guides.EB : mechanism.guides.ED, -mechanism.guides.OE};
}

double distance_to_line(const Vec2& point, const Vec2& from, const Vec2& to) {
  return std::abs(cross(to - from, point - from)) / (to - from).norm();
}

template <typename Visit>
void for_each_trace(const Case& c, Visit visit) {
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    for (const transmission::TransmissionPoint& point : c.synthesis.stroke) {
      const auto trace = trace_tendon(c.mechanism, outline_of(c, side), point.alpha, point.theta);
      ASSERT_TRUE(trace.has_value());
      visit(side, point, *trace);
    }
  }
}

TEST(TendonTrace, TouchesThePinAtItsPitchRadius) {
  for (const Case& c : cases()) {
    const double rho = c.mechanism.guide_pitch_radius();
    for_each_trace(c, [&](transmission::Side side, const transmission::TransmissionPoint&, const TendonTrace& trace) {
      const Vec2 pin = pin_of(c.mechanism, side);
      EXPECT_NEAR(distance_to_line(pin, trace.attachment, trace.onto_pin), rho, 1e-9);
      EXPECT_NEAR(distance_to_line(pin, trace.off_pin, trace.take_off), rho, 1e-9);
      EXPECT_NEAR((trace.onto_pin - pin).norm(), rho, 1e-9);
      EXPECT_NEAR((trace.off_pin - pin).norm(), rho, 1e-9);
      for (std::size_t i = 1; i + 1 < trace.free_path.size(); ++i)
        EXPECT_NEAR((trace.free_path[i] - pin).norm(), rho, 1e-9);
      EXPECT_GT(transmission::mirror_sign(side) * (trace.onto_pin - pin).x(), 0) << "it passes the outer side";
    });
  }
}

TEST(TendonTrace, PulleyIsOnInnerSide) {
  for (const Case& c : cases()) {
    const Vec2 axis(0, -c.mechanism.guides.OE - c.mechanism.pulley.EF);
    for_each_trace(
        c, [&](transmission::Side side, const transmission::TransmissionPoint& point, const TendonTrace& trace) {
          const Vec2 down = (trace.take_off - trace.off_pin).normalized();
          for (const profile::OutlinePoint& vertex : outline_of(c, side).points) {
            const Vec2 place = axis + Eigen::Rotation2Dd(-point.alpha) * vertex.position;
            EXPECT_LE(transmission::mirror_sign(side) * cross(down, place - trace.take_off), 1e-9);
          }
        });
  }
}

/// Largest less smallest length of the whole string over the stroke.
double length_change(const Case& c, transmission::Side of_side) {
  double least = 1e9, most = 0;
  for_each_trace(c, [&](transmission::Side side, const transmission::TransmissionPoint&, const TendonTrace& trace) {
    if (side != of_side) return;
    least = std::min(least, trace.free_length + trace.wound_length);
    most = std::max(most, trace.free_length + trace.wound_length);
  });
  return most - least;
}

TEST(TendonTrace, KeepsItsLengthOverTheStroke) {
  for (const Case& c : cases()) {
    EXPECT_LT(length_change(c, transmission::Side::left), 0.005);
    EXPECT_LT(length_change(c, transmission::Side::right), 0.005);
  }
}

TEST(TendonTrace, DetectsWrongPulley) {
  Case c = made(testing::forearm());
  for (profile::OutlinePoint& point : c.synthesis.p2.points) point.position *= 1.01;
  EXPECT_GT(length_change(c, transmission::Side::right), 0.05);
}

TEST(TendonTrace, AgreesWithTransmissionOnRoundPulley) {
  const Case c = made(testing::forearm());
  // On a round P1 the take-off point is the foot of the perpendicular, so that the transmission's free length ends
  // there. The traced length less that free length is the wound length, which decreases by r1 · α.
  const auto first =
      trace_tendon(c.mechanism, c.synthesis.p1, c.synthesis.stroke.front().alpha, c.synthesis.stroke.front().theta);
  ASSERT_TRUE(first.has_value());
  const double start = first->free_length + first->wound_length - c.synthesis.stroke.front().t1.length;
  for_each_trace(
      c, [&](transmission::Side side, const transmission::TransmissionPoint& point, const TendonTrace& trace) {
        if (side == transmission::Side::right) return;
        const double wound = trace.free_length + trace.wound_length - point.t1.length;
        EXPECT_NEAR(start - wound, c.mechanism.pulley.r1 * (point.alpha - c.synthesis.stroke.front().alpha), 0.005);
      });
}

TEST(TendonTrace, IsEmptyInsidePin) {
  Case c = made(testing::forearm());
  c.mechanism.guides.radius = 80;
  EXPECT_FALSE(trace_tendon(c.mechanism, c.synthesis.p1, 0, 0).has_value());
  EXPECT_FALSE(trace_tendon(testing::forearm(), profile::Outline{}, 0, 0).has_value());
}

}  // namespace
}  // namespace fusee::formats
