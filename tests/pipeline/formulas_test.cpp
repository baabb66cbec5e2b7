// Each of these formulas occurs once in the code. Tests have independent copies on purpose, so only the product's
// sources are searched.
#include <gmock/gmock.h>

#include <regex>

#include "pipeline/source_text.h"

namespace fusee::house {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A formula that may occur once, and its place.
struct Formula {
  std::string name;
  std::string pattern;
  std::string home;  ///< prefix of the path; "": anywhere
};
void PrintTo(const Formula& formula, std::ostream* stream) { *stream << formula.name; }

const std::vector<Formula> k_formulas = {
    // tan(π/4 − …) is another formula.
    {"section_stiffness", R"((0\.25\s*\*\s*k_pi|k_pi\s*/\s*4(\.0)?)\b(?!\s*-))", "include/fusee/mechanism.h"},
    {"standard_gravity", R"(\b9\.8\d*)", "src/transmission/load.h"},
    {"weight_moment", R"(\bmass(_kg)?\s*\*\s*k_gravity\b|\bk_gravity\s*\*\s*[\w.]*mass(_kg)?\b)",
     "src/transmission/load.cpp"},
    {"golden_section", R"(\b(0\.618|0\.38196|1\.618)\d*)", "src/base/"},
    {"target_motion", R"(\bclass\s+TargetMotion\b)", "src/transmission/target_motion.h"},
    {"binning", R"(\bstruct\s+Bins\b)", "src/measurement/value_range.h"},
    {"median", R"(\bmedian\w*\(std::vector<double>\s+\w+\)\s*\{)", ""},
    // The character itself is in quotes, which are blanked here.
    {"progress_bar", R"(std::string\(k_width - full)", "src/cli/"},
};

/// "src/transmission/load.cpp:15": every occurrence in code.
std::vector<std::string> places_of(const std::string& pattern, const std::vector<Source>& sources) {
  const std::regex regex(pattern);
  std::vector<std::string> places;
  for (const Source& source : sources) {
    const std::string code = code_of(source.text);
    for (std::sregex_iterator i(code.begin(), code.end(), regex), end; i != end; ++i)
      places.push_back(source.path + ":" + std::to_string(line_at(code, static_cast<std::size_t>(i->position()))));
  }
  return places;
}

const std::vector<Source>& searched_sources() {
  static const std::vector<Source> sources = sources_under({"include", "src", "export"});
  return sources;
}

class Formulas : public ::testing::TestWithParam<Formula> {};

TEST_P(Formulas, OccurOnce) {
  const std::vector<std::string> places = places_of(GetParam().pattern, searched_sources());
  ASSERT_THAT(places, ::testing::SizeIs(1));
  EXPECT_THAT(places.front(), ::testing::StartsWith(GetParam().home));
}

INSTANTIATE_TEST_SUITE_P(Symbols, Formulas, ::testing::ValuesIn(k_formulas),
                         [](const auto& tested) { return tested.param.name; });

TEST(FormulaText, IgnoresComments) {
  const std::vector<Source> sources = {{"a.cpp", "// 0.25 * k_pi * d * d\ndouble EA = E * 0.25 * k_pi * d * d;\n"},
                                       {"b.cpp", "double tangent = std::tan(0.25 * k_pi - 0.5 * lean);\n"}};
  EXPECT_THAT(places_of(k_formulas.front().pattern, sources), ElementsAre("a.cpp:2"));
  EXPECT_THAT(places_of(k_formulas.front().pattern, {sources[1]}), IsEmpty());
}

}  // namespace
}  // namespace fusee::house
