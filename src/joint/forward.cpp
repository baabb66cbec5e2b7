#include "joint/forward.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fusee/joint/simulate.h"
#include "joint/lower_path_table.h"

namespace fusee {
namespace {

/// Steps in which a joint is brought from home to where its run begins. What happened before the log is not known; a
/// joint that came straight from home is the least that can be assumed.
constexpr int k_approach = 24;

/// What sensors and play may add to the angles that were logged, rad.
constexpr double k_beyond = 0.1;

/// Far below any sensor's noise, and far below what a fit's steps move θ by. rad
constexpr double k_last_step = 1e-9;

constexpr double k_least_stiffness = 1e-3;  // of the declared EA

/// What the motor sensor hides.
double shaft_angle(double alpha, const Imperfections& at) {
  if (at.motor_eccentricity_sin == 0 && at.motor_eccentricity_cos == 0) return alpha + at.motor_offset;
  return alpha + at.motor_offset + at.motor_eccentricity_sin * std::sin(alpha) +
         at.motor_eccentricity_cos * (std::cos(alpha) - 1.0);
}

/// What a wave of the outline adds to the curve's support, and to the arc up to there.
struct SupportWave {
  double outward = 0;
  double arc = 0;
};

// Every point of the outline is moved along its normal by w. The farthest point along ψ is then a neighbour: beside w
// it gains w'²/(2ρ), with ρ the radius of curvature, for which the support stands.
SupportWave support_wave(double psi, double support, const Imperfections& at) {
  const double n = at.profile_harmonic;
  const double s = at.profile_sin;
  const double c = at.profile_cos;
  const double sine = std::sin(n * psi);
  const double cosine = std::cos(n * psi);
  const OutlineWave w = outline_wave(psi, at);
  const double squares =
      0.5 * n * n *
      ((s * s + c * c) * psi + ((s * s - c * c) * sine * cosine + s * c * (cosine * cosine - sine * sine)) / n);
  return {w.outward + 0.5 * w.slope * w.slope / support, (c * sine - s * cosine) / n + 0.5 * squares / support};
}

/// What the mechanism does not see: the same for all sensors.
Imperfections without_sensors(Imperfections at) {
  at.zero = at.gain = at.joint_eccentricity_sin = at.joint_eccentricity_cos = at.lag = 0;
  return at;
}

/// What the tendons' paths depend on.
Imperfections geometry(const Imperfections& at) {
  Imperfections key;
  key.joint_length = at.joint_length;
  key.radius_offset = at.radius_offset;
  key.pulley_scale = at.pulley_scale;
  key.runout_x = at.runout_x;
  key.runout_y = at.runout_y;
  key.guide_radius = at.guide_radius;
  key.guide_outward = at.guide_outward;
  key.guide_down = at.guide_down;
  key.profile_sin = at.profile_sin;
  key.profile_cos = at.profile_cos;
  key.profile_harmonic = at.profile_harmonic;
  return key;
}

double tip_force(const Run& run, const Sample& sample, const Mechanism& declared) {
  return run.has_load ? sample.load : declared.load.tip_force;
}

/// θ at the time `lag` earlier, straight between samples. Before the first sample the joint stood still.
std::vector<double> delayed(const Run& run, const std::vector<double>& theta, double lag) {
  std::vector<double> late(theta.size());
  std::size_t j = 0;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const double time = run.samples[i].time - lag;
    while (j + 1 < theta.size() && run.samples[j + 1].time <= time) ++j;
    const double from = run.samples[j].time;
    const double step = j + 1 < theta.size() ? run.samples[j + 1].time - from : 0.0;
    const double share = step > 0 ? std::clamp((time - from) / step, 0.0, 1.0) : 0.0;
    late[i] = share > 0 ? theta[j] + share * (theta[j + 1] - theta[j]) : theta[j];
  }
  return late;
}

double first_temperature(const Measurement& measurement) {
  for (const Run& run : measurement.runs) {
    if (run.has_temperature && !run.samples.empty()) return run.samples.front().temperature;
  }
  return 0;
}

/// As the joint's sensor shows it.
std::vector<double> shown(const Run& run, std::vector<double> theta, const Imperfections& at) {
  if (at.lag != 0) theta = delayed(run, theta, at.lag);
  for (double& angle : theta) {
    const double true_angle = angle;
    angle = at.zero + (1.0 + at.gain) * true_angle + at.joint_eccentricity_sin * std::sin(true_angle) +
            at.joint_eccentricity_cos * (std::cos(true_angle) - 1.0);
  }
  return theta;
}

double decades(const Run& run, const Sample& sample) {
  return std::log10(1.0 + std::max(0.0, sample.time - run.samples.front().time));
}

}  // namespace

OutlineWave outline_wave(double psi, const Imperfections& at) {
  const double n = at.profile_harmonic;
  const double outward = at.profile_sin * std::sin(n * psi) + at.profile_cos * std::cos(n * psi);
  const double slope = n * (at.profile_sin * std::cos(n * psi) - at.profile_cos * std::sin(n * psi));
  return {outward, slope, -n * n * outward};
}

double Play::to(double input) {
  output_ = std::clamp(output_, input - half_, input + half_);
  return output_;
}

Mechanism mounted(const Mechanism& declared, const Imperfections& at) {
  Mechanism mechanism = declared;
  mechanism.joint.R += at.joint_length;
  mechanism.guides.EB += at.guide_outward;
  mechanism.guides.ED += at.guide_outward;
  mechanism.guides.OE += at.guide_down;
  mechanism.pulley.EF -= at.guide_down;  // the pulley's axis stays
  mechanism.guides.radius = std::max(0.0, mechanism.guides.radius + at.guide_radius);
  mechanism.guides.mu = std::max(0.0, mechanism.guides.mu + at.friction);
  mechanism.tendon.modulus /= std::max(k_least_stiffness, 1.0 + at.stretch);
  mechanism.tendon.pretension = std::max(0.0, mechanism.tendon.pretension + at.pretension);
  return mechanism;
}

namespace {

/// Pulleys made for `declared` and imperfect themselves, seen from pins as mounted.
JointModel imperfect_geometry(const MadePulleys& made, const Mechanism& declared, const Imperfections& at) {
  const MadePulleys larger = made.offset_by(at.radius_offset / (1.0 + at.pulley_scale));
  JointModel model = joint_model(larger, mounted(declared, at));
  // The pulley's centre off the axis is, to a tendon, a pin that moves the other way; a pulley larger by a factor, pins
  // that stand closer by it.
  const bool as_made = at.pulley_scale == 0 && at.runout_x == 0 && at.runout_y == 0;
  if (!as_made) {
    model.lower = [larger, pins = model.pins, scale = 1.0 + at.pulley_scale, x = at.runout_x,
                   y = at.runout_y](double alpha) {
      const double c = std::cos(alpha);
      const double s = std::sin(alpha);
      const Vec2 centre(c * x + s * y, c * y - s * x);  // turned clockwise
      std::array<PinPlace, 2> seen = pins;
      for (std::size_t i = 0; i < 2; ++i) {
        const double sign = i == 0 ? -1.0 : 1.0;
        seen[i].e = (pins[i].e - sign * centre.x()) / scale;
        seen[i].ef = (pins[i].ef - centre.y()) / scale;
        seen[i].rho = pins[i].rho / scale;
      }
      std::array<LowerPath, 2> paths = larger.paths(seen, alpha);
      for (std::size_t i = 0; i < 2; ++i) {
        const double sign = i == 0 ? -1.0 : 1.0;
        paths[i].p =
            paths[i].p * scale + sign * centre.x() * std::cos(paths[i].normal) + centre.y() * std::sin(paths[i].normal);
        paths[i].reach *= scale;
        paths[i].wound *= scale;
      }
      return paths;
    };
  }
  // A wave moves the line that touches it and turns it too little to matter; on the left the image's arc runs the other
  // way.
  if (at.profile_sin != 0 || at.profile_cos != 0) {
    model.lower = [without = model.lower, at](double alpha) {
      std::array<LowerPath, 2> paths = without(alpha);
      const SupportWave left = support_wave(k_pi - paths[0].normal + alpha, paths[0].p, at);
      const SupportWave right = support_wave(paths[1].normal + alpha, paths[1].p, at);
      paths[0].p += left.outward;
      paths[0].wound -= left.arc;
      paths[1].p += right.outward;
      paths[1].wound += right.arc;
      return paths;
    };
  }
  return model;
}

// What is wound holds home's strain. With the strain of the moment the same numbers give a joint that yields under load
// by 15 % more where much is wound; six joints measured on a rig with other numerics (tests/data/rig) decide for this
// one, with residuals at the sensors' noise for both loads, directions and all places.
void set_imperfect_statics(JointModel& model, const Mechanism& declared, const Imperfections& at) {
  set_statics(model, mounted(declared, at));
  model.wound = WoundTendon::at_home;
  model.last_step = k_last_step;
  model.slack = 0.5 * at.slack;
  if (at.gravity_cos != 0 || at.gravity_sin != 0) {
    // weight · sin(tilt − θ) is added to what is declared.
    const double cos_part = model.weight * std::sin(model.tilt) + at.gravity_cos;
    const double sin_part = -model.weight * std::cos(model.tilt) + at.gravity_sin;
    model.weight = std::hypot(cos_part, sin_part);
    model.tilt = std::atan2(cos_part, -sin_part);
  }
}

void look_paths_up(JointModel& model, double least, double most) {
  const auto table = std::make_shared<const LowerPathTable>(model, least, most);
  model.lower = [table](double alpha) { return table->paths(alpha); };
  model.expected = [table](double alpha) { return table->expected(alpha); };
}

}  // namespace

JointModel imperfect_model(const MadePulleys& made, const Mechanism& declared, const Imperfections& at) {
  JointModel model = imperfect_geometry(made, declared, at);
  set_imperfect_statics(model, declared, at);
  return model;
}

std::vector<double> bench_clock(const Measurement& measurement) {
  std::vector<double> added;
  double end = -std::numeric_limits<double>::infinity();
  for (const Run& run : measurement.runs) {
    const double start = run.samples.empty() ? 0.0 : run.samples.front().time;
    added.push_back(start <= end ? end - start : 0.0);
    if (!run.samples.empty()) end = added.back() + run.samples.back().time;
  }
  return added;
}

Forward::Forward(const Mechanism& declared, const Measurement& measurement)
    : declared_(declared),
      measurement_(measurement),
      clock_(bench_clock(measurement)),
      first_temperature_(first_temperature(measurement)) {
  if (!declared.transmission) made_.emplace(declared);
  for (const Run& run : measurement.runs) {
    for (const Sample& sample : run.samples) {
      alpha_least_ = std::min(alpha_least_, sample.alpha);
      alpha_most_ = std::max(alpha_most_, sample.alpha);
    }
  }
}

JointMotion Forward::at_home(const Imperfections& at) {
  const Imperfections key = geometry(at);
  Geometry* known = nullptr;
  for (Geometry& latest : latest_geometry_) {
    if (latest.model && latest.key == key) known = &latest;
  }
  if (known == nullptr) {
    known = &latest_geometry_[next_geometry_++ % latest_geometry_.size()];
    *known = {key, imperfect_geometry(*made_, declared_, key)};
    look_paths_up(*known->model, alpha_least_ - k_beyond, alpha_most_ + k_beyond);
  }
  JointModel model = *known->model;
  set_imperfect_statics(model, declared_, at);
  return JointMotion(std::move(model));
}

TendonChange Forward::change(std::size_t index, const Sample& sample, const Imperfections& at) const {
  const Run& run = measurement_.runs[index];
  TendonChange change;
  change.compliance = 1.0 + at.creep * (at.creep != 0 ? decades(run, sample) : 0.0);
  if (run.has_temperature) {
    const double warmer = sample.temperature - first_temperature_;
    change.expansion = {at.thermal1 * warmer, at.thermal2 * warmer};
  }
  if (sample.time + clock_[index] >= at.slip_time) change.released = {std::max(0.0, at.slip), std::max(0.0, -at.slip)};
  return change;
}

void Forward::elastic(std::size_t index, JointMotion motion, const Imperfections& at, Motion& into) const {
  const Run& run = measurement_.runs[index];
  std::vector<double>& theta = into.theta.emplace_back();
  std::vector<double>& loose = into.loose.emplace_back();
  if (run.samples.empty()) return;
  Play play(at.backlash, 0.0);
  const auto step = [&](double alpha, const Sample& sample) {
    const double pulley = play.to(shaft_angle(alpha, at));
    return motion.to({pulley, tip_force(run, sample, declared_), declared_.load.torque, change(index, sample, at)});
  };
  const Sample& first = run.samples.front();
  for (int i = 1; i < k_approach; ++i) step(first.alpha * i / k_approach, first);
  for (const Sample& sample : run.samples) {
    const EquilibriumPoint point = step(sample.alpha, sample);
    const bool held = point.status != EquilibriumStatus::no_equilibrium;
    theta.push_back(held ? point.theta + 0.5 * (point.loose_above - point.loose_below)
                         : std::numeric_limits<double>::quiet_NaN());
    loose.push_back(0.5 * (point.loose_above + point.loose_below));
  }
}

std::vector<double> Forward::geared(std::size_t index, const Imperfections& at) const {
  const Run& run = measurement_.runs[index];
  std::vector<double> theta;
  theta.reserve(run.samples.size());
  if (run.samples.empty()) return theta;
  const double ratio = declared_.transmission->ratio;
  Play play(at.backlash, shaft_angle(0.0, at));
  const double start = run.samples.front().alpha;
  for (int i = 1; i < k_approach; ++i) play.to(shaft_angle(start * i / k_approach, at));
  double direction = 0;
  double before = play.to(shaft_angle(start, at));
  for (const Sample& sample : run.samples) {
    const double pulley = play.to(shaft_angle(sample.alpha, at));
    if (pulley != before) direction = (pulley > before) == (ratio > 0) ? 1.0 : -1.0;
    before = pulley;
    const double load = run.has_load ? sample.load : 0.0;
    double angle = pulley / ratio - at.compliance * load - at.dry_friction * std::abs(load) * direction;
    if (at.drift != 0) angle -= at.drift * load * decades(run, sample);
    if (at.step != 0 && sample.time + clock_[index] >= at.slip_time) angle += at.step;
    if (run.has_temperature) angle += at.warmth * (sample.temperature - first_temperature_);
    theta.push_back(angle);
  }
  return theta;
}

const Forward::Motion& Forward::mechanism(const Imperfections& imperfections) {
  const Imperfections key = without_sensors(imperfections);
  for (const Motion& motion : latest_) {
    if (motion.key == key && !motion.theta.empty()) return motion;
  }
  Motion& place = latest_[next_++ % latest_.size()];
  place = {key, {}, {}};
  std::optional<JointMotion> home;
  if (made_) home.emplace(at_home(key));
  for (std::size_t i = 0; i < measurement_.runs.size(); ++i) {
    if (home) {
      elastic(i, *home, key, place);
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
    readings[i] = shown(measurement_.runs[i], std::move(readings[i]), imperfections);
  return readings;
}

std::vector<std::vector<double>> predict(const Mechanism& declared, const Imperfections& imperfections,
                                         const Measurement& measurement) {
  return Forward(declared, measurement)(imperfections);
}

}  // namespace fusee
