// The catalogue's table in profiles/calibration.md is that of the program.
#include <gmock/gmock.h>

#include <filesystem>

#include "calibration/contract_effects.h"
#include "fusee/base/files.h"
#include "fusee/mechanism/file.h"
#include "mechanism/effects/effect.h"

namespace fusee {
namespace {

const std::filesystem::path k_profiles = std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles";

/// Everything logged, everything varied: no effect is beyond its reach.
Measurement rich_measurement() {
  Measurement measurement;
  measurement.load_unit = "N";
  for (const double load : {0.0, 10.0}) {
    Run run;
    run.has_time = run.has_load = run.has_temperature = true;
    run.speed = 0.2 * (1 + load);
    run.mean_load = load;
    for (int i = 0; i <= 100; ++i)
      run.samples.push_back({i * 0.1, radians(-180 + 3.6 * i), radians(-30 + 0.6 * i), load, 20 + 0.2 * i, 5, 5});
    measurement.runs.push_back(run);
  }
  return measurement;
}

std::string numbers(const Effect& effect) {
  std::string text;
  for (const EffectParameter& parameter : effect.parameters) text += (text.empty() ? "`" : " `") + parameter.name + "`";
  return text;
}

std::string corrected_by(const std::string& what) { return what.empty() ? "–" : what; }

/// As a joint with tendons has them; what a joint declared by a ratio has instead stands behind it.
std::string catalogue_table() {
  const Measurement measurement = rich_measurement();
  const Mechanism ratio = parse_mechanism("schema = 1\n[transmission]\nkind = \"ratio\"\nratio = 4\n", "ratio.toml");
  const std::vector<Effect> plain = catalogue(ratio, measurement);
  std::string text =
      "| place | effect | how it shows | its numbers | taken out by | what tells it from its rivals "
      "|\n|---|---|---|---|---|---|\n";
  for (const Effect& effect : catalogue(read_mechanism(k_profiles / "forearm.toml").mechanism, measurement)) {
    std::string shown = numbers(effect), by = corrected_by(effect.correctable_by);
    for (const Effect& other : plain) {
      if (other.name != effect.name) continue;
      if (numbers(other) != shown) shown += "; ratio: " + numbers(other);
      if (other.correctable_by != effect.correctable_by) by += "; ratio: " + corrected_by(other.correctable_by);
    }
    text += "| " + effect.place + " | `" + effect.name + "` | " + effect.signature + " | " + shown + " | " + by +
            " | " + effect.separating_run + " |\n";
  }
  return text;
}

TEST(CalibrationPage, ItsCatalogueIsThatOfTheProgram) {
  const std::string page = read_file(k_profiles / "calibration.md", 1 << 20);
  const std::string begin = "<!-- catalogue: begin -->\n", end = "<!-- catalogue: end -->";
  const std::size_t from = page.find(begin), to = page.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(page.substr(from + begin.size(), to - from - begin.size()), catalogue_table())
      << "profiles/calibration.md lags behind the catalogue: put the text above between its two marks";
}

TEST(CalibrationPage, TheCatalogueHoldsEveryNameThatWasPromised) {
  std::vector<std::string> names;
  for (const Effect& effect : catalogue(read_mechanism(k_profiles / "forearm.toml").mechanism, rich_measurement()))
    names.push_back(effect.name);
  for (const char* name : k_contract_effects) EXPECT_THAT(names, testing::Contains(name));
}

}  // namespace
}  // namespace fusee
