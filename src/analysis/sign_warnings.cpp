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
    Unevenness here{worst.made, std::numeric_limits<double>::infinity(), 0, pulley};
    for (const transmission::TransmissionPoint& point : synthesis.stroke) {
      here.least = std::min(here.least, (point.*tendon).p);
      here.most = std::max(here.most, (point.*tendon).p);
    }
    if (here.least > 0 && here.times() > worst.times()) worst = here;
  }
  return worst;
}

/// Ratio of radii above which the sign is implausible. With the pins below the joint, moment arms fall faster towards the
/// ends of the range, so that radii vary more. Profiles with the sign reversed: 2.8 to 10.5 times, as they are 1.1 to
/// 2.3 times. Random joints (tests/laws) as they are: at most 5.2 times, one in fifty above 3.5.
constexpr double k_uneven = 4.0;
/// Improvement by the opposite sign that is required for a warning.
constexpr double k_evener = 3.0;
/// Required improvement when no pulley exists with the declared sign.
constexpr double k_evener_and_made = 2.0;

bool is_likelier(const Unevenness& other, const Unevenness& declared) {
  if (!other.made) return false;
  const double evener = declared.times() / other.times();
  return declared.made ? declared.times() >= k_uneven && evener >= k_evener : evener >= k_evener_and_made;
}

std::string fold_text(const Unevenness& uneven) { return rounded(uneven.times(), 2) + "-fold"; }

}  // namespace

// Only a positive OE is tested: distances are usually entered as positive numbers, while a minus sign is not entered
// by mistake.
std::vector<InputWarning> sign_warnings(const DeclaredMechanism& mechanism) {
  const double OE = mechanism.guides.OE;
  if (mechanism.transmission || OE <= 0) return {};
  Mechanism turned = mechanism;
  turned.guides.OE = -OE;
  const Unevenness declared = unevenness(mechanism), other = unevenness(turned);
  if (!is_likelier(other, declared)) return {};
  const char* key = "guides.OE_mm";
  const std::string what = declared.made ? "there the radius of " + std::string(declared.pulley) + " varies " +
                                               fold_text(declared) + ", " + rounded(declared.least, 3) + " to " +
                                               rounded(declared.most, 3) + " mm"
                                         : "there no such pulley can be made";
  return {{key, setting_text(key, OE) + " mm: positive is below the joint, away from C, and " + what,
           "did you mean " + rounded(-OE) + " mm? Above the joint " +
               (declared.made ? "it varies " : "one can, of a radius that varies ") + fold_text(other)}};
}

}  // namespace fusee::analysis
