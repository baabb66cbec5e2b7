#include <gtest/gtest.h>

#include "fusee/transmission.h"
#include "support/mechanisms.h"

namespace fusee::transmission {
namespace {

constexpr PinPlace k_place{47.0, -33.0, 70.0, 3.5, 95.0};  // e, oe, ef, rho, R

TEST(UpperSpan, OverPointPinAgreesWithPaper) {
  const PinPlace place = pin_place(testing::reference(), Side::right, 0.0);
  for (const double theta : {-0.5, -0.1, 0.0, 0.3, 0.52}) {
    const UpperSpan span = upper_span(place, theta);
    const double CD = std::sqrt(place.R * place.R + place.e * place.e + place.oe * place.oe -
                                2 * place.R * (place.e * std::sin(theta) - place.oe * std::cos(theta)));
    EXPECT_NEAR(span.free, CD, 1e-12 * CD);
    EXPECT_NEAR(span.m, place.R * (place.e * std::cos(theta) + place.oe * std::sin(theta)) / CD, 1e-12 * span.m);
  }
}

TEST(UpperSpan, TouchesOuterSideOfPin) {
  for (const double theta : {-0.6, 0.0, 0.6}) {
    const UpperSpan span = upper_span(k_place, theta);
    const Vec2 normal = unit(span.normal);
    const Vec2 attachment = k_place.R * Vec2(std::sin(theta), std::cos(theta));
    EXPECT_NEAR((attachment - k_place.pin()).dot(normal), k_place.rho, 1e-12);
    EXPECT_NEAR(attachment.dot(normal), span.m, 1e-12);
    EXPECT_GT(normal.x(), 0.0);
  }
}

TEST(UpperSpan, DerivativesAgreeWithDifferences) {
  constexpr double step = 1e-4;
  for (const double theta : {-0.5, -0.2, 0.0, 0.25, 0.5}) {
    const UpperSpan before = upper_span(k_place, theta - step);
    const UpperSpan at = upper_span(k_place, theta);
    const UpperSpan after = upper_span(k_place, theta + step);
    EXPECT_NEAR((after.length - before.length) / (2 * step), -at.m, 1e-6);
    EXPECT_NEAR((after.m - before.m) / (2 * step), at.dm, 1e-6);
    EXPECT_NEAR((after.m - 2 * at.m + before.m) / (step * step), at.d2m, 1e-4);
  }
}

TEST(UpperSpan, IsUndefinedInsidePin) {
  PinPlace place = k_place;
  place.R = 60.0;
  place.oe = -60.0;
  place.e = 2.0;
  EXPECT_TRUE(std::isnan(upper_span(place, 0.0).m));
}

TEST(UpperSpan, IsContinuousBelowPin) {
  const PinPlace place{40.0, -120.0, 150.0, 2.0, 100.0};  // the pin is 120 mm above O, C at most 100 mm
  double previous = upper_span(place, -0.5).normal;
  for (double theta = -0.49; theta < 0.3; theta += 0.01) {
    const double normal = upper_span(place, theta).normal;
    EXPECT_LT(std::abs(normal - previous), 0.05) << "theta " << theta;
    previous = normal;
  }
}

}  // namespace
}  // namespace fusee::transmission
