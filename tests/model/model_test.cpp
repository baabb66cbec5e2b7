// Models for simulators and firmware, compared with independent results: polynomials with known best fits, P1's radius
// as the rate at which its tendon is wound, and a taut string by a convex hull. Damaged files must be rejected.
#include <gmock/gmock.h>

#include <cmath>

#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"

namespace {

using namespace fusee;
using ::testing::DoubleNear;
using ::testing::ElementsAre;

MechanismFile profile(const std::string& name, const std::vector<Setting>& settings = {}) {
  return read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / (name + ".toml"), settings);
}

pipeline::ModelResult dry(const MechanismFile& file, pipeline::ModelOptions options = {}) {
  options.folder = std::filesystem::temp_directory_path() / "fusee-model-test";
  options.dry_run = true;
  return pipeline::model(file, options);
}

std::vector<model::FitPoint> sampled(double low, double high, double (*f)(double)) {
  std::vector<model::FitPoint> points;
  for (int i = 0; i <= 2000; ++i) {
    const double x = std::lerp(low, high, i / 2000.0);
    points.push_back({x, f(x)});
  }
  return points;
}

// ---- polynomials ----------------------------------------------------------------------------------------------------

TEST(LeastLargestError, MatchesChebyshev) {
  // x^n − T_n/2^(n−1) is the best polynomial of degree n − 1, with the error 2^(1−n).
  EXPECT_NEAR(model::least_largest_error(sampled(-1, 1, [](double x) { return x * x * x; }), 2).error, 0.25, 1e-6);
  EXPECT_NEAR(model::least_largest_error(sampled(-1, 1, [](double x) { return std::pow(x, 5); }), 4).error, 0.0625,
              1e-6);
  // The best parabola for |x| is x² + 1/8, with the error 1/8.
  const model::PolynomialFit corner =
      model::least_largest_error(sampled(-1, 1, [](double x) { return std::abs(x); }), 2);
  EXPECT_NEAR(corner.error, 0.125, 1e-6);
  EXPECT_THAT(corner.p.c, ElementsAre(DoubleNear(0.125, 1e-6), DoubleNear(0, 1e-6), DoubleNear(1, 1e-5)));
}

TEST(LeastLargestError, ReproducesPolynomialOnAnyRange) {
  const model::PolynomialFit fit =
      model::least_largest_error(sampled(30, 31, [](double x) { return 2 - x + 0.5 * x * x; }), 4);
  EXPECT_LT(fit.error, 1e-9);
  for (const double x : {30.0, 30.3, 31.0}) EXPECT_NEAR(fit.p(x), 2 - x + 0.5 * x * x, 1e-9);
}

TEST(LeastLargestError, ErrorsAlternate) {
  const std::vector<model::FitPoint> points = sampled(-0.3, 2, [](double x) { return std::exp(x); });
  const model::PolynomialFit fit = model::least_largest_error(points, 4);
  int alternations = 0;
  double last = 0;
  for (const model::FitPoint& point : points) {
    const double error = point.y - fit.p(point.x);
    EXPECT_LE(std::abs(error), fit.error * (1 + 1e-6));
    if (std::abs(error) > 0.999 * fit.error && error * last <= 0) {
      ++alternations;
      last = error;
    }
  }
  EXPECT_EQ(alternations, 6);  // degree + 2
}

/// θ of an equality, solved by bisection and independently of the model.
double theta_of(const model::EqualityFit& fit, double alpha) {
  if (fit.of_alpha) return fit.p(alpha);
  double low = -2, high = 2;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (fit.p(middle) < alpha ? low : high) = middle;
  }
  return low;
}

class ModelOfProfile : public ::testing::TestWithParam<std::string> {};

TEST_P(ModelOfProfile, EqualityErrorsAreTrue) {
  const MechanismFile file = profile(GetParam());
  const model::AngleMap map = model::joint_curves(file.mechanism)->physical.middle;
  for (const model::EqualityFit& fit : {model::fit_equality(map), model::fit_line(map)}) {
    double largest = 0;
    for (int i = 0; i <= 777; ++i) {
      const double alpha = std::lerp(map.alpha_min, map.alpha_max, i / 777.0);
      largest = std::max(largest, std::abs(theta_of(fit, alpha) - map.theta(alpha)));
    }
    EXPECT_LE(largest, 1.001 * fit.error + 1e-12);
    EXPECT_GE(largest, 0.99 * fit.error - 1e-12);
  }
}

/// Length of a taut string from C over a pin to the anchor: the outer side of the convex hull of C, the anchor and a
/// polygon about the pin.
double taut_length(const model::WrappedTendon& tendon, const Vec2& C) {
  constexpr int sides = 400;  // of the polygon
  const Vec2 outward = (tendon.outer - tendon.pin).normalized();
  // The polygon's corners lie on rays from the pin between the directions of C and of the anchor, over the outer side.
  // Its sides touch the circle.
  const double from = std::atan2((C - tendon.pin).y(), (C - tendon.pin).x()),
               to = std::atan2((tendon.anchor - tendon.pin).y(), (tendon.anchor - tendon.pin).x());
  const double outer = std::atan2(outward.y(), outward.x());
  const auto turned = [&](double angle) { return std::remainder(angle - outer, k_two_pi); };
  std::vector<Vec2> hull{C, tendon.anchor};
  for (int i = 0; i <= sides; ++i) {
    const double angle = outer + std::lerp(turned(from), turned(to), double(i) / sides);
    hull.push_back(tendon.pin + tendon.rho / std::cos(0.5 * (turned(to) - turned(from)) / sides) *
                                    Vec2(std::cos(angle), std::sin(angle)));
  }
  std::sort(hull.begin(), hull.end(), [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
  // The outer side of the convex hull between its lowest and its highest point.
  const double side = outward.x() > 0 ? 1 : -1;
  std::vector<Vec2> chain;
  for (const Vec2& point : hull) {
    while (chain.size() >= 2) {
      const Vec2 a = chain.back() - chain[chain.size() - 2], b = point - chain.back();
      if (side * (a.x() * b.y() - a.y() * b.x()) > 0) break;
      chain.pop_back();
    }
    chain.push_back(point);
  }
  double length = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) length += (chain[i] - chain[i - 1]).norm();
  return length;
}

class TautString : public ::testing::TestWithParam<std::string> {};

TEST_P(TautString, LengthsMatchTautString) {
  const pipeline::ModelResult made = dry(profile(GetParam()));
  ASSERT_TRUE(made.product.tendons);
  const model::TendonModel& tendons = *made.product.tendons;
  const model::WrappedTendon& constrained = tendons.tendons[tendons.constrained == transmission::Side::left ? 0 : 1];
  const model::AngleMap& map = made.product.curves.physical.middle;
  for (int i = 0; i <= 6; ++i) {
    const double alpha = std::lerp(map.alpha_min, map.alpha_max, i / 6.0), theta = map.theta(alpha);
    const Vec2 end(std::cos(theta) * constrained.end.x() + std::sin(theta) * constrained.end.y(),
                   std::cos(theta) * constrained.end.y() - std::sin(theta) * constrained.end.x());
    const double length = taut_length(constrained, end) +
                          (constrained.sheath_exit ? (*constrained.sheath_exit - constrained.anchor).norm() : 0);
    // A moment arm is no longer than the lever.
    EXPECT_NEAR(length, constrained.home_length + tendons.length(alpha),
                constrained.end.norm() * (tendons.error + 1e-6))
        << "theta " << degrees(theta);
  }
}

TEST_P(ModelOfProfile, RoundP1HasItsRadius) {
  const MechanismFile file = profile(GetParam());
  const model::TendonModel tendons = *dry(file).product.tendons;
  if (file.mechanism.pulley.law == Law::compensate) {
    // α(θ) = (L1(θ) − L1(0))/r1.
    EXPECT_EQ(tendons.constrained, transmission::Side::left);
    EXPECT_THAT(tendons.length.c, ElementsAre(DoubleNear(0, 1e-9), DoubleNear(file.mechanism.pulley.r1, 1e-9)));
    EXPECT_LT(tendons.error, 1e-12);
  } else {
    EXPECT_EQ(tendons.length.c.size(), 5u);
    EXPECT_LT(tendons.error, radians(0.1));
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, ModelOfProfile,
                         ::testing::Values("paper_optimum", "forearm", "finger", "gripper", "linear_wrist",
                                           "unsymmetric", "wrist_exo"),
                         [](const auto& tested) { return tested.param; });

INSTANTIATE_TEST_SUITE_P(Profiles, TautString,
                         ::testing::Values("paper_optimum", "forearm", "finger", "gripper", "linear_wrist",
                                           "unsymmetric", "wrist_exo", "ankle_exo", "wrist_sheath"),
                         [](const auto& tested) { return tested.param; });

/// The path by sites and one cylinder. The length wound on a drum is its radius times the joint's angle.
TEST(Tendons, DrumTendonsFollowWoundLength) {
  for (const char* name : {"finger_mcp", "elbow_capstan"}) {
    const pipeline::ModelResult made = dry(profile(name));
    ASSERT_TRUE(made.product.tendons) << name;
    const model::TendonModel& tendons = *made.product.tendons;
    const double rho = made.product.mechanism.drum_pitch_radius();
    for (const model::WrappedTendon& tendon : tendons.tendons) {
      EXPECT_EQ(tendon.drum, rho);
      // Every place on the link lies on the drum, and the tendon leaves it for a place further out.
      for (const Vec2& at : tendon.on_drum) EXPECT_NEAR(at.norm(), rho, 1e-5 * rho);
      EXPECT_GT(tendon.off_drum.norm(), 1.001 * rho);
      EXPECT_GT(tendon.drum_outer.norm(), rho);
    }
    const model::AngleMap& map = made.product.curves.physical.middle;
    const double sign = tendons.constrained == transmission::Side::left ? 1 : -1;
    EXPECT_NEAR(tendons.length.slope(0), sign * rho * map.slope(0), 1e-6 * rho);
    EXPECT_LT(tendons.error, 1e-8);
  }
}

TEST(Tendons, OmitsTendonLeavingDrumWithReason) {
  const pipeline::ModelResult pip = dry(profile("finger_pip"));
  ASSERT_TRUE(pip.product.tendons);
  EXPECT_EQ(pip.product.tendons->constrained, transmission::Side::right);
  EXPECT_THAT(pip.product.tendons->omission[0], ::testing::HasSubstr("leaves the drum within the range"));
  EXPECT_THAT(pip.product.notes, ::testing::Contains(::testing::HasSubstr("omits tendon 1")));
  const pipeline::ModelResult elbow = dry(profile("elbow_idlers"));
  EXPECT_FALSE(elbow.product.tendons);
  EXPECT_THAT(elbow.product.without_tendons, ::testing::HasSubstr("leaves the drum within the range"));
}

/// Over the whole range the joint follows the tendon's length, also with C below the pins.
TEST(Tendons, FollowWideRanges) {
  const MechanismFile file = profile("finger", {{"joint.range_deg", "[-20, 75]"},
                                                {"guides.radius_mm", "3"},
                                                {"guides.OE_mm", "0"},
                                                {"guides.EB_mm", "25"},
                                                {"guides.ED_mm", "30"}});
  const transmission::Transmission law(file.mechanism);
  ASSERT_FALSE(law.dead_centre());
  const model::AngleMap map = model::angle_map(law);
  std::string why_not;
  const auto model = model::tendon_model(file.mechanism, map, why_not);
  ASSERT_TRUE(model) << why_not;
  const model::WrappedTendon& constrained = model->tendons[0];
  EXPECT_EQ(model->constrained, transmission::Side::left);
  EXPECT_LT(model::tendon_error(constrained, model->length, map), 1e-9);
}

// ---- curves ---------------------------------------------------------------------------------------------------------

TEST(JointCurve, DeclaredJointFollowsItsLaw) {
  const MechanismFile file = profile("forearm");
  const transmission::Transmission law(file.mechanism);
  const model::JointCurves curves = *model::joint_curves(file.mechanism);
  EXPECT_FALSE(curves.sensed.ways);
  for (const double alpha : {-1.9, 0.0, 0.7, 2.0}) {
    EXPECT_EQ(curves.sensed.middle.theta(alpha), law.theta(alpha));
    EXPECT_EQ(curves.physical.middle.slope(alpha), law.at_alpha(alpha).g);
  }
  EXPECT_NEAR(curves.sensed.middle.theta(99), file.mechanism.joint.theta_max, 1e-12);
}

TEST(JointCurve, HysteresisEqualsPlay) {
  const MechanismFile file =
      profile("forearm", {{"identified.backlash_deg", "1.5"}, {"guides.friction", "0"}, {"pulley.friction", "0"}});
  const model::JointCurve curve = model::joint_curves(file.mechanism)->sensed;
  ASSERT_TRUE(curve.ways);
  for (const double theta : {-0.4, -0.1, 0.2, 0.45})
    EXPECT_NEAR(degrees((*curve.ways)[0].alpha(theta) - (*curve.ways)[1].alpha(theta)), 1.5, 0.01);
}

TEST(JointCurve, SensorGainAffectsFirmwareOnly) {
  const MechanismFile file =
      profile("forearm", {{"identified.gain_percent", "2"}, {"guides.friction", "0"}, {"pulley.friction", "0"}});
  const model::JointCurves curves = *model::joint_curves(file.mechanism);
  for (const double alpha : {-1.5, 0.3, 1.0})
    EXPECT_NEAR(curves.sensed.middle.theta(alpha), 1.02 * curves.physical.middle.theta(alpha), radians(0.002));
}

/// A lag of the joint sensor acts on a moving joint only.
TEST(JointCurve, HasNoLag) {
  const MechanismFile still = profile("forearm", {{"identified.gain_percent", "2"}}),
                      late = profile("forearm", {{"identified.gain_percent", "2"}, {"identified.lag_s", "0.15"}});
  const auto curves = model::joint_curves(late.mechanism);
  ASSERT_TRUE(curves);
  for (const double alpha : {-1.5, 0.3, 1.0})
    EXPECT_EQ(curves->sensed.middle.theta(alpha), model::joint_curves(still.mechanism)->sensed.middle.theta(alpha));
}

TEST(Compensation, KeepsShapeOfLawBetweenRows) {
  const MechanismFile file = profile("forearm");
  const transmission::Transmission law(file.mechanism);
  std::vector<model::TwoWayRow> rows;
  for (int i = -5; i <= 5; ++i) rows.push_back({0.1 * i, law.alpha(0.1 * i) + 0.01, law.alpha(0.1 * i) - 0.01});
  const model::JointCurve curve = model::two_way_curve(model::refined(rows, law), model::CurveSource::compensation);
  for (const double theta : {-0.45, 0.03, 0.22}) {
    EXPECT_NEAR((*curve.ways)[0].alpha(theta), law.alpha(theta) + 0.01, 1e-6);
    EXPECT_NEAR((*curve.ways)[1].alpha(theta), law.alpha(theta) - 0.01, 1e-6);
  }
}

TEST(Compensation, ReadsOrRejectsAnyBytes) {
  const std::string sound = "theta_deg,alpha_up_deg,alpha_down_deg\n-5,-20,-21\n# a comment\n0,1,-1\n5,22.5,19\n";
  ASSERT_EQ(model::read_compensation(sound, "c.csv").size(), 3u);
  std::uint32_t state = 1;
  const auto next = [&state](std::uint32_t below) {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % below;
  };
  for (int i = 0; i < 3000; ++i) {
    std::string text = sound;
    for (std::uint32_t k = next(4); k < 4; ++k) {
      const std::size_t at = next(static_cast<std::uint32_t>(text.size()));
      if (next(3) == 0) {
        text.erase(at, next(12));
      } else {
        text.insert(at, 1, ",-.e9\n\r#n\0 "[next(12)]);
      }
      if (text.empty()) text = "\n";
    }
    try {
      const std::vector<model::TwoWayRow> rows = model::read_compensation(text, "c.csv");
      ASSERT_GE(rows.size(), 2u);
      for (std::size_t k = 1; k < rows.size(); ++k)
        ASSERT_TRUE(rows[k].theta > rows[k - 1].theta && rows[k].up > rows[k - 1].up &&
                    rows[k].down > rows[k - 1].down);
    } catch (const InputError& error) {
      ASSERT_FALSE(error.diagnostics().empty());
    }
  }
}

// ---- tables ---------------------------------------------------------------------------------------------------------

TEST(Table, StraightLineIsExact) {
  const pipeline::ModelResult made = dry(profile("linear_wrist"));
  EXPECT_EQ(made.product.table.pieces, 16);
  EXPECT_LT(degrees(made.product.table.errors.returned), 1e-5);
}

TEST(Table, ErrorQuartersWithTwiceThePieces) {
  const MechanismFile file = profile("paper_optimum");
  const model::JointCurve curve = model::joint_curves(file.mechanism)->sensed;
  const model::JointTable coarse = *model::joint_table(curve, file.mechanism, {}, radians(0.05)),
                          fine = *model::joint_table(curve, file.mechanism, {}, radians(0.002));
  ASSERT_EQ(coarse.pieces, 16);
  ASSERT_EQ(fine.pieces, 64);
  EXPECT_NEAR(coarse.errors.theta / fine.errors.theta, 16, 3);  // four times the pieces
}

TEST(Table, RejectsErrorLimitBelowFloatResolution) {
  pipeline::ModelOptions options;
  options.most_table_error = radians(1e-6);
  const pipeline::ModelResult made = dry(profile("forearm"), options);
  EXPECT_EQ(made.ending, pipeline::ModelEnding::table_off);
  EXPECT_TRUE(made.outputs.empty());
  ASSERT_EQ(made.changes.size(), 1u);
}

// ---- files ----------------------------------------------------------------------------------------------------------

double value_of(const std::vector<Check>& checks, const std::string& name, bool ok) {
  for (const Check& check : checks) {
    if (check.name != name) continue;
    EXPECT_EQ(check.ok, ok) << name << " = " << check.value;
    return check.value;
  }
  ADD_FAILURE() << "no check " << name;
  return 0;
}

/// A change of a written file, and the check that must detect it.
struct Damage {
  std::string file;
  std::string from, to;  ///< a text that the file has for profiles/forearm.toml, and its replacement
  std::string check;
};

TEST(Files, DetectsDamagedFiles) {
  const pipeline::ModelResult made = dry(profile("forearm"));
  ASSERT_EQ(made.ending, pipeline::ModelEnding::done);
  for (const Damage& broken :
       std::vector<Damage>{{"joint.xml", "polycoef=\"0.0003", "polycoef=\"0.0303", "joint_xml_theta_error"},
                           {"joint.xml", "joint2=\"theta\"", "joint2=\"alpha\"", "joint_xml_theta_error"},
                           {"joint_tendons.xml", "<geom name=\"pin_B\" type=\"cylinder\" pos=\"-0.05 ",
                            "<geom name=\"pin_B\" type=\"cylinder\" pos=\"-0.052 ", "joint_tendons_xml_theta_error"},
                           {"joint_tendons.xml", "coef=\"0.016\"", "coef=\"0.017\"", "joint_tendons_xml_theta_error"},
                           {"joint.urdf", "multiplier=\"0.2", "multiplier=\"0.3", "joint_urdf_theta_error"},
                           {"joint_ros2_control.urdf", "<offset>", "<offset>1", "joint_ros2_control_urdf_theta_error"},
                           {"joint_table.json", "-29.457499", "-29.557499", "joint_table_json_theta_error"},
                           {"joint_table.json", "-29.457499", "-30.5", "joint_table_json_not_growing"},
                           {"joint_table.h", "-29.457499f", "-29.4574f", "joint_table_h_differing_entries"}}) {
    std::vector<OutputFile> outputs = made.outputs;
    for (OutputFile& output : outputs) {
      if (output.name != broken.file) continue;
      const std::size_t at = output.bytes.find(broken.from);
      ASSERT_NE(at, std::string::npos) << broken.from;
      output.bytes.replace(at, broken.from.size(), broken.to);
    }
    value_of(made.product.checks, broken.check, true);
    value_of(formats::check_model(made.product, outputs), broken.check, false);
  }
}

TEST(Files, StateTheirAssumptions) {
  const pipeline::ModelResult made = dry(profile("finger", {{"load.mass_kg", "0"}}));
  for (const OutputFile& output : made.outputs) {
    const bool simulated =
        output.name.find(".xml") != std::string::npos || output.name.find(".urdf") != std::string::npos;
    EXPECT_EQ(output.bytes.find("Assumed: ") != std::string::npos, simulated) << output.name;
  }
}

}  // namespace
