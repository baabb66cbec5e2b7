#include <gmock/gmock.h>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "mechanism/mechanism_text.h"

namespace fusee {
namespace {

using testing::HasSubstr;

const std::string k_table =
    "[optimize]\n"                                                  // 15
    "objective = \"max_tension\"\n"                                 // 16
    "variables = [\"joint.length_mm\", \"guides.ED_mm\"]\n"         // 17
    "lower = [100, 30]\n"                                           // 18
    "upper = [300, 150]\n"                                          // 19
    "tied = [\"guides.EB_mm = guides.ED_mm\"]\n"                    // 20
    "constraints = [\"guides.EB_mm <= 0.5 * joint.length_mm\"]\n";  // 21

/// "line:column: message / hint" of each error.
std::string errors_of(const std::string& from, const std::string& to) {
  std::string text;
  try {
    parse_mechanism(k_good_file + (from.empty() ? k_table : replaced(k_table, from, to)), "f.toml");
  } catch (const InputError& error) {
    for (const Diagnostic& d : error.diagnostics()) {
      text += std::to_string(d.place.line) + ":" + std::to_string(d.place.column) + ": " + d.message + " / " + d.hint +
              "\n";
    }
  }
  return text;
}

TEST(OptimizeTable, AcceptsValidTable) { EXPECT_EQ(errors_of("", ""), ""); }

TEST(OptimizeTable, ReportsPlaceAndSuggestion) {
  EXPECT_THAT(errors_of("\"max_tension\"", "\"max_tensoin\""),
              HasSubstr("16:13: optimize.objective = \"max_tensoin\" is not known"));
  EXPECT_THAT(errors_of("\"max_tension\"", "\"max_tensoin\""), HasSubstr("did you mean \"max_tension\"?"));
  EXPECT_THAT(errors_of("guides.ED_mm\"]", "guides.ED\"]"),
              HasSubstr("17:33: \"guides.ED\" is not a key / did you mean guides.E"));
  EXPECT_THAT(errors_of("\"guides.ED_mm\"]", "\"joint.length_mm\"]"), HasSubstr("17:33: joint.length_mm occurs twice"));
  EXPECT_THAT(errors_of("[100, 30]", "[100, 200]"),
              HasSubstr("18:15: the bounds of guides.ED_mm are crossed: lower 200 mm is above upper 150 mm"));
  EXPECT_THAT(errors_of("[100, 30]", "[100]"), HasSubstr("optimize.lower has 1 number for 2 variables"));
  EXPECT_THAT(
      errors_of("[300, 150]", "[300, 1e5]"),
      HasSubstr("19:15: optimize.upper of guides.ED_mm = 100000 mm is out of range / allowed: 0.1 to 10000 mm"));
  EXPECT_THAT(errors_of("[300, 150]", "[300, nan]"), HasSubstr("19:15: optimize.upper holds numbers"));
  EXPECT_THAT(errors_of("objective =", "objectiv ="),
              HasSubstr("unknown key optimize.objectiv / did you mean objective?"));
}

TEST(OptimizeTable, ReportsColumnInConstraint) {
  // constraints = ["guides.EB_mm <= 0.5 * joint.lenght_mm"]: the text begins at column 17.
  EXPECT_THAT(errors_of("0.5 * joint.length_mm", "0.5 * joint.lenght_mm"), HasSubstr("21:39: optimize.constraints"));
  EXPECT_THAT(errors_of("0.5 * joint.length_mm", "0.5 * joint.lenght_mm"), HasSubstr("did you mean joint.length_mm?"));
  EXPECT_THAT(errors_of("<= 0.5", "< 0.5"), HasSubstr("21:30: "));
}

TEST(OptimizeTable, RejectsInvalidTies) {
  EXPECT_THAT(errors_of("guides.EB_mm = guides.ED_mm", "2 * guides.EB_mm = guides.ED_mm"),
              HasSubstr("does not define a key"));
  EXPECT_THAT(errors_of("guides.EB_mm = guides.ED_mm", "guides.EB_mm = guides.EB_mm + 1"),
              HasSubstr("is tied to itself"));
  EXPECT_THAT(errors_of("guides.EB_mm = guides.ED_mm", "guides.ED_mm = guides.EB_mm"),
              HasSubstr("is tied, and a variable as well"));
  EXPECT_THAT(errors_of("\"guides.EB_mm = guides.ED_mm\"",
                        "\"guides.EB_mm = pulley.r1_mm\", \"pulley.r1_mm = 3 + guides.ED_mm\""),
              HasSubstr("used before it is tied"));
}

TEST(OptimizeTable, ReportsAllErrors) {
  const std::string text = k_good_file + replaced(replaced(k_table, "max_tension", "x"), "[100, 30]", "[500, 30]");
  try {
    parse_mechanism(text, "f.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().size(), 2u);
  }
}

}  // namespace
}  // namespace fusee
