/// \file
/// Internal: what the files of a model say of themselves and of the body behind the joint.
#pragma once

#include <string>
#include <vector>

#include "fusee/export/model.h"

namespace fusee::model_words {

/// Twelve digits.
std::string number(double value);
/// Nine: all that a fit has, and the same from every compiler.
std::string coefficient(double value);
/// The shortest text that reads back as the same float, as C has it: "1.5f".
std::string c_float(float value);
/// Degrees for a person, rounded up, so that what is said bounds what is; nothing is nearer than a millionth.
std::string at_most_deg(double angle);

/// What α and θ are in these files, and where they come from.
std::vector<std::string> of_curve(const JointCurve& curve, const ModelProduct& product, bool shown);
/// Lines without what XML does not take in a comment.
std::string xml_comment(const std::vector<std::string>& lines);
std::string xml_attribute(const std::string& text);

/// The link and the pulley as a simulator needs them. SI units; what the file does not say is an assumption that
/// `words` names.
struct SimulatedBody {
  double mass = 0;           ///< of the link, kg
  double lever = 0;          ///< from O along OC to the centre of that mass, m
  double inertia = 0;        ///< about that centre, kg m²
  bool weighs = false;       ///< whether the file says what the link weighs
  double armature = 0;       ///< of pulley and motor about G, kg m²
  double pulley_radius = 0;  ///< mean moment arm, m
  double load = 0;           ///< constant torque against +θ: tip force, torque, a spring without stiffness, N m
  double stiffness = 0;      ///< of [spring], N m/rad
  double spring_rest = 0;    ///< θ at which that spring would not turn the joint, rad
  double effort = 0;         ///< what the motor can turn with, N m
  double speed = 0;          ///< rad/s
  double kp = 0, kv = 0;     ///< of a position servo, N m/rad and N m s/rad
  double timestep = 0;       ///< with which a simulator follows it, s
  double constant = 0;       ///< of constraints, s
  std::vector<std::string> words;
};
SimulatedBody body_of(const ModelProduct& product);

}  // namespace fusee::model_words
