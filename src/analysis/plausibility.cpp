#include "fusee/analysis/plausibility.h"

#include "analysis/likely_slip.h"
#include "fusee/analysis/analysis.h"
#include "fusee/joint/as_it_is.h"
#include "fusee/profile/synthesis.h"
#include "transmission/alpha_range.h"

namespace fusee {
namespace {

/// Steps of the range at which tensions are looked at: they change slowly, and a strength is known to a tenth at best.
constexpr int k_load_steps = 12;

Diagnostic placed(const LikelySlip& slip, const MechanismFile& file) {
  return {Severity::warning, file.place_of(slip.key), slip.message, slip.hint};
}

using Look = std::vector<LikelySlip> (*)(const DeclaredMechanism&);
constexpr Look k_looks[] = {slipped_angles, slipped_lengths, slipped_sign, slipped_modulus};

}  // namespace

std::vector<Diagnostic> likely_slips(const MechanismFile& file) {
  std::vector<Diagnostic> warnings;
  for (const Look look : k_looks) {
    for (const LikelySlip& slip : look(file.mechanism)) warnings.push_back(placed(slip, file));
  }
  return warnings;
}

std::optional<Diagnostic> overloaded_tendon(const MechanismFile& file) {
  if (file.mechanism.transmission) return std::nullopt;
  const Mechanism mechanism = as_it_is(file.mechanism).mechanism;
  const Transmission transmission(mechanism);
  const std::optional<Strength> strength = likely_strength(mechanism.tendon);
  if (transmission.dead_centre() || !strength) return std::nullopt;
  std::optional<Diagnostic> warning =
      tendon_breaks(largest_tensions(mechanism, alphas_over_range(transmission, k_load_steps)), *strength);
  if (!warning) return std::nullopt;
  warning->severity = Severity::warning;
  warning->place = file.place_of("tendon.strength_N");
  return warning;
}

std::vector<Diagnostic> tight_bends(const MechanismFile& file) {
  if (file.mechanism.transmission) return {};
  SynthesisOptions options;
  options.advice = false;
  std::vector<Diagnostic> warnings;
  for (const std::string& words : synthesise(as_it_is(file.mechanism).mechanism, options).warnings)
    warnings.push_back({Severity::warning, file.place_of("tendon.bend_ratio"), words, {}});
  return warnings;
}

std::vector<Diagnostic> doubts(const MechanismFile& file) {
  std::vector<Diagnostic> warnings = likely_slips(file);
  if (const auto overloaded = overloaded_tendon(file)) warnings.push_back(*overloaded);
  return warnings;
}

MechanismFile with_doubts(MechanismFile file) {
  const std::vector<Diagnostic> found = doubts(file);
  file.warnings.insert(file.warnings.end(), found.begin(), found.end());
  return file;
}

}  // namespace fusee
