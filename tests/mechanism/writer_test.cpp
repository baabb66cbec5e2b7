#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "fusee/mechanism_file.h"
#include "mechanism/catalogue.h"
#include "mechanism/mechanism_text.h"

namespace fusee {
namespace {

using testing::HasSubstr;

/// A random number within the field's bounds, often at a bound, with many or few digits.
double random_number(const Field& field) {
  const int digits = *rc::gen::inRange(0, 1 << 30);
  const double fraction = *rc::gen::element(0.0, 1.0, 0.5, digits / double(1 << 30), (digits % 1000) / 1000.0);
  return field.least + fraction * (field.most - field.least);
}

void set_random(const Field& field, DeclaredMechanism& mechanism) {
  switch (field.kind) {
    case FieldKind::number:
      field.set(mechanism, 0, random_number(field));
      break;
    case FieldKind::range:
      field.set(mechanism, 0, *rc::gen::inRange(-17500000, -1) / 1e5);
      field.set(mechanism, 1, *rc::gen::inRange(0, 17500000) / 1e5);
      break;
    case FieldKind::choice:
      field.set_text(mechanism, *rc::gen::elementOf(field.choices));
      break;
    case FieldKind::boolean:
      field.set_text(mechanism, *rc::gen::element(std::string_view("true"), std::string_view("false")));
      break;
    case FieldKind::text: {
      const std::string text = *rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '~'));
      field.set_text(mechanism, text.substr(0, 100));
      break;
    }
    case FieldKind::point:
      if (*rc::gen::element(true, false)) break;  // omitted in half of the files
      field.set(mechanism, 0, random_number(field));
      field.set(mechanism, 1, random_number(field));
      break;
    case FieldKind::numbers:
    case FieldKind::texts:
      break;  // lists depend on one another: see RoundTripsOptimizeTable
  }
}

/// Random values for every field, made consistent.
DeclaredMechanism random_mechanism() {
  DeclaredMechanism mechanism;
  const bool is_ratio_joint = *rc::gen::inRange(0, 5) == 0;
  for (const Field& field : fields()) {
    const bool is_of_tendons =
        field.table == "joint" || field.table == "guides" || field.table == "sheath" || field.table == "pulley";
    if (is_ratio_joint ? is_of_tendons : field.table == "transmission") continue;
    set_random(field, mechanism);
  }
  if (is_ratio_joint) {
    // Undeclared parts have their defaults.
    const DeclaredMechanism defaults = default_mechanism();
    mechanism.joint = defaults.joint;
    mechanism.guides = defaults.guides;
    mechanism.pulley = defaults.pulley;
    if (mechanism.transmission->ratio == 0) mechanism.transmission->ratio = 1;
  }
  if (mechanism.pulley.law == Law::table || mechanism.pulley.law == Law::torque) mechanism.pulley.law = Law::linear;
  Guides& guides = mechanism.guides;
  if (guides.kind == GuideKind::pin) {
    guides.bearing_radius = default_mechanism().guides.bearing_radius;
    guides.bearing_friction = default_mechanism().guides.bearing_friction;
  } else {
    guides.bearing_radius = std::min(guides.bearing_radius, guides.radius);
  }
  if (is_ratio_joint || *rc::gen::element(true, false)) mechanism.sheath = default_mechanism().sheath;
  if (!mechanism.joint.is_plain() || mechanism.sheath.is_there()) mechanism.pulley.method = Method::exact;
  mechanism.body.horn = "lynxmotion-ses";
  mechanism.horn = {};
  mechanism.body.shaft = "none";
  if (mechanism.body.bore == Bore::d) mechanism.body.bore_flat = 0;
  return mechanism;
}

TEST(Writer, RoundTripsExactly) {
  ::setenv("RC_PARAMS", "seed=1 max_success=300", /*replace=*/0);
  const bool holds = rc::check("parse(write(m)) == m", [] {
    const DeclaredMechanism mechanism = random_mechanism();
    RC_ASSERT(parse_mechanism(write_mechanism(mechanism), "written") == mechanism);
  });
  EXPECT_TRUE(holds);
}

TEST(Writer, RoundTripsHornAndShaft) {
  for (const char* body : {"bore = \"horn\"\n[horn]\nbolt_circle_mm = 16\nbolt_count = 8\nbolt_hole_mm = 2.2\n"
                           "first_bolt_deg = 22.5\ncentre_hole_mm = 5\nboss_diameter_mm = 8\nboss_height_mm = 1.9\n",
                           "bore = \"horn\"\n[horn]\nspline_teeth = 25\nspline_diameter_mm = 5.92\n"
                           "spline_depth_mm = 0.3\nspline_length_mm = 4\ncentre_hole_mm = 3.2\n",
                           "shaft = \"n20-d3\"\n"}) {
    const DeclaredMechanism mechanism = parse_mechanism(k_good_file + "[body]\n" + body, "f.toml");
    EXPECT_TRUE(parse_mechanism(write_mechanism(mechanism), "written") == mechanism) << body;
  }
}

TEST(Writer, WritesTableByName) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "fusee_writer";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "law.csv") << "alpha_deg,theta_deg\n-90,-30\n-45,-15\n0,0\n45,15\n90,30\n";
  const std::string text = replaced(k_good_file, "r1_mm = 16\n", "law = \"table\"\ntable = \"law.csv\"\n");
  const DeclaredMechanism mechanism = parse_mechanism(text, "f.toml", folder);
  EXPECT_EQ(mechanism.pulley.rows.size(), 5u);
  EXPECT_TRUE(parse_mechanism(write_mechanism(mechanism), "written", folder) == mechanism);
  std::filesystem::remove_all(folder);
}

TEST(Writer, WritesShortNumbers) {
  const std::string text =
      write_mechanism(parse_mechanism(k_good_file + "[material]\nshrinkage_percent = 0.3\n", "f.toml"));
  EXPECT_THAT(text, HasSubstr("\nrange_deg = [-30, 30]\n"));
  EXPECT_THAT(text, HasSubstr("\nshrinkage_percent = 0.3\n"));
  EXPECT_THAT(text, HasSubstr("\ngroove_angle_deg = 50\n"));
  EXPECT_THAT(text, HasSubstr("\n# ratio =\n"));
}

/// The text from a table's header to the next one.
std::string table_of(const std::string& text, std::string_view name) {
  const std::size_t from = text.find("\n[" + std::string(name) + "]\n");
  return from == std::string::npos ? "" : text.substr(from, text.find("\n[", from + 2) - from);
}

TEST(Writer, WritesEveryKeyWithMeaning) {
  const std::string text = write_mechanism(parse_mechanism(k_good_file, "f.toml"));
  for (const Field& field : fields()) {
    if (field.table == "transmission") continue;
    if (field.is_set != nullptr && !field.is_set(default_mechanism())) {
      // A key of [identified] may have the same name.
      EXPECT_THAT(table_of(text, field.table), testing::Not(HasSubstr(std::string(field.key) + " =")));
      continue;
    }
    EXPECT_THAT(text, HasSubstr("\n" + std::string(is_used(field, default_mechanism()) ? "" : "# ") +
                                std::string(field.key) + " ="));
    EXPECT_THAT(text, HasSubstr(std::string(field.meaning)));
  }
}

TEST(Writer, KeepsArbitraryAnglesToLastBits) {
  DeclaredMechanism mechanism = parse_mechanism(k_good_file, "f.toml");
  mechanism.joint.theta_min = -1.0 / 3;
  const DeclaredMechanism again = parse_mechanism(write_mechanism(mechanism), "written");
  EXPECT_DOUBLE_EQ(again.joint.theta_min, -1.0 / 3);
}

TEST(Writer, RoundTripsOptimizeTable) {
  const std::string text = k_good_file +
                           "[optimize]\nobjective = [\"max_tension\", \"footprint\"]\nvariables = "
                           "[\"joint.length_mm\", \"joint.range_deg[1]\"]\n"
                           "lower = [80, 20]\nupper = [120.5, 40]\ntied = [\"guides.EB_mm = guides.ED_mm\"]\n"
                           "constraints = [\"2 * (guides.EB_mm - 1) <= joint.length_mm / 2 + 3\"]\nfeasible = true\n";
  const DeclaredMechanism mechanism = parse_mechanism(text, "f.toml");
  EXPECT_EQ(mechanism.optimize.objectives.size(), 2u);
  EXPECT_EQ(mechanism.optimize.upper, (std::vector<double>{120.5, 40.0}));
  EXPECT_TRUE(mechanism.optimize.feasible);
  EXPECT_EQ(parse_mechanism(write_mechanism(mechanism), "g.toml"), mechanism);
}

}  // namespace
}  // namespace fusee
