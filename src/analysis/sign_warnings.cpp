#include <algorithm>
#include <limits>
#include <utility>

#include "analysis/input_warning.h"
#include "base/text.h"
#include "fusee/profile.h"

namespace fusee::analysis {
namespace {

/// Radii of the less even pulley over the stroke.
struct Unevenness {
  bool made = false;  ///< the pitch curves exist
  double least = 1;   ///< mm
  double most = 1;
  const char* pulley = "P2";

  double times() const { return most / least; }
};

Unevenness unevenness(const Mechanism& mechanism) {
  profile::SynthesisOptions options;
  options.advice = false;
  const profile::SynthesisResult synthesis = profile::synthesise(mechanism, options);
  Unevenness worst;
  worst.made = synthesis.made();
  for (const auto& [tendon, pulley] :
       {std::pair(&transmission::TransmissionPoint::t1, "P1"), std::pair(&transmission::TransmissionPoint::t2, "P2")}) {
    Unevenness own{worst.made, std::numeric_limits<double>::infinity(), 0, pulley};
    for (const transmission::TransmissionPoint& point : synthesis.stroke) {
      own.least = std::min(own.least, (point.*tendon).p);
      own.most = std::max(own.most, (point.*tendon).p);
    }
    if (own.least > 0 && own.times() > worst.times()) worst = own;
  }
  return worst;
}

/// Ratio of the largest to the smallest radius above which the sign is implausible. With the pins below the joint,
/// moment arms fall faster towards the ends of the range, so radii vary more. The ratio is 1.1 to 2.3 in the profiles,
/// and 2.8 to 10.5 with their sign reversed. In random joints (tests/laws) it is 5.2 at most, and above 3.5 in one of
/// fifty.
constexpr double k_uneven = 4.0;
/// Factor by which the opposite sign must reduce that ratio for a warning.
constexpr double k_improvement = 3.0;
/// The required factor if no pulley exists with the declared sign.
constexpr double k_improvement_if_infeasible = 2.0;

/// True if the mechanism with the opposite sign is the likelier intention.
bool is_likelier(const Unevenness& other, const Unevenness& declared) {
  if (!other.made) return false;
  const double improvement = declared.times() / other.times();
  if (!declared.made) return improvement >= k_improvement_if_infeasible;
  return declared.times() >= k_uneven && improvement >= k_improvement;
}

std::string fold_text(const Unevenness& uneven) { return rounded(uneven.times(), 2) + "-fold"; }

}  // namespace

// Only a positive OE is tested: distances are usually entered as positive numbers, while a minus sign is not entered
// by mistake.
std::vector<InputWarning> sign_warnings(const DeclaredMechanism& mechanism) {
  const double OE = mechanism.guides.OE;
  if (mechanism.transmission || OE <= 0) return {};
  Mechanism mirrored = mechanism;
  mirrored.guides.OE = -OE;
  const Unevenness declared = unevenness(mechanism), other = unevenness(mirrored);
  if (!is_likelier(other, declared)) return {};
  const char* key = "guides.OE_mm";
  const std::string consequence = declared.made ? "there the radius of " + std::string(declared.pulley) + " varies " +
                                                      fold_text(declared) + ", " + rounded(declared.least, 3) + " to " +
                                                      rounded(declared.most, 3) + " mm"
                                                : "there no such pulley can be made";
  return {{key, setting_text(key, OE) + " mm: positive is below the joint, away from C, and " + consequence,
           "did you mean " + rounded(-OE) + " mm? Above the joint " +
               (declared.made ? "it varies " : "one can, of a radius that varies ") + fold_text(other)}};
}

}  // namespace fusee::analysis
