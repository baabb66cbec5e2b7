#include <gtest/gtest.h>

#include "analysis/rigid_joint.h"
#include "fusee/analysis.h"
#include "support/mechanisms.h"

namespace fusee::analysis {
namespace {

using testing::forearm;
using testing::linear_wrist;
using testing::reference;
using testing::unsymmetric;

RigidJoint as_declared(const Mechanism& mechanism) { return {joint::MadePulleys(mechanism), mechanism}; }

const ErrorSource& named(const std::vector<ErrorSource>& sources, const std::string& name) {
  for (const ErrorSource& source : sources) {
    if (source.name == name) return source;
  }
  throw std::out_of_range(name);
}

TEST(RigidJoint, ReproducesTargetMotion) {
  for (const Mechanism& mechanism : {forearm(), linear_wrist(), unsymmetric()}) {
    const transmission::Transmission transmission(mechanism);
    for (const double theta : {-0.3, 0.0, 0.4}) {
      const RigidPoint point = as_declared(mechanism).at(transmission.alpha(theta));
      EXPECT_NEAR(point.theta, theta, 1e-12);
      EXPECT_NEAR(point.excess, 0.0, 1e-11);
    }
  }
}

TEST(RigidJoint, DerivativesAgreeWithDifferences) {
  constexpr double step = 1e-4;
  for (const Mechanism& mechanism :
       {forearm(), linear_wrist(), unsymmetric(), testing::finger(), testing::ankle(), testing::sheathed_wrist()}) {
    const transmission::Transmission transmission(mechanism);
    const joint::MadePulleys made(mechanism);
    for (const Dimension& dimension : dimensions(mechanism)) {
      const RigidJoint more = altered(made, mechanism, dimension, step);
      const RigidJoint less = altered(made, mechanism, dimension, -step);
      for (const double theta : {-0.3, 0.15, 0.4}) {
        const double alpha = transmission.alpha(theta);
        const RigidPoint rate = derivative(as_declared(mechanism), dimension, alpha);
        EXPECT_NEAR((more.at(alpha).theta - less.at(alpha).theta) / (2 * step), rate.theta, 1e-8) << dimension.key;
        EXPECT_NEAR((more.at(alpha).excess - less.at(alpha).excess) / (2 * step), rate.excess, 1e-6) << dimension.key;
      }
    }
  }
}

// The drum's centre is not a dimension of a file, but calibration may find it off the axis. Moving the drum changes the
// path by the components along the straight parts on either side.
template <bool is_across>
void move_drum(Alteration& joint, double by) {
  (is_across ? joint.mounted.joint.drum_centre.across : joint.mounted.joint.drum_centre.along) += by;
}
template <bool is_across>
double by_drum_centre(const transmission::PinPlace& pin, const joint::LowerPath&, transmission::Side side, double theta,
                      double) {
  const transmission::UpperSpan span = transmission::upper_span(pin, theta);
  const Vec2 across(std::cos(theta), -std::sin(theta)), along(std::sin(theta), std::cos(theta));
  const Vec2 pulled = turned_left(unit(span.normal)) - turned_left(unit(span.end_normal));
  return pulled.dot(is_across ? Vec2(transmission::mirror_sign(side) * across) : along);
}

TEST(RigidJoint, DrumCentreAgreesWithDifferences) {
  constexpr double step = 1e-4;
  const std::vector<Dimension> centre = {{"across", move_drum<true>, by_drum_centre<true>},
                                         {"along", move_drum<false>, by_drum_centre<false>}};
  for (const Mechanism& mechanism : {testing::finger(), testing::ankle()}) {
    const transmission::Transmission transmission(mechanism);
    const joint::MadePulleys made(mechanism);
    for (const Dimension& dimension : centre) {
      const RigidJoint more = altered(made, mechanism, dimension, step);
      const RigidJoint less = altered(made, mechanism, dimension, -step);
      for (const double theta : {-0.3, 0.15, 0.4}) {
        const double alpha = transmission.alpha(theta);
        const RigidPoint rate = derivative(as_declared(mechanism), dimension, alpha);
        EXPECT_NEAR((more.at(alpha).theta - less.at(alpha).theta) / (2 * step), rate.theta, 1e-6) << dimension.key;
        EXPECT_NEAR((more.at(alpha).excess - less.at(alpha).excess) / (2 * step), rate.excess, 1e-5) << dimension.key;
      }
    }
  }
}

TEST(RigidJoint, IsInvariantToScaling) {
  // An exact null direction of the mechanism: by Euler's theorem, the sum of length times derivative over all lengths
  // is zero.
  const Mechanism m = unsymmetric();
  const transmission::Transmission transmission(m);
  const double lengths[] = {m.joint.R,       m.guides.EB, m.guides.ED,      m.guides.OE,
                            m.guides.radius, m.pulley.EF, m.tendon.diameter};
  const double alpha = transmission.alpha(0.4);
  // The pulleys scale too, which an offset does not describe: their contribution equals that of r1 for the round P1.
  double sum = 0;
  for (std::size_t i = 0; i < std::size(lengths); ++i)
    sum += lengths[i] * derivative(as_declared(m), dimensions(m)[i], alpha).theta;
  // The pitch curve of the round P1 by r1 − d/2, the floor's radius.
  sum += (m.pulley.r1 - 0.5 * m.tendon.diameter) * derivative(as_declared(m), dimensions(m).back(), alpha).theta;
  EXPECT_NEAR(sum, 0.0, 1e-10);
}

TEST(RigidJoint, CombinedChangesEqualSingleChanges) {
  const Mechanism mechanism = unsymmetric();
  const joint::MadePulleys made(mechanism);
  const double alpha = made.declared().alpha(0.3);
  for (std::size_t i = 0; i < dimensions(mechanism).size(); ++i) {
    std::vector<double> changes(dimensions(mechanism).size(), 0.0);
    changes[i] = 0.5;
    EXPECT_EQ(altered(made, mechanism, changes).at(alpha).theta,
              altered(made, mechanism, dimensions(mechanism)[i], 0.5).at(alpha).theta)
        << dimensions(mechanism)[i].key;
  }
}

TEST(ErrorSources, AgreeWithReference) {
  // Ignoring a pin radius of 2 mm: +1.4/−0.85° at the ends of the stroke.
  Mechanism pins = reference();
  pins.guides.radius = 2.0;
  pins.tendon.diameter = 1e-6;
  const ErrorSource pin = named(error_sources(pins), "pin_radius_ignored");
  EXPECT_NEAR(degrees(pin.most), 1.4, 0.05);
  EXPECT_NEAR(degrees(pin.least), -0.85, 0.05);
  // A tendon 1 mm thick: −0.9/+0.8° due to the pulley, which is thicker by half of it.
  Mechanism point_pins = reference();
  point_pins.tendon.diameter = 1e-6;
  const joint::MadePulleys drawn(point_pins);
  const RigidJoint thicker(drawn.offset_by(0.5), point_pins);
  EXPECT_NEAR(degrees(thicker.at(drawn.declared().alpha_min()).theta) + 30.0, -0.9, 0.05);
  EXPECT_NEAR(degrees(thicker.at(drawn.declared().alpha_max()).theta) - 30.0, 0.8, 0.05);
  // The thicker pins compensate part of it: a quarter of the 2 mm above.
  const ErrorSource thick = named(error_sources(reference()), "tendon_thickness_ignored");
  EXPECT_NEAR(degrees(thick.least), -0.9 + 1.4 / 4, 0.06);
  EXPECT_NEAR(degrees(thick.most), 0.8 - 0.85 / 4, 0.05);
}

TEST(ErrorSources, VanishWithTheirCause) {
  Mechanism mechanism = forearm();
  mechanism.load.tip_force = 10.0;
  mechanism.guides.mu = mechanism.pulley.mu = 0;
  EXPECT_NEAR(named(error_sources(mechanism), "friction").most, 0.0, 1e-9);
  EXPECT_GT(-named(error_sources(mechanism), "stretch").least, 1e-4);
  mechanism.load.tip_force = 0;
  mechanism.tendon.pretension = 0;
  mechanism.guides.mu = mechanism.pulley.mu = 0.2;
  EXPECT_NEAR(named(error_sources(mechanism), "stretch").most, 0.0, 1e-9);
  EXPECT_NEAR(named(error_sources(mechanism), "friction").most, 0.0, 1e-9);
}

TEST(Tolerances, MethodsAgree) {
  AnalysisOptions options;
  options.samples = 2000;
  for (const Mechanism& mechanism : {forearm(), linear_wrist()}) {
    const std::vector<ToleranceEffect> effects = tolerance_effects(mechanism, options);
    ASSERT_EQ(effects.size(), dimensions(mechanism).size() + 1);
    EXPECT_EQ(effects.back().key, "all");
    for (const ToleranceEffect& effect : effects) {
      // A standard deviation from 2000 samples scatters by 1/√4000 = 1.6 %.
      EXPECT_NEAR(effect.theta_by_monte_carlo, effect.theta_by_derivative, 0.06 * effect.theta_by_derivative + 1e-12)
          << effect.key;
      EXPECT_NEAR(effect.excess_by_monte_carlo, effect.excess_by_derivative, 0.06 * effect.excess_by_derivative + 1e-9)
          << effect.key;
    }
    EXPECT_GT(effects.back().theta_by_derivative, effects.front().theta_by_derivative);
  }
}

TEST(Tolerances, ScaleWithTolerance) {
  AnalysisOptions fine;
  fine.samples = 50;
  fine.dimension_tolerance = 0.01;
  AnalysisOptions coarse = fine;
  coarse.dimension_tolerance = 0.1;
  const auto a = tolerance_effects(forearm(), fine);
  const auto b = tolerance_effects(forearm(), coarse);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(10 * a[i].theta_by_derivative, b[i].theta_by_derivative, 1e-14);
    // Both draw equal samples; the second scales them by ten.
    EXPECT_NEAR(10 * a[i].theta_by_monte_carlo, b[i].theta_by_monte_carlo, 0.01 * b[i].theta_by_monte_carlo + 1e-14);
  }
}

}  // namespace
}  // namespace fusee::analysis
