#include "optimize/wide_path.h"

#include <gtest/gtest.h>

#include "fusee/transmission.h"
#include "optimize/random.h"

namespace fusee::optimize {
namespace {

struct Pose {
  double across, along, drum, e, oe, rho, theta;
};

Pose random_pose(Random& random) {
  const auto between = [&](double low, double high) { return low + (high - low) * random.fraction(); };
  return {between(-12, 12), between(-12, 12), between(3, 10),    between(10, 20),
          between(8, 20),   between(0, 3),    between(-1.5, 1.5)};
}

/// The path as upper_span() computes it.
transmission::UpperSpan span_of(const Pose& pose) {
  transmission::PinPlace place{pose.e, pose.oe, 50, pose.rho, std::hypot(pose.across, pose.along)};
  place.twist = std::atan2(pose.across, pose.along);
  place.drum = pose.drum;
  place.at_C = false;
  place.R = std::max(place.R, place.drum);
  return transmission::upper_span(place, pose.theta);
}

TEST(WidePath, AgreesWithTransmission) {
  Random random(5);
  int on_drum = 0, free = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pose pose = random_pose(random);
    const transmission::UpperSpan span = span_of(pose);
    transmission::Domain domain;
    const std::optional<double> drum = pose.drum;
    const TendonEnd<double> end =
        tendon_end(std::hypot(pose.across, pose.along), twist_of(pose.across, pose.along, domain), drum);
    const WidePath<double> path = wide_path(end, drum, pose.e, pose.oe, pose.rho, pose.theta, domain);
    if (!(span.m > 0)) continue;
    ASSERT_TRUE(domain.possible);
    (span.on_drum > 0 ? on_drum : free) += 1;
    EXPECT_NEAR(path.arm, span.m, 1e-11);
    EXPECT_NEAR(path.normal, span.normal, 1e-11);
    EXPECT_NEAR(path.free, span.free, 1e-10);
  }
  EXPECT_GT(on_drum, 300);
  EXPECT_GT(free, 300);
}

/// Boxes from 1e-4 to 1, on the drum, clear of it and across lift-off. Values must lie in their intervals, and
/// differences from the middle in slope × distance (mean value theorem).
TEST(WidePath, EnclosesPathsInBox) {
  Random random(6);
  long compared = 0, about_lift_off = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pose pose = random_pose(random);
    const double size = std::pow(10.0, -4.0 * random.fraction());
    const auto interval = [&](double middle, double half) {
      return transmission::Interval(middle - half, middle + half);
    };
    const double half_drum = 3 * size, half_end = 5 * size;
    std::vector<std::pair<Pose, transmission::UpperSpan>> inside;
    int on_drum = 0;
    for (int k = 0; k < 10; ++k) {
      Pose one = pose;
      one.drum += half_drum * (2 * random.fraction() - 1);
      one.across += half_end * (2 * random.fraction() - 1);
      const transmission::UpperSpan span = span_of(one);
      if (!(span.m > 0)) continue;
      on_drum += span.on_drum > 0;
      inside.emplace_back(one, span);
    }
    const transmission::UpperSpan middle = span_of(pose);
    const transmission::RoundingUp rounding;
    transmission::Domain domain;
    const transmission::Jet across = transmission::Jet::variable(interval(pose.across, half_end), 0, 2);
    const std::optional<transmission::Jet> drum = transmission::Jet::variable(interval(pose.drum, half_drum), 1, 2);
    const transmission::Jet along(pose.along);
    const TendonEnd<transmission::Jet> end =
        tendon_end(transmission::Jet(transmission::hypot(across, along)), twist_of(across, along, domain), drum);
    const WidePath<transmission::Jet> path =
        wide_path(end, drum, transmission::Jet(pose.e), transmission::Jet(pose.oe), transmission::Jet(pose.rho),
                  transmission::Jet(pose.theta), domain);
    if (inside.empty()) continue;
    ASSERT_TRUE(domain.possible);
    about_lift_off += on_drum > 0 && on_drum < static_cast<int>(inside.size());
    for (const auto& [one, span] : inside) {
      const auto holds = [&, &one = one](const transmission::Jet& jet, double value, double at_middle) {
        constexpr double k_rounding = 1e-9;
        EXPECT_GE(value, jet.value.lower() - k_rounding);
        EXPECT_LE(value, jet.value.upper() + k_rounding);
        if (!domain.whole || !(middle.m > 0)) return;
        const transmission::Interval along_box = jet.slope[0] * transmission::Interval(one.across - pose.across) +
                                                 jet.slope[1] * transmission::Interval(one.drum - pose.drum);
        EXPECT_GE(value - at_middle, along_box.lower() - k_rounding);
        EXPECT_LE(value - at_middle, along_box.upper() + k_rounding);
        ++compared;
      };
      holds(path.arm, span.m, middle.m);
      holds(path.normal, span.normal, middle.normal);
      holds(path.free, span.free, middle.free);
    }
    if (::testing::Test::HasFailure()) break;
  }
  EXPECT_GT(compared, 5000);
  EXPECT_GT(about_lift_off, 20);
}

}  // namespace
}  // namespace fusee::optimize
