/// \file
/// Internal: texts in the files of a model, and the assumed body behind the joint.
#pragma once

#include <string>
#include <vector>

#include "fusee/export.h"

namespace fusee::formats::model_words {

/// Twelve digits.
std::string number(double value);
/// Nine digits: the accuracy of a fit. Further digits differ between compilers.
std::string coefficient(double value);
/// The shortest C literal that reads back as the same float: "1.5f".
std::string c_float(float value);
/// Upper bound in degrees: two digits, rounded up, and at least 0.000001.
std::string at_most_deg(double angle);

/// The meaning and source of α and θ in these files. `of_sensor`: θ is the reading of the joint's sensor, else the true
/// angle.
std::vector<std::string> curve_words(const model::JointCurve& curve, const ModelProduct& product, bool of_sensor);
/// Moments of inertia that have no influence on the joint, relative to those that have: of the link about its length,
/// and of motor and pulley across their axis.
inline constexpr double k_twist_share = 0.05, k_disc_share = 0.6;
/// Mass of the pulley, kg. Its centre does not move, so that it has no influence.
inline constexpr double k_pulley_mass = 0.01;

/// The lines as an XML comment, without the characters that it forbids.
std::string xml_comment(const std::vector<std::string>& lines);
std::string xml_attribute(const std::string& text);

/// The link and the pulley for a simulator. SI units. `words`: the values that the file gives, and each value that is
/// assumed because the file does not give it.
struct SimulatedBody {
  double mass = 0;             ///< of the link, kg
  double lever = 0;            ///< from O along OC to the centre of that mass, m
  double inertia = 0;          ///< about that centre, kg m²
  bool has_weight = false;     ///< the file gives the link's weight
  double armature = 0;         ///< of pulley and motor about G, kg m²
  double pulley_radius = 0;    ///< mean moment arm, m
  double load = 0;             ///< constant torque against +θ: tip force, torque, a spring without stiffness, N m
  double stiffness = 0;        ///< of [spring], N m/rad
  double spring_rest = 0;      ///< θ at which that spring exerts no torque, rad
  double effort = 0;           ///< largest torque of the motor, N m
  double speed = 0;            ///< of the motor, rad/s
  double kp = 0, kv = 0;       ///< of a position servo, N m/rad and N m s/rad
  double timestep = 0;         ///< time step for a simulator, s
  double constraint_time = 0;  ///< time constant of constraints, s
  std::vector<std::string> words;
};
SimulatedBody body_of(const ModelProduct& product);

}  // namespace fusee::formats::model_words
