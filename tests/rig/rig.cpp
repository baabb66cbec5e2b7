#include "rig/rig.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/helix.h"
#include "fusee/profile.h"
#include "rig/bench.h"
#include "rig/random.h"

namespace fusee::rig {
namespace {

constexpr double k_approach = radians(2.5);  // steps of α between home and the start of the sweep, and between far rows
constexpr int k_loading = 8;                 // steps in which the load comes on
constexpr int k_lag_steps = 4;               // steps between rows, for a sensor that shows an earlier angle
constexpr double k_warm = 31.0;              // °C, when the session begins
constexpr double k_cooling = 11.0;           // K, after a long time
constexpr double k_cooling_time = 150.0;     // s

double temperature_at(double time) { return k_warm - k_cooling * (1.0 - std::exp(-time / k_cooling_time)); }

/// A wave that is zero at angle 0.
double wave(double amplitude, int order, double angle, double phase) {
  return amplitude * (std::sin(order * angle + phase) - std::sin(phase));
}

/// From the motor's sensor to the pulley, including play.
class Drive {
 public:
  Drive(const HiddenFaults& hidden, double stroke)
      : hidden_(hidden), added_(hidden.shaft), seat_(0.5 * stroke), shaft_(shaft(0.0)), pulley_(shaft_) {}

  double to(double alpha, const Moment& now) {
    const double turned = shaft(alpha);
    travel_ += std::abs(turned - shaft_);
    shaft_ = turned;
    pulley_ = std::clamp(pulley_, shaft_ - 0.5 * hidden_.backlash, shaft_ + 0.5 * hidden_.backlash);
    return pulley_ + (hidden_.bedding != 0 ? hidden_.bedding * std::exp(-travel_ / seat_) : 0.0) + added_(now);
  }
  /// The pulley leaves its seat.
  void begin_run() { travel_ = 0; }

 private:
  double shaft(double alpha) const {
    return alpha + hidden_.motor_offset + wave(hidden_.motor_eccentricity, 1, alpha, hidden_.motor_eccentricity_phase) +
           wave(hidden_.motor_harmonic, hidden_.motor_harmonic_order, alpha, hidden_.motor_harmonic_phase) +
           hidden_.cogging * std::sin(hidden_.cogging_per_turn * alpha);
  }

  const HiddenFaults& hidden_;
  Actors added_;
  double seat_;
  double shaft_;
  double pulley_;
  double travel_ = 0;
};

/// θ at times closer than the rows.
struct Track {
  std::vector<double> time;
  std::vector<double> theta;

  /// Linear interpolation; constant before the first time.
  double at(double moment) const {
    const auto after = std::upper_bound(time.begin(), time.end(), moment);
    if (after == time.begin()) return theta.front();
    if (after == time.end()) return theta.back();
    const auto i = static_cast<std::size_t>(after - time.begin());
    const double share = (moment - time[i - 1]) / (time[i] - time[i - 1]);
    return theta[i - 1] + share * (theta[i] - theta[i - 1]);
  }
};

/// First-order lag of θ, exact for piecewise linear θ.
Track filter(const Track& track, double constant) {
  Track late = track;
  for (std::size_t i = 1; i < track.time.size(); ++i) {
    const double step = track.time[i] - track.time[i - 1];
    const double slope = (track.theta[i] - track.theta[i - 1]) / step;
    const double behind = track.theta[i - 1] - late.theta[i - 1];
    const double settled = slope * constant;
    late.theta[i] = track.theta[i] - (settled + (behind - settled) * std::exp(-step / constant));
  }
  return late;
}

/// Autoregressive noise of order 1.
class Noise {
 public:
  Noise(const SensorPlan& plan, std::size_t run) : plan_(plan), random_(plan.seed * 1000003 + run) {}
  double next() {
    const double fresh = random_.normal();
    last_ = first_ ? fresh : plan_.colour * last_ + std::sqrt(1.0 - plan_.colour * plan_.colour) * fresh;
    first_ = false;
    return plan_.noise * last_;
  }

 private:
  const SensorPlan& plan_;
  Random random_;
  double last_ = 0;
  bool first_ = true;
};

/// The state of joint, drive and sensors over all runs.
class Session {
 public:
  Session(const MadeJoint& joint, const HiddenFaults& hidden, const SensorPlan& sensors, const MotionPlan& motion)
      : as_mounted_(hidden),
        hidden_(hidden),
        sensors_(sensors),
        motion_(motion),
        low_(motion.reach * joint.alpha_min),
        high_(motion.reach * joint.alpha_max),
        bench_(joint, hidden),
        drive_(hidden_, high_ - low_),
        reading_(hidden.reading),
        load_(hidden.load) {}

  Log run(const RunPlan& plan) {
    const Way way = plan_way(plan, motion_, low_, high_);
    hidden_ = with_turned_sensors(as_mounted_, plan);
    begin(first_load(plan));
    Log log = read_sensors(way, follow(way));
    time_ += way.back().time + motion_.pause;
    ++at_.run;
    return log;
  }

 private:
  double move(double alpha, double time, double seconds) {
    if (alpha != at_.alpha) at_.direction = alpha > at_.alpha ? 1.0 : -1.0;
    at_.alpha_speed = (alpha - at_.alpha) / std::max(1e-9, seconds);
    at_.seconds = seconds;
    at_.alpha = alpha;
    at_.run_time = time;
    at_.time = time_ + time;
    at_.warmth = temperature_at(at_.time) - k_warm;
    at_.theta = bench_.theta();
    at_.theta_speed = bench_.now().theta_speed;
    at_.tension = bench_.now().tension;
    Conditions pulled = at_;
    pulled.load += load_(at_);
    return bench_.to(drive_.to(alpha, at_), alpha, pulled);
  }
  /// Moves in even steps of time, α and load.
  void go(double alpha, double load, double seconds) {
    const double from = at_.alpha;
    const double load_before = at_.load;
    const int steps = std::max(load != load_before ? k_loading : 1,
                               static_cast<int>(std::ceil(std::abs(alpha - from) / k_approach - 1e-9)));
    for (int i = 1; i <= steps; ++i) {
      at_.load = load_before + (load - load_before) * i / steps;
      move(from + (alpha - from) * i / steps, 0.0, seconds / steps);
    }
  }
  /// Takes the load off, moves home and to the start of the sweep, and applies the load. All of it takes one pause.
  void begin(double load) {
    const double quarter = 0.25 * motion_.pause;
    go(at_.alpha, 0.0, quarter);
    go(0.0, 0.0, quarter);
    drive_.begin_run();
    if (motion_.loaded_first) go(0.0, load, quarter);
    go(low_, at_.load, quarter);
    drive_.begin_run();
    go(low_, load, quarter);
  }

  struct TrackedRun {
    Track track;
    std::vector<Moment> rows;
  };
  TrackedRun follow(const Way& way) {
    const bool slips = hidden_.slip != 0 && at_.run == hidden_.slip_run;
    const double slip_time = hidden_.slip_at * way.back().time;
    const double let_go = at_.let_go[hidden_.slip_side];
    TrackedRun done{{{0.0}, {move(way.front().alpha, 0.0, 1e-3)}}, {at_}};
    for (std::size_t row = 1; row < way.size(); ++row) {
      const WayPoint& from = way[row - 1];
      const WayPoint& to = way[row];
      const int far = static_cast<int>(std::ceil(std::abs(to.alpha - from.alpha) / k_approach - 1e-9));
      const int steps = std::max({1, far, hidden_.lag > 0 || hidden_.lag_filter > 0 ? k_lag_steps : 1});
      for (int step = 1; step <= steps; ++step) {
        const double share = static_cast<double>(step) / steps;
        const double time = from.time + share * (to.time - from.time);
        if (slips && time >= slip_time) at_.let_go[hidden_.slip_side] = let_go + hidden_.slip;
        at_.load = from.load + share * (to.load - from.load);
        const double seconds = time - done.track.time.back();
        done.track.theta.push_back(move(from.alpha + share * (to.alpha - from.alpha), time, seconds));
        done.track.time.push_back(time);
      }
      done.rows.push_back(bench_.now());
    }
    return done;
  }

  /// Reading of the joint's sensor without noise.
  double read_joint_sensor(double theta, const Moment& now) {
    return joint_sensor_reading(hidden_, theta) + reading_(now);
  }
  Log read_sensors(const Way& way, const TrackedRun& followed) {
    const Track late = hidden_.lag_filter > 0 ? filter(followed.track, hidden_.lag_filter) : followed.track;
    Noise noise(sensors_, at_.run);
    Random walk(sensors_.seed * 7919 + 31 * at_.run + 1);
    Log log;
    log.reserve(way.size());
    for (std::size_t row = 0; row < way.size(); ++row) {
      if (way[row].reversal || row == 0) zero_walk_ += hidden_.zero_walk * walk.normal();
      const Moment& now = followed.rows[row];
      double theta = read_joint_sensor(late.at(way[row].time - hidden_.lag), now) + zero_walk_;
      if (!way[row].logged) continue;
      theta += noise.next();
      if (sensors_.quantum > 0) theta = sensors_.quantum * std::round(theta / sensors_.quantum);
      log.push_back(
          {time_ + way[row].time, way[row].alpha, theta, way[row].load, temperature_at(time_ + way[row].time)});
    }
    return log;
  }

  const HiddenFaults& as_mounted_;
  HiddenFaults hidden_;
  const SensorPlan& sensors_;
  const MotionPlan& motion_;
  double low_, high_;
  Bench bench_;
  Drive drive_;
  Actors reading_;
  Actors load_;
  Conditions at_;
  double time_ = 0;
  double zero_walk_ = 0;
};

/// A groove slightly wider than its tendon.
helix::HelixGroove groove_of(const Mechanism& mechanism) {
  const double depth = mechanism.groove_depth(), d = mechanism.tendon.diameter;
  return {depth, d, [depth, d](double step) { return d + 2.0 * depth + std::max(1.0, std::abs(step)); }};
}

MadeJoint make_helical_joint(const DeclaredMechanism& declared) {
  profile::SynthesisOptions options;
  options.chord_error_mm = 2e-4;
  const helix::HelixSynthesis made = helix::synthesise_helix(declared, groove_of(declared), options);
  if (!made.made()) throw InputError("rig", "no helical grooves for " + declared.name);
  MadeJoint joint{declared, {}, {}, made.stroke.front().alpha, made.stroke.back().alpha};
  const auto home = std::min_element(made.stroke.begin(), made.stroke.end(), [](const auto& a, const auto& b) {
    return std::abs(a.alpha) < std::abs(b.alpha);
  });
  for (std::size_t side = 0; side < 2; ++side) {
    const helix::HelixSide& own = made.sides[side];
    const double height = own.stroke[static_cast<std::size_t>(home - made.stroke.begin())].z;
    const auto at_home = static_cast<std::size_t>(&own.spiral.row_at(height) - own.spiral.rows.data());
    joint.spirals[side] = {own.spiral.rows, own.attachment_z, at_home};
  }
  return joint;
}

}  // namespace

HiddenFaults with_turned_sensors(HiddenFaults hidden, const RunPlan& plan) {
  hidden.motor_eccentricity_phase += plan.motor_turned;
  hidden.motor_harmonic_phase += hidden.motor_harmonic_order * plan.motor_turned;
  hidden.joint_eccentricity_phase += plan.joint_turned;
  hidden.joint_harmonic_phase += hidden.joint_harmonic_order * plan.joint_turned;
  return hidden;
}

double joint_sensor_reading(const HiddenFaults& hidden, double theta) {
  return hidden.zero + (1.0 + hidden.gain) * theta +
         wave(hidden.joint_eccentricity, 1, theta, hidden.joint_eccentricity_phase) +
         wave(hidden.joint_harmonic, hidden.joint_harmonic_order, theta, hidden.joint_harmonic_phase) +
         hidden.interpolation * std::sin(hidden.interpolation_per_turn * theta);
}

MadeJoint make_joint(const DeclaredMechanism& declared) {
  profile::SynthesisOptions options;
  options.chord_error_mm = 2e-5;
  options.advice = false;
  const profile::SynthesisResult made = profile::synthesise(declared, options);
  if (profile::needs_multi_turn(made)) return make_helical_joint(declared);
  if (!made.made()) throw InputError("rig", made.brief());
  return {declared, made.p1, made.p2, made.stroke.front().alpha, made.stroke.back().alpha};
}

std::vector<Log> log_runs(const MadeJoint& joint, const HiddenFaults& hidden, const std::vector<RunPlan>& runs,
                          const SensorPlan& sensors, const MotionPlan& motion) {
  Session session(joint, hidden, sensors, motion);
  std::vector<Log> logs;
  for (const RunPlan& plan : runs) logs.push_back(session.run(plan));
  return logs;
}

SensorPlan noiseless() { return {.noise = 0}; }

double rms_difference(const std::vector<Log>& one, const std::vector<Log>& other) {
  double squares = 0, rows = 0;
  for (std::size_t run = 0; run < one.size(); ++run) {
    for (std::size_t row = 0; row < one[run].size(); ++row, ++rows)
      squares += std::pow(one[run][row].theta - other[run][row].theta, 2);
  }
  return std::isfinite(squares) ? std::sqrt(squares / rows) : 0;
}

std::string csv_text(const Log& log, bool temperature, const RunPlan& plan) {
  std::string header = "time_s,alpha_deg,theta_deg,load_N", mounting;
  if (temperature) header += ",temperature_C";
  const auto turned = [&](const char* column, double angle) {
    if (angle == 0) return;
    header += std::string(",") + column;
    mounting += "," + shortest(degrees(angle));
  };
  turned("motor_sensor_turned_deg", plan.motor_turned);
  turned("joint_sensor_turned_deg", plan.joint_turned);
  std::string text = header + "\n";
  for (const Row& row : log) {
    text += fixed(row.time, 4) + "," + fixed(degrees(row.alpha), 4) + "," + fixed(degrees(row.theta), 5) + "," +
            shortest(row.load);
    if (temperature) text += "," + fixed(row.temperature, 2);
    text += mounting + "\n";
  }
  return text;
}

}  // namespace fusee::rig
