// Helical grooves as meshes, on spirals with a closed form.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "fusee/helical_solid.h"
#include "helical_solid/spirals.h"
#include "solid/print.h"
#include "support/mechanisms.h"
#include "support/shapes.h"

namespace fusee::helical_solid {
namespace {

using fusee::testing::growing;
using fusee::testing::oval;
using fusee::testing::spiral_of;

Mechanism plain() {
  DeclaredMechanism mechanism = testing::forearm();
  mechanism.body = testing::plain_mechanism().body;
  mechanism.material = testing::plain_mechanism().material;
  mechanism.print = testing::plain_mechanism().print;
  return mechanism;
}

// Writes the mesh to the folder FUSEE_KEEP, for inspection.
void keep(const solid::TriangleMesh& mesh, const std::string& name) {
  const char* folder = std::getenv("FUSEE_KEEP");
  if (folder == nullptr) return;
  std::ofstream file(std::string(folder) + "/" + name + ".off");
  file << "OFF\n" << mesh.vertices.size() << " " << mesh.triangles.size() << " 0\n";
  file.precision(9);
  for (const Vec3& v : mesh.vertices) file << v.x() << " " << v.y() << " " << v.z() << "\n";
  for (const auto& t : mesh.triangles) file << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
}

std::string failures(const std::vector<Check>& checks) {
  std::string text;
  for (const Check& check : checks) {
    if (!check.ok) text += check.name + " " + std::to_string(check.value) + " " + check.where + "; ";
  }
  return text;
}

void expect_good(const HelicalPulley& pulley, const std::string& name) {
  const HelicalSection section = helical_section(plain());
  keep(pulley.mesh, name);
  ASSERT_TRUE(pulley.made) << pulley.brief();
  EXPECT_EQ(failures(check_helical_pulley(pulley.mesh, pulley, section)), "");
  EXPECT_EQ(failures(solid::check_print(pulley.mesh)), "");
}

// Arguments of spiral_of(): curve, direction of the first normal (rad), number of turns, rise per mm. Feasible leads
// exceed the least one of the section by a margin.
TEST(HelicalPulley, BuildsRoundHelix) {
  const Mechanism mechanism = plain();
  const double lead = least_lead(helical_section(mechanism), 0.0) + 0.05, slope = lead / (k_two_pi * 16.0);
  const HelicalPulley pulley = make_helical_pulley(mechanism, spiral_of(testing::round_curve(16.0), 0.3, 5, slope),
                                                   spiral_of(testing::round_curve(18.0), 1.1, 4.4, slope));
  expect_good(pulley, "round");
}

// Advice is tried with a brief search and built with a thorough one.
TEST(HelicalPulley, BriefSearchAgreesWithThorough) {
  const Mechanism mechanism = plain();
  const double lead = least_lead(helical_section(mechanism), 0.0) + 0.05, slope = lead / (k_two_pi * 16.0);
  const auto made = [&](solid::TieOffSearch search) {
    return make_helical_pulley(mechanism, spiral_of(testing::round_curve(16.0), 0.3, 3, slope),
                               spiral_of(testing::round_curve(18.0), 1.1, 3, slope), 0.05, search);
  };
  const HelicalPulley brief = made(solid::TieOffSearch::brief), thorough = made(solid::TieOffSearch::thorough);
  ASSERT_TRUE(brief.made) << brief.brief();
  EXPECT_EQ(brief.mesh.vertices, thorough.mesh.vertices);
  EXPECT_EQ(brief.mesh.triangles, thorough.mesh.triangles);
}

TEST(HelicalPulley, BuildsGrowingSpirals) {
  const Mechanism mechanism = plain();
  const double lead = least_lead(helical_section(mechanism), 2.4) + 0.2, slope = lead / (k_two_pi * 12.0);
  const HelicalPulley pulley = make_helical_pulley(mechanism, spiral_of(growing(12, 2.4, 0.3), 0.3, 5, slope),
                                                   spiral_of(growing(24, -2.4, 1.1), 1.1, 5, slope));
  expect_good(pulley, "clock");
}

TEST(HelicalPulley, BuildsOvals) {
  const Mechanism mechanism = plain();
  const double lead = least_lead(helical_section(mechanism), 1.0) + 0.5, slope = lead / (k_two_pi * 14.0);
  const HelicalPulley pulley = make_helical_pulley(mechanism, spiral_of(oval(14, 0.7, 2, 0.3), 0.3, 3.2, slope),
                                                   spiral_of(oval(18, -0.5, 2.5, 1.1), 1.1, 3.7, slope));
  expect_good(pulley, "oval");
}

// Equal numbers of additional turns add equal numbers of facets.
TEST(HelicalPulley, FacetsAreProportionalToTurns) {
  const Mechanism mechanism = plain();
  const double lead = least_lead(helical_section(mechanism), 0.0) + 0.05, slope = lead / (k_two_pi * 16.0);
  const auto facets = [&](double turns) {
    const HelicalPulley pulley =
        make_helical_pulley(mechanism, spiral_of(testing::round_curve(16.0), 0.3, turns, slope),
                            spiral_of(testing::round_curve(16.0), 1.1, turns, slope), 0.01);
    EXPECT_TRUE(pulley.made) << pulley.brief();
    EXPECT_EQ(failures(check_helical_pulley(pulley.mesh, pulley, helical_section(mechanism))), "");
    return static_cast<double>(pulley.mesh.triangles.size());
  };
  const double two = facets(2), six = facets(6), ten = facets(10);
  EXPECT_NEAR(ten - six, six - two, 0.01 * ten);
}

TEST(HelicalPulley, RejectsIntersectingTurns) {
  const Mechanism mechanism = plain();
  const double lead = least_lead(helical_section(mechanism), 0.0) - 0.1, slope = lead / (k_two_pi * 16.0);
  const HelicalPulley pulley = make_helical_pulley(mechanism, spiral_of(testing::round_curve(16.0), 0.3, 4, slope),
                                                   spiral_of(testing::round_curve(16.0), 1.1, 4, slope));
  EXPECT_FALSE(pulley.made);
  EXPECT_THAT(pulley.brief(), ::testing::HasSubstr("body.lead_mm"));
}

}  // namespace
}  // namespace fusee::helical_solid
