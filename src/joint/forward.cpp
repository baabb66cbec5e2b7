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

/// Steps from home to the beginning of a run. The motion before the log is unknown; a direct approach from home is the
/// simplest assumption.
constexpr int k_approach = 24;

/// Margin for the effect of sensors and play on the logged angles, rad.
constexpr double k_beyond = 0.1;

/// Resets the order of a wave of zero amplitude, so that equivalent values compare equal.
template <typename Wave>
void reset_idle_order(Wave& wave) {
  if (wave.wave_sin == 0 && wave.wave_cos == 0) wave.wave_order = Wave{}.wave_order;
}

/// The imperfections that affect the motion, in canonical form: without the joint sensor, and without irrelevant
/// numbers.
Imperfections motion_key(Imperfections at) {
  at.sensor = {};
  reset_idle_order(at.motor);
  reset_idle_order(at.pulley.outline);
  if (at.tendon.slip == 0 && at.ratio_joint.step == 0) at.tendon.slip_time = 0;
  if (at.tendon.pretension_share() == 0) at.tendon.pretension = 0;
  return at;
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

std::vector<double> sensor_readings(const BenchRun& run, std::vector<double> theta, const Imperfections& at) {
  return sensed(run, std::move(theta), turned(at.sensor, run.mounting.joint_sensor_turned));
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

bool depends_on_time(const Imperfections& at) {
  return at.tendon.creep != 0 || at.tendon.slip != 0 || !(at.ratio_joint == RatioJointError{});
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
  const auto of = [this](const TendonState& tendon) { return 0.5 * (tendon.upper + tendon.lower) / EA_; };
  return {of(point.t1), of(point.t2)};
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
    driven_.push_back(first);
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
  earlier_motion_ = mechanism(earlier->joint);
  earlier_ = earlier;
  latest_ = {};  // later runs must not find the motions of earlier ones
  // Runs of the later state refer only to runs of the later state.
  for (std::size_t i = earlier->runs; i < log.size(); ++i) {
    if (driven_[i] >= earlier->runs) continue;
    driven_[i] = earlier->runs;
    while (driven_[i] < i && !are_driven_alike(log[driven_[i]], log[i])) ++driven_[i];
  }
}

/// The earlier state plus the imperfections; only the imperfections if there is none.
Imperfections Forward::whole(const Imperfections& imperfections) const {
  return earlier_ ? changed(earlier_->joint, imperfections, kind_of(declared_)) : imperfections;
}

JointMotion Forward::at_home(const Imperfections& at) {
  const GeometryError key = geometry_of(at);
  Geometry* known = nullptr;
  for (Geometry& latest : latest_geometry_) {
    if (latest.model && latest.key == key) known = &latest;
  }
  if (known == nullptr) {
    known = &latest_geometry_[next_geometry_++ % latest_geometry_.size()];
    *known = {key, imperfect_geometry(*made_, declared_, at)};
    tabulate_paths(*known->model, alpha_least_ - k_beyond, alpha_most_ + k_beyond);
  }
  JointModel model = *known->model;
  set_imperfect_statics(model, declared_, at);
  return JointMotion(std::move(model));
}

TendonChange Forward::change(std::size_t index, const BenchRow& row, const Imperfections& at) const {
  const BenchRun& run = log_[index];
  TendonChange change;
  if (run.has_temperature) {
    const double warmer = row.temperature_C - first_temperature_;
    change.expansion = {at.tendon.thermal1 * warmer, at.tendon.thermal2 * warmer};
  }
  if (row.time + clock_[index] >= at.tendon.slip_time)
    change.released = {std::max(0.0, at.tendon.slip), std::max(0.0, -at.tendon.slip)};
  return change;
}

/// Time between the end of the previous run and the first row, s.
double Forward::time_before(std::size_t index) const {
  if (index == 0 || log_[index].rows.empty() || log_[index - 1].rows.empty()) return 0;
  const double end = log_[index - 1].rows.back().time + clock_[index - 1];
  return std::max(0.0, log_[index].rows.front().time + clock_[index] - end);
}

void Forward::elastic(std::size_t index, JointMotion motion, const Imperfections& at, TendonCreep& creep,
                      const std::function<void(const EquilibriumPoint&)>& found) const {
  const BenchRun& run = log_[index];
  if (run.rows.empty()) return;
  creep.rest(time_before(index));
  Play play(0.0);
  const MotorSensorError motor = turned(at.motor, run.mounting.motor_sensor_turned);
  const auto step = [&](double alpha, const BenchRow& row, double time) {
    const double pulley = play.to(shaft_angle(alpha, motor), at.shaft.backlash);
    TendonChange changed = change(index, row, at);
    const std::array<double, 2> crept = creep.after(time);
    for (std::size_t i = 0; i < 2; ++i) changed.expansion[i] += crept[i];
    const EquilibriumPoint point = motion.to({pulley, tip_force(run, row, declared_), declared_.load.torque, changed});
    creep.hold(point, time);
    return point;
  };
  const BenchRow& first = run.rows.front();
  for (int i = 1; i < k_approach; ++i) step(first.alpha * i / k_approach, first, 0.0);
  double time = first.time;
  for (const BenchRow& row : run.rows) found(step(row.alpha, row, row.time - std::exchange(time, row.time)));
}

std::vector<double> Forward::geared(std::size_t index, const Imperfections& at, CreepMemory& drift) const {
  const BenchRun& run = log_[index];
  std::vector<double> theta;
  theta.reserve(run.rows.size());
  if (run.rows.empty()) return theta;
  const double ratio = declared_.transmission->ratio;
  const auto load_of = [&run](const BenchRow& row) { return run.has_load ? row.load : 0.0; };
  const MotorSensorError motor = turned(at.motor, run.mounting.motor_sensor_turned);
  Play play(shaft_angle(0.0, motor));
  const auto pulley_at = [&](double alpha, const BenchRow& row) {
    return play.to(shaft_angle(alpha, motor), at.shaft.backlash + slack_of(at.ratio_joint, load_of(row)));
  };
  const BenchRow& first = run.rows.front();
  RubbingCable cable(at.ratio_joint, shaft_angle(0.0, motor) / ratio);
  for (int i = 1; i < k_approach; ++i) cable.to(pulley_at(first.alpha * i / k_approach, first) / ratio, load_of(first));
  drift.hold(0, time_before(index));
  const BenchRow* last = &first;
  for (const BenchRow& row : run.rows) {
    const double load = load_of(row);
    const double driven = pulley_at(row.alpha, row) / ratio;
    double angle = cable.to(driven, load) + at.ratio_joint.curve.added(driven, load);
    if (at.ratio_joint.drift != 0) {
      drift.hold(0.5 * (load_of(*last) + load), row.time - last->time);
      angle -= at.ratio_joint.drift * drift.crept();
    }
    last = &row;
    if (at.ratio_joint.step != 0 && row.time + clock_[index] >= at.tendon.slip_time) angle += at.ratio_joint.step;
    if (run.has_temperature) angle += at.ratio_joint.warmth * (row.temperature_C - first_temperature_);
    theta.push_back(angle);
  }
  return theta;
}

void Forward::move(const Imperfections& at, const std::vector<std::size_t>& runs,
                   const std::function<void(std::size_t, const EquilibriumPoint&)>& found) {
  if (made_) {
    const JointMotion home = at_home(at);
    const double EA = section_stiffness(mounted(declared_, at).mechanism.tendon);
    TendonCreep creep(at.tendon.creep, EA, home, {.torque = declared_.load.torque});
    for (const std::size_t i : runs)
      elastic(i, home, at, creep, [&](const EquilibriumPoint& point) { found(i, point); });
    return;
  }
  CreepMemory drift;
  for (const std::size_t i : runs) {
    for (const double theta : geared(i, at, drift)) {
      EquilibriumPoint point;
      point.theta = theta;
      found(i, point);
    }
  }
}

const Forward::Motion& Forward::mechanism(const Imperfections& imperfections) {
  const Imperfections key = motion_key(imperfections);
  for (const Motion& motion : latest_) {
    if (motion.key == key && !motion.theta.empty()) return motion;
  }
  Motion& place = latest_[next_++ % latest_.size()];
  place = {key, Readings(log_.size()), Readings(log_.size())};
  const std::vector<std::size_t>& stands_for = depends_on_time(key) ? all_ : driven_;
  const std::size_t first = earlier_ ? earlier_->runs : 0;
  std::vector<std::size_t> moved;
  for (const std::size_t run : all_) {
    if (stands_for[run] == run && run >= first) moved.push_back(run);
  }
  move(key, moved, [&](std::size_t run, const EquilibriumPoint& point) {
    place.theta[run].push_back(angle_or_nan(point));
    place.loose[run].push_back(play_of(point));
  });
  for (const std::size_t run : all_) {
    const Motion& of = run < first ? *earlier_motion_ : place;
    place.theta[run] = of.theta[stands_for[run]];
    place.loose[run] = of.loose[stands_for[run]];
  }
  return place;
}

Readings Forward::operator()(const Imperfections& imperfections) {
  const Imperfections at = whole(imperfections);
  Readings readings = mechanism(at).theta;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const bool is_earlier = earlier_ && i < earlier_->runs;
    readings[i] = sensor_readings(log_[i], std::move(readings[i]), is_earlier ? earlier_->joint : at);
  }
  return readings;
}

std::vector<std::vector<JointState>> Forward::states(const Imperfections& at) {
  std::vector<std::vector<JointState>> all(log_.size());
  move(motion_key(at), all_, [&](std::size_t run, const EquilibriumPoint& point) {
    all[run].push_back(made_ ? state_of(point) : JointState{point.status, point.theta});
  });
  for (std::size_t i = 0; i < log_.size(); ++i) {
    std::vector<double> theta;
    for (const JointState& state : all[i]) theta.push_back(state.theta);
    theta = sensor_readings(log_[i], std::move(theta), at);
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
