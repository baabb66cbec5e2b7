#include "mechanism/effect.h"

namespace fusee {
namespace {

EffectParameter coefficient(std::string_view name, double& (*number)(Imperfections&), PriorUnit unit,
                            std::string_view meaning) {
  EffectParameter parameter;
  parameter.number = number;
  parameter.least = -1e6;
  parameter.most = 1e6;
  parameter.step = 1e-3;
  parameter.prior = 0.05;  // a linkage over 60°: three degrees
  parameter.prior_unit = unit;
  parameter.shown = shown::as_is;
  parameter.name = name;
  parameter.key = key::plain(name, "", -1e6, 1e6, meaning);
  return parameter;
}

}  // namespace

/// Taylor series to the third power in the angle. Its linear term is an error of the declared ratio, without which the
/// others would be fitted about a wrong slope.
Effect ratio_curve(JointKind) {
  Effect effect;
  effect.name = "ratio_curve";
  effect.place = ChainPlace::joint;
  effect.rank = 9;
  effect.signature = "a smooth curve of the angle, independent of direction, with a part proportional to the load";
  effect.separating_run = "re-clock each sensor by a quarter of a turn: the curve of the transmission stays";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.ratio = true};
  // An eccentric sensor makes the same curve, so this effect stands for an unmodelled cause and is never reported.
  effect.is_tested = false;
  effect.parameters = {
      coefficient(
          "ratio_error", [](Imperfections& at) -> double& { return at.ratio_joint.curve.linear; }, PriorUnit::own,
          "joint declared by a ratio: relative error of the rotation by the ratio"),
      coefficient(
          "ratio_square_per_rad", [](Imperfections& at) -> double& { return at.ratio_joint.curve.square; },
          PriorUnit::own, "joint declared by a ratio: coefficient of the squared angle"),
      coefficient(
          "ratio_cube_per_rad2", [](Imperfections& at) -> double& { return at.ratio_joint.curve.cube; }, PriorUnit::own,
          "joint declared by a ratio: coefficient of the cubed angle"),
      coefficient(
          "ratio_give_slope_per_load",
          [](Imperfections& at) -> double& { return at.ratio_joint.curve.compliance_slope; },
          PriorUnit::at_largest_load, "joint declared by a ratio: compliance per angle"),
      coefficient(
          "ratio_give_square_per_load",
          [](Imperfections& at) -> double& { return at.ratio_joint.curve.compliance_square; },
          PriorUnit::at_largest_load, "joint declared by a ratio: compliance per squared angle")};
  effect.starts = {{0, 0, 0, 0, 0}};
  return effect;
}

}  // namespace fusee
