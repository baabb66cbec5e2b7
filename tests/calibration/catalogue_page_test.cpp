// The table of docs/reference/effects.md is that of the program.
#include <gmock/gmock.h>

#include <filesystem>

#include "calibration/contract_effects.h"
#include "fusee/base.h"
#include "mechanism/effect.h"

namespace fusee::calibration {
namespace {

const std::filesystem::path k_page = std::filesystem::path(FUSEE_SOURCE_DIR) / "docs/reference/effects.md";

std::string numbers(const fusee::Effect& effect) {
  std::string text;
  for (const EffectParameter& parameter : effect.parameters) text += (text.empty() ? "`" : " `") + parameter.name + "`";
  return text;
}

std::string corrected_by(CorrectableBy what) {
  return what == CorrectableBy::nothing ? "–" : std::string(fusee::word(what));
}

/// The effects of joints with tendons, each followed by the differences of joints declared by a ratio.
std::string catalogue_table() {
  std::string text =
      "| place | effect | how it shows | its numbers | corrected by | how to separate it "
      "|\n|---|---|---|---|---|---|\n";
  for (const fusee::Effect& effect : effects(JointKind::tendons)) {
    std::string shown = effect.is_tested ? numbers(effect) : "", by = corrected_by(effect.correctable_by);
    if (const fusee::Effect* other = find_effect(effect.name, JointKind::ratio)) {
      if (numbers(*other) != shown) shown += (shown.empty() ? "ratio: " : "; ratio: ") + numbers(*other);
      if (other->correctable_by != effect.correctable_by) by += "; ratio: " + corrected_by(other->correctable_by);
    }
    text += "| " + std::string(fusee::word(effect.place)) + " | `" + effect.name + "` | " + effect.signature + " | " +
            shown + " | " + by + " | " + effect.separating_run + " |\n";
  }
  return text;
}

TEST(CalibrationPage, ListsCatalogueOfProgram) {
  const std::string page = read_file(k_page, 1 << 20);
  const std::string begin = "<!-- catalogue: begin -->\n", end = "<!-- catalogue: end -->";
  const std::size_t from = page.find(begin), to = page.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(page.substr(from + begin.size(), to - from - begin.size()), catalogue_table())
      << "docs/reference/effects.md lags behind the catalogue: put the text above between its two marks";
}

TEST(CalibrationPage, CatalogueContainsEveryContractName) {
  std::vector<std::string> names;
  for (const fusee::Effect& effect : effects(JointKind::tendons)) names.push_back(effect.name);
  for (const char* name : k_contract_effects) EXPECT_THAT(names, testing::Contains(name));
}

}  // namespace
}  // namespace fusee::calibration
