// The body without cross features, against closed formulas.
#include <gtest/gtest.h>

#include "fusee/solid/pulley.h"
#include "support/shapes.h"

namespace fusee {
namespace {

using testing::circle;
using testing::plain_mechanism;
using testing::pulley_of;

std::string failures(const std::vector<Check>& checks) {
  std::string text;
  for (const Check& check : checks) {
    if (!check.ok) text += check.name + ": " + check.where + "\n";
  }
  return text;
}

TEST(Body, CirclesMakeASolid) {
  const Mechanism mechanism = plain_mechanism();
  const Pulley pulley = make_pulley(mechanism, pulley_of(circle(20), circle(18, {3, 1})));
  ASSERT_TRUE(pulley.made());
  EXPECT_EQ(failures(check_mesh(pulley.mesh)), "");
  EXPECT_NEAR(enclosed_volume(pulley.mesh), pulley.expected_volume, 1e-9 * pulley.expected_volume);
}

}  // namespace
}  // namespace fusee
