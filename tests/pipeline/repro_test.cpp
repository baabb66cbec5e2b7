// Regressions: designs with a sound part that failed a check, a refusal reported as a bug, or advice that did not help.
// Each is built, or refused with advice that builds.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "base/text.h"
#include "fusee/mechanism_file.h"
#include "fusee/pipeline.h"

namespace {

using namespace fusee;
namespace fs = std::filesystem;

struct Repro {
  const char* name;
  const char* path;  ///< relative to the source folder
  std::vector<Setting> settings;
  double tolerance = 0.01;  ///< chord error, mm
  pipeline::BuildStatus status = pipeline::BuildStatus::done;
};

std::string shown(const pipeline::BuildResult& built) {
  std::string text;
  for (const Check& check : built.product.checks)
    if (!check.ok) text += check.name + " " + rounded(check.value) + " " + check.where + "\n";
  for (const profile::Condition& condition : profile::failed_of(built.product.synthesis.conditions))
    text += condition.message + "\n";
  for (const profile::Condition& condition : profile::failed_of(built.product.pulley.conditions))
    text += condition.message + "\n";
  return text;
}

pipeline::BuildResult dry_run(const Repro& repro, std::vector<Setting> more = {}) {
  more.insert(more.begin(), repro.settings.begin(), repro.settings.end());
  pipeline::BuildOptions options;
  options.chord_error_mm = repro.tolerance;
  options.dry_run = true;
  return pipeline::build(read_mechanism(fs::path(FUSEE_SOURCE_DIR) / repro.path, more), options);
}

/// The setting as a user types it.
Setting setting_of(const profile::Change& change, const Mechanism& mechanism) {
  if (!change.to_word.empty()) return {change.key, change.to_word};
  const std::string number = fmt::format("{}", change.to);
  const std::string low = fmt::format("{}", degrees(mechanism.joint.theta_min)),
                    high = fmt::format("{}", degrees(mechanism.joint.theta_max));
  if (change.key == "joint.range_deg") return {change.key, "[-" + number + ", " + number + "]"};
  if (change.key == "joint.range_deg[0]") return {"joint.range_deg", "[" + number + ", " + high + "]"};
  if (change.key == "joint.range_deg[1]") return {"joint.range_deg", "[" + low + ", " + number + "]"};
  return {change.key, number};
}

class Repros : public ::testing::TestWithParam<Repro> {};

TEST_P(Repros, IsBuiltOrRefusedWithValidAdvice) {
  const pipeline::BuildResult built = dry_run(GetParam());
  ASSERT_EQ(built.status, GetParam().status) << shown(built);
  if (built.status == pipeline::BuildStatus::done) return;
  EXPECT_NE(shown(built), "");
  if (built.advice.alone.empty()) return;
  const profile::Change& first = built.advice.alone.front();
  const pipeline::BuildResult advised = dry_run(GetParam(), {setting_of(first, built.product.file.mechanism)});
  EXPECT_EQ(advised.status, pipeline::BuildStatus::done) << first.text << "\n" << shown(advised);
}

INSTANTIATE_TEST_SUITE_P(
    Designs, Repros,
    ::testing::Values(
        Repro{"advice_wrong_body",
              "tests/data/repro/advice_wrong_body.toml",
              {},
              0.01,
              pipeline::BuildStatus::infeasible},
        Repro{"drc_a", "tests/data/repro/drc_a.toml", {}}, Repro{"drc_b", "tests/data/repro/drc_b.toml", {}, 0.0512},
        Repro{"mark_depth_2", "profiles/forearm.toml", {{"body.mark_depth_mm", "2"}}},
        Repro{"mark_depth_5", "profiles/forearm.toml", {{"body.mark_depth_mm", "5"}}},
        Repro{"raised_mark_5", "profiles/forearm.toml", {{"body.mark_depth_mm", "5"}, {"body.marks", "raised"}}},
        Repro{"no_rim_compensate", "tests/data/repro/exit1_no_rim_compensate.toml", {}},
        Repro{
            "no_rim_linear", "tests/data/repro/exit1_no_rim_linear.toml", {}, 0.01, pipeline::BuildStatus::infeasible},
        Repro{"no_rim_table", "tests/data/repro/exit1_no_rim_table.toml", {}},
        Repro{"rewind", "tests/data/repro/exit1_rewind.toml", {}, 0.01, pipeline::BuildStatus::infeasible},
        Repro{"paper_floor_deviation", "tests/data/repro/paper_floor_deviation.toml", {}},
        Repro{"plates_off_sheet", "tests/data/repro/plates_off_sheet.toml", {}},
        Repro{"spare_vertices", "tests/data/repro/spare_vertices.toml", {}},
        Repro{"plates_smallest_feature", "tests/data/repro/plates_smallest_feature.toml", {}},
        Repro{"thin_tendon", "profiles/forearm.toml", {{"tendon.diameter_mm", "0.3"}}},
        Repro{"slow_refusal", "tests/data/repro/slow_refusal.toml", {}, 0.01, pipeline::BuildStatus::infeasible},
        Repro{
            "slow_refusal_31s", "tests/data/repro/slow_refusal_31s.toml", {}, 0.01, pipeline::BuildStatus::infeasible},
        Repro{"slot_inside_out", "tests/data/repro/slot_inside_out.toml", {}, 0.01, pipeline::BuildStatus::infeasible},
        Repro{"hollow_cut", "tests/data/repro/hollow_cut.toml", {}, 0.01, pipeline::BuildStatus::infeasible},
        Repro{"horn_in_hub", "tests/data/repro/horn_in_hub.toml", {}, 0.01, pipeline::BuildStatus::infeasible},
        Repro{"slack_of_many_turns", "tests/data/repro/slack_of_many_turns.toml", {}},
        Repro{"replanned_heights", "tests/data/repro/replanned_heights.toml", {}},
        Repro{"mark_over_channel", "tests/data/repro/mark_over_channel.toml", {}, 0.0030928800816377943},
        Repro{"thin_dowel", "tests/data/repro/thin_dowel.toml", {}},
        Repro{"drawn_far_out", "tests/data/repro/drawn_far_out.toml", {}, 0.00685},
        Repro{"floats_of_a_giant",
              "tests/data/repro/floats_of_a_giant.toml",
              {},
              0.00262,
              pipeline::BuildStatus::infeasible},
        Repro{"within_the_largest",
              "tests/data/repro/floats_of_a_giant.toml",
              {{"pulley.r1_mm", "221"}},
              0.00262,
              pipeline::BuildStatus::done},
        Repro{"bridge_of_a_giant", "tests/data/repro/bridge_of_a_giant.toml", {}, 0.00434, pipeline::BuildStatus::done},
        Repro{
            "range_past_table", "tests/data/repro/range_past_table.toml", {}, 0.01, pipeline::BuildStatus::infeasible},
        Repro{"arc_16_km_out",
              "tests/data/repro/arc_16_km_out.toml",
              {{"joint.range_deg", "[-18.6, 18.6]"}},
              0.01,
              pipeline::BuildStatus::infeasible},
        Repro{"arc_16_km_out_was_advised",
              "tests/data/repro/arc_16_km_out.toml",
              {},
              0.01,
              pipeline::BuildStatus::infeasible},
        Repro{"sharp_bend_3_m_out",
              "tests/data/repro/sharp_bend_3_m_out.toml",
              {},
              0.01,
              pipeline::BuildStatus::infeasible},
        Repro{"table_over_turns", "tests/data/repro/table_over_turns.toml", {}},
        Repro{"sound_or_printable", "tests/data/repro/sound_or_printable.toml", {}},
        Repro{"hub_wider_than_a_helix",
              "tests/data/repro/hub_wider_than_a_helix.toml",
              {},
              0.01,
              pipeline::BuildStatus::infeasible},
        Repro{"pocket_as_wide_as_its_channel",
              "tests/data/repro/pocket_as_wide_as_its_channel.toml",
              {},
              0.01,
              pipeline::BuildStatus::infeasible},
        Repro{"slack_of_the_papers_drawing", "tests/data/repro/slack_of_the_papers_drawing.toml", {}},
        Repro{"floor_of_a_giant_helix", "tests/data/repro/floor_of_a_giant_helix.toml", {}, 0.00525628},
        Repro{"wave_in_a_paper_corner",
              "tests/data/repro/wave_in_a_paper_corner.toml",
              {},
              0.01,
              pipeline::BuildStatus::infeasible},
        Repro{"bore_of_the_cut_plates", "tests/data/repro/bore_of_the_cut_plates.toml", {}},
        Repro{"bore_in_a_drawing_alone",
              "tests/data/repro/bore_in_a_drawing_alone.toml",
              {{"pulley.r1_mm", "65"}},
              0.01,
              pipeline::BuildStatus::infeasible},
        Repro{"sliver_of_a_cone",
              "tests/data/repro/sliver_of_a_cone.toml",
              {},
              0.0106,
              pipeline::BuildStatus::infeasible},
        Repro{"ticks_of_like_pulleys",
              "profiles/elbow_capstan.toml",
              {{"joint.drum_radius_mm", "58.7"},
               {"joint.length_mm", "59"},
               {"joint.attachment1_mm", "[-41.64, 41.64]"},
               {"joint.attachment2_mm", "[-41.64, 41.64]"},
               {"pulley.EF_mm", "111.5"},
               {"pulley.law", "compensate"},
               {"pulley.r1_mm", "9.62"},
               {"joint.range_deg", "[-12.3, 33.0]"},
               {"body.spare_turns", "0.3"}}},
        Repro{"rim_inside_a_hub",
              "profiles/elbow_capstan.toml",
              {{"joint.drum_radius_mm", "43.8"},
               {"joint.length_mm", "44.1"},
               {"joint.attachment1_mm", "[-31.07, 31.07]"},
               {"joint.attachment2_mm", "[-31.07, 31.07]"},
               {"pulley.EF_mm", "82.8"},
               {"pulley.law", "compensate"},
               {"pulley.r1_mm", "10.34"},
               {"joint.range_deg", "[-54.5, 63.7]"},
               {"tendon.diameter_mm", "0.96"},
               {"body.spare_turns", "1.91"},
               {"body.groove_depth_mm", "2.03"}},
              0.01,
              pipeline::BuildStatus::infeasible},
        Repro{"pocket_in_plates", "tests/data/repro/pocket_in_plates.toml", {}},
        Repro{
            "entry_of_a_variant", "tests/data/repro/entry_of_a_variant.toml", {{"joint.range_deg", "[-29.8, 29.8]"}}}),
    [](const auto& repro) { return std::string(repro.param.name); });

}  // namespace
