#include "analysis/plausibility.h"

#include "analysis/input_warning.h"
#include "fusee/analysis.h"
#include "fusee/joint.h"
#include "fusee/profile.h"
#include "transmission/alpha_range.h"

namespace fusee::analysis {
namespace {

/// Number of steps for tensions: they change slowly, and strengths are known to 10 % at best.
constexpr int k_load_steps = 12;

Diagnostic placed(const InputWarning& warning, const MechanismFile& file) {
  return {Severity::warning, file.place_of(warning.key), warning.message, warning.hint};
}

/// One kind of likely input error.
using Rule = std::vector<InputWarning> (*)(const DeclaredMechanism&);
constexpr Rule k_rules[] = {angle_warnings, length_warnings, sign_warnings, modulus_warnings};

}  // namespace

std::vector<Diagnostic> likely_input_errors(const MechanismFile& file) {
  std::vector<Diagnostic> warnings;
  for (const Rule rule : k_rules) {
    for (const InputWarning& warning : rule(file.mechanism)) warnings.push_back(placed(warning, file));
  }
  return warnings;
}

std::optional<Diagnostic> overloaded_tendon(const MechanismFile& file) {
  if (file.mechanism.transmission) return std::nullopt;
  const Mechanism mechanism = joint::identified_joint(file.mechanism).mechanism;
  const transmission::Transmission transmission(mechanism);
  const std::optional<Strength> strength = likely_strength(mechanism.tendon);
  if (transmission.dead_centre() || !strength) return std::nullopt;
  std::optional<Diagnostic> warning = tendon_breaks(
      largest_tensions(mechanism, transmission::alphas_over_range(transmission, k_load_steps)), *strength);
  if (!warning) return std::nullopt;
  warning->severity = Severity::warning;
  warning->place = file.place_of("tendon.strength_N");
  return warning;
}

std::vector<Diagnostic> tight_bends(const MechanismFile& file) {
  if (file.mechanism.transmission) return {};
  profile::SynthesisOptions options;
  options.advice = false;
  std::vector<Diagnostic> warnings;
  for (const std::string& words :
       profile::synthesise(joint::identified_joint(file.mechanism).mechanism, options).warnings)
    warnings.push_back({Severity::warning, file.place_of("tendon.bend_ratio"), words, {}});
  return warnings;
}

std::vector<Diagnostic> plausibility_warnings(const MechanismFile& file) {
  std::vector<Diagnostic> warnings = likely_input_errors(file);
  if (const auto overloaded = overloaded_tendon(file)) warnings.push_back(*overloaded);
  return warnings;
}

MechanismFile with_plausibility_warnings(MechanismFile file) {
  const std::vector<Diagnostic> found = plausibility_warnings(file);
  file.warnings.insert(file.warnings.end(), found.begin(), found.end());
  return file;
}

}  // namespace fusee::analysis
