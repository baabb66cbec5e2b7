#include "calibration/whole_loop.h"

#include <algorithm>
#include <cmath>

#include "calibration/words.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "fusee/profile.h"
#include "fusee/transmission.h"

namespace fusee::rig {
namespace {

constexpr double k_slow = radians(12.0);
constexpr double k_fast = radians(90.0);

/// Loads about a constant mean.
std::vector<RunPlan> about(double load) {
  return {{load, k_slow, 3, 0.0}, {1.5 * load, k_slow, 2, 0.0}, {load, k_fast, 3, 0.0}, {0.5 * load, k_slow, 2, 0.0}};
}

std::vector<RunPlan> about_zero(double load) {
  return {{0.0, k_slow, 3, 0.0}, {load, k_slow, 2, 0.0}, {0.0, k_fast, 3, 0.0}, {-load, k_slow, 2, 0.0}};
}

Log one_run(const MadeJoint& joint, const HiddenFaults& hidden, double load) {
  SensorPlan silent;
  silent.noise = 0;
  return log_runs(joint, hidden, {{load, k_slow, 2, 0.0}}, silent).front();
}

/// rms over the rows from the first reversal on: before it the play depends on how the run began.
template <typename Error>
double rms(const Log& log, Error error) {
  double squares = 0, count = 0;
  for (std::size_t i = log.size() / 4 + 1; i < log.size(); ++i) {
    const double off = error(log[i], log[i].alpha > log[i - 1].alpha);
    squares += off * off;
    count += 1;
  }
  return std::sqrt(squares / count);
}

double miss(const Log& log, const transmission::Transmission& law) {
  return rms(log, [&](const Row& row, bool) { return row.theta - law.theta(row.alpha); });
}

/// θ that the table gives for an α on the way up or down.
double tabled(const std::vector<correction::CompensationRow>& table, double alpha, bool up) {
  const auto of = [up](const correction::CompensationRow& row) { return up ? row.alpha_up : row.alpha_down; };
  const auto above =
      std::lower_bound(table.begin() + 1, table.end() - 1, alpha,
                       [&](const correction::CompensationRow& row, double value) { return of(row) < value; });
  const correction::CompensationRow& low = *(above - 1);
  return low.theta + (above->theta - low.theta) * (alpha - of(low)) / (of(*above) - of(low));
}

std::string found_words(const calibration::Calibration& calibration) {
  std::string text;
  for (const calibration::FoundEffect& effect : calibration.effects) {
    text += (text.empty() ? "" : ", ") + effect.name;
    for (const std::string& rival : effect.group) text += rival == effect.name ? "" : " [" + rival + "]";
  }
  return text.empty() ? "nothing" : text;
}

/// The print: it shrinks as the declared material, not as the drawing assumes.
profile::Outline printed(profile::Outline outline, const DeclaredMechanism& declared, const Mechanism& drawn) {
  const double scale = (1.0 - declared.material.shrinkage) / (1.0 - drawn.material.shrinkage);
  for (profile::OutlinePoint& point : outline.points) point.position *= scale;
  return outline;
}

MadeJoint with_corrected_spirals(const MadeJoint& declared, const joint::IdentifiedJoint& made_for) {
  const Mechanism& drawn = made_for.mechanism;
  MadeJoint joint = declared;
  DeclaredMechanism as_drawn = declared.declared;
  static_cast<Mechanism&>(as_drawn) = drawn;
  joint.spirals = make_joint(as_drawn).spirals;
  const double scale = (1.0 - declared.declared.material.shrinkage) / (1.0 - drawn.material.shrinkage);
  for (MadeSpiral& spiral : joint.spirals) {
    for (helix::SpiralRow& row : spiral.rows) {
      const Vec2 made =
          scale *
          joint::drawn_for_making({row.turn, {row.x, row.y}, unit(row.turn), row.rho}, made_for.outline).position;
      row.x = made.x();
      row.y = made.y();
    }
  }
  return joint;
}

}  // namespace

std::vector<LoopCase> loop_cases(const DeclaredMechanism& declared, double load) {
  const double R = declared.joint.R;
  std::vector<LoopCase> cases;
  const auto add = [&](const std::string& name, auto set) {
    LoopCase one{name, {}, full_protocol(load), 0};
    set(one);
    cases.push_back(one);
  };
  add("radius_offset", [&](LoopCase& c) { c.hidden.radius_offset = 0.003 * R; });
  add("pulley_scale", [](LoopCase& c) { c.hidden.pulley_scale = -0.02; });
  add("pulley_runout", [&](LoopCase& c) { c.hidden.runout_x = 0.004 * R, c.hidden.runout_y = -0.003 * R; });
  add("profile_error", [&](LoopCase& c) { c.hidden.profile_error = 0.006 * R; });
  add("guide_radius", [&](LoopCase& c) { c.hidden.guide_radius = 0.03 * R; });
  add("guide_position", [&](LoopCase& c) {
    c.hidden.guide_outward = 0.012 * R, c.hidden.guide_down = -0.005 * R;
    c.hidden.pin_outward = {-0.004 * R, 0}, c.hidden.pin_down = {0, 0.004 * R};
  });
  add("joint_length", [&](LoopCase& c) { c.hidden.joint_length = -0.05 * R; });
  add("tendon_stretch", [&](LoopCase& c) {
    c.hidden.modulus = declared.tendon.modulus / 3.0;
    c.plans = about(load);
    c.load = load;
  });
  add("gravity", [&](LoopCase& c) {
    c.hidden.gravity = 3 * load * R;
    c.hidden.gravity_direction = 0.5;
    c.plans = about_zero(load);
  });
  if (declared.joint.drum_radius > 0) {
    const double drum = declared.joint.drum_radius;
    add("drum_radius", [&](LoopCase& c) { c.hidden.drum_radius = -0.02 * drum; });
    add("drum_runout", [&](LoopCase& c) { c.hidden.drum_runout = 0.02 * drum, c.hidden.drum_runout_phase = 2.0; });
  }
  if (declared.sheath.is_there()) {
    add("sheath_friction", [](LoopCase& c) { c.hidden.sheath_friction = 0.15; });
    add("sheath_stiffness", [&](LoopCase& c) {
      c.hidden.sheath_compliance = 0.03;
      c.plans = about(load);
      c.load = load;
    });
  }
  const auto add_end = [&](const std::string& name, std::size_t tendon, const std::optional<Attachment>& own) {
    if (!own) return;
    const double away = std::hypot(own->across, own->along);
    add(name, [&](LoopCase& c) { c.hidden.end_moved[tendon] = away * Vec2(tendon == 0 ? -0.02 : 0.02, 0.01); });
  };
  add_end("attachment1_place", 0, declared.joint.attachment1);
  add_end("attachment2_place", 1, declared.joint.attachment2);
  return cases;
}

MadeJoint with_corrected_pulley(const MadeJoint& declared, const DeclaredMechanism& corrected) {
  const joint::IdentifiedJoint made_for = joint::identified_joint(corrected);
  const Mechanism& drawn = made_for.mechanism;
  if (declared.is_helical()) return with_corrected_spirals(declared, made_for);
  profile::SynthesisOptions options;
  options.chord_error_mm = 2e-5;
  options.advice = false;
  profile::SynthesisResult made = profile::synthesise(drawn, options);
  if (!made.made()) throw InputError("corrected.toml", made.brief());
  joint::draw_for_making(made, made_for.outline);
  MadeJoint joint = declared;
  joint.p1 = printed(made.p1, declared.declared, drawn);
  joint.p2 = printed(made.p2, declared.declared, drawn);
  return joint;
}

measurement::Measurement measured(const MadeJoint& joint, const LoopCase& hidden, const std::filesystem::path& folder) {
  OutputFolder target(folder, true);
  std::vector<std::filesystem::path> runs;
  int number = 0;
  for (const Log& log : log_runs(joint, hidden.hidden, hidden.plans)) {
    const std::string name = "run_" + std::to_string(++number) + ".csv";
    target.stage({name, csv_text(log)});
    runs.push_back(folder / name);
  }
  std::vector<Diagnostic> notes;
  target.publish(notes);
  return measurement::read_measurement(runs);
}

double joint_error(const MadeJoint& joint, const LoopCase& hidden, double assembly_angle) {
  HiddenFaults mounted = hidden.hidden;
  mounted.motor_offset -= assembly_angle;
  return miss(one_run(joint, mounted, hidden.load), transmission::Transmission(joint.declared));
}

LoopOutcome turn_loop(const MadeJoint& joint, const std::string& spec, const LoopCase& hidden,
                      const std::filesystem::path& folder) {
  const measurement::Measurement measurement = measured(joint, hidden, folder);
  const calibration::Calibration calibration = calibration::calibrate(joint.declared, measurement);
  const correction::Correction correction = correction::correct(joint.declared, measurement, calibration);
  LoopOutcome outcome;
  outcome.name = hidden.name;
  outcome.found = found_words(calibration);
  outcome.verdict = calibration::word(calibration.verdict);
  outcome.corrected_toml = correction::corrected_toml(spec, joint.declared, calibration, correction);
  const MadeJoint then = with_corrected_pulley(joint, parse_mechanism(outcome.corrected_toml, "corrected.toml"));
  outcome.before = joint_error(joint, hidden, 0);
  outcome.declared = joint_error(joint, {}, 0);
  outcome.after = joint_error(then, hidden, correction.assembly_angle);
  outcome.after_assembled_at_zero = joint_error(then, hidden, 0);
  outcome.after_table = rms(one_run(then, hidden.hidden, hidden.load), [&](const Row& row, bool up) {
    return row.theta - tabled(correction.table, row.alpha, up);
  });
  outcome.predicted = correction.error_with_pulley;
  return outcome;
}

}  // namespace fusee::rig
