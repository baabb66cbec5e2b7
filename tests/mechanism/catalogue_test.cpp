#include "fusee/mechanism/catalogue.h"

#include <gmock/gmock.h>

namespace fusee {
namespace {

TEST(Catalogue, HornsCanBeScrewedOn) {
  ASSERT_FALSE(horns().empty());
  for (const Horn& horn : horns()) {
    EXPECT_GE(horn.hole_count, 2) << horn.name;
    // The screws stand clear of the hole in the middle.
    EXPECT_GT(horn.hole_circle - horn.hole_diameter, horn.centre_hole) << horn.name;
    EXPECT_GE(horn.recess_depth, 0) << horn.name;
    EXPECT_EQ(find_horn(horn.name), &horn);
  }
  EXPECT_EQ(find_horn("none such"), nullptr);
}

TEST(Catalogue, TendonsArePhysical) {
  ASSERT_FALSE(tendon_types().empty());
  for (const TendonType& type : tendon_types()) {
    const double area = 3.14159 / 4 * type.diameter * type.diameter;
    EXPECT_GT(type.breaking_strength / area, 100) << type.name;   // MPa
    EXPECT_LT(type.breaking_strength / area, 4000) << type.name;  // fibres break at 3600
    EXPECT_LT(type.breaking_strength / area, type.modulus) << type.name;
    EXPECT_GE(type.bend_ratio, 5) << type.name;
  }
}

TEST(Catalogue, ShrinkagesAreOrdered) {
  ASSERT_FALSE(material_types().empty());
  for (const MaterialType& type : material_types()) {
    EXPECT_LE(type.shrinkage_least, type.shrinkage_typical) << type.name;
    EXPECT_LE(type.shrinkage_typical, type.shrinkage_most) << type.name;
    EXPECT_LE(type.shrinkage_most, 3) << type.name;
  }
}

}  // namespace
}  // namespace fusee
