#include "pipeline/shaft_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/mechanism_file.h"
#include "mechanism/catalogue.h"
#include "pipeline/design.h"
#include "pipeline/omissions.h"
#include "solid/plan.h"
#include "solid/set_screw.h"

namespace fusee::pipeline {
namespace {

bool is_listed(const std::vector<std::string>& all, const std::string& name) {
  return std::find(all.begin(), all.end(), name) != all.end();
}

/// True if the model has a shaft of this motor with the diameter of the bore.
bool has_shaft_in_bore(const MotorModel& model, const MotorType& motor, const solid::BoreLayout& bore) {
  return std::any_of(model.fits.begin(), model.fits.end(), [&](const std::string& name) {
    const ShaftType* shaft = find_shaft(name);
    return shaft != nullptr && is_listed(motor.fits, name) && std::abs(shaft->diameter - bore.shaft) < 0.01;
  });
}

/// The motor whose shaft the file names, by body.shaft or by its model; null for another one or an unknown length.
const MotorType* motor_in_bore(const Mechanism& mechanism, const solid::BodyLayout& layout) {
  if (mechanism.motor.gear_ratio != 1 || mechanism.body.bore == Bore::horn) return nullptr;
  const MotorModel* model = find_motor_model(mechanism.motor.model);
  for (const MotorType& motor : motor_types()) {
    if (!(motor.shaft_length > 0)) continue;
    if (is_listed(motor.fits, mechanism.body.shaft)) return &motor;
    if (model != nullptr && has_shaft_in_bore(*model, motor, layout.bore)) return &motor;
  }
  return nullptr;
}

/// Step of a hub's height, mm: half a millimetre, or 0.02 in.
double step_of(LengthUnit units) { return units == LengthUnit::inch ? 0.508 : 0.5; }

/// The length, mm, that the file states with the digits of its unit.
double in_file_digits(double length, LengthUnit units) {
  constexpr double k_inch = 25.4;  // mm
  return units == LengthUnit::inch ? k_inch * number_of(rounded(length / k_inch)) : number_of(rounded(length));
}

}  // namespace

std::optional<ShaftReach> shaft_reach(const Mechanism& mechanism, const solid::BodyLayout& layout, double below) {
  const solid::SetScrewLayout& screw = layout.set_screw;
  const MotorType* motor = screw.present ? motor_in_bore(mechanism, layout) : nullptr;
  if (motor == nullptr) return std::nullopt;
  const solid::Screw* size = solid::find_screw(screw.thread);
  const double diameter = size != nullptr ? size->nominal : screw.hole_diameter;
  const double axis = below + screw.z;
  return ShaftReach{motor->name, screw.thread, below, axis, axis + 0.5 * diameter, motor->shaft_length};
}

std::optional<DeclaredMechanism> with_lower_hub(const DeclaredMechanism& declared, double below) {
  const Curves curves = curves_of(declared);
  if (!curves.obstacles.empty()) return std::nullopt;
  enum class Outcome { reached, missed, no_screw };
  DeclaredMechanism lower = declared;
  const auto try_height = [&](double height) {
    Mechanism changed = curves.joint.mechanism;
    changed.body.hub_height = lower.body.hub_height = in_file_digits(height, declared.units);
    const solid::BodyPlan plan = solid::plan_body(changed, curves.synthesis);
    if (!plan.is_possible()) return Outcome::no_screw;
    const std::optional<ShaftReach> reach = shaft_reach(changed, plan.layout, below);
    if (!reach) return Outcome::no_screw;
    return reach->suffices() ? Outcome::reached : Outcome::missed;
  };
  // Fine steps lead to the lowest hub that has a screw.
  const double step = step_of(declared.units), fine_step = 0.2 * step;
  for (double height = step * (std::ceil(declared.body.hub_height / step - 1e-9) - 1); height > 0; height -= step) {
    const Outcome outcome = try_height(height);
    if (outcome == Outcome::reached) return lower;
    if (outcome == Outcome::missed) continue;
    for (int i = 4; i > 0 && height + i * fine_step < declared.body.hub_height; --i) {
      const Outcome fine = try_height(height + i * fine_step);
      if (fine == Outcome::reached) return lower;
      if (fine == Outcome::no_screw) return std::nullopt;
    }
    return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Diagnostic> shaft_reach_warning(
    const formats::Product& product, double below,
    const std::function<std::optional<formats::Product>(const Mechanism&)>& build) {
  const std::optional<ShaftReach> reach = shaft_reach(product.joint.mechanism, product.pulley.layout, below);
  if (!reach || reach->suffices()) return std::nullopt;
  const bool is_named = product.file.places.contains("body.shaft");
  Diagnostic warning{Severity::warning, product.file.place_of(is_named ? "body.shaft" : "motor.model"), {}, {}};
  const std::string where = below > 0 ? fmt::format("{} mm above the motor's face ({} mm of it below the pulley)",
                                                    rounded(reach->axis, 3), rounded(below, 3))
                                      : fmt::format("{} mm above the pulley's lower face", rounded(reach->axis, 3));
  warning.message = fmt::format(
      "the shaft does not reach the set screw: {} at {} requires {} mm of shaft, and the shaft of {} is "
      "{} mm long",
      reach->screw, where, rounded(reach->needed, 3), reach->motor, rounded(reach->length, 3));
  if (const auto lower = with_lower_hub(product.file.mechanism, below)) {
    if (const auto made = build(*lower)) {
      const std::optional<ShaftReach> new_reach = shaft_reach(made->joint.mechanism, made->pulley.layout, below);
      if (new_reach && new_reach->suffices()) {
        const Field& field = *find_field("body.hub_height_mm");
        const std::string lost = lost_features(made->pulley.layout, product.pulley.layout);
        warning.hint =
            fmt::format("try body.hub_height_mm = {} (now {}){}", rounded(number_of(*lower, field)),
                        rounded(number_of(product.file.mechanism, field)), lost.empty() ? "" : ", which omits " + lost);
        return warning;
      }
    }
  }
  warning.hint =
      "take a motor with a longer shaft, extend its shaft by a coupling, or take a servo with a horn (body.bore = "
      "\"horn\"); or set body.set_screw = \"none\" and glue the pulley to the shaft";
  return warning;
}

}  // namespace fusee::pipeline
