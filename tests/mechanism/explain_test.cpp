#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "mechanism/catalogue.h"

namespace fusee {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::filesystem::path k_profiles = std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles";

TEST(Explain, DescribesOneKey) {
  const std::string text = explain("r1_mm");
  EXPECT_EQ(text, explain("pulley.r1_mm"));
  for (const char* part :
       {"pulley.r1_mm  (r1)", "a number in mm", "0.1 to 10000 mm", "required with law = \"compensate\""}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(explain("friction"), HasSubstr("default 0.12"));
}

TEST(Explain, DescribesKeyOfTwoTables) {
  EXPECT_THAT(explain("ratio"), HasSubstr("pulley.ratio"));
  EXPECT_THAT(explain("ratio"), HasSubstr("transmission.ratio"));
}

TEST(Explain, ListsKeysOfOneTable) {
  EXPECT_THAT(explain("pulley"), HasSubstr("EF_mm"));
  EXPECT_THAT(explain("pulley"), Not(HasSubstr("length_mm")));
}

TEST(Explain, ListsAllKeys) {
  for (const Field& field : fields()) EXPECT_THAT(explain(""), HasSubstr("  " + std::string(field.key) + " "));
}

TEST(Explain, FitsTerminalWidth) {
  std::vector<std::string> words{""};
  for (const Field& field : fields()) words.push_back(field.name());
  for (const std::string& word : words) {
    std::istringstream lines(explain(word));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(characters(line), 80u) << word << ": " << line;
  }
}

// Joins the wrapped lines of list entries.
std::string with_whole_entries(const std::string& text) { return std::regex_replace(text, std::regex("\n {6}"), " "); }

TEST(Explain, ShowsCatalogueEntries) {
  const std::string horn_words = with_whole_entries(explain("body.horn"));
  for (const HornType& type : horns()) {
    EXPECT_THAT(horn_words, HasSubstr("    " + type.name + ": " + type.description + "; "));
    EXPECT_THAT(horn_words, HasSubstr(". " + type.source + "\n"));
  }
  EXPECT_THAT(horn_words, HasSubstr("8 holes of 2.2 mm on 16 mm, a boss of 8 mm, 1.9 mm high"));
  EXPECT_THAT(horn_words, HasSubstr("25 teeth, 5.92 mm over them, 0.3 mm deep"));
  const std::string shaft_words = with_whole_entries(explain("body.shaft"));
  for (const ShaftType& type : shafts()) {
    EXPECT_THAT(shaft_words, HasSubstr("    " + type.name + ": " + type.description + "; "));
    EXPECT_THAT(shaft_words, HasSubstr(". " + type.source + "\n"));
  }
  EXPECT_THAT(shaft_words, HasSubstr("3 mm, 2.5 mm over the flat"));
  EXPECT_THAT(explain("tendon.modulus_MPa"), HasSubstr("steel-7x19-2.4"));
  EXPECT_THAT(explain("material.name"), HasSubstr("PETG"));
  const std::string motor_words = with_whole_entries(explain("motor.model"));
  for (const MotorModel& model : motor_models()) {
    EXPECT_THAT(motor_words, HasSubstr("    " + model.name + ": "));
    EXPECT_THAT(motor_words, HasSubstr(". " + model.source + "\n"));
  }
  EXPECT_THAT(motor_words, HasSubstr("MG996R: 180 deg, 1078.7 Nmm at stall, 429 deg/s."));
}

TEST(Explain, SuggestsNearestKey) {
  try {
    explain("r1_m");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.diagnostics().front().hint, HasSubstr("r1_mm"));
  }
}

TEST(Explain, JsonContainsEveryField) {
  const nlohmann::json json = nlohmann::json::parse(explain_json(""));
  EXPECT_EQ(json["fields"].size(), fields().size());
  EXPECT_EQ(json["catalogue"]["horns"].size(), horns().size());
  EXPECT_EQ(json["catalogue"]["horns"][0]["bolt_circle_mm"], 16.66);
  EXPECT_EQ(json["catalogue"]["shafts"].size(), shafts().size());
  EXPECT_EQ(json["catalogue"]["motors"].size(), motor_models().size());
  EXPECT_EQ(json["catalogue"]["motors"][0]["travel_deg"], 180.0);
  EXPECT_EQ(nlohmann::json::parse(explain_json("EF_mm"))["fields"][0]["unit"], "mm");
}

TEST(Schema, ContainsEveryKeyWithBounds) {
  const nlohmann::json schema = nlohmann::json::parse(mechanism_schema());
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  for (const Field& field : fields()) {
    const nlohmann::json& object = field.table.empty() ? schema : schema["properties"][std::string(field.table)];
    EXPECT_EQ(object["additionalProperties"], false);
    const nlohmann::json& property = object["properties"][std::string(field.key)];
    EXPECT_THAT(property["description"].get<std::string>(), HasSubstr(std::string(field.meaning)));
    const bool is_length = field.unit == "mm";
    const bool is_number = field.kind == FieldKind::number && !is_length;
    EXPECT_EQ(property.value("minimum", 0.0), is_number ? field.least : 0.0) << field.name();
    EXPECT_EQ(property.value("maximum", 0.0), is_number ? field.most : 0.0) << field.name();
    if (is_length) {
      // A number within the bounds of the file's unit, or a text.
      const auto bound = [&](const char* units, const char* which) {
        const nlohmann::json& key =
            schema["allOf"].back()[units]["properties"][std::string(field.table)]["properties"][std::string(field.key)];
        return (field.kind == FieldKind::point ? key["items"] : key)[which].get<double>();
      };
      EXPECT_EQ(bound("else", "minimum"), field.least) << field.name();
      EXPECT_DOUBLE_EQ(bound("then", "maximum"), field.most / 25.4) << field.name();
    }
    if (field.kind == FieldKind::choice) {
      EXPECT_EQ(property["enum"].size(), field.choices.size()) << field.name();
    }
    EXPECT_EQ(property.contains("default"), !field.fallback.empty()) << field.name();
  }
}

TEST(Templates, AreReadableProfiles) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(k_profiles)) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    const std::string text = read_file(entry.path(), 1 << 20);
    EXPECT_EQ(find_template(entry.path().stem().string()), text);
    std::vector<Diagnostic> warnings;
    EXPECT_NO_THROW(parse_mechanism(text, entry.path().string(), k_profiles, {}, &warnings));
    EXPECT_TRUE(warnings.empty()) << to_text(warnings.front());
  }
  EXPECT_EQ(templates().size(), count);
}

TEST(Templates, HaveOneSentenceInOneGroup) {
  constexpr std::size_t k_longest = 62;  // a line of the list has 80 columns, 18 of them before the description
  std::vector<std::string> groups;
  for (const Template& known : templates()) {
    EXPECT_TRUE(known.description.ends_with('.')) << known.name;
    EXPECT_EQ(known.description.find(". "), std::string::npos) << known.name;
    EXPECT_LE(known.description.size(), k_longest) << known.name;
    if (groups.empty() || groups.back() != known.group) groups.push_back(known.group);
  }
  EXPECT_EQ(std::set<std::string>(groups.begin(), groups.end()).size(), groups.size());
}

TEST(Templates, SuggestNearestName) {
  try {
    find_template("forarm");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.diagnostics().front().hint, HasSubstr("forearm"));
  }
}

std::string code(std::string_view text) { return "`" + std::string(text) + "`"; }

TEST(Readme, NamesEveryProfile) {
  const std::string readme = read_file(k_profiles / "README.md", 1 << 20);
  for (const Template& profile : templates())
    EXPECT_THAT(readme, HasSubstr("| " + code(std::string(profile.name) + ".toml") + " |"));
}

}  // namespace
}  // namespace fusee
