// The motor's limits compared with the joint's requirements, which are known in closed form.
#include <gmock/gmock.h>

#include "base/text.h"
#include "fusee/analysis.h"
#include "mechanism/catalogue.h"
#include "support/mechanisms.h"

namespace fusee::analysis {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using testing::forearm;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::linear_wrist;
using ::testing::Not;
using ::testing::SizeIs;

/// θ = α/3.2 over ±25°: the motor turns 160°, and 3.2 times as fast as the joint.
DeclaredMechanism with_motor(double travel_deg, double stall_torque, double speed_deg_per_s) {
  DeclaredMechanism mechanism = linear_wrist();
  mechanism.load.tip_force = 10;
  mechanism.motor.travel = radians(travel_deg);
  mechanism.motor.stall_torque = stall_torque;
  mechanism.motor.speed = radians(speed_deg_per_s);
  return mechanism;
}

std::vector<std::string> failed_names(const MotorCheck& motor) {
  std::vector<std::string> names;
  for (const profile::Condition& condition : profile::failed_of(motor.conditions)) names.push_back(condition.name);
  return names;
}

TEST(Motor, IsNotCheckedWithoutTable) {
  EXPECT_FALSE(under_load(linear_wrist()).motor);
  EXPECT_THAT(motor_obstacles(linear_wrist()), IsEmpty());
}

TEST(Motor, RequiresTravelOfLaw) {
  EXPECT_NEAR(degrees(under_load(with_motor(200, 0, 0)).motor->travel), 160, 1e-9);
  EXPECT_TRUE(under_load(with_motor(160, 0, 0)).motor->ok());
  const MotorCheck short_of = *under_load(with_motor(159.9, 0, 0)).motor;
  EXPECT_THAT(failed_names(short_of), ElementsAre("motor_travel"));
  EXPECT_THAT(short_of.conditions.front().message, HasSubstr("turns 159.9 deg, and the range requires 160 deg"));
  EXPECT_THAT(motor_obstacles(with_motor(159.9, 1, 0)), SizeIs(1)) << "torque is not computed if travel fails";
}

TEST(Motor, RequiresTorqueOfAnalysis) {
  const UnderLoad load = under_load(with_motor(0, 1e6, 0));
  EXPECT_EQ(load.motor->torque.value, load.largest_torque.value);
  // F R dθ/dα at home, and more by friction.
  EXPECT_GT(load.motor->torque.value, 10.0 * 100.0 / 3.2);
  EXPECT_LT(load.motor->torque.value, 1.3 * 10.0 * 100.0 / 3.2);
  const double needed = load.motor->torque.value;
  EXPECT_TRUE(under_load(with_motor(0, 1.001 * needed, 0)).motor->ok());
  EXPECT_THAT(failed_names(*under_load(with_motor(0, 0.999 * needed, 0)).motor), ElementsAre("motor_torque"));
  EXPECT_THAT(motor_obstacles(with_motor(0, 0.999 * needed, 0)), SizeIs(1));
}

TEST(Motor, SpeedFallsInStraightLineToStall) {
  DeclaredMechanism mechanism = with_motor(0, 0, 320);
  const MotorCheck free = *under_load(mechanism).motor;
  EXPECT_NEAR(free.ratio, 3.2, 1e-9);
  EXPECT_NEAR(degrees(free.joint_speed_free), 100, 1e-6);
  EXPECT_NEAR(degrees(free.joint_speed), 100, 1e-6) << "an unknown stall torque slows nothing";
  mechanism.motor.stall_torque = 4 * free.torque.value;
  mechanism.motor.joint_speed = radians(75.1);
  const MotorCheck loaded = *under_load(mechanism).motor;
  EXPECT_NEAR(degrees(loaded.joint_speed), 75, 1e-6);
  EXPECT_THAT(failed_names(loaded), ElementsAre("motor_speed"));
  mechanism.motor.joint_speed = radians(74.9);
  EXPECT_TRUE(under_load(mechanism).motor->ok());
}

TEST(Motor, WrittenNumberReplacesThatOfModel) {
  DeclaredMechanism mechanism = linear_wrist();
  mechanism.motor.model = "MG996R";
  const MotorModel& model = *find_motor_model("MG996R");
  EXPECT_EQ(under_load(mechanism).motor->travel_limit, model.travel);
  EXPECT_EQ(under_load(mechanism).motor->torque_limit, model.stall_torque);
  mechanism.motor.travel = radians(120);
  EXPECT_EQ(under_load(mechanism).motor->travel_limit, radians(120));
  EXPECT_EQ(under_load(mechanism).motor->torque_limit, model.stall_torque);
}

TEST(Motor, SufficientModelsHaveTravelAndTwiceTheTorque) {
  const MotorCheck motor = *under_load(with_motor(100, 0, 0)).motor;
  ASSERT_THAT(motor.sufficient_models, Not(IsEmpty()));
  for (const MotorModel& model : motor_models()) {
    const bool turns = model.travel == 0 || model.travel >= motor.travel;
    const bool bears = model.stall_torque >= (model.holds ? 1 : 2) * motor.torque.value;
    EXPECT_EQ(::testing::Value(motor.sufficient_models, Contains(model.name)), turns && bears) << model.name;
  }
}

TEST(Motor, ModelThatFitsBoreComesFirst) {
  DeclaredMechanism mechanism = with_motor(100, 0, 0);
  mechanism.body.bore = Bore::horn;
  mechanism.body.horn = "dynamixel-xm430";
  EXPECT_THAT(under_load(mechanism).motor->sufficient_models.front(), HasSubstr("XM430"));
  mechanism.body.bore = Bore::round;
  EXPECT_THAT(under_load(mechanism).motor->sufficient_models.front(), Not(HasSubstr("XM430")));
}

TEST(Motor, ListsMarginsAndWhetherModelsFit) {
  DeclaredMechanism mechanism = with_motor(100, 0, 0);
  MotorCheck motor = *under_load(mechanism).motor;
  const double stall = find_motor_model(motor.sufficient_models.front())->stall_torque;
  EXPECT_THAT(motor.models_text(), ::testing::StartsWith("suitable: " + motor.sufficient_models.front() + " (margin " +
                                                         rounded(stall / motor.torque.value, 3) + "), "));
  EXPECT_EQ(motor.strongest_text(), "");
  // No N20 holds twice this torque.
  mechanism.body.shaft = "n20-d3";
  motor = *under_load(mechanism).motor;
  EXPECT_EQ(motor.fitting_models, 0u);
  EXPECT_THAT(motor.models_text(), ::testing::StartsWith("suitable with another bore: "));
  const double strongest = find_motor_model("N20-298-LP")->stall_torque;
  EXPECT_EQ(motor.strongest_text(), "N20-298-LP, the strongest that fits the bore, has margin " +
                                        rounded(strongest / motor.torque.value, 3) + ", and 2 is advised");
}

TEST(Motor, DividesListByDiameterOfBore) {
  DeclaredMechanism mechanism = with_motor(100, 0, 0);
  mechanism.body.bore_diameter = 4;  // no motor of the catalogue has this shaft
  MotorCheck motor = *under_load(mechanism).motor;
  EXPECT_EQ(motor.fitting_models, 0u);
  EXPECT_THAT(motor.models_text(), ::testing::StartsWith("suitable with another bore: "));
  mechanism.body.bore_diameter = 5;
  mechanism.joint.R *= 0.1;  // NEMA 17 steppers hold a tenth of the torque
  motor = *under_load(mechanism).motor;
  ASSERT_GT(motor.fitting_models, 0u);
  EXPECT_THAT(motor.models_text(), ::testing::StartsWith("suitable: NEMA17-40mm (margin "));
  EXPECT_THAT(motor.models_text(), HasSubstr("; with another bore: "));
}

TEST(Motor, NoServoStandsBehindGearbox) {
  DeclaredMechanism mechanism = with_motor(100, 0, 0);
  mechanism.motor = {};
  mechanism.motor.model = "NEMA17-48mm";
  mechanism.motor.gear_ratio = 50;
  const MotorCheck motor = *under_load(mechanism).motor;
  EXPECT_THAT(motor.sufficient_models, Not(Contains(HasSubstr("XL430"))));
  EXPECT_THAT(motor.sufficient_models, Not(Contains(HasSubstr("STS3215"))));
  ASSERT_GE(motor.sufficient_models.size(), 3u);
  EXPECT_EQ(motor.sufficient_models[0], "NEMA17-48mm 50:1");
  EXPECT_EQ(motor.sufficient_models[1], "NEMA17-40mm 50:1");
  EXPECT_EQ(motor.fitting_models, 2u);
  EXPECT_THAT(motor.models_text(), HasSubstr("; with another gearbox: N20-"));
}

TEST(Motor, GearboxAppliesToEverySuitableModel) {
  DeclaredMechanism mechanism = with_motor(100, 0, 0);
  mechanism.motor = {};
  mechanism.motor.model = "NEMA17-48mm";
  const double torque = under_load(mechanism).motor->torque.value,
               stall = find_motor_model("NEMA17-48mm")->stall_torque;
  // With a gearbox of twice the missing ratio the motor holds the load.
  mechanism.motor.gear_ratio = std::ceil(2 * torque / stall) + 1;
  const MotorCheck motor = *under_load(mechanism).motor;
  const std::string name = "NEMA17-48mm " + rounded(mechanism.motor.gear_ratio) + ":1";
  ASSERT_THAT(motor.sufficient_models, Contains(name));
  EXPECT_EQ(motor.sufficient_models.front(), name);
  const double margin = stall * mechanism.motor.gear_ratio * mechanism.motor.gear_efficiency / torque;
  EXPECT_THAT(motor.models_text(), ::testing::StartsWith("suitable: " + name + " (margin " + rounded(margin, 3) + ")"));
}

TEST(Motor, GearboxMultipliesTorqueAndDividesSpeed) {
  DeclaredMechanism mechanism = linear_wrist();
  mechanism.motor.model = "MG996R";
  const MotorModel& model = *find_motor_model("MG996R");
  mechanism.motor.gear_ratio = 5;
  MotorCheck motor = *under_load(mechanism).motor;
  EXPECT_EQ(motor.model, "MG996R 5:1");
  EXPECT_DOUBLE_EQ(motor.torque_limit, 5 * 0.9 * model.stall_torque);  // 0.9: efficiency of a gearbox by default
  EXPECT_DOUBLE_EQ(motor.travel_limit, model.travel / 5);
  EXPECT_DOUBLE_EQ(motor.speed_limit, model.speed / 5);
  mechanism.motor.gear_efficiency = 1;
  EXPECT_DOUBLE_EQ(under_load(mechanism).motor->torque_limit, 5 * model.stall_torque);
}

TEST(Motor, ModelMustFitBore) {
  MechanismFile file;
  file.path = "mcp.toml";
  file.mechanism = linear_wrist();
  Body& body = file.mechanism.body;
  const auto misfit = [&file](const char* model) {
    file.mechanism.motor = {};
    file.mechanism.motor.model = model;
    return under_load(file.mechanism).motor->misfit;
  };
  body.shaft = "n20-d3";
  EXPECT_EQ(
      misfit("XC330-M288"),
      "the motor XC330-M288 does not fit the bore: it has the horn dynamixel-xl330, and the bore is for the shaft "
      "n20-d3");
  const std::vector<Diagnostic> warnings = motor_warnings(*under_load(file.mechanism).motor, file);
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings.back().severity, Severity::warning);
  EXPECT_EQ(warnings.back().hint,
            "try body.bore = \"horn\" together with body.horn = \"dynamixel-xl330\", without body.shaft");
  EXPECT_EQ(misfit("N20-298-LP"), "");
  EXPECT_EQ(misfit("RMD-X6-8"), "") << "its flange is not known";
  body.shaft = "none";
  body.bore_diameter = 5;
  EXPECT_EQ(misfit("NEMA17-48mm"), "");
  EXPECT_THAT(misfit("N20-298-LP"), HasSubstr("it has the shaft n20-d3, and the bore is for a shaft of 5 mm"));
  file.mechanism.motor.gear_ratio = 5;
  EXPECT_EQ(under_load(file.mechanism).motor->misfit, "") << "a gearbox has its own shaft";
  body.bore = Bore::horn;
  body.horn = "dynamixel-xl430";
  EXPECT_THAT(misfit("XC330-M288"), HasSubstr("the bore is for the horn dynamixel-xl430"));
  body.horn = "own";
  EXPECT_EQ(misfit("XC330-M288"), "") << "a horn of one's own may be that of any motor";
}

TEST(Motor, WarningStandsAtLimitOrModel) {
  MechanismFile file;
  file.path = "arm.toml";
  file.mechanism = with_motor(100, 0, 0);
  file.places["motor.travel_deg"] = {"arm.toml", 7, 14};
  MotorCheck motor = *under_load(file.mechanism).motor;
  motor.advice.alone.push_back({"pulley.ratio", 3.2, 2.0, "", "ratio ≤ 2"});
  const std::vector<Diagnostic> warnings = motor_warnings(motor, file);
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_EQ(warnings[0].place.line, 7);
  EXPECT_EQ(warnings[0].severity, Severity::warning);
  EXPECT_THAT(warnings[0].hint, HasSubstr("try pulley.ratio = 2 or less (now 3.2); suitable: "));
  motor.enforced = true;
  EXPECT_EQ(motor_warnings(motor, file)[0].severity, Severity::error);
}

TEST(UnderLoad, SafetyFactorIsThatOfWeakestPlace) {
  DeclaredMechanism mechanism = forearm();
  mechanism.load.tip_force = 10;
  mechanism.tendon.strength = 400;
  mechanism.tendon.knot_efficiency = 1;
  const UnderLoad free = under_load(mechanism);
  EXPECT_DOUBLE_EQ(*free.safety_factor(), 400 / free.largest_tension.tension);
  mechanism.tendon.knot_efficiency = 0.25;
  const UnderLoad knotted = under_load(mechanism);
  EXPECT_DOUBLE_EQ(*knotted.safety_factor(), 100 / knotted.largest_at_joint.value);
  mechanism.tendon.strength = 0;
  mechanism.tendon.diameter = 0.3;  // not in the catalogue
  EXPECT_FALSE(under_load(mechanism).safety_factor());
}

TEST(UnderLoad, ErrorIsLargestOfBothDirections) {
  DeclaredMechanism mechanism = forearm();
  mechanism.load.tip_force = -10;
  const UnderLoad load = under_load(mechanism);
  double most = 0;
  for (const AnalysisRow& row : load.rows)
    for (const joint::EquilibriumPoint& point : {row.rising, row.falling})
      most = std::max(most, std::abs(point.theta - row.declared.theta));
  EXPECT_EQ(load.theta_error.value, most);
  EXPECT_GT(degrees(most), 0.05);
}

// A tendon without tension in one direction alone is slack, too.
TEST(UnderLoad, SlackCountsInEitherDirection) {
  for (const double force : {-6.0, -3.0, 2.0, 3.0, 4.0, 6.0}) {
    DeclaredMechanism mechanism = forearm();
    mechanism.load.tip_force = force;
    const UnderLoad load = under_load(mechanism);
    bool any = false;
    for (const AnalysisRow& row : load.rows)
      for (const joint::EquilibriumPoint& point : {row.rising, row.falling})
        any = any || point.t1.upper <= 1e-6 || point.t2.upper <= 1e-6;
    EXPECT_EQ(any, !load.slack1.empty() || !load.slack2.empty()) << force;
  }
}

}  // namespace
}  // namespace fusee::analysis
