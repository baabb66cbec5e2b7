#include "rig/rig.h"

#include <algorithm>
#include <cmath>

#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"
#include "fusee/profile/synthesis.h"
#include "rig/bench.h"
#include "rig/random.h"

namespace fusee::rig {
namespace {

constexpr int k_approach = 40;  // steps from home to the start of the sweep
constexpr int k_loading = 8;    // steps in which the load comes on
constexpr int k_lag_steps = 4;  // between rows, where a late sensor shows what was there between them
constexpr int k_dwell_rows = 10;
constexpr double k_warm = 31.0;           // °C, when the session begins
constexpr double k_cooling = 11.0;        // K, in the end
constexpr double k_cooling_time = 150.0;  // s

double temperature_at(double time) { return k_warm - k_cooling * (1.0 - std::exp(-time / k_cooling_time)); }

/// Where the motor's sensor is taken to, by increasing time.
struct Way {
  std::vector<double> time;
  std::vector<double> alpha;
  std::vector<bool> reversal;  ///< a new stroke begins here
};

Way planned_way(const RunPlan& plan, const MotionPlan& motion, double low, double high) {
  Way way;
  const double step_time = (high - low) / motion.rows_per_stroke / plan.speed;
  double time = 0;
  const auto add = [&](double alpha, bool reversal) {
    way.time.push_back(time);
    way.alpha.push_back(alpha);
    way.reversal.push_back(reversal);
  };
  add(low, false);
  for (int stroke = 0; stroke < 2 * plan.cycles; ++stroke) {
    const double from = stroke % 2 == 0 ? low : high;
    const double to = stroke % 2 == 0 ? high : low;
    for (int row = 1; row <= motion.rows_per_stroke; ++row) {
      time += step_time;
      add(from + (to - from) * row / motion.rows_per_stroke, row == 1 && stroke > 0);
    }
    for (int row = 0; plan.dwell > 0 && row < k_dwell_rows; ++row) {
      time += plan.dwell / k_dwell_rows;
      add(to, false);
    }
  }
  return way;
}

/// From the motor's sensor to the pulley, with the play's memory.
class Drive {
 public:
  Drive(const Hidden& hidden, double stroke)
      : hidden_(hidden), seat_(0.5 * stroke), shaft_(shaft(0.0)), pulley_(shaft_) {}

  double to(double alpha) {
    const double now = shaft(alpha);
    travel_ += std::abs(now - shaft_);
    shaft_ = now;
    pulley_ = std::clamp(pulley_, shaft_ - 0.5 * hidden_.backlash, shaft_ + 0.5 * hidden_.backlash);
    return pulley_ + (hidden_.bedding != 0 ? hidden_.bedding * std::exp(-travel_ / seat_) : 0.0);
  }
  /// The pulley goes back off its seat.
  void begin_run() { travel_ = 0; }

 private:
  double shaft(double alpha) const {
    const double eccentric = hidden_.motor_eccentricity * (std::sin(alpha + hidden_.motor_eccentricity_phase) -
                                                           std::sin(hidden_.motor_eccentricity_phase));
    return alpha + hidden_.motor_offset + eccentric + hidden_.cogging * std::sin(hidden_.cogging_per_turn * alpha);
  }

  const Hidden& hidden_;
  double seat_;
  double shaft_;
  double pulley_;
  double travel_ = 0;
};

/// θ at moments a little closer than the rows.
struct Track {
  std::vector<double> time;
  std::vector<double> theta;

  /// Straight between moments; before the first one the joint stood still.
  double at(double moment) const {
    const auto after = std::upper_bound(time.begin(), time.end(), moment);
    if (after == time.begin()) return theta.front();
    if (after == time.end()) return theta.back();
    const auto i = static_cast<std::size_t>(after - time.begin());
    const double share = (moment - time[i - 1]) / (time[i] - time[i - 1]);
    return theta[i - 1] + share * (theta[i] - theta[i - 1]);
  }
};

/// What went before in this session.
struct Session {
  double time = 0;
  std::array<double, 2> let_go{};
  double zero_walk = 0;
};

Track follow(const MadeJoint& joint, const Hidden& hidden, const RunPlan& plan, const Way& way, std::size_t run,
             Session& session) {
  Bench bench(joint, hidden);
  Drive drive(hidden, *std::max_element(way.alpha.begin(), way.alpha.end()) - way.alpha.front());
  Conditions at;
  at.let_go = session.let_go;
  at.warmth = temperature_at(session.time) - k_warm;
  for (int i = 1; i <= k_approach; ++i) {
    const double alpha = way.alpha.front() * i / k_approach;
    bench.to(drive.to(alpha), alpha, at);
  }
  drive.begin_run();
  for (int i = 1; i <= k_loading; ++i) {
    at.load = plan.load * i / k_loading;
    bench.to(drive.to(way.alpha.front()), way.alpha.front(), at);
  }
  const int steps = hidden.lag > 0 ? k_lag_steps : 1;
  const bool slips = hidden.slip != 0 && run == hidden.slip_run;
  const double slip_time = hidden.slip_at * way.time.back();
  Track track{{0.0}, {bench.to(drive.to(way.alpha.front()), way.alpha.front(), at)}};
  for (std::size_t row = 1; row < way.time.size(); ++row) {
    for (int step = 1; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      const double time = way.time[row - 1] + share * (way.time[row] - way.time[row - 1]);
      const double alpha = way.alpha[row - 1] + share * (way.alpha[row] - way.alpha[row - 1]);
      at.seconds = time - track.time.back();
      at.creep_time = time;
      at.warmth = temperature_at(session.time + time) - k_warm;
      if (slips && time >= slip_time) at.let_go[hidden.slip_side] = session.let_go[hidden.slip_side] + hidden.slip;
      track.time.push_back(time);
      track.theta.push_back(bench.to(drive.to(alpha), alpha, at));
    }
  }
  session.let_go = at.let_go;
  return track;
}

/// The joint's sensor, but for noise.
double shown(double theta, const Hidden& hidden) {
  const double phase = hidden.joint_eccentricity_phase;
  return hidden.zero + (1.0 + hidden.gain) * theta +
         hidden.joint_eccentricity * (std::sin(theta + phase) - std::sin(phase)) +
         hidden.interpolation * std::sin(hidden.interpolation_per_turn * theta);
}

/// White noise with a memory.
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

Log sensed(const Track& track, const Way& way, const RunPlan& plan, const Hidden& hidden, const SensorPlan& sensors,
           std::size_t run, Session& session) {
  Noise noise(sensors, run);
  Random walk(sensors.seed * 7919 + 31 * run + 1);
  Log log;
  log.reserve(way.time.size());
  for (std::size_t row = 0; row < way.time.size(); ++row) {
    if (way.reversal[row] || row == 0) session.zero_walk += hidden.zero_walk * walk.normal();
    double theta = shown(track.at(way.time[row] - hidden.lag), hidden) + session.zero_walk + noise.next();
    if (sensors.quantum > 0) theta = sensors.quantum * std::round(theta / sensors.quantum);
    const double time = session.time + way.time[row];
    log.push_back({time, way.alpha[row], theta, plan.load, temperature_at(time)});
  }
  return log;
}

}  // namespace

MadeJoint make_joint(const DeclaredMechanism& declared) {
  SynthesisOptions options;
  options.tolerance = 2e-5;
  options.advice = false;
  const SynthesisResult made = synthesise(declared, options);
  if (!made.made()) throw InputError("rig", made.brief());
  return {declared, made.p1, made.p2, made.stroke.front().alpha, made.stroke.back().alpha};
}

std::vector<Log> log_runs(const MadeJoint& joint, const Hidden& hidden, const std::vector<RunPlan>& runs,
                          const SensorPlan& sensors, const MotionPlan& motion) {
  Session session;
  std::vector<Log> logs;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const Way way = planned_way(runs[run], motion, motion.reach * joint.alpha_min, motion.reach * joint.alpha_max);
    const Track track = follow(joint, hidden, runs[run], way, run, session);
    logs.push_back(sensed(track, way, runs[run], hidden, sensors, run, session));
    session.time += way.time.back() + motion.pause;
  }
  return logs;
}

std::vector<RunPlan> full_protocol(double load) {
  constexpr double fast = radians(90.0);
  constexpr double slow = radians(12.0);
  return {{0.0, slow, 3, 0.0},
          {load, slow, 3, 0.0},
          {0.0, fast, 4, 0.0},
          {0.5 * load, slow, 2, 0.0},
          {-load, slow, 2, 0.0}};
}

std::vector<RunPlan> single_protocol() { return {{0.0, radians(12.0), 2, 0.0}}; }

std::string csv_text(const Log& log, bool temperature) {
  std::string text =
      temperature ? "time_s,alpha_deg,theta_deg,load_N,temperature_C\n" : "time_s,alpha_deg,theta_deg,load_N\n";
  for (const Row& row : log) {
    text += fixed(row.time, 4) + "," + fixed(degrees(row.alpha), 4) + "," + fixed(degrees(row.theta), 5) + "," +
            shortest(row.load);
    if (temperature) text += "," + fixed(row.temperature, 2);
    text += "\n";
  }
  return text;
}

}  // namespace fusee::rig
