#include "calibration/input_error_hypotheses.h"

#include <cmath>
#include <optional>

#include "fusee/mechanism_file.h"

namespace fusee::calibration {
namespace {

/// Relative difference below which values are equal.
constexpr double k_alike = 0.01;

/// Hypothesis that the keys should have the values `would_be`; none if they are equal or invalid in a file.
std::optional<InputErrorHypothesis> with_values(const DeclaredMechanism& declared, const std::string& name,
                                                const std::vector<std::string>& keys,
                                                const std::vector<double>& would_be, const char* question) {
  InputErrorHypothesis hypothesis{{name, {}, would_be, question}, declared, declared};
  bool differs = false;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const NumberKey key = *find_number_key(keys[i]);
    const double value = key.get(declared);
    const bool allowed = would_be[i] >= key.field->least && would_be[i] <= key.field->most;
    if (!allowed || !is_used(*key.field, declared)) return std::nullopt;
    differs = differs || std::abs(would_be[i] - value) > k_alike * std::abs(value);
    hypothesis.error.declared.push_back(value);
    key.set(hypothesis.joint, would_be[i]);
  }
  if (!differs) return std::nullopt;
  hypothesis.drawn = hypothesis.joint;
  return hypothesis;
}

std::optional<InputErrorHypothesis> scaled(const DeclaredMechanism& declared, const char* key, double factor,
                                           const char* question) {
  return with_values(declared, key, {key}, {factor * find_number_key(key)->get(declared)}, question);
}

std::optional<InputErrorHypothesis> inverted(const DeclaredMechanism& declared, const char* key) {
  return with_values(declared, key, {key}, {1.0 / find_number_key(key)->get(declared)}, "is it alpha per theta?");
}

std::optional<InputErrorHypothesis> exchanged_pins(const DeclaredMechanism& declared) {
  return with_values(declared, "guides.EB_mm, guides.ED_mm", {"guides.EB_mm", "guides.ED_mm"},
                     {declared.guides.ED, declared.guides.EB}, "are the two exchanged?");
}

std::optional<InputErrorHypothesis> range_in_radians(const DeclaredMechanism& declared) {
  const Joint& joint = declared.joint;
  return with_values(declared, "joint.range_deg", {"joint.range_deg[0]", "joint.range_deg[1]"},
                     {degrees(degrees(joint.theta_min)), degrees(degrees(joint.theta_max))}, "is it in radians?");
}

/// The corrected joint with the pulley of the uncorrected file.
std::optional<InputErrorHypothesis> with_pulley_as_declared(std::optional<InputErrorHypothesis> hypothesis,
                                                            const DeclaredMechanism& declared) {
  if (!hypothesis) return hypothesis;
  hypothesis->drawn = declared;
  hypothesis->error.pulley_as_declared = true;
  return hypothesis;
}

struct DataError {
  const char* angles;
  double alpha, theta;
  const char* question;
};
constexpr const char* k_sign = "is the sign right?";
constexpr const char* k_unit = "is the unit right?";
constexpr const char* k_radians = "is the log in radians?";
constexpr DataError k_data_errors[] = {
    {"alpha", -1.0, 1.0, k_sign},
    {"theta", 1.0, -1.0, k_sign},
    {"alpha and theta", -1.0, -1.0, k_sign},
    {"alpha", degrees(1.0), 1.0, k_radians},
    {"theta", 1.0, degrees(1.0), k_radians},
    {"alpha and theta", degrees(1.0), degrees(1.0), k_radians},
};

}  // namespace

std::vector<InputErrorHypothesis> input_error_hypotheses(const DeclaredMechanism& declared) {
  std::vector<InputErrorHypothesis> all;
  const auto add = [&all](std::optional<InputErrorHypothesis> hypothesis) {
    if (hypothesis) all.push_back(std::move(*hypothesis));
  };
  for (const auto& geometry : {scaled(declared, "guides.OE_mm", -1.0, k_sign), exchanged_pins(declared)}) {
    add(geometry);
    add(with_pulley_as_declared(geometry, declared));
  }
  add(range_in_radians(declared));
  for (const char* length :
       {"joint.length_mm", "guides.EB_mm", "guides.ED_mm", "guides.OE_mm", "pulley.EF_mm", "pulley.r1_mm"}) {
    for (const double factor : {10.0, 0.1}) add(scaled(declared, length, factor, k_unit));
  }
  add(scaled(declared, "tendon.modulus_MPa", 1000.0, "is it in GPa?"));
  for (const char* ratio : {"pulley.ratio", "transmission.ratio"}) add(inverted(declared, ratio));
  for (const DataError& data : k_data_errors) {
    const double factor = data.alpha != 1.0 ? data.alpha : data.theta;
    all.push_back({{data.angles, {1.0}, {factor}, data.question}, declared, declared, data.alpha, data.theta});
  }
  return all;
}

}  // namespace fusee::calibration
