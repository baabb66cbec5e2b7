// URDF in m, kg, s and rad, in the mechanism's frame.

#include <cmath>

#include "base/text.h"
#include "export/model/words.h"
#include "export/tool.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

using namespace model_words;

/// Mass (kg) centred at (0, y) (m), with the moments of inertia (kg m²) about y (`along`), x (`across`) and z.
std::string inertial(double mass, double y, double along, double across, double about_z) {
  return "    <inertial>\n      <origin xyz=\"0 " + number(y) + " 0\"/>\n      <mass value=\"" + number(mass) +
         "\"/>\n      <inertia ixx=\"" + number(across) + "\" ixy=\"0\" ixz=\"0\" iyy=\"" + number(along) +
         "\" iyz=\"0\" izz=\"" + number(about_z) + "\"/>\n    </inertial>\n";
}

std::string link_of(const ModelProduct& product, const SimulatedBody& body) {
  const double R = product.mechanism.joint.R * 1e-3;
  const double width = 0.06 * R;  // for display only
  return "  <link name=\"link\">\n" +
         inertial(body.mass, body.lever, k_twist_share * body.inertia, body.inertia, body.inertia) +
         "    <visual>\n      <origin xyz=\"0 " + number(0.5 * R) + " 0\"/>\n      <geometry><box size=\"" +
         number(width) + " " + number(R) + " " + number(width) + "\"/></geometry>\n    </visual>\n  </link>\n";
}

std::string hinge(const std::string& name, const std::string& child, const std::string& origin, double low, double high,
                  double effort, double speed, const std::string& more = {}) {
  return "  <joint name=\"" + name + "\" type=\"revolute\">\n    <parent link=\"base_link\"/>\n    <child link=\"" +
         child + "\"/>\n    <origin xyz=\"" + origin + "\"/>\n    <axis xyz=\"0 0 -1\"/>\n    <limit lower=\"" +
         number(low) + "\" upper=\"" + number(high) + "\" effort=\"" + number(effort) + "\" velocity=\"" +
         number(speed) + "\"/>\n" + more + "  </joint>\n";
}

/// The limits of the joint follow from those of the motor.
std::string theta_joint(const ModelProduct& product, const SimulatedBody& body, const std::string& more) {
  const model::AngleMap& map = product.curves.physical.middle;
  const double slope = product.line.p.c[1];
  return hinge("theta", "link", "0 0 0", map.theta_min, map.theta_max, number_of(rounded(body.effort / slope)),
               number_of(rounded(body.speed * slope)), more);
}

std::string head(const ModelProduct& product, const std::vector<std::string>& coupling, const SimulatedBody& body) {
  std::vector<std::string> lines{product.mechanism.name + ", by " + std::string(k_tool) + " model"};
  for (const auto& more : {curve_words(product.curves.physical, product, false), coupling, body.words})
    lines.insert(lines.end(), more.begin(), more.end());
  return "<?xml version=\"1.0\"?>\n" + xml_comment(lines) + "<robot name=\"" + xml_attribute(product.mechanism.name) +
         "\">\n  <link name=\"base_link\"/>\n";
}

}  // namespace

std::string joint_urdf(const ModelProduct& product) {
  const SimulatedBody body = body_of(product);
  const model::AngleMap& map = product.curves.physical.middle;
  const Vec2 axis = transmission::pin_place(product.mechanism, transmission::Side::left, 0).pulley_axis();
  const std::string multiplier = coefficient(product.line.p.c[1]), offset = coefficient(product.line.p.c[0]);
  const std::vector<std::string> coupling = {
      "theta mimics alpha: URDF supports only a straight line. The best one (minimax) misses "
      "theta(alpha) by",
      at_most_deg(product.line.error) + " deg at most, over the whole range; torques by " +
          rounded(100 * product.line.slope_error, 2) + " % at most. joint.xml and joint_table.h are more accurate."};
  return head(product, coupling, body) + "  <link name=\"pulley\">\n" +
         inertial(k_pulley_mass, 0, k_disc_share * body.armature, k_disc_share * body.armature, body.armature) +
         "    <visual>\n      <geometry><cylinder radius=\"" + number(body.pulley_radius) +
         "\" length=\"0.01\"/></geometry>\n    </visual>\n  </link>\n" + link_of(product, body) +
         hinge("alpha", "pulley", "0 " + number(axis.y() * 1e-3) + " 0", map.alpha_min, map.alpha_max, body.effort,
               body.speed) +
         theta_joint(product, body,
                     "    <mimic joint=\"alpha\" multiplier=\"" + multiplier + "\" offset=\"" + offset + "\"/>\n") +
         "</robot>\n";
}

// ros2_control reads <ros2_control> from the robot's description: interfaces of a joint, and transmissions that a
// hardware component loads by their plugin's name. SimpleTransmission has joint = actuator/reduction + offset, with
// velocity and effort by the same reduction, which is a straight line. A joint that mimics another cannot be commanded,
// so the motor is an actuator here and not a joint.
std::string ros2_control_urdf(const ModelProduct& product) {
  const SimulatedBody body = body_of(product);
  const model::AngleMap& map = product.curves.physical.middle;
  const std::string name = product.prefix;
  const std::vector<std::string> coupling = {
      "For ros2_control: joint theta, and a SimpleTransmission from the actuator to it: theta = "
      "alpha/mechanical_reduction + offset,",
      "velocity and effort by the same reduction. The best line misses theta(alpha) by " +
          at_most_deg(product.line.error) + " deg at most,",
      "velocity and effort by " + rounded(100 * product.line.slope_error, 2) +
          " % at most. A hardware component or a transmission plugin that",
      "includes joint_table.h has them without that error: position " + name + "_theta_deg(), velocity and effort by " +
          name + "_slope().",
      "The hardware is ros2_control's mock: replace it by your own plugin."};
  // Without limits if low is not below high.
  const auto interface = [](const std::string& kind, const std::string& quantity, double low, double high) {
    const std::string tag = kind + "_interface";
    if (!(low < high)) return "      <" + tag + " name=\"" + quantity + "\"/>\n";
    return "      <" + tag + " name=\"" + quantity + "\">\n        <param name=\"min\">" + number(low) +
           "</param>\n        <param name=\"max\">" + number(high) + "</param>\n      </" + tag + ">\n";
  };
  return head(product, coupling, body) + link_of(product, body) + theta_joint(product, body, "") +
         "  <ros2_control name=\"" + name +
         "\" type=\"system\">\n    <hardware>\n      <plugin>mock_components/GenericSystem</plugin>\n    </hardware>\n "
         "   <joint name=\"theta\">\n" +
         interface("command", "position", map.theta_min, map.theta_max) + interface("state", "position", 0, 0) +
         interface("state", "velocity", 0, 0) + interface("state", "effort", 0, 0) +
         "    </joint>\n    <transmission name=\"" + name +
         "_transmission\">\n      <plugin>transmission_interface/SimpleTransmission</plugin>\n      <actuator name=\"" +
         name +
         "_motor\" role=\"actuator1\"/>\n      <joint name=\"theta\" role=\"joint1\">\n        <mechanical_reduction>" +
         coefficient(1 / product.line.p.c[1]) + "</mechanical_reduction>\n        <offset>" +
         coefficient(product.line.p.c[0]) +
         "</offset>\n      </joint>\n    </transmission>\n  </ros2_control>\n</robot>\n";
}

}  // namespace fusee::formats
