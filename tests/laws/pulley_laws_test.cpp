#include <gtest/gtest.h>

#include <algorithm>

#include "fusee/profile.h"
#include "fusee/solid.h"
#include "laws/random_mechanism.h"

namespace fusee {
namespace {

using testing::expect_law;

constexpr double k_chord_error_mm = 0.01;  // default of synthesise()

// Every accepted mechanism gives a valid mesh, and strings wound on its sections reproduce θ(α). Every rejected one has a
// reason.
TEST(PulleyLaws, AcceptedPulleysAreValidAndRewind) {
  expect_law(60, [](const Mechanism& mechanism) {
    const profile::SynthesisResult synthesis = profile::synthesise(mechanism, {.advice = false});
    const auto has_reason = [](const std::vector<profile::Condition>& conditions) {
      return std::any_of(conditions.begin(), conditions.end(),
                         [](const profile::Condition& c) { return !c.ok && !c.message.empty(); });
    };
    if (!synthesis.made()) {
      RC_ASSERT(has_reason(synthesis.conditions));
      return false;
    }
    const solid::Pulley pulley = solid::make_pulley(mechanism, synthesis);
    if (!pulley.made()) {
      RC_ASSERT(has_reason(pulley.conditions));
      return false;
    }
    for (const Check& check : solid::check_pulley(pulley.mesh, mechanism, synthesis, pulley, k_chord_error_mm)) {
      RC_LOG() << check.name << " " << check.value << " " << check.limit << " " << check.where << "\n";
      RC_ASSERT(check.ok);
    }
    const Polygon floor1 = solid::outer_loop(solid::section(pulley.mesh, pulley.layout.z_p1));
    const Polygon floor2 = solid::outer_loop(solid::section(pulley.mesh, pulley.layout.z_p2));
    const profile::RewindResult wound = profile::rewind(mechanism, floor1, floor2);
    RC_ASSERT(degrees(wound.max_theta_error) < 0.05);
    RC_ASSERT(wound.max_excess < 0.05);
    return true;
  });
}

}  // namespace
}  // namespace fusee
