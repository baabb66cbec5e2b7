// Tendon paths over drums and to separate attachments, compared with a string laid by brute force. Both circles are
// polygons of a few thousand points, and the string is the chain of points with all others on its inner side. Turns are
// counted by following the joint. The test uses no formula of tendon_path.cpp.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "fusee/transmission.h"
#include "support/brute_string.h"
#include "support/mechanisms.h"

namespace fusee::transmission {
namespace {

using testing::BruteString;
using testing::k_string_step;
using testing::right_of;

PinPlace random_place(std::mt19937& random) {
  const auto between = [&random](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(random);
  };
  PinPlace place{};
  place.drum = between(3.0, 40.0);
  place.rho = place.drum * between(0.02, 0.8);
  const double away = (place.drum + place.rho) * between(1.05, 4.0), direction = radians(between(-85.0, 60.0));
  place.e = away * std::cos(direction);
  place.oe = -away * std::sin(direction);
  place.ef = place.drum * between(3.0, 6.0);
  place.R = place.drum * (random() % 4 == 0 ? 1.0 : between(1.0, 2.5));
  place.twist = radians(between(-179.0, 120.0));
  return place;
}

TEST(DrumPath, AgreesWithBruteForceString) {
  std::mt19937 random(20261122);
  const int joints = std::getenv("FUSEE_LONG_TESTS") != nullptr ? 4000 : 150;
  int wound = 0, free = 0;
  for (int i = 0; i < joints; ++i) {
    const PinPlace place = random_place(random);
    BruteString string(place);
    double before = 0, before_formula = 0;
    for (double theta = radians(-170.0); theta < radians(170.0); theta += radians(17.0)) {
      const UpperSpan span = upper_span(place, theta);
      // Past a dead centre no tendon pulls, and shortly before it the end may run into the pin.
      if (!(span.m > 0.05 * place.drum)) break;
      // The string is coarse where the end is within a few polygon points of the pin.
      if (span.on_drum == 0 && span.free < 0.5 * place.drum) break;
      const auto leaves = lift_off(place);
      ASSERT_TRUE(leaves);
      // At lift-off the last touching point is arbitrary.
      if (std::abs(theta - *leaves) < 2 * k_string_step + 0.01) continue;
      const double length = string.length(theta);
      if (before != 0) {
        EXPECT_NEAR(length - before, span.length - before_formula, 2e-8 * place.drum)
            << "joint " << i << ", theta " << degrees(theta);
      }
      before = length;
      before_formula = span.length;
      EXPECT_EQ(string.is_wound(), theta < *leaves) << i;
      EXPECT_EQ(span.on_drum > 0, theta < *leaves) << i;
      (span.on_drum > 0 ? wound : free) += 1;
      // Differences of the polygonal string are accurate to its point spacing.
      const double arm = -(string.length(theta + 0.01) - string.length(theta - 0.01)) / 0.02;
      const UpperSpan after = upper_span(place, theta + 0.01), behind = upper_span(place, theta - 0.01);
      EXPECT_NEAR(arm, -(after.length - behind.length) / 0.02, 1e-5 * place.drum) << i;
    }
  }
  EXPECT_GT(wound, 4 * joints);
  EXPECT_GT(free, joints);
}

TEST(DrumPath, DerivativesAgreeWithDifferencesAroundLiftOff) {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    PinPlace place = random_place(random);
    const double leaves = *lift_off(place);
    for (const double off : {-0.4, -0.01, 0.01, 0.3}) {
      constexpr double step = 1e-4;
      const double theta = leaves + off;
      const UpperSpan before = upper_span(place, theta - step), at = upper_span(place, theta),
                      after = upper_span(place, theta + step);
      // Curvatures are large where the span is short.
      if (!(at.m > 0.1 * place.drum) || at.free < 0.5 * place.drum) continue;
      const double size = place.R;
      EXPECT_NEAR((after.length - before.length) / (2 * step), -at.m, 1e-6 * size);
      EXPECT_NEAR((after.m - before.m) / (2 * step), at.dm, 1e-6 * size);
      EXPECT_NEAR((after.dm - before.dm) / (2 * step), at.d2m, 1e-4 * size);
      EXPECT_NEAR((after.normal - before.normal) / (2 * step), at.dnormal, 1e-6);
      EXPECT_NEAR((after.dnormal - before.dnormal) / (2 * step), at.d2normal, 1e-4);
    }
  }
}

TEST(DrumPath, ArmIsContinuousAtLiftOff) {
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    const PinPlace place = random_place(random);
    const double leaves = *lift_off(place);
    const UpperSpan on = upper_span(place, leaves - 1e-10), off = upper_span(place, leaves + 1e-10);
    EXPECT_EQ(on.m, place.drum);
    EXPECT_NEAR(off.m, place.drum, 1e-8 * place.drum);
    EXPECT_NEAR(off.length, on.length, 1e-8 * place.drum);
    EXPECT_EQ(on.dm, 0.0);
    EXPECT_GE(off.dm, -1e-7 * place.drum);
  }
}

TEST(DrumPath, MovesEndOntoPitchCircle) {
  Mechanism mechanism = testing::finger();
  mechanism.joint.attachment2 = Attachment{0.0, 8.1};
  const PinPlace place = pin_place(mechanism, Side::right, mechanism.seen_pitch_radius());
  EXPECT_EQ(place.R, 8.3);
  EXPECT_EQ(place.drum, 8.3);
}

TEST(DrumPath, PermanentDrumWrapIsPlainPulley) {
  Mechanism mechanism = testing::finger();
  const Transmission round(mechanism);
  ASSERT_FALSE(round.dead_centre());
  for (const double theta : {-0.34, -0.1, 0.0, 0.7, 1.57}) {
    const TransmissionPoint at = round.at_theta(theta);
    EXPECT_EQ(at.t1.p, 9.0);  // r1
    EXPECT_EQ(at.t1.m, 8.3);  // radius of the drum to the tendon's centre line
    EXPECT_EQ(at.t2.p, 9.0 / 8.3 * 8.3);
    EXPECT_NEAR(at.alpha, theta * 8.3 / 9.0, 1e-15);
  }
  mechanism.pulley.law = Law::linear;
  mechanism.pulley.ratio = 0.8;
  const Transmission linear(mechanism);
  for (const double theta : {-0.34, 0.0, 1.57}) {
    EXPECT_EQ(linear.at_theta(theta).t1.p, 8.3 * (1 / 0.8));
    EXPECT_EQ(linear.at_theta(theta).t2.p, 8.3 * (1 / 0.8));
  }
}

/// A tendon through its sheath. The brute-force string runs from the tendon's end over drum and pin straight down into
/// the sheath, and from the sheath exit round the pulley. Only θ(α) and the radii come from the transmission. The
/// pulley is the envelope of the lines that pass its axis at these radii on their way to the exit: intersections of
/// neighbouring lines, round which the string is laid.
class StringThroughSheath {
 public:
  StringThroughSheath(const Mechanism& mechanism, const Transmission& law, Side side)
      : law_(law),
        sign_(mirror_sign(side)),
        upper_(law.place(side)),
        exit_(mechanism.sheath.exit_across, mechanism.sheath.exit_above) {
    constexpr int lines = 6000;
    const double beyond = 0.02 * (law.alpha_max() - law.alpha_min());
    const double from = sign_ > 0 ? law.alpha_min() - beyond : law.alpha_max() + beyond;
    const double to = sign_ > 0 ? law.alpha_max() + beyond : law.alpha_min() - beyond;
    Vec2 normal_before(0, 0);
    double p_before = 0;
    for (int i = 0; i <= lines; ++i) {
      const double alpha = from + (to - from) * i / lines;
      const TransmissionPoint at = law.at_alpha(alpha);
      const double p = side == Side::right ? at.t2.p : at.t1.p;
      // Foot of the axis' perpendicular on the line, to the right of the way from the axis to the sheath exit.
      const double c = exit_.norm(), ahead = p * p / c, aside = p * std::sqrt(1.0 - p * p / (c * c));
      const Vec2 towards = exit_ / c, right(towards.y(), -towards.x());
      const Vec2 normal = turned(Vec2((ahead * towards + aside * right) / p), sign_ * alpha);
      if (i > 0) {
        const double det = cross(normal_before, normal);
        corners_.push_back(Vec2((p_before * normal.y() - p * normal_before.y()) / det,
                                (p * normal_before.x() - p_before * normal.x()) / det));
        along_.push_back(i == 1 ? 0.0 : along_.back() + (corners_.back() - corners_[corners_.size() - 2]).norm());
      }
      normal_before = normal;
      p_before = p;
    }
  }

  double length(double alpha) {
    const Vec2 exit_point = turned(exit_, sign_ * alpha);
    std::size_t best = 0;
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      if (right_of(corners_[best], exit_point, corners_[i]) > 0) best = i;
    }
    return upper_.length(sign_ * law_.theta(alpha)) + (exit_point - corners_[best]).norm() + along_[best];
  }

 private:
  static Vec2 turned(const Vec2& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
  }

  const Transmission& law_;
  double sign_;
  BruteString upper_;
  Vec2 exit_;  ///< relative to the pulley's axis
  std::vector<Vec2> corners_;
  std::vector<double> along_;
};

TEST(SheathPath, LengthIsConstant) {
  Mechanism finger = testing::finger(), ankle = testing::ankle();
  finger.sheath = {300.0, 2.0, 0.1, 0.0, 15.0, 40.0};
  ankle.sheath = {600.0, 3.0, 0.1, 0.0, 60.0, 130.0};
  for (const Mechanism& mechanism : {finger, ankle, testing::mirrored(ankle)}) {
    const Transmission law(mechanism);
    ASSERT_FALSE(law.dead_centre());
    for (const Side side : {Side::left, Side::right}) {
      StringThroughSheath string(mechanism, law, side);
      const double home = string.length(0.0);
      for (int i = 0; i <= 20; ++i) {
        const double alpha = law.alpha_min() + (law.alpha_max() - law.alpha_min()) * i / 20;
        EXPECT_NEAR(string.length(alpha), home, 1e-4)
            << mechanism.name << " " << i << (side == Side::left ? " left" : "");
      }
    }
  }
}

TEST(SheathPath, IsIndependentOfPulleyPosition) {
  const Mechanism mechanism = testing::sheathed_wrist();
  Mechanism elsewhere = mechanism;
  elsewhere.pulley.EF = 1234.0;
  const Transmission one(mechanism), other(elsewhere);
  for (const double theta : {-0.4, 0.0, 0.3}) {
    const TransmissionPoint here = one.at_theta(theta), there = other.at_theta(theta);
    EXPECT_EQ(here.t1.length, there.t1.length);
    EXPECT_EQ(here.t2.lower_normal, there.t2.lower_normal);
    EXPECT_EQ(here.t2.wrap, there.t2.wrap);
  }
}

/// Sheath exits in place of point pins leave the line from pin to pulley unchanged.
TEST(SheathPath, ExitInPlaceOfPointPinKeepsLine) {
  Mechanism pins = testing::reference(), sheaths = pins;
  pins.tendon.diameter = sheaths.tendon.diameter = 0.0;
  sheaths.sheath = {400.0, 1.0, 0.1, 0.0, pins.guides.ED, pins.pulley.EF};
  const Transmission one(pins), other(sheaths);
  for (const double theta : {-0.5, -0.1, 0.0, 0.4}) {
    const TransmissionPoint here = one.at_theta(theta), there = other.at_theta(theta);
    EXPECT_EQ(here.alpha, there.alpha);
    EXPECT_EQ(here.t2.p, there.t2.p);
    EXPECT_EQ(here.t1.lower_normal, there.t1.lower_normal);
    EXPECT_NEAR(here.t2.length + 400.0, there.t2.length, 1e-12);
  }
}

TEST(DrumPath, AcceptsEndCAsAttachment) {
  const Mechanism plain = testing::unsymmetric();
  Mechanism same = plain;
  same.joint.attachment1 = same.joint.attachment2 = Attachment{0.0, plain.joint.R};
  const Transmission one(plain), other(same);
  for (const double theta : {-0.3, 0.0, 0.5}) {
    EXPECT_EQ(one.at_theta(theta).t1.length, other.at_theta(theta).t1.length);
    EXPECT_EQ(one.at_theta(theta).t2.p, other.at_theta(theta).t2.p);
  }
}

TEST(DrumPath, MirroredJointHasMirroredArms) {
  const Mechanism mechanism = testing::ankle();
  const Transmission one(mechanism), other(testing::mirrored(mechanism));
  ASSERT_FALSE(one.dead_centre());
  for (const double theta : {-0.5, -0.1, 0.0, 0.3, 0.42}) {
    EXPECT_NEAR(one.at_theta(theta).t1.m, other.at_theta(-theta).t2.m, 1e-12);
    EXPECT_NEAR(one.at_theta(theta).t2.p, other.at_theta(-theta).t1.p, 1e-12);
  }
}

/// A drum whose centre moves round the joint's axis.
PinPlace random_place_off_axis(std::mt19937& random) {
  PinPlace place = random_place(random);
  place.drum_offset = place.drum * 0.04 * (1 + static_cast<double>(random() % 3));
  place.drum_twist = radians(static_cast<double>(random() % 360) - 180.0);
  place.R = std::max(place.R, place.drum + place.drum_offset);
  return place;
}

// Reference: the path over a drum about O, seen from the drum's own centre. DrumPath.AgreesWithBruteForceString
// compares that path with a string.
TEST(DrumOffTheAxis, AgreesWithBruteForceString) {
  std::mt19937 random(11);
  int wound = 0, free = 0;
  for (int i = 0; i < 200; ++i) {
    const PinPlace place = random_place_off_axis(random);
    for (double theta = -1.2; theta < 1.2; theta += 0.17) {
      const UpperSpan span = upper_span(place, theta);
      if (!(span.m > 0.1 * place.drum) || span.free < 0.3 * place.drum) break;
      // Pin and end relative to the drum's centre: a joint with another link length, at another angle.
      const Vec2 centre = drum_centre(place, theta);
      const double turned = theta + place.twist;
      const Vec2 end = place.R * Vec2(std::sin(turned), std::cos(turned)) - centre;
      PinPlace seen = place;
      seen.e -= centre.x();
      seen.oe += centre.y();
      seen.drum_offset = seen.drum_twist = 0;
      seen.R = end.norm();
      seen.twist = place.twist;
      double angle = std::atan2(end.x(), end.y()) - place.twist;
      angle -= k_two_pi * std::round((angle - theta) / k_two_pi);
      const UpperSpan there = upper_span(seen, angle);
      EXPECT_NEAR(there.length, span.length, 1e-9 * place.drum) << i << " " << theta;
      EXPECT_NEAR(there.on_drum, span.on_drum, 1e-9) << i << " " << theta;
      (span.on_drum > 0 ? wound : free) += 1;
    }
  }
  EXPECT_GT(wound, 300);
  EXPECT_GT(free, 100);
}

TEST(DrumOffTheAxis, DerivativesAgreeWithDifferences) {
  std::mt19937 random(12);
  int seen = 0;
  for (int i = 0; i < 300; ++i) {
    const PinPlace place = random_place_off_axis(random);
    const double leaves = *lift_off(place);
    for (const double off : {-0.9, -0.4, -0.01, 0.01, 0.3}) {
      constexpr double step = 1e-4;
      const double theta = leaves + off;
      const UpperSpan at = upper_span(place, theta), less = upper_span(place, theta - step),
                      more = upper_span(place, theta + step);
      if (!(at.m > 0.1 * place.drum) || at.free < 0.5 * place.drum) continue;
      EXPECT_EQ(at.on_drum > 0, off < 0);
      EXPECT_NEAR(at.m, -(more.length - less.length) / (2 * step), 1e-6 * place.drum) << i << " " << off;
      EXPECT_NEAR(at.dm, (more.m - less.m) / (2 * step), 1e-5 * place.drum) << i << " " << off;
      EXPECT_NEAR(at.d2m, (more.dm - less.dm) / (2 * step), 1e-4 * place.drum) << i << " " << off;
      EXPECT_NEAR(at.dnormal, (more.normal - less.normal) / (2 * step), 1e-6) << i << " " << off;
      EXPECT_NEAR(at.d2normal, (more.dnormal - less.dnormal) / (2 * step), 1e-5) << i << " " << off;
      ++seen;
    }
    const UpperSpan on = upper_span(place, leaves - 1e-9), after = upper_span(place, leaves + 1e-9);
    EXPECT_NEAR(on.length, after.length, 1e-7 * place.drum);
    EXPECT_NEAR(on.m, after.m, 1e-6 * place.drum);
  }
  EXPECT_GT(seen, 500);
}

}  // namespace
}  // namespace fusee::transmission
