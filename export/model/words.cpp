#include "export/model/words.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"
#include "transmission/load.h"

namespace fusee::formats {

std::string c_prefix(const std::string& name) {
  std::string prefix;
  for (const char c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'), is_digit = c >= '0' && c <= '9';
    if (is_letter || (is_digit && !prefix.empty())) {
      prefix += c;
    } else if (!prefix.empty() && prefix.back() != '_') {
      prefix += '_';
    }
  }
  while (!prefix.empty() && prefix.back() == '_') prefix.pop_back();
  constexpr std::size_t k_longest = 40;
  return prefix.empty() ? "joint" : prefix.substr(0, k_longest);
}

namespace model_words {
namespace {

/// A round bar of 8 mm diameter and 2.5 g/cm³: the approximate mass of a printed or bought link, for each mm of length.
constexpr double k_link_mass_per_mm = 0.125e-3;  // kg
/// Inertia of a small geared servo at its output, pulley included.
constexpr double k_rotor_inertia = 1e-3;  // kg m²
constexpr double k_load_reserve = 3;      // the motor holds three times the load
constexpr double k_least_effort = 1;      // N m
/// Time steps per time constant of a constraint. Simulators require at least two.
constexpr double k_steps_per_constant = 4;
constexpr double k_motor_speed = 6.283;  // rad/s: 60 rpm

}  // namespace

std::string number(double value) { return rounded(value, 12); }
std::string coefficient(double value) { return rounded(value, 9); }

std::string c_float(float value) {
  char text[32];
  const float without_negative_zero = value == 0.0f ? 0.0f : value;
  const auto [end, error] = std::to_chars(text, text + sizeof(text), without_negative_zero);
  std::string result(text, end);
  if (result.find_first_of(".e") == std::string::npos) result += ".0";
  return result + "f";
}

std::string at_most_deg(double angle) {
  const double value = std::abs(degrees(angle));
  constexpr double k_rounding = 1e-6;  // below this only rounding remains
  if (!(value > k_rounding)) return "0.000001";
  const double scale = elementary::pow(10.0, 1 - std::floor(elementary::log10(value)));
  constexpr double k_almost_one = 1 - 1e-9;  // so that a value of two digits is not rounded up to the next one
  return rounded(std::ceil(value * scale * k_almost_one) / scale, 3);
}

std::vector<std::string> curve_words(const model::JointCurve& curve, const ModelProduct& product, bool of_sensor) {
  std::vector<std::string> lines;
  switch (curve.source) {
    case model::CurveSource::law:
      lines.push_back("The joint as declared: theta(alpha) is the law of the file, equal in both directions.");
      break;
    case model::CurveSource::identified:
      lines.push_back(
          "The joint as identified ([identified]), with the pulley that 'fusee build' makes of this file, simulated");
      lines.push_back(
          std::string("in both directions under its declared load. alpha: reading of the motor's sensor; theta: ") +
          (of_sensor ? "reading of" : "true"));
      lines.push_back(of_sensor ? "the joint's sensor." : "joint angle, mean of both directions.");
      break;
    case model::CurveSource::compensation:
      lines.push_back("From " + product.compensation +
                      ", with the shape of the target motion between its rows. alpha: reading of the");
      lines.push_back("motor's sensor; theta: reading of the joint's sensor.");
      break;
  }
  if (curve.half_hysteresis > 0)
    lines.push_back("Hysteresis at the joint: at most 2 x " + at_most_deg(curve.half_hysteresis) + " deg.");
  return lines;
}

std::string xml_comment(const std::vector<std::string>& lines) {
  std::string text = "<!--\n";
  for (const std::string& words : lines) {
    std::string line = cleaned_line(words);
    // "--" ends a comment too early.
    for (std::size_t at = line.find("--"); at != std::string::npos; at = line.find("--", at))
      line.replace(at, 2, "- -");
    text += "  " + line + "\n";
  }
  return text + "-->\n";
}

std::string xml_attribute(const std::string& text) { return escape_html(cleaned_line(text)); }

namespace {

/// The torque of a spring is k (θ − rest). Without stiffness it is constant.
void add_spring(SimulatedBody& body, const Spring& spring) {
  if (spring == Spring{}) return;
  if (spring.stiffness == 0) {
    body.load += spring.preload * 1e-3;
    body.words.push_back("Spring of [spring]: " + rounded(spring.preload * 1e-3) +
                         " N m against +theta at every angle.");
    return;
  }
  body.stiffness = spring.stiffness * 1e-3;
  body.spring_rest = spring.free - spring.preload / spring.stiffness;
  body.words.push_back("Spring of [spring]: " + rounded(body.stiffness) + " N m/rad, at rest at theta = " +
                       rounded(degrees(body.spring_rest)) + " deg. URDF has no springs: a plugin's work there.");
}

void add_link(SimulatedBody& body, const Mechanism& mechanism) {
  const Load& load = mechanism.load;
  const double R = mechanism.joint.R * 1e-3;
  body.has_weight = load.mass_kg > 0;
  body.mass = body.has_weight ? load.mass_kg : k_link_mass_per_mm * mechanism.joint.R;
  body.lever = body.has_weight ? load.lever * 1e-3 : 0.5 * R;
  body.inertia = body.mass * R * R / 12;
  if (body.has_weight) {
    body.words.push_back("Link: " + rounded(body.mass) + " kg at " + rounded(load.lever) +
                         " mm along OC, from [load]; straight up at theta = " + rounded(degrees(load.tilt)) + " deg.");
    body.words.push_back("Assumed: its moment of inertia about its centre is that of a thin rod as long as OC.");
  } else {
    body.words.push_back("[load] has no mass: the joint's axis is taken as vertical, so that weight has no torque.");
    body.words.push_back("Assumed: the link is a rod along OC of 0.125 g a millimetre, " + rounded(body.mass) + " kg.");
  }
}

void add_load(SimulatedBody& body, const Mechanism& mechanism) {
  const Load& load = mechanism.load;
  const double R = mechanism.joint.R * 1e-3;
  body.load = (load.tip_force * mechanism.joint.R + load.torque) * 1e-3;
  if (body.load == 0) return;
  body.inertia += std::abs(body.load) / transmission::k_gravity * R;
  body.words.push_back("Tip force and torque of [load]: " + rounded(body.load) + " N m against +theta at every angle.");
  body.words.push_back("Assumed: they have the inertia of a weight at C with the same force.");
}

/// Largest values over the range.
struct LoadExtremes {
  double slope = 0;         ///< dθ/dα
  double joint_torque = 0;  ///< of the declared load, N m
  double motor_torque = 0;  ///< that holds it without friction, N m
};

LoadExtremes load_extremes(const ModelProduct& product) {
  constexpr int k_samples = 20;
  const model::AngleMap& map = product.curves.physical.middle;
  LoadExtremes extremes;
  for (int i = 0; i <= k_samples; ++i) {
    const double alpha = std::lerp(map.alpha_min, map.alpha_max, double(i) / k_samples), slope = map.slope(alpha);
    extremes.slope = std::max(extremes.slope, slope);
    const double torque = std::abs(transmission::load_torque(product.mechanism, map.theta(alpha))) * 1e-3;
    extremes.joint_torque = std::max(extremes.joint_torque, torque);
    extremes.motor_torque = std::max(extremes.motor_torque, slope * torque);
  }
  return extremes;
}

/// A position servo with a bandwidth of 20 Hz that deflects by at most 5 deg under k_load_reserve times the load.
/// `inertia`: of all that it moves, at the motor, kg m².
void choose_servo(SimulatedBody& body, double inertia, double most_motor_torque) {
  constexpr double k_bandwidth = k_two_pi * 20, k_deflection = radians(5);
  body.kp = std::max(inertia * k_bandwidth * k_bandwidth, k_load_reserve * most_motor_torque / k_deflection);
  body.kv = 2 * std::sqrt(body.kp * inertia);  // critical damping
}

/// Constraints deflect by (1 − d) a t², with impedance d, time constant t, and a the acceleration that the load would
/// give link and motor if they were free. 1e-5 rad is about half of a table's default allowed error, 0.001°.
/// `inertia`: as in choose_servo(); `link_inertia`: about O, kg m².
void choose_time_step(SimulatedBody& body, double inertia, double link_inertia, double most_joint_torque) {
  constexpr double k_softness = 1e-4, k_deflection = 1e-5;  // 1 − d, rad
  constexpr double k_most_step = 1e-3;                      // s
  constexpr double k_step_per_servo_time = 0.1;             // of 1/ω of the servo
  const double acceleration = most_joint_torque * (1 / link_inertia + 1 / body.armature);
  const double most_constraint_time = acceleration > 0 ? std::sqrt(k_deflection / (k_softness * acceleration)) : 1;
  const double step = std::min(
      {k_most_step, k_step_per_servo_time * std::sqrt(inertia / body.kp), most_constraint_time / k_steps_per_constant});
  // One digit, rounded up or down. If up, half of the step is rounded instead, which stays below the whole.
  body.timestep = number_of(rounded(step, 1));
  if (body.timestep > step) body.timestep = number_of(rounded(0.5 * step, 1));
  body.constraint_time = k_steps_per_constant * body.timestep;
}

}  // namespace

SimulatedBody body_of(const ModelProduct& product) {
  const Mechanism& mechanism = product.mechanism;
  SimulatedBody body;
  add_link(body, mechanism);
  add_load(body, mechanism);
  add_spring(body, mechanism.spring);
  const LoadExtremes extremes = load_extremes(product);
  const transmission::Transmission law(mechanism);
  body.pulley_radius = law.at_alpha(0).t1.p * 1e-3;
  // The link's inertia at the motor, plus the rotor of a matched motor, or a small servo's at its output.
  const double link_inertia = body.inertia + body.mass * body.lever * body.lever;
  const double link_at_motor = link_inertia * extremes.slope * extremes.slope;
  body.armature = number_of(rounded(std::max(k_rotor_inertia, link_at_motor), 3));
  const double inertia = body.armature + link_at_motor;
  choose_servo(body, inertia, extremes.motor_torque);
  choose_time_step(body, inertia, link_inertia, extremes.joint_torque);
  body.effort = std::max(k_least_effort, k_load_reserve * extremes.motor_torque);
  body.speed = k_motor_speed;
  body.words.push_back("Assumed: the inertia of motor and pulley together is " + rounded(body.armature) +
                       " kg m2 about alpha, no less than link and load seen from there;");
  body.words.push_back("the motor has " + rounded(body.effort) + " N m and " + rounded(body.speed) +
                       " rad/s. Replace them by your own.");
  return body;
}

}  // namespace model_words
}  // namespace fusee::formats
