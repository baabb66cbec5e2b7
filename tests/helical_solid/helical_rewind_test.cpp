// Strings wound on helical grooves in meshes, against closed forms.
#include <gmock/gmock.h>

#include <cmath>

#include "fusee/base.h"
#include "fusee/helical_solid.h"
#include "fusee/transmission.h"
#include "helical_solid/spirals.h"
#include "support/mechanisms.h"
#include "support/shapes.h"

namespace fusee::helical_solid {
namespace {

/// Distance of a point from the spiral's floor.
double away_from(const helix::Spiral& spiral, const SpiralPlace& place, const Vec3& point) {
  const auto floor = [&](const helix::SpiralRow& row) {
    return Vec3(row.x - 0.5 * std::cos(row.turn), row.y - 0.5 * std::sin(row.turn), place.height(row.z));
  };
  double least = 1e9;
  for (std::size_t k = 0; k + 1 < spiral.rows.size(); ++k) {
    const Vec3 a = floor(spiral.rows[k]), b = floor(spiral.rows[k + 1]);
    const double share = std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (point - a - share * (b - a)).norm());
  }
  return least;
}

TEST(HelicalFloors, MatchTheSpirals) {
  DeclaredMechanism mechanism = testing::forearm();
  mechanism.body = testing::plain_mechanism().body;
  mechanism.print = testing::plain_mechanism().print;
  const double lead = least_lead(helical_section(mechanism), 2.4) + 0.3, slope = lead / (k_two_pi * 12.0);
  const helix::Spiral p1 = testing::spiral_of(testing::growing(12, 2.4, 0.3), 0.3, 5, slope);
  const helix::Spiral p2 = testing::spiral_of(testing::growing(24, -2.4, 1.1), 1.1, 5, slope);
  const HelicalPulley pulley = make_helical_pulley(mechanism, p1, p2);
  ASSERT_TRUE(pulley.made) << pulley.brief();
  const auto floors = helical_floors(pulley.mesh, pulley.layout.scale);
  ASSERT_EQ(floors.size(), 2u);
  for (const auto& [floor, spiral, place] :
       {std::tuple{&floors[0], &p1, &pulley.p1}, std::tuple{&floors[1], &p2, &pulley.p2}}) {
    EXPECT_NEAR(static_cast<double>(floor->size()), 5 * 720.0 - 16.0, 4.0);  // 4° (8 places) less at both ends
    double furthest = 0;
    for (const Vec3& point : *floor) furthest = std::max(furthest, away_from(*spiral, *place, point));
    EXPECT_LT(furthest, 0.012);
  }
}

/// Both tendons on a drum of the joint, both grooves round. The string's length in closed form is that of a helix and
/// of one straight line, unrolled over pin and drum.
struct RoundCapstan {
  static constexpr double radius = 12.0, drum = 80.0;

  RoundCapstan() {
    mechanism = testing::forearm();
    mechanism.body = testing::plain_mechanism().body;
    mechanism.print = testing::plain_mechanism().print;
    mechanism.joint = {90.0, radians(-60.0), radians(60.0)};
    mechanism.joint.drum_radius = drum - 0.5;
    mechanism.joint.attachment1 = Attachment{60.0, 60.0};
    mechanism.joint.attachment2 = Attachment{-60.0, 60.0};
    mechanism.guides.EB = mechanism.guides.ED = 84.0;
    mechanism.guides.OE = 60.0;
    mechanism.pulley.EF = 120.0;
    mechanism.pulley.law = Law::linear;
    mechanism.pulley.ratio = drum / radius;
    slope = (least_lead(helical_section(mechanism), 0.0) + 0.2) / (k_two_pi * radius);
    const transmission::Transmission law(mechanism);
    for (int k = 0; k <= 60; ++k)
      stroke.push_back(law.at_alpha(law.alpha_min() + (law.alpha_max() - law.alpha_min()) * k / 60));
    p1 = spiral_about(law.at_alpha(0).t1.lower_normal, law);
    p2 = spiral_about(law.at_alpha(0).t2.lower_normal, law);
    free1 = law.at_alpha(0).t1.length;
    free2 = law.at_alpha(0).t2.length;
    pulley = make_helical_pulley(mechanism, p1, p2);
  }

  helix::Spiral spiral_about(double home, const transmission::Transmission& law) const {
    const double spare = k_two_pi, begin = home + law.alpha_min() - spare;
    const double turns = (law.alpha_max() - law.alpha_min() + 2 * spare) / k_two_pi;
    helix::Spiral spiral = testing::spiral_of(testing::round_curve(radius), begin, turns, slope);
    const double per_row = turns * k_two_pi / static_cast<double>(spiral.rows.size() - 1);
    spiral.first_used = static_cast<std::size_t>(std::lround(spare / per_row));
    spiral.last_used = spiral.rows.size() - 1 - spiral.first_used;
    return spiral;
  }
  /// Height of the take-off in the spiral's frame at α.
  double take_off(const helix::Spiral& spiral, double alpha) const {
    const double middle = 0.5 * (spiral.rows.front().z + spiral.rows.back().z);
    const double offset = 0.5 * (stroke.front().alpha + stroke.back().alpha);
    return middle + slope * radius * (alpha - offset);
  }
  /// θ at which a string is as long as at home. `hand`: +1 for tendon 2.
  double theta(double alpha, double hand, double free, double end_z, const helix::Spiral& spiral) const {
    const auto length = [&](double a, double t) {
      return hand * radius * a * std::hypot(1.0, slope) +
             std::hypot(free - hand * drum * t, end_z - take_off(spiral, a));
    };
    double low = -1.5, high = 1.5;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (hand * (length(alpha, middle) - length(0, 0)) > 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  Mechanism mechanism = testing::forearm();
  double slope = 0, free1 = 0, free2 = 0;
  std::vector<transmission::TransmissionPoint> stroke;
  helix::Spiral p1, p2;
  HelicalPulley pulley;
};

TEST(HelicalRewind, MatchesClosedForm) {
  const RoundCapstan joint;
  ASSERT_TRUE(joint.pulley.made) << joint.pulley.brief();
  // Tolerances cover the steps of the polygon: the take-off moves from corner to corner, 0.9 mm and 0.07 mm of height
  // apart. Omitting corners, or letting the tendon rise with the floor only, would be 0.003° and 0.005 mm off.
  for (const double aside : {0.0, 7.0}) {
    const double end1 = joint.take_off(joint.p1, 0) + aside, end2 = joint.take_off(joint.p2, 0) - aside;
    const TendonsLaid laid = tendons_laid(joint.pulley, joint.p1, joint.p2, end1, end2, false);
    const HelicalRewind wound = rewind_helical(joint.pulley.mesh, joint.mechanism, joint.stroke, laid);
    ASSERT_EQ(wound.result.points.size(), joint.stroke.size());
    double fleet = 0;
    for (const profile::RewindPoint& point : wound.result.points) {
      const double closed_form = joint.theta(point.alpha, -1.0, joint.free1, end1, joint.p1);
      EXPECT_NEAR(degrees(point.theta), degrees(closed_form), 0.0015) << degrees(point.alpha);
      // Fleet angle in closed form.
      for (const double hand : {-1.0, 1.0}) {
        const double free = hand > 0 ? joint.free2 : joint.free1;
        const double rise = (hand > 0 ? end2 : end1) - joint.take_off(hand > 0 ? joint.p2 : joint.p1, point.alpha);
        fleet = std::max(fleet, std::abs(std::atan(rise / (free - hand * RoundCapstan::drum * point.theta)) -
                                         hand * std::atan(joint.slope)));
      }
      const double free2 = joint.free2 - RoundCapstan::drum * point.theta;
      const auto length2 = [&](double alpha, double planar) {
        return RoundCapstan::radius * alpha * std::hypot(1.0, joint.slope) +
               std::hypot(planar, end2 - joint.take_off(joint.p2, alpha));
      };
      EXPECT_NEAR(point.excess, length2(0, joint.free2) - length2(point.alpha, free2), 0.002) << degrees(point.alpha);
    }
    EXPECT_NEAR(degrees(wound.max_fleet), degrees(fleet), 0.03);
    // The path's slope moves the joint, and the planar law does not contain it.
    EXPECT_GT(degrees(wound.result.max_theta_error), aside > 0 ? 0.1 : 0.02);
  }
}

TEST(HelicalRewind, RejectsGrooveEndingWithinRange) {
  const RoundCapstan joint;
  ASSERT_TRUE(joint.pulley.made) << joint.pulley.brief();
  TendonsLaid laid = tendons_laid(joint.pulley, joint.p1, joint.p2, 0, 0, false);
  laid.spare1 = -k_two_pi;
  EXPECT_THROW(rewind_helical(joint.pulley.mesh, joint.mechanism, joint.stroke, laid), InputError);
}

}  // namespace
}  // namespace fusee::helical_solid
