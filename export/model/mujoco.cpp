// MJCF in m, kg, s and rad. The frame is the mechanism's, with z towards the viewer: α and θ turn clockwise, about −z.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/text.h"
#include "export/model/words.h"
#include "export/tool.h"
#include "fusee/base.h"
#include "transmission/load.h"

namespace fusee::formats {
namespace {

using namespace model_words;

constexpr double k_tendon_height = 0.004;  // m, above and below the middle plane, for display only

/// Solver parameters for the stiffest stable constraints: time constant and damping ratio, and an impedance of 0.9999,
/// which choose_time_step() in words.cpp assumes.
std::string stiff(const SimulatedBody& body) {
  return "solref=\"" + number(body.constraint_time) + " 1\" solimp=\"0.9999 0.9999 0.001\"";
}

std::string metres(double mm) { return number(mm * 1e-3); }
std::string position(const Vec2& at, double z = 0) { return metres(at.x()) + " " + metres(at.y()) + " " + number(z); }

/// The coefficients of a polynomial of degree k_equality_degree. Missing ones are 0.
std::string coefficients(const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i <= model::k_equality_degree; ++i)
    text += (i > 0 ? " " : "") + coefficient(i < values.size() ? values[i] : 0.0);
  return text;
}

/// Converts a polynomial in an angle, with values in mm, to one in the length `arm` times that angle, in m.
model::Polynomial over_arm(model::Polynomial p, double arm) {
  double power = 1e-3;
  for (double& c : p.c) {
    c *= power;
    power /= arm;
  }
  return p;
}

/// tests/oracle/judge_model.py allows for this compliance too.
const std::string k_compliance =
    "MuJoCo's equalities are slightly compliant: by about 0.001 deg, driven through the range in 3 s.";

std::vector<std::string> bounds_of(const ModelProduct& product) {
  const model::AngleMap& map = product.curves.physical.middle;
  const auto degs = [](double angle) { return rounded(degrees(angle), 6); };
  return {"alpha (motor) from " + degs(map.alpha_min) + " to " + degs(map.alpha_max) + " deg, theta (joint) from " +
          degs(map.theta_min) + " to " + degs(map.theta_max) + " deg."};
}

std::string opening(const ModelProduct& product, const SimulatedBody& body, const std::vector<std::string>& coupling) {
  const Mechanism& mechanism = product.mechanism;
  std::vector<std::string> lines{mechanism.name + ", by " + std::string(k_tool) + " model"};
  for (const auto& more :
       {curve_words(product.curves.physical, product, false), bounds_of(product), coupling, body.words})
    lines.insert(lines.end(), more.begin(), more.end());
  const double tilt = mechanism.load.tilt;
  const std::string gravity = body.has_weight ? number(-transmission::k_gravity * elementary::sin(tilt)) + " " +
                                                    number(-transmission::k_gravity * elementary::cos(tilt)) + " 0"
                                              : "0 0 " + number(-transmission::k_gravity);
  return "<mujoco model=\"" + xml_attribute(mechanism.name) + "\">\n" + xml_comment(lines) +
         "  <compiler angle=\"radian\" autolimits=\"true\"/>\n  <option timestep=\"" + number(body.timestep) +
         "\" integrator=\"implicitfast\" gravity=\"" + gravity + "\"/>\n  <statistic center=\"0 0 0\" extent=\"" +
         metres(2 * mechanism.joint.R) +
         "\"/>\n  <default>\n    <geom contype=\"0\" conaffinity=\"0\" group=\"1\"/>\n  </default>\n";
}

/// Pulley and link; `world` and `link` are additional elements.
std::string bodies(const ModelProduct& product, const SimulatedBody& body, const std::string& world,
                   const std::string& link) {
  const Mechanism& mechanism = product.mechanism;
  const model::AngleMap& map = product.curves.physical.middle;
  const Vec2 axis = transmission::pin_place(mechanism, transmission::Side::left, 0).pulley_axis();
  const std::string link_radius = number(0.03 * mechanism.joint.R * 1e-3);  // for display only
  const double armature = body.armature, inertia = body.inertia;
  const std::string spring = body.stiffness == 0 ? ""
                                                 : " stiffness=\"" + number(body.stiffness) + "\" springref=\"" +
                                                       number(body.spring_rest) + "\"";
  std::string text = "  <worldbody>\n    <light pos=\"0 0 " + metres(5 * mechanism.joint.R) + "\"/>\n" + world;
  text += "    <body name=\"pulley\" pos=\"" + position(axis) +
          "\">\n      <joint name=\"alpha\" type=\"hinge\" axis=\"0 0 -1\" range=\"" + number(map.alpha_min) + " " +
          number(map.alpha_max) + "\"/>\n      <inertial pos=\"0 0 0\" mass=\"" + number(k_pulley_mass) +
          "\" diaginertia=\"" + number(k_disc_share * armature) + " " + number(k_disc_share * armature) + " " +
          number(armature) + "\"/>\n      <geom name=\"pulley\" type=\"cylinder\" size=\"" +
          number(body.pulley_radius) +
          " 0.005\" rgba=\"0.8 0.75 0.6 1\"/>\n      <geom name=\"mark\" type=\"capsule\" fromto=\"0 0 0.006 0 " +
          number(body.pulley_radius) + " 0.006\" size=\"" + number(0.1 * body.pulley_radius) +
          "\" rgba=\"0.2 0.2 0.2 1\"/>\n    </body>\n";
  text += "    <body name=\"link\" pos=\"0 0 0\">\n      <joint name=\"theta\" type=\"hinge\" axis=\"0 0 -1\"" +
          spring + "/>\n      <inertial pos=\"0 " + number(body.lever) + " 0\" mass=\"" + number(body.mass) +
          "\" diaginertia=\"" + number(inertia) + " " + number(k_twist_share * inertia) + " " + number(inertia) +
          "\"/>\n      <geom name=\"link\" type=\"capsule\" fromto=\"0 0 0 0 " + metres(mechanism.joint.R) +
          " 0\" size=\"" + link_radius + "\" rgba=\"0.35 0.5 0.65 1\"/>\n" + link + "    </body>\n  </worldbody>\n";
  return text;
}

std::string ending(const ModelProduct& product, const SimulatedBody& body) {
  const model::AngleMap& map = product.curves.physical.middle;
  std::string text = "  <actuator>\n    <position name=\"motor\" joint=\"alpha\" kp=\"" + number(body.kp) + "\" kv=\"" +
                     number(body.kv) + "\" ctrlrange=\"" + number(map.alpha_min) + " " + number(map.alpha_max) +
                     "\" forcerange=\"" + number(-body.effort) + " " + number(body.effort) + "\"/>\n";
  if (body.load != 0)
    text += "    <general name=\"load\" joint=\"theta\" gainprm=\"0\" biastype=\"affine\" biasprm=\"" +
            number(-body.load) + " 0 0\"/>\n";
  return text +
         "  </actuator>\n  <sensor>\n    <jointpos name=\"alpha\" joint=\"alpha\"/>\n    <jointpos name=\"theta\" "
         "joint=\"theta\"/>\n"
         "    <actuatorfrc name=\"motor_torque\" actuator=\"motor\"/>\n  </sensor>\n</mujoco>\n";
}

std::string pin_name(transmission::Side side) { return side == transmission::Side::left ? "pin_B" : "pin_D"; }
std::string tendon_number(transmission::Side side) { return side == transmission::Side::left ? "1" : "2"; }

/// Pins or idlers. `drawn_radius`: least radius, mm, so that a pin without radius can be seen.
std::string pins(const Mechanism& mechanism, double drawn_radius) {
  std::string text;
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const transmission::PinPlace at = transmission::pin_place(mechanism, side, mechanism.seen_pitch_radius());
    const double radius = std::max(at.rho, drawn_radius);
    text += "    <geom name=\"" + pin_name(side) + "\" type=\"cylinder\" pos=\"" +
            position({transmission::mirror_sign(side) * at.pin().x(), at.pin().y()}) + "\" size=\"" + metres(radius) +
            " 0.008\" rgba=\"0.6 0.6 0.6 1\"/>\n";
  }
  return text;
}

/// The link's drum. In joint.xml it is for display only; in joint_tendons.xml the tendons wrap round it.
std::string drum(const Mechanism& mechanism) {
  if (!(mechanism.joint.drum_radius > 0)) return "";
  const Attachment& centre = mechanism.joint.drum_centre;
  return "      <geom name=\"drum\" type=\"cylinder\" pos=\"" + position({centre.across, centre.along}) + "\" size=\"" +
         metres(mechanism.drum_pitch_radius()) + " 0.006\" rgba=\"0.35 0.5 0.65 0.6\"/>\n";
}

/// A point of a tendon, mm; z in m.
std::string site(const std::string& name, const Vec2& at, double z) {
  return "site name=\"" + name + "\" pos=\"" + position(at, z) + "\" size=\"0.001\"/>\n";
}

/// A point on the side of a cylinder over which a tendon is wrapped; invisible.
std::string side_site(const std::string& name, const Vec2& at, double z) {
  return "site name=\"" + name + "\" pos=\"" + position(at, z) + "\" size=\"0.0005\" rgba=\"0 0 0 0\"/>\n";
}

/// Sites of the world and of the link, and the path of a tendon.
struct TendonText {
  std::string world, link, path;

  void add_site(const std::string& name) { path += "      <site site=\"" + name + "\"/>\n"; }
  void add_wrap(const std::string& geom, const std::string& side_site) {
    path += "      <geom geom=\"" + geom + "\" sidesite=\"" + side_site + "\"/>\n";
  }
};

void add_drum(TendonText& text, const model::WrappedTendon& tendon, const std::string& n, double z) {
  for (std::size_t i = 0; i < tendon.on_drum.size(); ++i) {
    const std::string name = "on_drum_" + n + "_" + std::to_string(i + 1);
    text.link += "      <" + site(name, tendon.on_drum[i], z);
    text.add_site(name);
  }
  text.world += "    <" + side_site("beside_drum_" + n, tendon.drum_outer, z);
  text.world += "    <" + site("off_drum_" + n, tendon.off_drum, z);
  text.add_wrap("drum", "beside_drum_" + n);
  text.add_site("off_drum_" + n);
}

TendonText text_of(const model::WrappedTendon& tendon, bool ends_in_C) {
  TendonText text;
  const std::string n = tendon_number(tendon.side), end = (ends_in_C ? "C_" : "A_") + n;
  const double z = tendon.side == transmission::Side::left ? -k_tendon_height : k_tendon_height;
  text.world += "    <" + site("anchor_" + n, tendon.anchor, z);
  text.link += "      <" + site(end, tendon.end, z);
  text.add_site(end);
  if (tendon.drum > 0) add_drum(text, tendon, n, z);
  if (tendon.rho > 0) {
    text.world += "    <" + side_site("outer_" + n, tendon.outer, z);
    text.add_wrap(pin_name(tendon.side), "outer_" + n);
  } else {
    text.world += "    <" + site("over_" + n, tendon.pin, z);
    text.add_site("over_" + n);
  }
  text.add_site("anchor_" + n);
  if (tendon.sheath_exit) {
    text.world += "    <" + site("sheath_exit_" + n, *tendon.sheath_exit, z);
    text.add_site("sheath_exit_" + n);
  }
  return text;
}

/// Describes the tendons' path, and the parts of it that MuJoCo cannot represent.
std::vector<std::string> path_words(const ModelProduct& product) {
  const model::TendonModel& model = *product.tendons;
  const Mechanism& mechanism = product.mechanism;
  const std::string constrained = tendon_number(model.constrained);
  const std::string pin = mechanism.guides.kind == GuideKind::idler ? "idler" : "pin";
  const std::string length_words = model.length.c.size() == 2
                                       ? " is its radius times alpha: P" + constrained + " is round."
                                       : " is a polynomial of alpha (degree 4).";
  const std::string error_words =
      "It misses theta(alpha) by " + at_most_deg(model.error) + " deg at most, over the whole range.";
  const std::string other_tendon_words = " The other tendon is drawn without a constraint:";
  if (mechanism.is_papers()) {
    return {
        "Both tendons run over their pins; MuJoCo wraps them round cylinders and spheres only, so that below its pin "
        "each ends",
        "at a fixed point. The length of tendon " + constrained + " taken in by pulley P" + constrained + length_words,
        error_words + other_tendon_words,
        "its length follows from theta. No friction at the pins: MuJoCo's tendons have none."};
  }
  std::vector<std::string> lines{
      std::string(mechanism.joint.drum_radius > 0 ? "Tendons run over the link's drum and their "
                                                  : "Tendons run over their ") +
          pin + "s; MuJoCo wraps them round cylinders and spheres only, so that below its " + pin + " each ends",
      "at a fixed point. The length of tendon " + constrained + " taken in by pulley P" + constrained + length_words};
  const bool has_both_tendons = model.omission[0].empty() && model.omission[1].empty();
  lines.push_back(error_words + (has_both_tendons ? other_tendon_words : ""));
  if (has_both_tendons) lines.push_back("its length follows from theta.");
  for (std::size_t i = 0; i < 2; ++i) {
    if (!model.omission[i].empty())
      lines.push_back("Tendon " + std::to_string(i + 1) + " is not in this file: " + model.omission[i] + ".");
  }
  if (mechanism.sheath.is_there())
    lines.push_back(
        "Between the ends of its sheath a tendon is drawn straight: the sheath's true course and length, its "
        "compliance and its friction are not in this file.");
  lines.push_back("No friction at drum, pins and bearings: MuJoCo's tendons have none" +
                  std::string(pin == "idler" ? ", and idlers do not turn." : "."));
  return lines;
}

}  // namespace

std::string mujoco_joint_xml(const ModelProduct& product) {
  const model::EqualityFit& fit = product.equality;
  const SimulatedBody body = body_of(product);
  const std::vector<std::string> coupling = {
      std::string(fit.of_alpha ? "theta is a polynomial of alpha" : "alpha is a polynomial of theta") +
          " (a joint equality, degree 4, least largest error). It misses theta(alpha)",
      "by " + at_most_deg(fit.error) + " deg at most, over the whole range; torques by " +
          rounded(100 * fit.slope_error, 2) + " % at most.",
      k_compliance};
  return opening(product, body, coupling) +
         bodies(product, body, pins(product.mechanism, 0.01 * product.mechanism.joint.R), drum(product.mechanism)) +
         "  <equality>\n    <joint joint1=\"" + (fit.of_alpha ? "theta" : "alpha") + "\" joint2=\"" +
         (fit.of_alpha ? "alpha" : "theta") + "\" polycoef=\"" + coefficients(fit.p.c) + "\" " + stiff(body) +
         "/>\n  </equality>\n" + ending(product, body);
}

std::string mujoco_tendons_xml(const ModelProduct& product) {
  const model::TendonModel& model = *product.tendons;
  const Mechanism& mechanism = product.mechanism;
  const SimulatedBody body = body_of(product);
  const std::string constrained = tendon_number(model.constrained);
  std::vector<std::string> coupling = path_words(product);
  coupling.push_back(k_compliance);
  std::string world, link = drum(mechanism), tendons;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!model.omission[i].empty()) continue;
    const model::WrappedTendon& tendon = model.tendons[i];
    const TendonText text = text_of(tendon, !(i == 0 ? mechanism.joint.attachment1 : mechanism.joint.attachment2));
    world += text.world;
    link += text.link;
    tendons += "    <spatial name=\"tendon_" + tendon_number(tendon.side) + "\" width=\"" +
               metres(std::max(0.5 * mechanism.tendon.diameter, 0.004 * mechanism.joint.R)) +
               "\" rgba=\"0.8 0.2 0.2 1\">\n" + text.path + "    </spatial>\n";
  }
  // The coefficient has the size of the true moment arm: MuJoCo scales a constraint's softness by the unscaled inertia
  // of both sides.
  const double arm = std::stod(rounded(body.pulley_radius, 3));
  const double drawn = mechanism.seen_pitch_radius() > 0 ? 0 : 0.01 * mechanism.joint.R;
  return opening(product, body, coupling) + bodies(product, body, pins(mechanism, drawn) + world, link) +
         "  <tendon>\n" + tendons + "    <fixed name=\"wound\">\n      <joint joint=\"alpha\" coef=\"" + number(arm) +
         "\"/>\n    </fixed>\n  </tendon>\n  <equality>\n    <tendon tendon1=\"tendon_" + constrained +
         "\" tendon2=\"wound\" polycoef=\"" + coefficients(over_arm(model.length, arm).c) + "\" " + stiff(body) +
         "/>\n  </equality>\n" + ending(product, body);
}

}  // namespace fusee::formats
