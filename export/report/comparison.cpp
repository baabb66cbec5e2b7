// Outputs of a comparison of two states: words, comparison.json, manifest.json, report.html.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/output_list.h"
#include "base/text.h"
#include "export/report/calibration_plots.h"
#include "export/report/calibration_words.h"
#include "export/report/html.h"
#include "export/report/input_json.h"
#include "export/report/report_parts.h"
#include "export/report/svg.h"
#include "export/report/tables.h"
#include "export/tool.h"
#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::formats {
namespace {

// ---- words ----------------------------------------------------------------------------------------------------------

/// The words for a change of a number; % is replaced by its size and unit.
struct ChangeWords {
  std::string_view effect;
  std::string_view parameter;
  std::string_view name;  ///< in a table
  std::string_view grew;
  std::string_view shrank;
  std::string_view remedy;  ///< the remedy for both signs
};

constexpr std::array<ChangeWords, 20> k_words{{
    {"slack", "pretension_N", "pretension of tendon 1", "Tendon 1 gained % of pretension",
     "Tendon 1 lost % of pretension", "Set the pretension again"},
    {"slack", "slack_mm", "slack of both tendons", "The tendons have % more slack", "The tendons have % less slack",
     "Take the slack up at the anchors"},
    {"slack", "width_deg", "lost motion without load", "The lost motion without load grew by %",
     "The lost motion without load shrank by %", "Take the slack up at the anchors"},
    {"tendon_stretch", "EA_N", "stiffness of the tendons (EA)", "The tendons became stiffer by %",
     "The tendons became softer by %", "Look for worn strands or another cord"},
    {"tendon_stretch", "compliance_deg_per_load", "compliance", "The joint yields % more", "The joint yields % less",
     "Look for worn strands or another cord"},
    {"backlash", "width_deg", "play between motor and pulley", "The play between motor and pulley grew by %",
     "The play between motor and pulley shrank by %", "Look at the set screw and the coupling"},
    {"zero_offset", "offset_deg", "zero of the joint sensor", "The joint sensor reads % higher",
     "The joint sensor reads % lower", "Set the joint sensor's zero again"},
    {"motor_offset", "offset_deg", "zero of the motor", "The motor's zero moved up by %",
     "The motor's zero moved down by %", "Set the motor's zero again"},
    {"joint_sensor_gain", "gain_percent", "gain of the joint sensor", "The joint sensor reads % more",
     "The joint sensor reads % less", "Look at the supply and the mounting of the joint sensor"},
    {"pulley_scale", "scale_percent", "scale of both pulleys", "Both pulleys are % larger",
     "Both pulleys are % smaller", "Measure a pulley with a caliper"},
    {"radius_offset", "offset_mm", "radius of both pulleys", "The radius of both pulleys is % larger",
     "The radius of both pulleys is % smaller", "Measure a pulley and the tendon with a caliper"},
    {"capstan_friction", "mu", "friction coefficient at the pins", "The friction coefficient at the pins rose by %",
     "The friction coefficient at the pins fell by %", "Look at the pins: worn, dry or dirty"},
    {"groove_friction", "mu", "friction coefficient in the grooves",
     "The friction coefficient in the grooves rose by %", "The friction coefficient in the grooves fell by %",
     "Look at the grooves: worn, greasy or dirty"},
    {"joint_friction", "torque_Nmm", "friction of the joint's bearing", "The joint's bearing rubs % more",
     "The joint's bearing rubs % less", "Look at the joint's bearing"},
    {"sensor_lag", "lag_ms", "delay of the joint sensor", "The joint sensor is % later",
     "The joint sensor is % earlier", "Look at the filter and the sampling of the joint sensor"},
    {"creep", "compliance_percent_per_decade", "creep of the tendons", "The tendons creep % more",
     "The tendons creep % less", "Stretch the tendons before use"},
    {"guide_radius", "radius_mm", "radius of the pins", "The pins' radius is % larger", "The pins' radius is % smaller",
     "Measure the pins with a caliper"},
    {"joint_length", "length_mm", "length of the link", "The link is % longer", "The link is % shorter",
     "Measure from the joint's axis to the attachment"},
    {"frame_compliance", "mm_per_N", "compliance of the frame", "The frame yields % more", "The frame yields % less",
     "Look at the screws that hold the pins"},
    {"tendon_slip", "length_mm", "slip of a tendon", "Tendon 1 slipped by % at its anchor",
     "Tendon 2 slipped by % at its anchor", "Tie the tendon again"},
}};

const ChangeWords* find_words(const std::string& effect, const std::string& parameter) {
  const auto found = std::find_if(k_words.begin(), k_words.end(), [&](const ChangeWords& words) {
    return words.effect == effect && words.parameter == parameter;
  });
  return found == k_words.end() ? nullptr : &*found;
}

std::string with_sign(double value) { return (value < 0 ? "−" : "+") + readable_rounded(std::abs(value)); }

/// The text with `size` in place of its '%'.
std::string with_size(std::string_view text, const std::string& size) {
  std::string words(text);
  words.replace(words.find('%'), 1, size);
  return words;
}

/// The most significant parameter: the largest ratio of change to interval width. A number without an interval follows
/// from the others.
const calibration::ChangedParameter* most_significant(const calibration::StateChange& change) {
  const auto significance = [](const calibration::ChangedParameter& p) {
    return p.high > p.low ? std::abs(p.change()) / (p.high - p.low) : 0.0;
  };
  const auto most =
      std::max_element(change.parameters.begin(), change.parameters.end(),
                       [&](const calibration::ChangedParameter& a, const calibration::ChangedParameter& b) {
                         return significance(a) < significance(b);
                       });
  return most == change.parameters.end() ? nullptr : &*most;
}

std::string interval_words(const calibration::ChangedParameter& parameter, const std::string& unit) {
  return with_sign(parameter.low) + " … " + with_sign(parameter.high) + unit;
}

/// "Tendon 1 lost 4.2 N of pretension (95 %: −4.6 … −3.8 N)". If the interval contains 0, no direction
/// is stated.
std::string sentence(const calibration::StateChange& change, const std::string& load_unit) {
  const calibration::ChangedParameter* number = most_significant(change);
  if (number == nullptr) return first_upper(open_words(change.name)) + " changed";
  const auto [name, unit] = name_and_unit(number->name, load_unit);
  const std::string interval = " (95 %: " + interval_words(*number, unit) + ")";
  const ChangeWords* words = find_words(change.name, number->name);
  const bool has_sign = number->low > 0 || number->high < 0;
  if (words != nullptr && has_sign)
    return with_size(number->change() > 0 ? words->grew : words->shrank,
                     readable_rounded(std::abs(number->change())) + unit) +
           interval;
  return first_upper(words != nullptr ? std::string(words->name) : open_words(change.name) + ", " + name) +
         " changed by " + with_sign(number->change()) + unit + interval;
}

std::string remedy(const calibration::StateChange& change) {
  const calibration::ChangedParameter* number = most_significant(change);
  const ChangeWords* words = number == nullptr ? nullptr : find_words(change.name, number->name);
  return words == nullptr ? "Look at the " + std::string(fusee::word(change.place)) : std::string(words->remedy);
}

std::vector<std::string> others_of(const calibration::StateChange& change) {
  std::vector<std::string> others;
  for (const std::string& member : change.group) {
    if (member != change.name)
      others.push_back(member == calibration::k_unmodelled ? "an unmodelled cause" : open_words(member));
  }
  return others;
}

/// The largest first.
std::vector<calibration::StateChange> by_size(std::vector<calibration::StateChange> changes) {
  std::stable_sort(
      changes.begin(), changes.end(),
      [](const calibration::StateChange& a, const calibration::StateChange& b) { return a.rms_drop > b.rms_drop; });
  return changes;
}

constexpr std::size_t k_named_others = 3;

std::string changed_words(const ComparisonProduct& product) {
  const std::vector<calibration::StateChange> changes = by_size(product.comparison.found);
  const calibration::StateChange& first = changes.front();
  std::string words = sentence(first, product.measurement.load_unit) + ". ";
  std::vector<std::string> others = others_of(first);
  const std::size_t more = others.size() > k_named_others ? others.size() - k_named_others : 0;
  others.resize(others.size() - more);
  if (!others.empty())
    words +=
        "Equally likely: " + joined(others, ", ") + (more > 0 ? " or " + std::to_string(more) + " more" : "") + ". ";
  words += remedy(first) + ".";
  if (changes.size() == 2) words += " Another change is below.";
  if (changes.size() > 2) words += " " + std::to_string(changes.size() - 1) + " more changes are below.";
  return words;
}

std::string degree_words(double value) { return with_unit(degrees(value), "deg", 3); }

// ---- JSON -----------------------------------------------------------------------------------------------------------

Json change_json(const calibration::StateChange& change) {
  Json parameters = Json::object();
  for (const calibration::ChangedParameter& parameter : change.parameters) {
    parameters[parameter.name] = {{"before", result_json(parameter.before)},
                                  {"after", result_json(parameter.after)},
                                  {"change", result_json(parameter.change())},
                                  {"ci95", {result_json(parameter.low), result_json(parameter.high)}}};
  }
  return {{"name", change.name},
          {"group", change.group},
          {"place", fusee::word(change.place)},
          {"parameters", parameters},
          {"rms_drop_deg", angle_json(change.rms_drop)},
          {"by_runs", result_json(change.by_runs)},
          {"share", result_json(change.share)}};
}

/// Names of the runs of each state.
Json run_names_json(const ComparisonProduct& product) {
  Json before = Json::array(), after = Json::array();
  for (std::size_t i = 0; i < product.measurement.runs.size(); ++i)
    (i < product.runs_before ? before : after).push_back(product.measurement.runs[i].name);
  return {{"before", before}, {"after", after}};
}

// ---- page -----------------------------------------------------------------------------------------------------------

std::string verdict_section(const ComparisonProduct& product) {
  const calibration::ComparisonVerdict verdict = product.comparison.verdict;
  const bool is_unchanged = verdict == calibration::ComparisonVerdict::no_change;
  const bool is_changed = verdict == calibration::ComparisonVerdict::changed;
  const std::string style = is_unchanged ? "good" : is_changed ? "noted" : "bad";
  const std::string sign = is_unchanged ? "✓" : is_changed ? "!" : "✗";
  return "<section class=\"verdict " + style + "\"><span class=\"sign\">" + sign + "</span><p><b>" +
         safe_text(first_upper(open_words(std::string(calibration::word(verdict))))) + ".</b> " +
         safe_text(comparison_words(product)) + "</p></section>\n";
}

std::string numbers_section(const calibration::Comparison& comparison) {
  KeyNumbers numbers;
  numbers.add("Difference between the states, RMS", degree_words(comparison.difference.before));
  numbers.add("The same beside the changes", degree_words(comparison.difference.after));
  numbers.add("Noise floor", degree_words(comparison.changes.noise.rms));
  return html_section("numbers", "Key numbers", numbers.html());
}

std::string changes_section(const ComparisonProduct& product) {
  std::string rows;
  for (const ChangeRow& row : change_rows(product))
    rows += "<tr>" + html_cell(row.cause) + html_cell(row.change) + html_cell(row.states) + html_cell(row.interval) +
            html_cell(row.share) + html_cell(row.as_likely) + "</tr>";
  if (rows.empty()) return "";
  return html_section(
      "changes", "What changed",
      html_table({"cause", "change", "before → after", "95 % interval", "of the difference", "equally likely"}, rows));
}

std::string detectable_section(const calibration::Calibration& calibration) {
  std::string rows;
  for (const auto& [size, names] : detectable_groups(calibration))
    rows += "<tr>" + html_number_cell(degree_words(size)) + html_cell(open_words(joined(names, ", "))) + "</tr>";
  if (rows.empty()) return "";
  return html_section("detectable", "What would have been seen",
                      "<p class=\"lead\">The smallest change at the joint, rms, that these runs would have "
                      "shown.</p>" +
                          html_table({"#at the joint", "effects"}, rows));
}

/// The plots of a calibration page: residuals of all runs from the joint as it was identified before.
std::string residuals_section(const ComparisonProduct& product) {
  CalibrationProduct about_before;
  about_before.file = product.file;
  about_before.measurement = product.measurement;
  about_before.calibration = product.comparison.changes;
  const std::string map = residual_map_html(about_before);
  if (map.empty()) return "";
  return html_section(
      "residuals", "Residuals of both states",
      "<p class=\"lead\">About the joint as it was identified before, and with the changes. The first " +
          std::to_string(product.runs_before) + " runs are those before.</p>" + map + residual_runs_html(about_before));
}

}  // namespace

double certainly_detected(const calibration::Comparison& comparison) {
  double most = 0;
  for (const calibration::Detectable& one : comparison.changes.detectable) most = std::max(most, one.smallest);
  return most;
}

std::string comparison_words(const ComparisonProduct& product) {
  const calibration::Comparison& comparison = product.comparison;
  switch (comparison.verdict) {
    case calibration::ComparisonVerdict::not_testable:
    case calibration::ComparisonVerdict::not_comparable:
      return comparison.why;
    case calibration::ComparisonVerdict::no_change:
      return "Nothing changed that these runs could show" +
             (certainly_detected(comparison) > 0
                  ? "; a change of more than " + rounded(degrees(certainly_detected(comparison)), 2) +
                        "° at the joint would have been seen."
                  : std::string("."));
    case calibration::ComparisonVerdict::changed:
      return changed_words(product);
  }
  return "";
}

std::vector<ChangeRow> change_rows(const ComparisonProduct& product) {
  const calibration::Comparison& comparison = product.comparison;
  std::vector<ChangeRow> rows;
  for (const calibration::StateChange& change : by_size(comparison.found)) {
    std::string share = share_words(change.share), as_likely = joined(others_of(change), ", ");
    for (const calibration::ChangedParameter& parameter : change.parameters) {
      const auto [name, unit] = name_and_unit(parameter.name, product.measurement.load_unit);
      const ChangeWords* words = find_words(change.name, parameter.name);
      rows.push_back({words != nullptr ? std::string(words->name) : open_words(change.name) + ": " + name,
                      with_sign(parameter.change()) + unit,
                      readable_rounded(parameter.before) + " → " + readable_rounded(parameter.after),
                      interval_words(parameter, unit), share, as_likely});
      share.clear();
      as_likely.clear();
    }
  }
  return rows;
}

std::string comparison_json(const ComparisonProduct& product) {
  const calibration::Comparison& comparison = product.comparison;
  Json json = {
      {"schema", 1}, {"verdict", calibration::word(comparison.verdict)}, {"summary", comparison_words(product)}};
  json["changes"] = Json::array();
  for (const calibration::StateChange& change : by_size(comparison.found))
    json["changes"].push_back(change_json(change));
  json["difference"] = {{"before_rms_deg", angle_json(comparison.difference.before)},
                        {"after_rms_deg", angle_json(comparison.difference.after)}};
  json["noise_floor_deg"] = angle_json(comparison.changes.noise.rms);
  json["detectable"] = Json::array();
  for (const calibration::Detectable& one : comparison.changes.detectable)
    json["detectable"].push_back({{"name", one.name}, {"smallest_deg", angle_json(one.smallest)}});
  json["runs"] = run_names_json(product);
  json["notes"] = product.measurement.notes;
  return json_text(json, 1);
}

std::string comparison_manifest_json(const ComparisonProduct& product, const std::vector<OutputFile>& outputs) {
  Json json = {{"schema", 1}, {"tool", std::string(k_tool)}};
  json["input"] = input_json(product.file);
  json["runs"] = run_names_json(product);
  json["verdict"] = calibration::word(product.comparison.verdict);
  json["outputs"] = output_list(outputs);
  return json_text(json, 1);
}

std::string comparison_report_html(const ComparisonProduct& product) {
  const calibration::Comparison& comparison = product.comparison;
  const std::size_t after = product.measurement.runs.size() - product.runs_before;
  Page page{.title = "comparison",
            .kicker = "Comparison of two states",
            .name = product.file.mechanism.name,
            .source = std::to_string(product.runs_before) + " runs before and " + std::to_string(after) +
                      " after, of <code>" + safe_text(std::filesystem::path(product.file.path).filename().string()) +
                      "</code>",
            .body = verdict_section(product),
            .foot = "Angles in degrees at the joint, lengths in mm, forces in N.",
            .styles = {embedded::figure_css, embedded::page_css, embedded::calibration_css},
            .scripts = {embedded::readout_js}};
  if (comparison.verdict == calibration::ComparisonVerdict::changed ||
      comparison.verdict == calibration::ComparisonVerdict::no_change)
    page.body += changes_section(product) + numbers_section(comparison) + residuals_section(product) +
                 detectable_section(comparison.changes);
  if (const std::vector<std::string> notes = shortened_notes(product.measurement.notes); !notes.empty())
    page.body += html_section("data", "About the data", html_list(notes));
  return html_page(page);
}

}  // namespace fusee::formats
