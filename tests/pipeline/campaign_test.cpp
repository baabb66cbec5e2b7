// Random designs through the whole build, with every law and option, with motors and inches: each is built with all
// checks, or refused with a reason. FUSEE_LAW_CASES: number of designs (24); FUSEE_LAW_SEED: seed (1). Also the options
// in [body] and [print] on three mechanisms: every pair of words of two keys, FUSEE_LAW_CASES further combinations, and
// with FUSEE_LONG_TESTS all distinct combinations (7560 a mechanism, a quarter of an hour of one core each).
#include "support/campaign.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/kit.h"
#include "fusee/mechanism_file.h"
#include "fusee/pipeline.h"
#include "support/motor_and_units.h"

namespace {

using namespace fusee;
using fusee::testing::BuildEnd;
using fusee::testing::Dice;
using fusee::testing::number_in;

struct Number {
  const char* key;
  double low, high;
};
/// Values that users may plausibly write.
constexpr std::array k_numbers{Number{"guides.friction", 0, 0.5},
                               Number{"tendon.modulus_MPa", 500, 2e5},
                               Number{"tendon.pretension_N", 0, 60},
                               Number{"tendon.bend_ratio", 2, 20},
                               Number{"load.tip_force_N", -40, 40},
                               Number{"load.mass_kg", 0, 3},
                               Number{"body.groove_angle_deg", 0, 90},
                               Number{"body.groove_depth_mm", 0.4, 6},
                               Number{"body.seat_ratio", 0.5, 1},
                               Number{"body.flange_thickness_mm", 0.6, 4},
                               Number{"body.hub_diameter_mm", 6, 40},
                               Number{"body.hub_height_mm", 0, 15},
                               Number{"body.bore_diameter_mm", 1.5, 12},
                               Number{"body.anchor_hole_mm", 0.6, 4},
                               Number{"body.knot_pocket_mm", 1, 8},
                               Number{"body.mark_depth_mm", 0.1, 5},
                               Number{"body.min_wall_mm", 0.4, 3},
                               Number{"material.shrinkage_percent", -1, 3},
                               Number{"material.hole_compensation_mm", -0.2, 0.5},
                               Number{"material.elephant_foot_mm", 0, 0.8},
                               Number{"cut.kerf_mm", 0, 0.6},
                               Number{"cut.plate_mm", 1, 8},
                               Number{"cut.sheet_width_mm", 80, 900},
                               Number{"cut.sheet_height_mm", 80, 900},
                               Number{"cut.dowel_mm", 0, 5},
                               Number{"identified.radius_offset_mm", -0.2, 0.2},
                               Number{"identified.pulley_scale_percent", -2, 2},
                               Number{"identified.runout_x_mm", -0.2, 0.2},
                               Number{"identified.profile_sin_mm", -0.1, 0.1},
                               Number{"identified.guide1_outward_mm", -0.5, 0.5}};

std::vector<Setting> body_choices(Dice& dice) {
  std::vector<Setting> settings;
  const auto choose = [&](double probability, const char* key, const auto& words) {
    if (dice.happens(probability)) settings.push_back({key, dice.one_of(words)});
  };
  choose(0.15, "body.groove", std::array{"u", "v", "flat"});
  choose(0.15, "body.flange", std::array{"follow", "round"});
  choose(0.15, "body.nut_trap", std::array{"true", "false"});
  choose(0.15, "body.marks", std::array{"engraved", "raised", "none"});
  choose(0.15, "body.set_screw", std::array{"auto", "none", "M2", "M3", "M4", "M6"});
  choose(0.4, "body.bore", std::array{"round", "d", "hex", "square", "keyway", "horn"});
  choose(0.15, "print.parts", std::array{"one", "two"});
  choose(0.1, "print.supports", std::array{"true", "false"});
  const bool has_horn = !settings.empty() && std::any_of(settings.begin(), settings.end(),
                                                         [](const Setting& s) { return s.value == "horn"; });
  if (has_horn)
    settings.push_back({"body.horn", dice.one_of(std::array{"lynxmotion-ses", "actobotics-0.770", "disc-25T-M3"})});
  return settings;
}

struct Design {
  std::string text;
  double tolerance = 0.01;
};

Design draw_design(std::uint64_t seed) {
  Dice dice(seed);
  const bool is_extreme = dice.happens(0.2);
  const double R = is_extreme ? dice.log_between(2, 1500) : dice.log_between(15, 400);
  const auto share = [&](double low, double high, double wide_low, double wide_high) {
    return fmt::format("{}", R * (is_extreme ? dice.between(wide_low, wide_high) : dice.between(low, high)));
  };
  std::map<std::string, std::vector<Setting>> tables;
  const auto add = [&tables](const std::string& key, const std::string& value) {
    tables[key.substr(0, key.find('.'))].push_back({key.substr(key.find('.') + 1), value});
  };
  add("joint.length_mm", fmt::format("{}", R));
  const double half = is_extreme ? dice.log_between(0.5, 80) : dice.between(8, 36);
  add("joint.range_deg", fmt::format("[{}, {}]", dice.happens(0.6) ? -half : -half * dice.between(0.1, 1), half));
  const std::string EB = share(0.2, 0.9, 0.05, 2);
  add("guides.EB_mm", EB);
  add("guides.ED_mm", dice.happens(0.6) ? EB : share(0.2, 0.9, 0.05, 2));
  add("guides.OE_mm", share(-0.45, 0.05, -2, 2));
  add("guides.radius_mm",
      fmt::format("{}", dice.happens(0.3) ? 0.0 : std::min(10.0, R * dice.log_between(0.004, 0.05))));
  add("pulley.EF_mm", share(0.75, 1.5, 0.1, 4));
  if (dice.happens(0.7)) {
    add("pulley.r1_mm", share(0.1, 0.2, 0.02, 1));
  } else {
    add("pulley.law", "\"linear\"");
    add("pulley.ratio", fmt::format("{}", dice.between(2, 6)));
  }
  if (dice.happens(0.2)) add("pulley.method", "\"paper\"");
  add("tendon.diameter_mm", fmt::format("{}", std::clamp(R * dice.log_between(0.004, 0.03), 0.2, 8.0)));
  for (const Setting& choice : body_choices(dice))
    add(choice.key, choice.value == "true" || choice.value == "false" ? choice.value : "\"" + choice.value + "\"");
  const double probability = 0.25 * dice.between(0, 1);
  for (const Number& number : k_numbers)
    if (dice.happens(probability)) add(number.key, fmt::format("{:.6g}", dice.between(number.low, number.high)));
  Design design{"schema = 1\nname = \"random\"\n", dice.happens(0.2) ? dice.log_between(0.002, 0.1) : 0.01};
  for (const auto& [table, keys] : tables) {
    design.text += "\n[" + table + "]\n";
    for (const Setting& key : keys) design.text += key.key + " = " + key.value + "\n";
  }
  return design;
}

/// The test rig is designed, or refused with the reason.
void expect_kit_or_reasons(const formats::Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const kit::KitPlan plan = kit::plan_kit(mechanism, product.synthesis, product.pulley.layout);
  for (const profile::Condition& condition : plan.conditions)
    EXPECT_EQ(condition.ok, condition.message.empty()) << condition.name;
  EXPECT_EQ(plan.made(), profile::failed_of(plan.conditions).empty());
  EXPECT_EQ(plan.made(), !plan.parts.empty());
  for (const kit::KitPart& part : plan.parts) {
    const double volume = kit::printed_volume(part, mechanism, product.pulley.layout);
    EXPECT_NEAR(solid::enclosed_volume(kit::printed_mesh(part, mechanism, product.pulley.layout)) / volume, 1, 1e-4)
        << part.name;
  }
}

/// Builds the mechanism that `read` returns.
template <typename Read>
BuildEnd build_end(Read read, double tolerance) {
  pipeline::BuildOptions options;
  options.chord_error_mm = tolerance;
  options.dry_run = true;
  options.advice = false;  // tested elsewhere, and slower than all other checks
  try {
    const pipeline::BuildResult built = pipeline::build(read(), options);
    for (const Check& check : built.product.checks)
      EXPECT_TRUE(check.ok) << check.name << " " << check.value << ", limit " << check.limit << "; " << check.where;
    if (built.status == pipeline::BuildStatus::infeasible) return BuildEnd::refused;
    expect_kit_or_reasons(built.product);
    return BuildEnd::made;
  } catch (const InputError&) {
    return BuildEnd::bad_input;
  }
}

constexpr int k_shards = 8;  // so that ctest can run them in parallel

class Campaign : public ::testing::TestWithParam<int> {};

TEST_P(Campaign, DesignsAreBuiltOrRefused) {
  const int cases = number_in("FUSEE_LAW_CASES", 24), seed = number_in("FUSEE_LAW_SEED", 1);
  int made = 0, refused = 0, bad = 0;
  for (int i = GetParam(); i < cases; i += k_shards) {
    const Design design = draw_design(static_cast<std::uint64_t>(seed) * 1000003 + static_cast<std::uint64_t>(i));
    SCOPED_TRACE(
        fmt::format("FUSEE_LAW_SEED={}, design {}, --tolerance-mm {}\n{}", seed, i, design.tolerance, design.text));
    try {
      const auto read = [&design, i] {
        MechanismFile file;
        file.mechanism =
            fusee::testing::with_motor_and_units(design.text, static_cast<std::uint64_t>(i), "random.toml");
        return file;
      };
      const BuildEnd end = build_end(read, design.tolerance);
      if (end == BuildEnd::made) ++made;
      if (end == BuildEnd::refused) ++refused;
      if (end == BuildEnd::bad_input) ++bad;
    } catch (const std::exception& bug) {
      ADD_FAILURE() << bug.what();
    }
  }
  EXPECT_GT(made + refused, 8 * bad);
  if (cases >= 64) {
    EXPECT_GT(made, 0);
    EXPECT_GT(refused, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Random, Campaign, ::testing::Range(0, k_shards));

// ---- every choice ---------------------------------------------------------------------------------------------------

struct Choice {
  std::string key;
  std::vector<std::string> words;
};

/// All words of the keys of [body] and [print]; two or three screws and shafts stand for all.
std::vector<Choice> all_choices() {
  const std::map<std::string, std::vector<std::string>> fewer{{"body.set_screw", {"auto", "none", "M3"}},
                                                              {"body.clamp_screw", {"none", "M2"}},
                                                              {"body.shaft", {"none", "nema17-d5"}},
                                                              {"print.parts", {"one", "two"}}};
  std::vector<Choice> choices;
  for (const Field& field : fields()) {
    if (field.table != "body" && field.table != "print") continue;
    Choice choice{field.name(), {field.choices.begin(), field.choices.end()}};
    if (field.kind == FieldKind::boolean) choice.words = {"true", "false"};
    if (fewer.count(choice.key)) choice.words = fewer.at(choice.key);
    if (choice.words.size() > 1) choices.push_back(choice);
  }
  return choices;
}

/// For each choice the index of its word.
using Combination = std::vector<std::size_t>;

Combination combination_of(std::size_t number, const std::vector<Choice>& choices) {
  Combination combination;
  for (const Choice& choice : choices) {
    combination.push_back(number % choice.words.size());
    number /= choice.words.size();
  }
  return combination;
}

/// False if a key that another key makes irrelevant has another than its first word: the design occurs elsewhere.
bool is_distinct(const Combination& combination, const std::vector<Choice>& choices) {
  const auto at = [&](const std::string& key) {
    return static_cast<std::size_t>(
        std::find_if(choices.begin(), choices.end(), [&](const Choice& choice) { return choice.key == key; }) -
        choices.begin());
  };
  const auto word = [&](const std::string& key) { return choices[at(key)].words[combination[at(key)]]; };
  if (word("body.shaft") != "none" && combination[at("body.bore")] != 0) return false;
  if (word("body.set_screw") == "none" && combination[at("body.nut_trap")] != 0) return false;
  return word("body.tail") != "none" || combination[at("body.clamp_screw")] == 0;
}

/// All combinations, in an order in which neighbours differ in most keys.
std::vector<Combination> all_combinations(const std::vector<Choice>& choices) {
  constexpr std::size_t k_stride = 7919;  // a prime
  std::size_t count = 1;
  for (const Choice& choice : choices) count *= choice.words.size();
  std::vector<Combination> all;
  for (std::size_t n = 0; n < count; ++n) {
    const Combination combination = combination_of(n * k_stride % count, choices);
    if (is_distinct(combination, choices)) all.push_back(combination);
  }
  return all;
}

using Pairs = std::set<std::array<std::size_t, 4>>;

Pairs pairs_in(const Combination& combination) {
  Pairs pairs;
  for (std::size_t i = 0; i < combination.size(); ++i) {
    for (std::size_t k = i + 1; k < combination.size(); ++k) pairs.insert({i, combination[i], k, combination[k]});
  }
  return pairs;
}

/// First a set that contains every pair of words of two keys, then the others. `needed`: size of that set.
std::vector<Combination> pairs_first(std::vector<Combination> all, std::size_t& needed) {
  Pairs missing;
  for (const Combination& combination : all) missing.merge(pairs_in(combination));
  constexpr std::size_t k_candidates = 300;
  for (needed = 0; !missing.empty(); ++needed) {
    const auto new_pairs = [&missing](const Combination& combination) {
      const Pairs pairs = pairs_in(combination);
      return std::count_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return missing.count(pair) != 0; });
    };
    std::size_t best = needed;
    for (std::size_t n = needed; n < all.size() && (n < needed + k_candidates || new_pairs(all[best]) == 0); ++n)
      if (new_pairs(all[n]) > new_pairs(all[best])) best = n;
    std::swap(all[needed], all[best]);
    for (const auto& pair : pairs_in(all[needed])) missing.erase(pair);
  }
  return all;
}

class Choices : public ::testing::TestWithParam<const char*> {
 protected:
  BuildEnd end_of_combination(const Combination& combination, const std::vector<Choice>& choices) {
    std::vector<Setting> settings{{"body.horn", "disc-25T-M3"}};
    std::string words;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      settings.push_back({choices[i].key, choices[i].words[combination[i]]});
      words += " --set " + settings.back().key + "=" + settings.back().value;
    }
    // With a shaft the bore is given by the shaft.
    const bool has_shaft = words.find("body.shaft=none") == std::string::npos;
    if (has_shaft) settings.push_back({"body.bore", "d"});
    SCOPED_TRACE(GetParam() + words);
    const auto read = [&] {
      return read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / GetParam(), settings);
    };
    try {
      return build_end(read, 0.01);
    } catch (const std::exception& bug) {
      ADD_FAILURE() << bug.what();
      return BuildEnd::bad_input;
    }
  }
};

TEST_P(Choices, AreBuiltOrRefused) {
  const std::vector<Choice> choices = all_choices();
  ASSERT_GE(choices.size(), 10u);
  std::size_t needed = 0;
  std::vector<Combination> combinations = pairs_first(all_combinations(choices), needed);
  const auto more = static_cast<std::size_t>(number_in("FUSEE_LAW_CASES", 0));
  if (std::getenv("FUSEE_LONG_TESTS") == nullptr) combinations.resize(std::min(combinations.size(), needed + more));
  std::map<BuildEnd, int> ends;
  for (const Combination& combination : combinations) ++ends[end_of_combination(combination, choices)];
  EXPECT_GT(ends[BuildEnd::made], 0);
  EXPECT_EQ(ends[BuildEnd::bad_input], 0);
  std::printf("%s: %zu combinations, %d made, %d refused\n", GetParam(), combinations.size(), ends[BuildEnd::made],
              ends[BuildEnd::refused]);
}

INSTANTIATE_TEST_SUITE_P(Profiles, Choices, ::testing::Values("forearm.toml", "gripper.toml", "wrist_exo.toml"));

}  // namespace
