// Reads the written files as other programs do, and compares them with the joint over the range.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <new>
#include <pugixml.hpp>

#include "base/json.h"
#include "base/text.h"
#include "export/model/words.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

const std::string& bytes_of(const std::vector<OutputFile>& outputs, const std::string& name) {
  const auto found =
      std::find_if(outputs.begin(), outputs.end(), [&](const OutputFile& file) { return file.name == name; });
  demand(found != outputs.end(), name + " was not written");
  return found->bytes;
}

pugi::xml_document xml_of(const std::vector<OutputFile>& outputs, const std::string& name) {
  pugi::xml_document document;
  const std::string& bytes = bytes_of(outputs, name);
  const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size());
  if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
  demand(bool(parsed), name + " cannot be read back: " + parsed.description());
  return document;
}

/// Numbers between blanks; NaN for other words.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> values;
  while (true) {
    const std::size_t begin = text.find_first_not_of(' ');
    if (begin == std::string_view::npos) return values;
    text.remove_prefix(begin);
    double value = std::numeric_limits<double>::quiet_NaN();
    const std::string_view word = text.substr(0, text.find(' '));
    std::from_chars(word.data(), word.data() + word.size(), value);
    values.push_back(value);
    text.remove_prefix(word.size());
  }
}

// ---- simulators -----------------------------------------------------------------------------------------------------

double error_of_joint_xml(const ModelProduct& product, const std::vector<OutputFile>& outputs) {
  const pugi::xml_document document = xml_of(outputs, "joint.xml");
  const pugi::xml_node equality = document.child("mujoco").child("equality").child("joint");
  const bool of_alpha = std::string_view(equality.attribute("joint2").value()) == "alpha";
  return model::measured({of_alpha, {numbers_in(equality.attribute("polycoef").value())}},
                         product.curves.physical.middle)
      .error;
}

pugi::xml_node child_named(const pugi::xml_node& parent, const char* kind, const std::string& name) {
  return parent.find_child([&](const pugi::xml_node& node) {
    return std::string_view(node.name()) == kind && node.attribute("name").value() == name;
  });
}

/// The position of an element, mm.
Vec2 point_in(const pugi::xml_node& node) {
  const std::vector<double> values = numbers_in(node.attribute("pos").value());
  demand(values.size() == 3, "a place of " + std::to_string(values.size()) + " numbers");
  return 1e3 * Vec2(values[0], values[1]);
}

/// The error of the tendon equality, computed from the values in the file as MuJoCo would.
double error_of_tendons_xml(const ModelProduct& product, const std::vector<OutputFile>& outputs) {
  const pugi::xml_document document = xml_of(outputs, "joint_tendons.xml");
  const pugi::xml_node root = document.child("mujoco"), world = root.child("worldbody");
  const pugi::xml_node equality = root.child("equality").child("tendon");
  model::WrappedTendon tendon;
  tendon.side = std::string_view(equality.attribute("tendon1").value()) == "tendon_1" ? transmission::Side::left
                                                                                      : transmission::Side::right;
  const std::string number = tendon.side == transmission::Side::left ? "1" : "2";
  const pugi::xml_node spatial = child_named(root.child("tendon"), "spatial", "tendon_" + number);
  const pugi::xml_node link = child_named(world, "body", "link");
  tendon.end = point_in(child_named(link, "site", spatial.child("site").attribute("site").value()));
  for (const pugi::xml_node& wrapped : spatial.children("geom")) {
    const std::string name = wrapped.attribute("geom").value();
    const bool on_link = name == "drum";
    const pugi::xml_node cylinder = child_named(on_link ? link : world, "geom", name);
    (on_link ? tendon.drum : tendon.rho) = 1e3 * numbers_in(cylinder.attribute("size").value()).front();
    if (!on_link) tendon.pin = point_in(cylinder);
  }
  if (tendon.rho == 0) tendon.pin = point_in(child_named(world, "site", "over_" + number));
  tendon.anchor = point_in(child_named(world, "site", "anchor_" + number));
  // The file's polynomial is in the length of the tendon "wound", radius · α, in m. Here it becomes one in α, with values
  // in mm.
  model::Polynomial length{numbers_in(equality.attribute("polycoef").value())};
  double scale = 1e3;
  const double radius = child_named(root.child("tendon"), "fixed", equality.attribute("tendon2").value())
                            .child("joint")
                            .attribute("coef")
                            .as_double();
  for (double& c : length.c) {
    c *= scale;
    scale *= radius;
  }
  return model::tendon_error(tendon, length, product.curves.physical.middle);
}

double error_of_urdf(const ModelProduct& product, const std::vector<OutputFile>& outputs) {
  const pugi::xml_document document = xml_of(outputs, "joint.urdf");
  const pugi::xml_node mimic = child_named(document.child("robot"), "joint", "theta").child("mimic");
  return model::measured({true, {{mimic.attribute("offset").as_double(), mimic.attribute("multiplier").as_double()}}},
                         product.curves.physical.middle)
      .error;
}

double error_of_ros2_control(const ModelProduct& product, const std::vector<OutputFile>& outputs) {
  const pugi::xml_document document = xml_of(outputs, "joint_ros2_control.urdf");
  const pugi::xml_node joint = document.child("robot").child("ros2_control").child("transmission").child("joint");
  const double reduction = joint.child("mechanical_reduction").text().as_double(),
               offset = joint.child("offset").text().as_double();
  return model::measured({true, {{offset, 1 / reduction}}}, product.curves.physical.middle).error;
}

// ---- tables ---------------------------------------------------------------------------------------------------------

std::vector<float> floats_of(const Json& list) {
  std::vector<float> values;
  for (const Json& value : list) values.push_back(static_cast<float>(value.get<double>()));
  return values;
}

model::JointTable table_in(const std::string& bytes) {
  const Json json = parse_json(bytes);
  model::JointTable table;
  table.unit.per_turn = json["motor_unit"]["per_turn"];
  table.unit.zero = json["motor_unit"]["zero"];
  table.pieces = json["pieces"];
  const std::vector<float> theta = floats_of(json["theta_deg"]);
  table.theta_first_deg = theta[0];
  table.theta_last_deg = theta[1];
  for (const Json& way : json["ways"]) {
    const std::vector<float> ends = floats_of(way["motor"]);
    table.ways.push_back({ends[0], ends[1], floats_of(way["theta_deg_of_motor"]), floats_of(way["motor_of_theta"])});
  }
  return table;
}

/// Entries of all arrays of a header, in order.
std::vector<float> entries_in(std::string_view header) {
  std::vector<float> values;
  for (std::size_t at = header.find("= {"); at != std::string_view::npos; at = header.find("= {", at + 1)) {
    const std::size_t end = header.find('}', at);
    for (std::size_t i = at + 3; i < end;) {
      i = header.find_first_not_of(" ,\n", i);
      float value = 0;
      const auto [stop, error] = std::from_chars(header.data() + i, header.data() + end, value);
      if (error != std::errc()) break;
      values.push_back(value);
      i = static_cast<std::size_t>(stop - header.data()) + 1;  // the "f"
    }
  }
  return values;
}

std::size_t differing_entries(const ModelProduct& product, const std::string& header) {
  const model::JointTable& table = product.table;
  std::vector<float> expected;
  const auto add = [&](const std::vector<float>& values) {
    expected.insert(expected.end(), values.begin(), values.end());
  };
  for (const model::OneWayTable& way : table.ways) {
    add(way.theta_deg);
    add(way.motor);
  }
  add(table.slope);
  add(table.holding);
  const std::vector<float> found = entries_in(header);
  std::size_t differing = std::max(found.size(), expected.size()) - std::min(found.size(), expected.size());
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) differing += found[i] != expected[i];
  return differing;
}

/// Number of entries out of order. They must increase, or decrease if counts fall as α increases.
std::size_t non_monotonic_entries(const model::JointTable& table) {
  std::size_t count = 0;
  const bool falls = table.unit.per_turn < 0;
  for (const model::OneWayTable& way : table.ways) {
    for (const std::vector<float>* entries : {&way.theta_deg, &way.motor}) {
      for (std::size_t i = 1; i < entries->size(); ++i) {
        const bool is_monotonic = falls ? (*entries)[i] < (*entries)[i - 1] : (*entries)[i] > (*entries)[i - 1];
        if (!is_monotonic) ++count;
      }
    }
  }
  return count;
}

}  // namespace

std::vector<Check> check_model(const ModelProduct& product, const std::vector<OutputFile>& outputs) {
  constexpr double k_last_digits = 1e-8;  // rad, by which coefficients of nine digits miss
  std::vector<Check> checks;
  const auto add = [&](const std::string& name, double error, double limit) {
    // Digits beyond the ninth decimal depend on the compiler.
    const double rounded_error = std::isfinite(error) ? std::round(1e9 * degrees(error)) / 1e9 : error;
    checks.push_back(at_most(name, rounded_error, degrees(limit), "deg"));
  };
  if (product.with_polynomial) add("joint_xml_theta_error", error_of_joint_xml(product, outputs), product.most_error);
  if (product.tendons) add("joint_tendons_xml_theta_error", error_of_tendons_xml(product, outputs), product.most_error);
  add("joint_urdf_theta_error", error_of_urdf(product, outputs), product.line.error + k_last_digits);
  add("joint_ros2_control_urdf_theta_error", error_of_ros2_control(product, outputs),
      product.line.error + k_last_digits);
  const model::JointTable read = table_in(bytes_of(outputs, "joint_table.json"));
  const model::TableErrors errors = model::measured(read, product.curves.sensed);
  add("joint_table_json_theta_error", errors.theta, product.most_table_error);
  add("joint_table_json_returned_theta_error", errors.returned, product.most_table_error);
  checks.push_back(exactly("joint_table_json_not_growing", static_cast<double>(non_monotonic_entries(read)), 0, "1"));
  checks.push_back(exactly("joint_table_h_differing_entries",
                           static_cast<double>(differing_entries(product, bytes_of(outputs, "joint_table.h"))), 0,
                           "1"));
  return checks;
}

}  // namespace fusee::formats
