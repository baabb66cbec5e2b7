// The equations in interval arithmetic must enclose their values in double precision.
#include "transmission/equations.h"

#include <gtest/gtest.h>

#include "fusee/transmission.h"
#include "support/mechanisms.h"
#include "transmission/interval.h"
#include "transmission/load.h"

namespace fusee::transmission {
namespace {

TEST(Interval, EnclosesTrueValue) {
  const RoundingUp rounding;
  const Interval third = Interval(1.0) / 3.0;
  EXPECT_LT(third.lower(), third.upper());
  EXPECT_LE(std::nextafter(third.lower(), 1.0), third.upper() + 1e-300);
  // The maximum of sin lies inside the interval.
  EXPECT_GE(sin(Interval(1.0, 2.0)).upper(), 1.0);
  EXPECT_LE(sin(Interval(1.0, 2.0)).lower(), 0.8414709848078965);    // sin 1
  EXPECT_LE(cos(Interval(-0.5, 0.25)).lower(), 0.8775825618903728);  // cos 0.5
  EXPECT_GE(cos(Interval(-0.5, 0.25)).upper(), 1.0);
}

bool holds(const Jet& jet, double value) { return jet.value.lower() <= value && value <= jet.value.upper(); }

/// All directions but those near straight down, where the angle jumps by a full turn.
TEST(Interval, EnclosesDirections) {
  const RoundingUp rounding;
  for (double angle = -0.49 * k_pi; angle < 1.49 * k_pi; angle += 0.01) {
    Domain domain;
    const double x = 3.0 * std::cos(angle), y = 3.0 * std::sin(angle);
    const Jet within = direction(Jet(Interval(x - 0.02, x + 0.02)), Jet(Interval(y - 0.02, y + 0.02)), domain);
    EXPECT_TRUE(holds(within, direction(x, y, domain))) << angle;
    EXPECT_LT(within.value.upper() - within.value.lower(), 0.1) << angle;
    EXPECT_TRUE(domain.possible && domain.whole);
  }
  Domain domain;
  EXPECT_TRUE(holds(direction(Jet(Interval(-1.0, 1.0)), Jet(Interval(-1.0, 1.0)), domain), -1.5));
  EXPECT_FALSE(domain.whole);
}

TEST(Interval, EnclosesSineBeyondWholeTurns) {
  const RoundingUp rounding;
  for (double x = -2.4 * k_pi; x < 2.4 * k_pi; x += 0.05) {
    const Interval over = sin(Interval(x, x + 0.3));
    for (int i = 0; i <= 10; ++i) {
      const double value = std::sin(x + 0.03 * i);
      EXPECT_TRUE(over.lower() <= value && value <= over.upper()) << x;
    }
  }
}

/// One formula per case: its interval contains the double-precision value, with a relative width below 1e-9.
TEST(Equations, IntervalsEncloseNumbers) {
  for (Mechanism mechanism : {testing::forearm(), testing::reference(), testing::unsymmetric()}) {
    mechanism.load.tip_force = 3.0;
    const Transmission law(mechanism);
    const PinPlace& pin = law.place(Side::right);
    for (const double theta : {mechanism.joint.theta_min, 0.0, mechanism.joint.theta_max}) {
      const TransmissionPoint at = law.at_theta(theta);
      const PaperForces forces = paper_forces(mechanism, at);
      const double torque = load_torque(mechanism, theta), stiffness = section_stiffness(mechanism.tendon);
      const double c = pin.lower().c(), phi = pin.lower().phi(), normal = upper_span(pin, theta).normal;
      const RoundingUp rounding;
      const auto expect = [](const Jet& jet, double value, const char* what) {
        EXPECT_TRUE(holds(jet, value)) << what;
        EXPECT_LT(jet.value.upper() - jet.value.lower(), 1e-9 * (1 + std::abs(value))) << what;
      };
      Domain domain;
      const RotationAngle<Jet> turned = rotation_angle(Jet(theta));
      const UpperLine<Jet> upper =
          upper_line(offset_from_pin(Jet(pin.R), Jet(pin.e), Jet(pin.oe), turned), Jet(pin.rho), domain);
      const UpperLine<Jet> in_link =
          upper_line(offset_from_pin_in_link(Jet(pin.R), Jet(pin.e), Jet(pin.oe), turned), Jet(pin.rho), domain);
      const LowerLine<Jet> lower = lower_line(Jet(at.t2.p), Jet(pin.rho), Jet(c), Jet(phi), domain);
      const Jet wrap = upper.normal - lower.normal, arm = Jet(pin.R) * sin(in_link.normal);
      expect(arm, at.t2.m, "moment arm");
      expect(in_link.normal, theta + normal, "gamma");
      expect(upper.free, at.t2.free_upper, "free length");
      expect(wrap, at.t2.wrap, "wrap");
      expect(lower.reach, at.t2.lower_reach, "reach");
      const Jet above = tension_above_pin(Jet(torque), arm);
      const Jet below = tension_below_pin(above, Jet(mechanism.guides.mu), wrap);
      expect(above, forces.T2, "T2");
      expect(below, forces.Tb, "Tb");
      const Jet elongation =
          elongation_of_tendon(above, below, upper.free, Jet(pin.rho) * wrap, lower.reach, Jet(stiffness));
      EXPECT_NEAR(elongation.value.lower(), forces.elongation, 1e-12);
      EXPECT_TRUE(domain.possible && domain.whole);
    }
  }
}

}  // namespace
}  // namespace fusee::transmission
