#include "pipeline/omissions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/text.h"
#include "fusee/analysis.h"
#include "pipeline/design.h"
#include "solid/hub.h"
#include "solid/plan.h"

namespace fusee::pipeline {
namespace {

// Factors by which a number is changed. A number that has to triple describes another joint.
constexpr std::array k_factors{1.05, 1.1, 1.2, 1.35, 1.5, 1.8, 2.2, 3.0};
// Limits of the search: plans take some milliseconds, builds some tenths of a second.
constexpr int k_most_plans = 60;
constexpr int k_most_builds = 6;
// Largest number of outline points with which the search is made: with more, every build takes seconds.
constexpr std::size_t k_most_points = 1600;

/// A number of the mechanism to change, and the direction of the change.
struct NumberChange {
  const char* key;
  double value = 0;   ///< present value; for an automatic number the chosen one
  bool grows = true;  ///< false: it shrinks
};

/// A changed mechanism with its number.
struct Trial {
  NumberChange change;
  double new_value = 0;
  Mechanism mechanism;
};

struct FeatureWords {
  std::string_view feature, words;
};
constexpr std::array k_words{FeatureWords{"set_screw", "the set screw"},
                             FeatureWords{"nut", "the nut"},
                             FeatureWords{"hub", "the hub"},
                             FeatureWords{"knot_pocket", "full knot pockets"},
                             FeatureWords{"bore", "the full bore"},
                             FeatureWords{"marks", "the marks"},
                             FeatureWords{"home_mark", "the home mark"},
                             FeatureWords{"clocking_mark", "the clocking mark"},
                             FeatureWords{"label_P1", "the label P1"},
                             FeatureWords{"label_P2", "the label P2"},
                             FeatureWords{"tail_slot_P1", "P1's tail slot"},
                             FeatureWords{"tail_slot_P2", "P2's tail slot"},
                             FeatureWords{"spare_tie_off_P1", "P1's spare tie-off"},
                             FeatureWords{"spare_tie_off_P2", "P2's spare tie-off"},
                             FeatureWords{"channel_P1", "P1's channel"},
                             FeatureWords{"channel_P2", "P2's channel"}};

std::string words_of(const std::string& feature) {
  const auto* found = std::find_if(k_words.begin(), k_words.end(),
                                   [&feature](const FeatureWords& entry) { return entry.feature == feature; });
  return found == k_words.end() ? feature : std::string(found->words);
}

std::vector<std::string> features_of(const solid::BodyLayout& layout) {
  std::vector<std::string> features;
  for (const solid::Omission& omission : layout.omissions) features.push_back(omission.feature);
  return features;
}

bool has(const std::vector<std::string>& features, const std::string& feature) {
  return std::find(features.begin(), features.end(), feature) != features.end();
}

/// The value with two digits, rounded up or down.
double in_two_digits(double value, bool up) {
  const double unit = elementary::pow(10.0, std::floor(elementary::log10(value)) - 1.0), scaled = value / unit;
  return number_of(rounded((up ? std::ceil(scaled - 1e-9) : std::floor(scaled + 1e-9)) * unit, 3));
}

/// "the nut, the home mark": features in `omitted` that are not in `omitted_before`.
std::string words_of_lost(const std::vector<std::string>& omitted, const std::vector<std::string>& omitted_before) {
  std::string lost;
  for (const std::string& feature : omitted) {
    if (!has(omitted_before, feature)) lost += (lost.empty() ? "" : ", ") + words_of(feature);
  }
  return lost;
}

/// ", which omits the nut and takes 12 % more motor torque"; "" without a clause.
std::string which(const std::vector<std::string>& clauses) {
  std::string words;
  for (const std::string& clause : clauses)
    if (!clause.empty()) words += (words.empty() ? ", which " : " and ") + clause;
  return words;
}

class OmissionSearch {
 public:
  OmissionSearch(const formats::Product& product, const BuildOmissions& build, const RunContext& context)
      : product_(product), build_(build), context_(context), omitted_(features_of(product.pulley.layout)) {}

  /// Advice by feature, for each omitted feature that a change of one number brings back.
  std::map<std::string, std::string> all() {
    std::map<std::string, std::string> advice;
    for (const NumberChange& change : changes()) {
      for (const double factor : k_factors) {
        std::vector<std::string> without_advice;
        std::copy_if(omitted_.begin(), omitted_.end(), std::back_inserter(without_advice),
                     [&](const std::string& feature) { return advice.count(feature) == 0; });
        if (without_advice.empty() || plans_ == k_most_plans || builds_ == k_most_builds) return advice;
        const std::optional<Trial> trial = trial_of(change, factor);
        if (!trial) break;
        const auto planned = planned_omissions(*trial);
        const bool brings_one_back = planned && std::any_of(without_advice.begin(), without_advice.end(),
                                                            [&](const std::string& f) { return !has(*planned, f); });
        if (!brings_one_back || loses_fastening(*planned)) continue;
        context_.throw_if_stopped();
        ++builds_;
        const auto built = build_(trial->mechanism);
        if (!built || loses_fastening(built->omitted)) continue;
        for (const std::string& feature : without_advice) {
          if (!has(built->omitted, feature)) advice[feature] = sentence(*trial, *built);
        }
      }
    }
    return advice;
  }

 private:
  /// Numbers to change; those of the body first, since they change nothing else.
  std::vector<NumberChange> changes() const {
    const solid::BodyLayout& layout = product_.pulley.layout;
    const Mechanism& mechanism = product_.file.mechanism;
    const Body& body = mechanism.body;
    std::vector<NumberChange> all;
    // Another hub may bring back features of the hub and of P2, which is beside it, but none of P1 and none of these.
    const bool at_hub = std::any_of(omitted_.begin(), omitted_.end(), [](const std::string& feature) {
      return !feature.ends_with("_P1") && feature != "clocking_mark" && feature != "bore" && feature != "marks";
    });
    if (at_hub && body.bore != Bore::horn && body.hub_height > 0) {
      const double hub = 2.0 * (layout.hub_radius > 0 ? layout.hub_radius : solid::least_hub_radius(layout));
      all.push_back({"body.hub_diameter_mm", hub, false});
      all.push_back({"body.hub_diameter_mm", hub, true});
      if (has(omitted_, "set_screw") || has(omitted_, "nut"))
        all.push_back({"body.hub_height_mm", body.hub_height, true});
    }
    if (!product_.helix && !has(omitted_, "knot_pocket"))
      all.push_back({"body.knot_pocket_mm", 2.0 * layout.pocket_radius, false});
    if (mechanism.pulley.law == Law::compensate) all.push_back({"pulley.r1_mm", mechanism.pulley.r1, true});
    // p = m dθ/dα: a smaller ratio and a larger torque make both pulleys larger.
    if (mechanism.pulley.law == Law::linear) all.push_back({"pulley.ratio", mechanism.pulley.ratio, false});
    if (mechanism.pulley.law == Law::torque && mechanism.pulley.motor_torque > 0)
      all.push_back({"pulley.motor_torque_Nmm", mechanism.pulley.motor_torque, true});
    all.push_back({"body.groove_depth_mm", layout.groove_depth, true});
    all.push_back({"body.flange_thickness_mm", layout.flange_thickness, true});
    all.push_back({"body.min_wall_mm", layout.min_wall, false});
    return all;
  }

  std::optional<Trial> trial_of(const NumberChange& change, double factor) const {
    const Field& field = *find_field(change.key);
    if (!(change.value > 0)) return std::nullopt;
    Trial trial{change, in_two_digits(change.grows ? change.value * factor : change.value / factor, change.grows),
                product_.file.mechanism};
    // A wall thinner than a line of the nozzle is no advice.
    if (trial.new_value < (field.key == "min_wall_mm" ? product_.file.mechanism.print.nozzle : field.least))
      return std::nullopt;
    if (trial.new_value > field.most || trial.new_value == change.value) return std::nullopt;
    set_number(trial.mechanism, field, 0, trial.new_value);
    return trial;
  }

  /// Features that a plan of the trial omits; empty if the trial has no body. There are no plans for multi-turn
  /// pulleys: the plan is assumed to omit nothing, and the build decides.
  std::optional<std::vector<std::string>> planned_omissions(const Trial& trial) {
    ++plans_;
    if (product_.helix) return std::vector<std::string>{};
    const Curves curves = curves_of(with_declared(product_.file, trial.mechanism).mechanism);
    if (!curves.obstacles.empty()) return std::nullopt;
    const solid::BodyPlan plan = solid::plan_body(curves.joint.mechanism, curves.synthesis);
    return plan.is_possible() ? std::optional(features_of(plan.layout)) : std::nullopt;
  }

  /// Without its set screw or hub the pulley has nothing that holds it: no advice for another feature.
  bool loses_fastening(const std::vector<std::string>& built) const {
    const auto loses = [&](const char* feature) { return has(built, feature) && !has(omitted_, feature); };
    return loses("set_screw") || loses("hub") || loses("bore");
  }

  /// "try pulley.r1_mm = 11 (now 9)", and the further features that it omits.
  std::string sentence(const Trial& trial, const BuiltTrial& built) const {
    const double now = number_of(product_.file.mechanism, *find_field(trial.change.key));
    std::string text = fmt::format("try {} = {} (now {})", trial.change.key, rounded(trial.new_value, 3),
                                   now > 0 ? rounded(now) : "automatic, " + rounded(trial.change.value, 3));
    const std::string lost = words_of_lost(built.omitted, omitted_);
    return text + which({lost.empty() ? "" : "omits " + lost, built.cost});
  }

  const formats::Product& product_;
  const BuildOmissions& build_;
  const RunContext& context_;
  std::vector<std::string> omitted_;
  int plans_ = 0;
  int builds_ = 0;
};

}  // namespace

std::vector<std::string> notes_with_advice(const formats::Product& product, const BuildOmissions& build,
                                           const RunContext& context) {
  const solid::BodyLayout& layout = product.pulley.layout;
  std::vector<std::string> notes = layout.notes;
  if (layout.omissions.empty() || product.synthesis.p1.points.size() > k_most_points) return notes;
  const std::map<std::string, std::string> advice = OmissionSearch(product, build, context).all();
  for (const solid::Omission& omission : layout.omissions) {
    const auto found = advice.find(omission.feature);
    notes.at(omission.note) +=
        found != advice.end() ? "; " + found->second : "; no change of a single number that was tried brings it back";
  }
  return notes;
}

std::string costs(const formats::Product& changed, const formats::Product& before) {
  constexpr double k_more = 1.05;  // a ratio of torques or sizes that is worth a word
  std::string words;
  const auto add = [&words](const std::string& clause) { words += (words.empty() ? "" : " and ") + clause; };
  const auto torque = [](const formats::Product& product) {
    return analysis::under_load(product.joint.mechanism).largest_torque.value;
  };
  const double torque_before = torque(before), ratio = torque_before > 0 ? torque(changed) / torque_before : 1;
  if (ratio > k_more) add(fmt::format("takes {} % more motor torque", rounded(100 * (ratio - 1), 2)));
  const double pocket = 2 * changed.pulley.layout.pocket_radius, pocket_before = 2 * before.pulley.layout.pocket_radius;
  if (pocket > 0 && pocket * k_more < pocket_before && changed.file.mechanism.body.knot_pocket == 0)
    add(fmt::format("narrows the knot pockets to {} mm (now {})", rounded(pocket, 3), rounded(pocket_before, 3)));
  return words;
}

std::string lost_with(const formats::Product& changed, const formats::Product& before) {
  const std::string omitted = lost_features(changed.pulley.layout, before.pulley.layout);
  const bool bends = changed.synthesis.warnings.size() > before.synthesis.warnings.size();
  return which({omitted.empty() ? "" : "omits " + omitted,
                changed.helix && !before.helix ? "requires several turns of the pulley" : "",
                bends ? "bends the tendon more tightly than tendon.bend_ratio advises" : ""});
}

std::string lost_features(const solid::BodyLayout& changed, const solid::BodyLayout& before) {
  return words_of_lost(features_of(changed), features_of(before));
}

}  // namespace fusee::pipeline
