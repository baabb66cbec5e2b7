#include "analysis/motor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "mechanism/catalogue.h"

namespace fusee::analysis {
namespace {

/// Relative tolerance: rounding may put a range above a limit that equals it.
constexpr double k_rounding = 1e-9;

/// Required torque, and ratio, at one place and in one direction of the stroke.
struct Demand {
  double alpha = 0;
  double torque = 0;  ///< magnitude, N·mm
  double ratio = 0;   ///< |dα/dθ|
};

std::vector<Demand> demands(const UnderLoad& load) {
  std::vector<Demand> all;
  for (const AnalysisRow& row : load.rows) {
    const double ratio = 1.0 / std::abs(row.declared.g);
    for (const joint::EquilibriumPoint* point : {&row.rising, &row.falling})
      if (point->status != joint::EquilibriumStatus::no_equilibrium)
        all.push_back({row.declared.alpha, std::abs(point->motor_torque), ratio});
  }
  return all;
}

/// Lowest speed of the joint over the stroke, rad/s, with its place. `loaded`: under the load, else without it. The
/// motor's speed falls linearly with torque down to stall; a motor that `holds` runs at full speed under any torque up
/// to its limit. The magnitude of the torque counts: a load that drives the motor does not speed it up.
Extreme lowest_joint_speed(const MotorModel& motor, const std::vector<Demand>& all, bool loaded) {
  Extreme lowest{std::numeric_limits<double>::infinity(), 0};
  for (const Demand& demand : all) {
    double speed_share = 1;  // of the motor's speed without load
    if (loaded && motor.stall_torque > 0) {
      const double torque_share = demand.torque / motor.stall_torque;
      if (!motor.holds)
        speed_share = std::max(0.0, 1 - torque_share);
      else if (!(torque_share <= 1))
        speed_share = 0;
    }
    const double speed = speed_share * motor.speed / demand.ratio;
    if (speed < lowest.value) lowest = {speed, demand.alpha};
  }
  return lowest;
}

/// True if the model has the required travel, torque and speed.
bool suffices(const MotorModel& model, const MotorCheck& need, const std::vector<Demand>& all) {
  if (model.travel > 0 && model.travel < need.travel * (1 - k_rounding)) return false;
  if (model.stall_torque < model.advised_margin() * need.torque.value) return false;
  return need.joint_speed_needed == 0 ||
         (model.speed > 0 && lowest_joint_speed(model, all, true).value >= need.joint_speed_needed * (1 - k_rounding));
}

/// True if a bore that names no shaft has the diameter of one of the model's shafts.
bool has_diameter_of_shaft(const Body& body, const MotorModel& model) {
  constexpr double k_usual_bore = 5.0, k_same = 0.01;  // mm; k_usual_bore: if the file states no diameter
  if (find_shaft(body.shaft) != nullptr || body.bore == Bore::horn) return false;
  const double bore = body.bore_diameter > 0 ? body.bore_diameter : k_usual_bore;
  return std::any_of(model.fits.begin(), model.fits.end(), [bore](const std::string& name) {
    const ShaftType* shaft = find_shaft(name);
    return shaft != nullptr && std::abs(shaft->diameter - bore) < k_same;
  });
}

/// True if both models have a shaft or horn in common.
bool have_same_fitting(const MotorModel& one, const MotorModel& other) {
  return std::any_of(one.fits.begin(), one.fits.end(), [&other](const std::string& name) {
    return std::find(other.fits.begin(), other.fits.end(), name) != other.fits.end();
  });
}

bool has_shaft(const MotorModel& model) {
  return std::any_of(model.fits.begin(), model.fits.end(),
                     [](const std::string& name) { return find_shaft(name) != nullptr; });
}

/// True if the file states the motor's shaft or horn. A horn of one's own may be that of any motor, and so may a bore
/// without a diameter.
bool states_fitting(const Body& body) {
  if (find_shaft(body.shaft) != nullptr) return true;
  return body.bore == Bore::horn ? body.horn != k_own_horn : body.bore_diameter > 0;
}

/// Sets the models of the catalogue that suffice behind the file's gearbox, and the strongest that fits the bore.
/// Models that fit the bore come first; within both groups, the weaker ones. Behind a gearbox, whose own shaft is in the
/// bore, the model of the file comes first, then those with the same shaft. Of the others it takes those with a shaft.
void add_models(MotorCheck& need, const Mechanism& mechanism, const std::vector<Demand>& all) {
  enum class Fit { named, fitting, other };
  struct Found {
    MotorModel model;
    Fit fit = Fit::other;
  };
  const MotorModel* named = find_motor_model(mechanism.motor.model);
  need.has_gearbox = mechanism.motor.gear_ratio != 1;
  need.is_fit_known = need.has_gearbox ? named != nullptr : states_fitting(mechanism.body);
  const auto fit_of = [&](const MotorModel& model) {
    if (!need.has_gearbox) {
      const bool fits = fits_bore(model, mechanism.body) || has_diameter_of_shaft(mechanism.body, model);
      return fits && need.is_fit_known ? Fit::fitting : Fit::other;
    }
    if (&model == named) return Fit::named;
    return named != nullptr && have_same_fitting(model, *named) ? Fit::fitting : Fit::other;
  };
  std::vector<Found> found;
  for (const MotorModel& model : motor_models()) {
    const Fit fit = fit_of(model);
    if (need.has_gearbox && fit == Fit::other && !has_shaft(model)) continue;
    const MotorModel geared = behind_gearbox(model, mechanism.motor);
    if (suffices(geared, need, all)) found.push_back({geared, fit});
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& one, const Found& other) {
    return one.fit != other.fit ? one.fit < other.fit : one.model.stall_torque < other.model.stall_torque;
  });
  for (const Found& one : found) {
    need.sufficient_models.push_back(one.model.name);
    need.sufficient_torques.push_back(one.model.stall_torque);
    need.fitting_models += one.fit != Fit::other ? 1 : 0;
  }
  if (need.has_gearbox) return;
  if (const MotorModel* strongest = strongest_motor_that_fits(mechanism.body)) need.strongest_model = strongest->name;
}

/// "the bore is for the shaft n20-d3".
std::string bore_words(const Body& body) {
  if (find_shaft(body.shaft) != nullptr) return "the bore is for the shaft " + body.shaft;
  if (body.bore == Bore::horn) return "the bore is for the horn " + body.horn;
  return "the bore is for a shaft of " + (body.bore_diameter > 0 ? rounded(body.bore_diameter) : "5") + " mm";
}

/// A model whose shaft and horns are known, and none of which fits the bore. A gearbox has a shaft of its own.
void add_misfit(MotorCheck& check, const Mechanism& mechanism) {
  const MotorModel* model = find_motor_model(mechanism.motor.model);
  const Body& body = mechanism.body;
  if (model == nullptr || model->fits.empty() || mechanism.motor.gear_ratio != 1) return;
  if (fits_bore(*model, body) || has_diameter_of_shaft(body, *model)) return;
  if (body.bore == Bore::horn && body.horn == k_own_horn) return;
  std::string names;
  for (const std::string& name : model->fits) names += (names.empty() ? "" : " or ") + name;
  const std::string& first = model->fits.front();
  const bool has_shaft = find_shaft(first) != nullptr;
  check.misfit = "the motor " + model->name + " does not fit the bore: it has the " + (has_shaft ? "shaft " : "horn ") +
                 names + ", and " + bore_words(body);
  check.misfit_hint = has_shaft ? "try body.shaft = \"" + first + "\""
                                : "try body.bore = \"horn\" together with body.horn = \"" + first + "\"" +
                                      (find_shaft(body.shaft) != nullptr ? ", without body.shaft" : "");
}

std::string motor_words(const MotorCheck& motor) {
  return motor.model.empty() ? "the motor" : "the motor " + motor.model;
}

profile::Condition travel_condition(const MotorCheck& motor) {
  const double needed = degrees(motor.travel), limit = degrees(motor.travel_limit);
  return {"motor_travel",
          motor.travel <= motor.travel_limit * (1 + k_rounding),
          0,
          needed,
          limit,
          "deg",
          motor_words(motor) + " turns " + rounded(limit, 4) + " deg, and the range requires " + rounded(needed, 4) +
              " deg"};
}

profile::Condition torque_condition(const MotorCheck& motor) {
  return {"motor_torque",
          motor.torque.value <= motor.torque_limit,
          motor.torque.alpha,
          motor.torque.value,
          motor.torque_limit,
          "Nmm",
          motor_words(motor) + (motor.holds ? " holds " : " stalls at ") + rounded(motor.torque_limit, 4) +
              " Nmm, and the load requires " + rounded(motor.torque.value, 4) +
              " Nmm at alpha = " + fixed(degrees(motor.torque.alpha), 1) + " deg"};
}

profile::Condition speed_condition(const MotorCheck& motor, double alpha) {
  const double speed = degrees(motor.joint_speed), needed = degrees(motor.joint_speed_needed);
  return {"motor_speed",
          speed >= needed * (1 - k_rounding),
          alpha,
          speed,
          needed,
          "deg/s",
          motor_words(motor) + " turns the joint under its load at " + rounded(speed, 4) + " deg/s at alpha = " +
              fixed(degrees(alpha), 1) + " deg, and " + rounded(needed, 4) + " deg/s are required"};
}

/// The key of a condition's limit.
std::string_view key_of(const std::string& condition) {
  if (condition == "motor_travel") return "motor.travel_deg";
  if (condition == "motor_torque") return "motor.stall_torque_Nmm";
  return "motor.joint_speed_deg_per_s";
}

std::string hint_of(const MotorCheck& motor) {
  std::string advice;
  for (const profile::Change& change : motor.advice.alone)
    advice += (advice.empty() ? "try " : ", or ") + profile::setting_words(change);
  for (const profile::Change& change : motor.advice.together)
    advice += (advice.empty() ? "try " : " together with ") + profile::setting_words(change);
  return advice.empty() ? motor.models_text() : advice + "; " + motor.models_text();
}

}  // namespace

std::string MotorCheck::strongest_text() const {
  const MotorModel* strongest = find_motor_model(strongest_model);
  if (strongest == nullptr || !(strongest->stall_torque < strongest->advised_margin() * torque.value)) return "";
  return strongest->name + ", the strongest that fits the bore, has margin " +
         rounded(strongest->stall_torque / torque.value, 3) + ", and " + rounded(strongest->advised_margin()) +
         " is advised";
}

std::vector<std::string> MotorCheck::models_texts() const {
  constexpr std::size_t k_shown = 3;
  if (sufficient_models.empty()) return {"no motor of the catalogue suffices"};
  const std::size_t shown = std::min(sufficient_models.size(), k_shown);
  const std::size_t fitting = is_fit_known ? std::min(fitting_models, shown) : shown;
  const auto list = [this](std::size_t begin, std::size_t end) {
    std::string text;
    for (std::size_t i = begin; i < end; ++i) {
      text += (i == begin ? "" : ", ") + sufficient_models[i];
      if (torque.value > 0) text += " (margin " + rounded(sufficient_torques[i] / torque.value, 3) + ")";
    }
    return text;
  };
  std::vector<std::string> texts;
  if (fitting > 0) texts.push_back("suitable: " + list(0, fitting));
  if (fitting < shown)
    texts.push_back((fitting > 0 ? "with another " : "suitable with another ") +
                    std::string(has_gearbox ? "gearbox: " : "bore: ") + list(fitting, shown));
  if (shown < sufficient_models.size())
    texts.back() += " or " + std::to_string(sufficient_models.size() - shown) + " more";
  return texts;
}

std::string MotorCheck::models_text() const {
  std::string text;
  for (const std::string& part : models_texts()) text += (text.empty() ? "" : "; ") + part;
  return text;
}

MotorCheck travel_check(const Mechanism& mechanism, double travel) {
  const MotorModel limits = motor_limits(mechanism.motor);
  MotorCheck check;
  check.model = limits.name;
  check.enforced = mechanism.motor.enforce;
  check.holds = limits.holds;
  check.travel = travel;
  check.travel_limit = limits.travel;
  if (check.travel_limit > 0) check.conditions.push_back(travel_condition(check));
  return check;
}

MotorCheck motor_check(const Mechanism& mechanism, const UnderLoad& load) {
  const MotorModel limits = motor_limits(mechanism.motor);
  const std::vector<Demand> all = demands(load);
  MotorCheck check = travel_check(mechanism, load.rows.back().declared.alpha - load.rows.front().declared.alpha);
  check.torque = load.largest_torque;
  check.torque_limit = limits.stall_torque;
  for (const Demand& demand : all) check.ratio = std::max(check.ratio, demand.ratio);
  check.speed_limit = limits.speed;
  check.joint_speed_needed = mechanism.motor.joint_speed;
  if (check.torque_limit > 0) check.conditions.push_back(torque_condition(check));
  if (check.speed_limit > 0 && !all.empty()) {
    const Extreme slowest = lowest_joint_speed(limits, all, true);
    check.joint_speed = slowest.value;
    check.joint_speed_free = lowest_joint_speed(limits, all, false).value;
    if (check.joint_speed_needed > 0) check.conditions.push_back(speed_condition(check, slowest.alpha));
  }
  add_models(check, mechanism, all);
  add_misfit(check, mechanism);
  return check;
}

std::vector<Diagnostic> motor_warnings(const MotorCheck& motor, const MechanismFile& file) {
  std::vector<Diagnostic> warnings;
  const std::vector<profile::Condition> failed = profile::failed_of(motor.conditions);
  for (const profile::Condition& condition : failed) {
    const bool is_written = file.places.contains(key_of(condition.name));
    warnings.push_back({motor.enforced ? Severity::error : Severity::warning,
                        file.place_of(is_written ? key_of(condition.name) : "motor.model"), condition.message,
                        &condition == &failed.back() ? hint_of(motor) : ""});
  }
  if (!motor.misfit.empty())
    warnings.push_back({Severity::warning, file.place_of("motor.model"), motor.misfit, motor.misfit_hint});
  return warnings;
}

}  // namespace fusee::analysis
