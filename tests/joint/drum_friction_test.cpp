// Friction on a joint's drum, [d1] to [d3] of docs/background/physics.md: compared with a string of links that shares
// no equation with the model, with the energy balance of a cycle, and with its limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fusee/joint.h"
#include "fusee/transmission.h"
#include "support/mechanisms.h"

namespace fusee::joint {
namespace {

/// A string from its end over a drum, in links of the unstretched length h that keep their material. A knot between two
/// links slips when their tension ratio exceeds the capstan limit, and only up to it. Solved by relaxation, without
/// profile, bounds or pieces.
class StringInLinks {
 public:
  StringInLinks(double drum, double behind, double friction, double EA, double link, double home)
      : drum_(drum), behind_(behind), friction_(friction), EA_(EA), link_(link), knots_{0.0} {
    const double long_enough = behind + 1.2 * k_two_pi * drum;
    while (knots_.back() < long_enough) knots_.push_back(knots_.back() + link * (1.0 + home / EA));
  }

  /// Sets the wrap on the drum and the tension beyond it.
  void to(double wrap, double tension) {
    const double taut = link_ * (1.0 + tension / EA_);
    const double takes_off = wrap > 0 ? behind_ + drum_ * wrap : 0.0;
    for (int sweep = 0; sweep < 40000; ++sweep) {
      double moved = 0;
      std::size_t i = 1;
      for (; i + 1 < knots_.size() && knots_[i] < takes_off; ++i) moved = std::max(moved, relax(i, takes_off));
      // From the first knot off the drum on, the string is free.
      for (; i < knots_.size(); ++i) {
        const double beyond = std::max(0.0, takes_off - knots_[i - 1]);
        const double at = knots_[i - 1] + taut;
        if (beyond == 0 || at > knots_[i - 1]) moved = std::max(moved, std::abs(at - knots_[i]));
        knots_[i] = at;
      }
      if (moved < 1e-13) return;
    }
  }

  /// Material from the end to the lift-off point.
  double material(double wrap) const {
    const double takes_off = wrap > 0 ? behind_ + drum_ * wrap : 0.0;
    const auto next = std::upper_bound(knots_.begin(), knots_.end(), takes_off);
    const auto i = next - knots_.begin();
    return link_ * (static_cast<double>(i - 1) + (takes_off - *(next - 1)) / (*next - *(next - 1)));
  }
  double at_end() const { return EA_ * ((knots_[1] - knots_[0]) / link_ - 1.0); }

 private:
  double relax(std::size_t i, double takes_off) {
    const double low = knots_[i - 1], here = knots_[i], high = knots_[i + 1];
    const double from = std::max(behind_, 0.5 * (low + here)), to = std::min(takes_off, 0.5 * (here + high));
    const double limit = std::exp(friction_ * std::max(0.0, to - from) / drum_);
    const double below = here - low - link_, above = high - here - link_;
    double ratio = 0;  // above to below
    if (above > below * limit)
      ratio = limit;
    else if (below > above * limit)
      ratio = 1.0 / limit;
    else
      return 0;
    knots_[i] = (high - link_ + ratio * (low + link_)) / (1.0 + ratio);
    return std::abs(knots_[i] - here);
  }

  double drum_, behind_, friction_, EA_, link_;
  std::vector<double> knots_;  ///< positions along the string, in the frame of the link, mm
};

Mechanism rubbing(Mechanism mechanism, double friction, double modulus) {
  mechanism.joint.drum_mu = friction;
  mechanism.tendon.modulus = modulus;
  mechanism.tendon.pretension = 12.0;
  return mechanism;
}

/// Difference between model and string. With infinite groove friction and without pin friction, span and wound part of
/// a tendon follow from the span's tension. The string must contain all other material at every angle.
struct Difference {
  double slides = 0;    ///< largest excess or deficit of material on the drum relative to the span's tension, mm
  double material = 0;  ///< difference in the tendon's material, mm
  double at_end = 0;    ///< difference in the tension at the end, as a fraction of the span's
};

Difference difference_to_links(Mechanism mechanism, double force, int links_per_rad) {
  Difference difference;
  mechanism.guides.mu = 0;
  mechanism.pulley.mu = 1e6;
  const JointModel model = joint_model(mechanism);
  const transmission::Transmission law(mechanism);
  std::vector<JointStep> steps;
  constexpr int winding = 200, loading = 60;
  for (int i = 0; i <= winding; ++i) steps.push_back({law.alpha_max() * i / winding, 0.2 * force, 0.0});
  for (const auto& [from, to] : {std::pair{0.2, 1.0}, std::pair{1.0, -0.1}, std::pair{-0.1, 0.6}}) {
    for (int i = 1; i <= loading; ++i)
      steps.push_back({law.alpha_max(), force * std::lerp(from, to, double(i) / loading), 0.0});
  }
  const std::vector<EquilibriumPoint> points = follow(model, steps);
  const transmission::PinPlace& place = model.pins[1];
  const double EA = model.EA, home = mechanism.tendon.pretension * transmission::upper_span(model.pins[0], 0).m /
                                     transmission::upper_span(place, 0).m;
  const transmission::UpperSpan at_home = transmission::upper_span(place, 0.0);
  StringInLinks string(place.drum, at_home.behind_drum, mechanism.joint.drum_mu, EA, place.drum / links_per_rad, home);
  const LowerPath lower_home = model.lower(0.0)[1];
  double wound = 0;
  LowerPath before = lower_home;
  double tension = home;
  const auto material_off_drum = [&](const transmission::UpperSpan& span, const LowerPath& lower, double now) {
    const double on_drum = span.on_drum > 0 ? place.drum * span.on_drum + span.behind_drum : 0.0;
    return (span.free - on_drum + place.rho * (span.normal - lower.normal) + lower.reach) / (1.0 + now / EA);
  };
  string.to(at_home.on_drum, home);
  const double all = material_off_drum(at_home, lower_home, home) + string.material(at_home.on_drum);
  for (const EquilibriumPoint& point : points) {
    EXPECT_EQ(point.status, EquilibriumStatus::held);
    const transmission::UpperSpan span = transmission::upper_span(place, point.theta);
    const LowerPath lower = model.lower(point.alpha)[1];
    wound += 0.5 * (lower.wound - before.wound) * (1.0 / (1.0 + tension / EA) + 1.0 / (1.0 + point.t2.upper / EA));
    before = lower;
    tension = point.t2.upper;
    string.to(span.on_drum, tension);
    const double on_drum = string.material(span.on_drum);
    const double length = span.on_drum > 0 ? place.drum * span.on_drum + span.behind_drum : 0.0;
    const double as_span = length / (1.0 + tension / EA);
    difference.slides = std::max(difference.slides, std::abs(on_drum - as_span));
    difference.material =
        std::max(difference.material, std::abs(material_off_drum(span, lower, tension) + on_drum + wound - all));
    if (span.on_drum > 0)
      difference.at_end = std::max(difference.at_end, std::abs(point.t2.end - string.at_end()) / tension);
  }
  return difference;
}

// The error comes from the links alone: it halves when their length is halved.
TEST(DrumFriction, AgreesWithStringOfLinks) {
  Mechanism ankle = rubbing(testing::ankle(), 0.25, 3000.0);
  ankle.joint.attachment2 = Attachment{20.0, 45.0};  // outside the drum: tendon 2 leaves it within the range
  const auto expect_near = [](const Mechanism& mechanism, double force) {
    const Difference coarse = difference_to_links(mechanism, force, 15),
                     fine = difference_to_links(mechanism, force, 30);
    EXPECT_GT(fine.slides, 0.02);
    EXPECT_LT(fine.material, 0.04 * fine.slides);
    EXPECT_NEAR(fine.material / coarse.material, 0.5, 0.05);
    EXPECT_LT(fine.at_end, 0.01);
  };
  expect_near(rubbing(testing::finger(), 0.25, 3000.0), 30.0);
  expect_near(ankle, 20.0);
}

TEST(DrumFriction, BoundsEndTensionOnly) {
  const Mechanism mechanism = rubbing(testing::finger(), 0.3, 3000.0);
  const JointModel model = joint_model(mechanism);
  JointMotion motion(model);
  double reached = 0;
  const auto move = [&](const JointStep& step) {
    const EquilibriumPoint point = motion.to(step);
    const double rho = mechanism.drum_pitch_radius();
    EXPECT_NEAR((point.t2.upper - point.t1.upper) * rho, point.load_torque, 1e-8);
    for (const auto& [tendon, side] :
         {std::pair{point.t1, transmission::Side::left}, std::pair{point.t2, transmission::Side::right}}) {
      const double wrap = transmission::upper_span(model.pins[side == transmission::Side::right],
                                                   transmission::mirror_sign(side) * point.theta)
                              .on_drum;
      const double most = std::exp(0.3 * wrap) * (1 + 1e-9);
      EXPECT_LE(tendon.end, tendon.upper * most);
      EXPECT_LE(tendon.upper, tendon.end * most);
      reached = std::max(reached, std::abs(std::log(tendon.end / tendon.upper)) / std::log(most));
    }
    return point;
  };
  for (int i = 0; i <= 100; ++i) move({0.0, 0.3 * i, 0.0});
  for (int i = 0; i <= 300; ++i) move({1.2 * std::sin(0.04 * i), 30.0, 0.0});
  EXPECT_GT(reached, 0.999);  // sliding reaches the end at some angles
}

TEST(DrumFriction, ConvergesToFrictionless) {
  for (const Mechanism& joint : {testing::finger(), testing::ankle()}) {
    std::vector<JointStep> steps;
    for (int i = 0; i <= 4000; ++i) steps.push_back({0.5 * std::sin(0.003 * i), 10.0 * std::sin(0.002 * i), 0.0});
    const auto none = follow(joint_model(rubbing(joint, 0.0, 3000.0)), steps);
    const auto hardly = follow(joint_model(rubbing(joint, 1e-7, 3000.0)), steps);
    const auto some = follow(joint_model(rubbing(joint, 0.2, 3000.0)), steps);
    double difference = 0;
    for (std::size_t i = 0; i < none.size(); ++i) {
      // Material that is wound in one step can slide in the next.
      EXPECT_NEAR(none[i].theta, hardly[i].theta, 1e-6);
      EXPECT_NEAR(none[i].t2.lower, hardly[i].t2.lower, 1e-3);
      difference = std::max(difference, std::abs(none[i].theta - some[i].theta));
    }
    EXPECT_GT(degrees(difference), 1e-3);
  }
}

// The model moves from the unloaded to the loaded joint. The change of θ must agree with [d3] of the paper's formulas.
TEST(DrumFriction, AgreesWithPaperForces) {
  double reduction = 0;  // of the error by friction on the drum
  for (const double friction : {0.0, 0.3}) {
    Mechanism mechanism = rubbing(testing::finger(), friction, 1e6);
    mechanism.tendon.pretension = 0;
    mechanism.guides.mu = 0;
    mechanism.pulley.mu = 1e6;
    JointMotion motion(joint_model(mechanism));
    const double unloaded = motion.to({0.4, 0.0, 0.0}).theta;
    EquilibriumPoint loaded;
    for (int i = 1; i <= 50; ++i) loaded = motion.to({0.4, 0.4 * i, 0.0});
    mechanism.load.tip_force = 20.0;
    const transmission::TransmissionPoint at = transmission::Transmission(mechanism).at_alpha(0.4);
    const transmission::PaperForces forces = transmission::paper_forces(mechanism, at);
    // The free length ends at the contact on the pulley, not at the foot of the axis' perpendicular. On a round pulley
    // they coincide.
    EXPECT_NEAR(unloaded - loaded.theta, forces.theta_error, 2e-3 * forces.theta_error) << friction;
    const double wrap =
        transmission::upper_span(
            transmission::pin_place(mechanism, transmission::Side::right, mechanism.guide_pitch_radius()), at.theta)
            .on_drum;
    EXPECT_NEAR(loaded.t2.end, forces.T2 * std::exp(-friction * wrap), 1e-3 * forces.T2);
    reduction = friction == 0 ? forces.theta_error : reduction - forces.theta_error;
    if (friction > 0) {
      EXPECT_GT(reduction, 0.01 * forces.theta_error);
    }
  }
}

TEST(DrumFriction, ConservesEnergy) {
  for (const Mechanism& joint : {testing::finger(), testing::ankle()}) {
    const Mechanism mechanism = rubbing(joint, 0.25, 3000.0);
    const transmission::Transmission law(mechanism);
    const auto missing = [&](int steps, double* lost) {
      std::vector<JointStep> path;
      const auto run = [&](double from, double to) {
        for (int i = 0; i <= steps; ++i) {
          const double share = double(i) / steps;
          path.push_back({std::lerp(from, to, share), 6.0 + 4.0 * std::sin(9.0 * share), 0.0});
        }
      };
      run(0.0, law.alpha_max());
      run(law.alpha_max(), law.alpha_min());
      run(law.alpha_min(), law.alpha_max());
      const auto points = follow(joint_model(mechanism), path);
      double motor = 0, load = 0;
      for (std::size_t i = 1; i < points.size(); ++i) {
        const EquilibriumPoint &a = points[i - 1], &b = points[i];
        motor += 0.5 * (a.motor_torque + b.motor_torque) * (b.alpha - a.alpha);
        load += 0.5 * (a.load_torque + b.load_torque) * (b.theta - a.theta);
      }
      // The balance begins at the first point, because the load is applied there in one step.
      const EquilibriumPoint &first = points.front(), &end = points.back();
      *lost = end.friction - first.friction;
      return motor - load - (end.stored - first.stored) - *lost - (end.groove_friction - first.groove_friction);
    };
    double lost = 0;
    const double coarse = missing(300, &lost), fine = missing(3000, &lost);
    EXPECT_GT(lost, 1.0);
    EXPECT_LT(std::abs(fine), 1e-6 * lost) << coarse << " " << lost;
  }
}

}  // namespace
}  // namespace fusee::joint
