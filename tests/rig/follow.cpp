#include <algorithm>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "mechanism/effect.h"
#include "rig/truths.h"

namespace fusee::rig {
namespace {

constexpr double k_quarter = 0.25 * k_two_pi;

/// The x at which the affine function `value` is `target`.
template <typename Value>
double solve_linear(double target, Value value) {
  return (target - value(0.0)) / (value(1.0) - value(0.0));
}

const Effect& effect_of(const EffectParameter& number) {
  for (const Effect& effect : effects(JointKind::tendons)) {
    const auto is = [&](const EffectParameter& own) { return &own == &number; };
    if (std::any_of(effect.parameters.begin(), effect.parameters.end(), is)) return effect;
  }
  throw InputError("rig", "no effect has the number " + number.name);
}

void make_run(const plan::PlannedRun& run, Case& made) {
  RunPlan plan;
  plan.load = run.load;
  plan.speed = run.speed;
  plan.cycles = run.cycles;
  plan.dwell = run.dwell;
  plan.motor_turned = run.change == plan::BenchChange::motor_sensor_turned ? k_quarter : 0.0;
  plan.joint_turned = run.change == plan::BenchChange::joint_sensor_turned ? k_quarter : 0.0;
  made.plans.push_back(plan);
  made.logs = log_runs(made.joint, made.hidden, made.plans, made.sensors, made.motion);
}

/// Writes a reading into [prior], in the form that calibrate reads.
void write_reading(const EffectParameter& number, double value, DeclaredMechanism& declared) {
  const Field* field = find_field(number.by_hand.key);
  if (field == nullptr) throw InputError("rig", "no key " + std::string(number.by_hand.key));
  std::vector<double>& prior = field->numbers(declared);
  if (&prior == &declared.prior.modulus) {  // modulus is proportional to 1 / (1 + stretch)
    prior = {declared.tendon.modulus / (1.0 + value), 0.0};
    prior[1] = prior[0] * number.by_hand.uncertainty / (1.0 + value);
    return;
  }
  const auto read = [&](double written) {
    prior = {written, 1.0};
    return number.by_hand.readings(declared).back().value;
  };
  const double per_unit = std::abs(read(1.0) - read(0.0));
  const double written = solve_linear(value, read);
  prior = {written, number.by_hand.uncertainty / per_unit};
}

}  // namespace

double read_by_hand(const EffectParameter& number, const Case& made) {
  const Joint& range = made.joint.declared.joint;
  if (number.by_hand.tool == HandTool::protractor) {
    const auto shown = [&](double theta) { return joint_sensor_reading(made.hidden, theta); };
    return (shown(range.theta_max) - shown(range.theta_min)) / (range.theta_max - range.theta_min) - 1.0;
  }
  const Effect& effect = effect_of(number);
  if (effect.name == "tendon_stretch")
    return made.hidden.modulus > 0 ? made.joint.declared.tendon.modulus / made.hidden.modulus - 1.0 : 0.0;
  const Fault& fault = find_fault(effect.name);
  for (const auto& [name, value] : fault.numbers(made.hidden, made.joint)) {
    if (name == number.name) return solve_linear(value, [&](double x) { return number.shown(x, made.joint.declared); });
  }
  throw InputError("rig", "the rig knows no " + number.name);
}

bool perform(const plan::NextMeasurement& next, Case& made) {
  if (next.run) {
    make_run(*next.run, made);
    return true;
  }
  for (std::size_t i = 0; i < next.readings.size(); ++i) {
    const EffectParameter& number = *next.readings[i];
    Random error(made.seed * 1000033 + 101 * i + made.plans.size() + number.by_hand.key.size());
    write_reading(number, read_by_hand(number, made) + number.by_hand.uncertainty * error.normal(),
                  made.joint.declared);
  }
  return !next.readings.empty();
}

}  // namespace fusee::rig
