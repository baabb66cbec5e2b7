#include <gmock/gmock.h>

#include <random>
#include <set>

#include "fusee/mechanism_file.h"
#include "mechanism/mechanism_text.h"

namespace fusee {
namespace {

TEST(Fields, NamesAreUniqueAndFound) {
  std::set<std::string> names;
  for (const Field& field : fields()) {
    EXPECT_TRUE(names.insert(field.name()).second) << field.name();
    EXPECT_EQ(find_field(field.name()), &field);
    EXPECT_FALSE(field.meaning.empty()) << field.name();
  }
  EXPECT_EQ(find_field("joint.nothing"), nullptr);
  EXPECT_EQ(find_field(""), nullptr);
}

TEST(Fields, NamesIncludeUnits) {
  for (const Field& field : fields()) {
    std::string unit = field.unit == "%" ? "percent" : std::string(field.unit);
    if (const std::size_t slash = unit.find('/'); slash != std::string::npos) unit.replace(slash, 1, "_per_");
    EXPECT_TRUE(unit.empty() || field.key.ends_with("_" + unit)) << field.name();
  }
}

TEST(Fields, RowsAccessDistinctMembers) {
  const DeclaredMechanism start = parse_mechanism(k_good_file, "f.toml");
  std::vector<DeclaredMechanism> changed;
  for (const Field& field : fields()) {
    if (field.key == "schema") continue;
    for (int end = 0; end < (field.kind == FieldKind::range ? 2 : 1); ++end) {
      DeclaredMechanism mechanism = start;
      if (field.set != nullptr) {
        const double fraction = field.whole ? 0.0 : 0.125, value = 0.25 * field.least + 0.75 * field.most - fraction;
        field.set(mechanism, end, value);
        EXPECT_NEAR(field.get(mechanism, end), value, 1e-9) << field.name();
      } else if (field.kind == FieldKind::numbers) {
        field.numbers(mechanism).push_back(1.5);
      } else if (field.kind == FieldKind::texts) {
        field.texts(mechanism).push_back("another text");
      } else if (field.kind == FieldKind::text) {
        field.set_text(mechanism, "another text");
        EXPECT_EQ(field.get_text(mechanism), "another text");
      } else {
        const std::string now = field.get_text(mechanism);
        for (const std::string_view value : field.choices) {
          if (value != now) field.set_text(mechanism, value);
        }
        if (field.kind == FieldKind::boolean) field.set_text(mechanism, now == "true" ? "false" : "true");
        EXPECT_NE(field.get_text(mechanism), now) << field.name();
      }
      EXPECT_FALSE(mechanism == start) << field.name();
      for (const DeclaredMechanism& other : changed) EXPECT_FALSE(mechanism == other) << field.name();
      changed.push_back(mechanism);
    }
  }
}

TEST(Fields, DefaultsAreWithinBounds) {
  const DeclaredMechanism defaults = default_mechanism();
  for (const Field& field : fields()) {
    if (field.kind != FieldKind::number || field.fallback.empty()) continue;
    EXPECT_GE(field.get(defaults, 0), field.least) << field.name();
    EXPECT_LE(field.get(defaults, 0), field.most) << field.name();
  }
}

TEST(NumberKeys, ReadBackTheNumberThatTheyReport) {
  std::mt19937_64 random(1);
  DeclaredMechanism mechanism = default_mechanism();
  for (const std::string& name : number_key_names()) {
    const NumberKey key = *find_number_key(name);
    if (key.field->whole) continue;
    std::uniform_real_distribution<double> inside(std::max(key.field->least, -100.0), std::min(key.field->most, 100.0));
    for (int i = 0; i < 1000; ++i) {
      key.set(mechanism, inside(random));
      const DeclaredMechanism once = mechanism;
      key.set(mechanism, key.get(mechanism));
      ASSERT_EQ(mechanism, once) << name << " = " << key.get(once);
    }
  }
}

TEST(NumberKeys, AreNumbersAndEndsOfRanges) {
  DeclaredMechanism mechanism = parse_mechanism(k_good_file, "f.toml");
  EXPECT_EQ(find_number_key("joint.length_mm")->get(mechanism), 100.0);
  find_number_key("joint.range_deg[1]")->set(mechanism, 20.0);
  EXPECT_NEAR(mechanism.joint.theta_max, radians(20.0), 1e-15);
  for (const char* none :
       {"joint.range_deg", "joint.length_mm[0]", "pulley.law", "schema", "nothing", "joint.range_deg[2]"}) {
    EXPECT_FALSE(find_number_key(none)) << none;
  }
  for (const std::string& name : number_key_names()) EXPECT_TRUE(find_number_key(name)) << name;
}

}  // namespace
}  // namespace fusee
