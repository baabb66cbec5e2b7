#include "joint/forward.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fusee/joint.h"
#include "joint/lower_path_table.h"
#include "joint/rubbing_cable.h"
#include "joint/sensors.h"
#include "mechanism/effect.h"

namespace fusee::joint {
namespace {

/// Number of steps from home to the first row of a run. The motion before the log is unknown. A direct approach from
/// home is the simplest assumption.
constexpr int k_approach = 24;

/// Convergence limit for θ in fits: a hundredth of the finest sensor noise. rad
constexpr double k_last_step_of_fits = 1e-7;

/// Motions in the cache of a joint. Each takes 16 bytes a row.
constexpr std::size_t k_most_motions = 512;

/// Margin of the path tables beyond the logged α, for the errors of the motor's sensor and for play. rad
constexpr double k_beyond = 0.1;

/// Resets the order of a wave of zero amplitude, so that equivalent values compare equal.
template <typename Wave>
void reset_idle_order(Wave& wave) {
  if (wave.wave_sin == 0 && wave.wave_cos == 0) wave.wave_order = Wave{}.wave_order;
}

/// The imperfections that affect the motion, in canonical form: without the joint sensor, and without irrelevant
/// numbers.
Imperfections motion_key(Imperfections errors) {
  errors.sensor = {};
  reset_idle_order(errors.motor);
  reset_idle_order(errors.pulley.outline);
  if (errors.tendon.slip == 0 && errors.ratio_joint.step == 0) errors.tendon.slip_time = 0;
  if (errors.tendon.pretension_share() == 0) errors.tendon.pretension = 0;
  return errors;
}

double tip_force(const BenchRun& run, const BenchRow& row, const Mechanism& declared) {
  return run.has_load ? row.load : declared.load.tip_force;
}

double first_temperature(const BenchLog& log) {
  for (const BenchRun& run : log) {
    if (run.has_temperature && !run.rows.empty()) return run.rows.front().temperature_C;
  }
  return 0;
}

/// Play of α that remains under `load`, rad.
double slack_of(const RatioJointError& joint, double load) {
  return joint.slack / (1.0 + joint.slack_taken_up * std::abs(load));
}

std::vector<double> sensor_readings(const BenchRun& run, std::vector<double> theta, const Imperfections& errors) {
  return sensed(run, std::move(theta), turned(errors.sensor, run.mounting.joint_sensor_turned));
}

/// Angle of the joint; within its play, the angle to which it was last pushed.
double angle_or_nan(const EquilibriumPoint& point) {
  return point.status == EquilibriumStatus::no_equilibrium ? std::numeric_limits<double>::quiet_NaN() : point.theta;
}
double play_of(const EquilibriumPoint& point) { return std::max(point.loose_above, point.loose_below); }

/// True when a joint without time dependence moves equally in both runs.
bool are_driven_alike(const BenchRun& one, const BenchRun& other) {
  const auto alike = [&one](const BenchRow& a, const BenchRow& b) {
    return a.alpha == b.alpha && (!one.has_load || a.load == b.load) &&
           (!one.has_temperature || a.temperature_C == b.temperature_C);
  };
  return one.has_load == other.has_load && one.has_temperature == other.has_temperature &&
         one.mounting.motor_sensor_turned == other.mounting.motor_sensor_turned &&
         std::equal(one.rows.begin(), one.rows.end(), other.rows.begin(), other.rows.end(), alike);
}

bool depends_on_time(const Imperfections& errors) {
  return errors.tendon.creep != 0 || errors.tendon.slip != 0 || !(errors.ratio_joint == RatioJointError{});
}

JointState state_of(const EquilibriumPoint& point) {
  JointState state{point.status, angle_or_nan(point)};
  state.loose = play_of(point);
  if (point.status == EquilibriumStatus::no_equilibrium) return state;
  state.t1 = point.t1;
  state.t2 = point.t2;
  state.motor_torque = point.motor_torque;
  return state;
}

/// Replaces the model's functions of α by tables from `least` to `most`.
void tabulate_paths(JointModel& model, double least, double most) {
  const auto table = std::make_shared<const LowerPathTable>(model, least, most);
  model.lower = [table](double alpha) { return table->paths(alpha); };
  model.expected = [table](double alpha) { return table->expected(alpha); };
}

}  // namespace

TendonCreep::TendonCreep(double per_decade, double EA, JointMotion home, const JointStep& rest)
    : per_decade_(per_decade), EA_(EA) {
  if (per_decade_ != 0) at_rest_ = strains(home.to(rest));
}

std::array<double, 2> TendonCreep::strains(const EquilibriumPoint& point) const {
  const auto mean_strain = [this](const TendonState& tendon) { return 0.5 * (tendon.upper + tendon.lower) / EA_; };
  return {mean_strain(point.t1), mean_strain(point.t2)};
}

std::array<double, 2> TendonCreep::after(double time) const {
  std::array<double, 2> added{};
  for (std::size_t i = 0; i < 2 && per_decade_ != 0; ++i) {
    CreepMemory then = memory_[i];
    then.hold(beyond_[i], time);
    added[i] = per_decade_ * then.crept();
  }
  return added;
}

void TendonCreep::hold(const EquilibriumPoint& now, double time) {
  if (per_decade_ == 0 || now.status == EquilibriumStatus::no_equilibrium) return;
  const std::array<double, 2> strain = strains(now);
  for (std::size_t i = 0; i < 2; ++i) {
    const double before = std::exchange(beyond_[i], strain[i] - at_rest_[i]);
    memory_[i].hold(0.5 * (before + beyond_[i]), time);
  }
}

void TendonCreep::rest(double time) {
  beyond_ = {};
  for (CreepMemory& memory : memory_) memory.hold(0, time);
}

Forward::Forward(const Mechanism& declared, const BenchLog& log, const Mechanism& made_for)
    : declared_(declared), log_(log), clock_(bench_clock(log)), first_temperature_(first_temperature(log)) {
  if (!declared.transmission) made_.emplace(made_for);
  for (std::size_t i = 0; i < log.size(); ++i) {
    all_.push_back(i);
    std::size_t first = 0;
    while (first < i && !are_driven_alike(log[first], log[i])) ++first;
    first_alike_.push_back(first);
  }
  for (const BenchRun& run : log) {
    for (const BenchRow& row : run.rows) {
      alpha_least_ = std::min(alpha_least_, row.alpha);
      alpha_most_ = std::max(alpha_most_, row.alpha);
    }
  }
}

Forward::Forward(const Mechanism& declared, const BenchLog& log, const std::optional<EarlierState>& earlier)
    : Forward(declared, log) {
  if (!earlier) return;
  earlier_motion_ = motion_of(earlier->joint);
  earlier_ = earlier;
  latest_.clear();  // later runs must not find the motions of earlier ones
  // Runs of the later state refer only to runs of the later state.
  for (std::size_t i = earlier->runs; i < log.size(); ++i) {
    if (first_alike_[i] >= earlier->runs) continue;
    first_alike_[i] = earlier->runs;
    while (first_alike_[i] < i && !are_driven_alike(log[first_alike_[i]], log[i])) ++first_alike_[i];
  }
}

/// The earlier state plus the imperfections; only the imperfections if there is none.
Imperfections Forward::with_earlier_state(const Imperfections& imperfections) const {
  return earlier_ ? changed(earlier_->joint, imperfections, kind_of(declared_)) : imperfections;
}

JointMotion Forward::at_home(const Imperfections& errors) {
  const GeometryError key = geometry_of(errors);
  Geometry* known = nullptr;
  for (Geometry& latest : latest_geometry_) {
    if (latest.model && latest.key == key) known = &latest;
  }
  if (known == nullptr) {
    known = &latest_geometry_[next_geometry_++ % latest_geometry_.size()];
    *known = {key, imperfect_geometry(*made_, declared_, errors)};
    tabulate_paths(*known->model, alpha_least_ - k_beyond, alpha_most_ + k_beyond);
  }
  JointModel model = *known->model;
  set_imperfect_statics(model, declared_, errors);
  if (is_for_fits_) model.last_step = k_last_step_of_fits;
  return JointMotion(std::move(model));
}

TendonChange Forward::change(std::size_t index, const BenchRow& row, const Imperfections& errors) const {
  const BenchRun& run = log_[index];
  TendonChange change;
  if (run.has_temperature) {
    const double warmer = row.temperature_C - first_temperature_;
    change.expansion = {errors.tendon.thermal1 * warmer, errors.tendon.thermal2 * warmer};
  }
  if (row.time + clock_[index] >= errors.tendon.slip_time)
    change.released = {std::max(0.0, errors.tendon.slip), std::max(0.0, -errors.tendon.slip)};
  return change;
}

/// Time between the end of the previous run and the first row, s.
double Forward::time_before(std::size_t index) const {
  if (index == 0 || log_[index].rows.empty() || log_[index - 1].rows.empty()) return 0;
  const double end = log_[index - 1].rows.back().time + clock_[index - 1];
  return std::max(0.0, log_[index].rows.front().time + clock_[index] - end);
}

void Forward::move_tendon_joint(std::size_t index, JointMotion motion, const Imperfections& errors, TendonCreep& creep,
                                const std::function<void(const EquilibriumPoint&)>& on_row) const {
  const BenchRun& run = log_[index];
  if (run.rows.empty()) return;
  creep.rest(time_before(index));
  Play play(0.0);
  const MotorSensorError motor = turned(errors.motor, run.mounting.motor_sensor_turned);
  const auto step = [&](double alpha, const BenchRow& row, double time) {
    const double pulley = play.to(shaft_angle(alpha, motor), errors.shaft.backlash);
    TendonChange changed = change(index, row, errors);
    const std::array<double, 2> crept = creep.after(time);
    for (std::size_t i = 0; i < 2; ++i) changed.expansion[i] += crept[i];
    const EquilibriumPoint point = motion.to({pulley, tip_force(run, row, declared_), declared_.load.torque, changed});
    creep.hold(point, time);
    return point;
  };
  const BenchRow& first = run.rows.front();
  for (int i = 1; i < k_approach; ++i) step(first.alpha * i / k_approach, first, 0.0);
  double last_time = first.time;
  for (const BenchRow& row : run.rows) {
    on_row(step(row.alpha, row, row.time - last_time));
    last_time = row.time;
  }
}

std::vector<double> Forward::ratio_joint_angles(std::size_t index, const Imperfections& errors,
                                                CreepMemory& drift) const {
  const BenchRun& run = log_[index];
  std::vector<double> theta;
  theta.reserve(run.rows.size());
  if (run.rows.empty()) return theta;
  const double ratio = declared_.transmission->ratio;
  const auto load_of = [&run](const BenchRow& row) { return run.has_load ? row.load : 0.0; };
  const MotorSensorError motor = turned(errors.motor, run.mounting.motor_sensor_turned);
  Play play(shaft_angle(0.0, motor));
  const auto pulley_at = [&](double alpha, const BenchRow& row) {
    return play.to(shaft_angle(alpha, motor), errors.shaft.backlash + slack_of(errors.ratio_joint, load_of(row)));
  };
  const BenchRow& first = run.rows.front();
  RubbingCable cable(errors.ratio_joint, shaft_angle(0.0, motor) / ratio);
  for (int i = 1; i < k_approach; ++i) cable.to(pulley_at(first.alpha * i / k_approach, first) / ratio, load_of(first));
  drift.hold(0, time_before(index));
  const BenchRow* last = &first;
  for (const BenchRow& row : run.rows) {
    const double load = load_of(row);
    const double driven = pulley_at(row.alpha, row) / ratio;
    double angle = cable.to(driven, load) + errors.ratio_joint.curve.added(driven, load);
    if (errors.ratio_joint.drift != 0) {
      drift.hold(0.5 * (load_of(*last) + load), row.time - last->time);
      angle -= errors.ratio_joint.drift * drift.crept();
    }
    last = &row;
    if (errors.ratio_joint.step != 0 && row.time + clock_[index] >= errors.tendon.slip_time)
      angle += errors.ratio_joint.step;
    if (run.has_temperature) angle += errors.ratio_joint.warmth * (row.temperature_C - first_temperature_);
    theta.push_back(angle);
  }
  return theta;
}

void Forward::move(const Imperfections& errors, const std::vector<std::size_t>& runs,
                   const std::function<void(std::size_t, const EquilibriumPoint&)>& on_row) {
  if (made_) {
    const JointMotion home = at_home(errors);
    const double EA = section_stiffness(mounted(declared_, errors).mechanism.tendon);
    TendonCreep creep(errors.tendon.creep, EA, home, {.torque = declared_.load.torque});
    for (const std::size_t i : runs)
      move_tendon_joint(i, home, errors, creep, [&](const EquilibriumPoint& point) { on_row(i, point); });
    return;
  }
  CreepMemory drift;
  for (const std::size_t i : runs) {
    for (const double theta : ratio_joint_angles(i, errors, drift)) {
      EquilibriumPoint point;
      point.theta = theta;
      on_row(i, point);
    }
  }
}

const Forward::Motion& Forward::motion_of(const Imperfections& imperfections) {
  const Imperfections key = motion_key(imperfections);
  for (const Motion& known : latest_) {
    if (known.key == key) return known;
  }
  Motion& motion = latest_.size() < k_most_motions ? latest_.emplace_back() : latest_[next_++ % k_most_motions];
  motion = {key, Readings(log_.size()), Readings(log_.size())};
  // Run i has the motion of run source[i].
  const std::vector<std::size_t>& source = depends_on_time(key) ? all_ : first_alike_;
  const std::size_t first = earlier_ ? earlier_->runs : 0;
  std::vector<std::size_t> moved;
  for (const std::size_t run : all_) {
    if (source[run] == run && run >= first) moved.push_back(run);
  }
  move(key, moved, [&](std::size_t run, const EquilibriumPoint& point) {
    motion.theta[run].push_back(angle_or_nan(point));
    motion.loose[run].push_back(play_of(point));
  });
  for (const std::size_t run : all_) {
    const Motion& computed = run < first ? *earlier_motion_ : motion;
    motion.theta[run] = computed.theta[source[run]];
    motion.loose[run] = computed.loose[source[run]];
  }
  return motion;
}

Readings Forward::operator()(const Imperfections& imperfections) {
  const Imperfections errors = with_earlier_state(imperfections);
  Readings readings = motion_of(errors).theta;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const bool is_earlier = earlier_ && i < earlier_->runs;
    readings[i] = sensor_readings(log_[i], std::move(readings[i]), is_earlier ? earlier_->joint : errors);
  }
  return readings;
}

std::vector<std::vector<JointState>> Forward::states(const Imperfections& errors) {
  std::vector<std::vector<JointState>> all(log_.size());
  move(motion_key(errors), all_, [&](std::size_t run, const EquilibriumPoint& point) {
    all[run].push_back(made_ ? state_of(point) : JointState{point.status, point.theta});
  });
  for (std::size_t i = 0; i < log_.size(); ++i) {
    std::vector<double> theta;
    for (const JointState& state : all[i]) theta.push_back(state.theta);
    theta = sensor_readings(log_[i], std::move(theta), errors);
    for (std::size_t k = 0; k < theta.size(); ++k) all[i][k].shown = theta[k];
  }
  return all;
}

std::vector<std::vector<JointState>> simulate(const Mechanism& declared, const Imperfections& imperfections,
                                              const BenchLog& log) {
  return Forward(declared, log).states(imperfections);
}

Readings predict(const Mechanism& declared, const Imperfections& imperfections, const BenchLog& log) {
  return Forward(declared, log)(imperfections);
}

Readings predict(const Mechanism& declared, const Imperfections& imperfections, const BenchLog& log,
                 const std::optional<EarlierState>& earlier) {
  return Forward(declared, log, earlier)(imperfections);
}

}  // namespace fusee::joint
