#include "joint/forward.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fusee/joint/simulate.h"
#include "joint/lower_path_table.h"
#include "joint/sensors.h"

namespace fusee {
namespace {

/// Steps in which a joint is brought from home to where its run begins. What happened before the log is not known; a
/// joint that came straight from home is the least that can be assumed.
constexpr int k_approach = 24;

/// What sensors and play may add to the angles that were logged, rad.
constexpr double k_beyond = 0.1;

/// What the mechanism does not see: the same for all sensors.
Imperfections without_sensor(Imperfections at) {
  at.sensor = {};
  return at;
}

double tip_force(const BenchRun& run, const BenchRow& row, const Mechanism& declared) {
  return run.has_load ? row.load : declared.load.tip_force;
}

double first_temperature(const BenchLog& log) {
  for (const BenchRun& run : log) {
    if (run.has_temperature && !run.rows.empty()) return run.rows.front().temperature;
  }
  return 0;
}

double decades(const BenchRun& run, const BenchRow& row) {
  return std::log10(1.0 + std::max(0.0, row.time - run.rows.front().time));
}

std::vector<double> shown_by_sensor(const BenchRun& run, std::vector<double> theta, const Imperfections& at) {
  return sensed(run, std::move(theta), turned(at.sensor, run.mounting.joint_sensor_turned));
}

/// Where the joint stands; within its play in the middle.
double standing(const EquilibriumPoint& point) {
  return point.status == EquilibriumStatus::no_equilibrium
             ? std::numeric_limits<double>::quiet_NaN()
             : point.theta + 0.5 * (point.loose_above - point.loose_below);
}
double half_play(const EquilibriumPoint& point) { return 0.5 * (point.loose_above + point.loose_below); }

JointState state_of(const EquilibriumPoint& point) {
  JointState state{point.status, standing(point)};
  state.loose = half_play(point);
  if (point.status == EquilibriumStatus::no_equilibrium) return state;
  state.t1 = point.t1;
  state.t2 = point.t2;
  state.motor_torque = point.motor_torque;
  return state;
}

void look_paths_up(JointModel& model, double least, double most) {
  const auto table = std::make_shared<const LowerPathTable>(model, least, most);
  model.lower = [table](double alpha) { return table->paths(alpha); };
  model.expected = [table](double alpha) { return table->expected(alpha); };
}

}  // namespace

Forward::Forward(const Mechanism& declared, const BenchLog& log, const Mechanism& made_for)
    : declared_(declared), log_(log), clock_(bench_clock(log)), first_temperature_(first_temperature(log)) {
  if (!declared.transmission) made_.emplace(made_for);
  for (const BenchRun& run : log) {
    for (const BenchRow& row : run.rows) {
      alpha_least_ = std::min(alpha_least_, row.alpha);
      alpha_most_ = std::max(alpha_most_, row.alpha);
    }
  }
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
    look_paths_up(*known->model, alpha_least_ - k_beyond, alpha_most_ + k_beyond);
  }
  JointModel model = *known->model;
  set_imperfect_statics(model, declared_, at);
  return JointMotion(std::move(model));
}

TendonChange Forward::change(std::size_t index, const BenchRow& row, const Imperfections& at) const {
  const BenchRun& run = log_[index];
  TendonChange change;
  change.compliance = 1.0 + at.tendon.creep * (at.tendon.creep != 0 ? decades(run, row) : 0.0);
  if (run.has_temperature) {
    const double warmer = row.temperature - first_temperature_;
    change.expansion = {at.tendon.thermal1 * warmer, at.tendon.thermal2 * warmer};
  }
  if (row.time + clock_[index] >= at.tendon.slip_time)
    change.released = {std::max(0.0, at.tendon.slip), std::max(0.0, -at.tendon.slip)};
  return change;
}

void Forward::elastic(std::size_t index, JointMotion motion, const Imperfections& at,
                      const std::function<void(const EquilibriumPoint&)>& found) const {
  const BenchRun& run = log_[index];
  if (run.rows.empty()) return;
  Play play(at.shaft.backlash, 0.0);
  const MotorSensorError motor = turned(at.motor, run.mounting.motor_sensor_turned);
  const auto step = [&](double alpha, const BenchRow& row) {
    const double pulley = play.to(shaft_angle(alpha, motor));
    return motion.to({pulley, tip_force(run, row, declared_), declared_.load.torque, change(index, row, at)});
  };
  const BenchRow& first = run.rows.front();
  for (int i = 1; i < k_approach; ++i) step(first.alpha * i / k_approach, first);
  for (const BenchRow& row : run.rows) found(step(row.alpha, row));
}

std::vector<double> Forward::geared(std::size_t index, const Imperfections& at) const {
  const BenchRun& run = log_[index];
  std::vector<double> theta;
  theta.reserve(run.rows.size());
  if (run.rows.empty()) return theta;
  const double ratio = declared_.transmission->ratio;
  const MotorSensorError motor = turned(at.motor, run.mounting.motor_sensor_turned);
  Play play(at.shaft.backlash, shaft_angle(0.0, motor));
  const double start = run.rows.front().alpha;
  for (int i = 1; i < k_approach; ++i) play.to(shaft_angle(start * i / k_approach, motor));
  double direction = 0;
  double before = play.to(shaft_angle(start, motor));
  for (const BenchRow& row : run.rows) {
    const double pulley = play.to(shaft_angle(row.alpha, motor));
    if (pulley != before) direction = (pulley > before) == (ratio > 0) ? 1.0 : -1.0;
    before = pulley;
    const double load = run.has_load ? row.load : 0.0;
    double angle =
        pulley / ratio - at.ratio_joint.compliance * load - at.ratio_joint.dry_friction * std::abs(load) * direction;
    if (at.ratio_joint.drift != 0) angle -= at.ratio_joint.drift * load * decades(run, row);
    if (at.ratio_joint.step != 0 && row.time + clock_[index] >= at.tendon.slip_time) angle += at.ratio_joint.step;
    if (run.has_temperature) angle += at.ratio_joint.warmth * (row.temperature - first_temperature_);
    theta.push_back(angle);
  }
  return theta;
}

const Forward::Motion& Forward::mechanism(const Imperfections& imperfections) {
  const Imperfections key = without_sensor(imperfections);
  for (const Motion& motion : latest_) {
    if (motion.key == key && !motion.theta.empty()) return motion;
  }
  Motion& place = latest_[next_++ % latest_.size()];
  place = {key, {}, {}};
  std::optional<JointMotion> home;
  if (made_) home.emplace(at_home(key));
  for (std::size_t i = 0; i < log_.size(); ++i) {
    if (home) {
      std::vector<double>& theta = place.theta.emplace_back();
      std::vector<double>& loose = place.loose.emplace_back();
      elastic(i, *home, key, [&](const EquilibriumPoint& point) {
        theta.push_back(standing(point));
        loose.push_back(half_play(point));
      });
    } else {
      place.theta.push_back(geared(i, key));
      place.loose.emplace_back(place.theta.back().size(), 0.0);
    }
  }
  return place;
}

Readings Forward::operator()(const Imperfections& imperfections) {
  Readings readings = mechanism(imperfections).theta;
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] = shown_by_sensor(log_[i], std::move(readings[i]), imperfections);
  return readings;
}

std::vector<std::vector<JointState>> Forward::states(const Imperfections& at) {
  const Imperfections key = without_sensor(at);
  std::optional<JointMotion> home;
  if (made_) home.emplace(at_home(key));
  std::vector<std::vector<JointState>> all(log_.size());
  for (std::size_t i = 0; i < log_.size(); ++i) {
    if (home) {
      elastic(i, *home, key, [&](const EquilibriumPoint& point) { all[i].push_back(state_of(point)); });
    } else {
      for (const double theta : geared(i, key)) all[i].push_back({EquilibriumStatus::held, theta});
    }
    std::vector<double> theta;
    for (const JointState& state : all[i]) theta.push_back(state.theta);
    theta = shown_by_sensor(log_[i], std::move(theta), at);
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

}  // namespace fusee
