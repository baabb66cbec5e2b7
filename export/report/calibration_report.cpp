// report.html of a calibration: the verdict, what to do, residuals before and after on the same axes, and the evidence.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/text.h"
#include "calibration/words.h"
#include "export/report/calibration_plots.h"
#include "export/report/calibration_words.h"
#include "export/report/html.h"
#include "export/report/moving_joint.h"
#include "export/report/report_parts.h"
#include "export/report/svg.h"
#include "export/report/tables.h"
#include "export/tool.h"
#include "mechanism/effect.h"

namespace fusee::formats {
namespace {

std::string degree_words(double value) { return with_unit(degrees(value), "deg", 3); }

// ---- verdict and figures --------------------------------------------------------------------------------------------

struct Sign {
  std::string style;  ///< class in page.css
  std::string sign;
};

Sign sign_of(calibration::CalibrationVerdict verdict) {
  switch (verdict) {
    case calibration::CalibrationVerdict::explained:
    case calibration::CalibrationVerdict::no_effect:
      return {"good", "✓"};
    case calibration::CalibrationVerdict::confounded:
    case calibration::CalibrationVerdict::unexplained:
      return {"noted", "?"};
    case calibration::CalibrationVerdict::not_repeatable:
    case calibration::CalibrationVerdict::not_testable:
      break;
  }
  return {"bad", "✗"};
}

std::string verdict_section(const CalibrationProduct& product) {
  const Sign sign = sign_of(product.calibration.verdict);
  const Headline first = headline(product);
  std::string html = "<p><b>" + safe_text(first.problem) + "</b></p>";
  for (const std::string& line : {first.cause, first.action})
    html += line.empty() ? "" : "<p>" + safe_text(line) + "</p>";
  return "<section class=\"verdict " + sign.style + "\"><span class=\"sign\">" + sign.sign + "</span><div>" + html +
         "</div></section>\n";
}

std::string cause_table_section(const CalibrationProduct& product) {
  std::string rows;
  for (const CauseRow& row : cause_rows(product))
    rows += "<tr>" + html_cell(first_upper(row.cause)) + html_cell(row.size) + html_cell(row.interval) +
            html_number_cell(row.share) + html_cell(row.corrected_by) + "</tr>";
  if (rows.empty()) return "";
  const auto& titles = CauseRow::k_titles;
  return html_section("causes", "Causes",
                      html_table({titles[0], titles[1], titles[2], std::string("#") + titles[3], titles[4]}, rows));
}

/// The section under a title that opens and closes it.
std::string folded(const std::string& section, bool is_open = false) {
  const std::size_t title = section.find("<h2>"), end = section.find("</h2>");
  if (title == std::string::npos) return section;
  return section.substr(0, title) + (is_open ? "<details open=\"open\">" : "<details>") + "<summary><h2>" +
         section.substr(title + 4, end - title - 4) + "</h2></summary>" +
         section.substr(end + 5, section.rfind("</section>") - end - 5) + "</details></section>\n";
}

std::string summary_section(const calibration::Calibration& calibration) {
  return html_section(
      "verdict", "Verdict: " + open_words(std::string(calibration::word(calibration.verdict))),
      "<p>" + safe_text(calibration.summary) + "</p>" +
          (calibration.noise_varies.empty() ? "" : "<p>" + safe_text(calibration.noise_varies) + "</p>"));
}

std::string input_error_section(const CalibrationProduct& product) {
  if (product.input_errors.empty()) return "";
  return html_section(
      "slips", "Likely input error",
      "<p class=\"lead\">These errors of the file or log would explain the data. Check them first.</p>" +
          html_list(input_error_texts(product)));
}

std::string key_numbers(const CalibrationProduct& product) {
  const calibration::Calibration& c = product.calibration;
  KeyNumbers numbers;
  numbers.add("Error on data not fitted, RMS",
              degree_words(c.before.held_out_rms) + " → " + degree_words(c.after.held_out_rms));
  numbers.add("Largest error", degree_words(c.before.max) + " → " + degree_words(c.after.max));
  numbers.add("Noise floor", degree_words(c.noise.rms), c.noise.from_repeats ? "from repeats" : "at least: no repeats");
  if (c.noise.rms > 0) numbers.add("Residual / noise floor", readable(c.after.rms / c.noise.rms, 2));
  numbers.add("Unexplained beyond the noise, RMS", degree_words(c.unexplained_rms));
  numbers.add("Reversal error (ISO 230-2 B)", degree_words(c.iso_before.B) + " → " + degree_words(c.iso_after.B));
  if (product.correction.has_pulley)
    numbers.add("Corrected by a new pulley, RMS", degree_words(product.correction.by_pulley));
  numbers.add("Corrected by the table, RMS", degree_words(product.correction.by_table),
              product.correction.by_curve > 0
                  ? degree_words(product.correction.by_curve) + " of it by an empirical curve, without a cause"
                  : "");
  return html_section("numbers", "Key numbers", numbers.html());
}

std::string figures_row(const std::string& name, double before, double after) {
  return "<tr>" + html_cell(name) + html_number_cell(degree_words(before)) + html_number_cell(degree_words(after)) +
         "</tr>";
}

std::string held_out_words(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  const std::size_t runs = product.measurement.runs.size();
  const bool named = calibration.held_out_runs.size() < runs;
  std::string words = "Data that were not fitted: ";
  words += named ? joined(calibration.held_out_runs, ", ") : runs == 1 ? "each stroke in turn" : "each run in turn";
  words += ".";
  if (!calibration.held_out_factors.empty())
    words += " For the choice between effects: each level of " +
             joined(calibration.held_out_factors, " in turn, and each level of ") + " in turn.";
  return words;
}

std::string figures_section(const CalibrationProduct& product) {
  const calibration::Calibration& c = product.calibration;
  const std::string rows =
      figures_row("RMS", c.before.rms, c.after.rms) + figures_row("Largest", c.before.max, c.after.max) +
      figures_row("RMS on data that were not fitted", c.before.held_out_rms, c.after.held_out_rms) +
      (c.curve.used ? "<tr>" + html_cell("The same, without the empirical curve") + html_number_cell("–") +
                          html_number_cell(degree_words(c.after_effects.held_out_rms)) + "</tr>"
                    : std::string()) +
      figures_row("ISO 230-2 A, accuracy", c.iso_before.A, c.iso_after.A) +
      figures_row("ISO 230-2 R, repeatability both ways", c.iso_before.R, c.iso_after.R) +
      figures_row("ISO 230-2 B, reversal", c.iso_before.B, c.iso_after.B) +
      figures_row("ISO 230-2 E, systematic", c.iso_before.E, c.iso_after.E) +
      figures_row("ISO 230-2 M, mean of both ways", c.iso_before.M, c.iso_after.M);
  return html_section("figures", "Before and after",
                      "<p class=\"lead\">Before: the joint as the file declares it; only free zeros are fitted. After: "
                      "with the identified effects. " +
                          safe_text(held_out_words(product)) + "</p>" +
                          html_table({"at the joint", "#before", "#after"}, rows));
}

// ---- what to do -----------------------------------------------------------------------------------------------------

std::vector<std::string> correction_items(const CalibrationProduct& product) {
  const correction::Correction& correction = product.correction;
  std::vector<std::string> items;
  if (correction.has_pulley) {
    items.push_back("fusee build corrected.toml makes a pulley that removes " + degree_words(correction.by_pulley) +
                    " rms on rows that were not fitted.");
    if (correction.round.r1 > 0) items.push_back(round_words(correction) + ".");
    if (correction.assembly_angle != 0) items.push_back(first_upper(assembly_angle_words(correction)) + ".");
  } else if (!correction.infeasible.empty()) {
    items.push_back(first_upper(infeasible_words(correction)) + ".");
  } else if (correction.why_no_pulley_file.empty()) {
    items.push_back("Nothing was identified that another pulley would correct.");
  }
  if (!correction.why_no_pulley_file.empty())
    items.push_back("corrected.toml is not written: " + correction.why_no_pulley_file + ".");
  if (!correction.why_no_table.empty())
    items.push_back("compensation.csv is not written: " + correction.why_no_table + ".");
  if (!correction.table.empty()) {
    items.push_back("compensation.csv, loaded into the motor’s controller" +
                    std::string(correction.has_pulley ? " with the corrected pulley," : ",") + " removes " +
                    degree_words(correction.by_table) + (correction.has_pulley ? " rms more." : " rms."));
  }
  if (const std::string curve = curve_words(product); !curve.empty()) items.push_back(first_upper(curve) + ".");
  return items;
}

std::string compensation_table(const correction::Correction& correction) {
  const bool has_curve = correction.by_curve > 0;
  std::string rows;
  for (const correction::CompensationRow& row : correction.table) {
    std::vector<double> angles = {row.theta, row.alpha_up, row.alpha_down, row.alpha_up - row.alpha_down};
    if (has_curve) angles.insert(angles.end(), {row.curve_up, row.curve_down});
    rows += "<tr>";
    for (const double angle : angles) rows += html_number_cell(readable(degrees(angle), 3));
    rows += "</tr>";
  }
  if (rows.empty()) return "";
  std::vector<std::string> titles = {"#θ (°)", "#α from below (°)", "#α from above (°)", "#lost motion (°)"};
  if (has_curve) titles.insert(titles.end(), {"#empirical, from below (°)", "#empirical, from above (°)"});
  return "<details><summary>The table: where the motor must stand</summary>" + html_table(titles, rows) + "</details>";
}

std::string action_section(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  std::string html;
  if (!calibration.next.empty())
    html += "<h3>Measure next, the most decisive first</h3>" + html_list(next_texts(calibration), "ol", "next");
  html += "<h3>Correction</h3>" + html_list(correction_items(product)) + compensation_html(product) +
          compensation_table(product.correction);
  return html_section("actions", "What to do", html);
}

// ---- effects --------------------------------------------------------------------------------------------------------

using Signatures = std::map<std::string, const Effect*>;

std::string effect_card(const calibration::FoundEffect& effect, const Signatures& known, const std::string& load_unit) {
  std::string html =
      "<div class=\"effect\"><h3>" +
      safe_text(first_upper(open_words(effect.name)) + ", at the " + std::string(fusee::word(effect.place))) +
      "</h3><p class=\"found\">";
  for (std::size_t i = 0; i < effect.parameters.size(); ++i)
    html += (i > 0 ? "<br/>" : "") + safe_text(parameter_words(effect.parameters[i], load_unit));
  html += "</p><p>Reduces the error on data that were not fitted by " + safe_text(degree_words(effect.rms_drop)) +
          " rms. " + std::string(calibration::remedy_words(effect)) + "</p>";
  if (const auto found = known.find(effect.name); found != known.end())
    html += "<p>How it shows: " + safe_text(found->second->signature) + ".</p>";
  if (const std::string audit = audit_words(effect); !audit.empty()) html += "<p>" + safe_text(audit) + "</p>";
  if (const std::string words = beside_words(effect, load_unit); !words.empty())
    html += "<p>" + safe_text(words) + "</p>";
  if (const std::string words = unmodelled_words(effect); !words.empty()) html += "<p>" + safe_text(words) + "</p>";
  std::vector<std::string> rivals = rivals_of(effect);
  std::erase(rivals, calibration::k_unmodelled);
  if (rivals.empty()) return html + "<p>Nothing else in the catalogue explains these data as well.</p></div>";
  html += "<p><b>Equally likely:</b></p><ul>";
  for (const std::string& rival : rivals) {
    const auto found = known.find(rival);
    html += "<li><b>" + safe_text(open_words(rival)) + "</b>" +
            (found == known.end() ? "" : " – " + safe_text(found->second->signature)) + "</li>";
  }
  return html + "</ul></div>";
}

std::string effects_section(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  Signatures known;
  for (const Effect& effect : effects(kind_of(product.file.mechanism))) known[effect.name] = &effect;
  std::string html;
  for (const calibration::FoundEffect& effect : calibration.effects)
    html += effect_card(effect, known, product.measurement.load_unit);
  if (html.empty()) html = "<p>None was accepted.</p>";
  if (!calibration.null_combinations.empty()) {
    html +=
        "<h3>Causes that these data do not distinguish</h3><p class=\"lead\">With these numbers, both causes look the "
        "same in these runs, except for this difference at the joint.</p>" +
        html_list(calibration.null_combinations);
  }
  return html_section("effects", "Effects found", html);
}

std::string moving_section(const CalibrationProduct& product) {
  const std::string joint = moving_joint(product.rehearsal);
  if (joint.empty()) return "";
  return html_section("moving", "What they do",
                      "<p class=\"lead\">The joint with the identified effects, simulated in a slow stroke back and "
                      "forth. Sliders change each effect up to twice its identified size. Each is simulated alone and "
                      "added to the declared joint under that load, whose tensions and torque are shown.</p>" +
                          joint);
}

// ---- residuals ------------------------------------------------------------------------------------------------------

/// Mean and rms of a run's residuals in one direction.
std::string direction_cells(const measurement::Run& run, const std::vector<double>& residuals, int direction) {
  double sum = 0, squares = 0, count = 0;
  for (const measurement::Stroke& stroke : run.strokes) {
    if (stroke.direction != direction || stroke.partial) continue;
    for (std::size_t i = stroke.first; i <= stroke.last && i < residuals.size(); ++i) {
      if (!std::isfinite(residuals[i])) continue;
      sum += residuals[i];
      squares += residuals[i] * residuals[i];
      count += 1;
    }
  }
  if (count == 0) return html_number_cell("–") + html_number_cell("–");
  return html_number_cell(readable(degrees(sum / count), 3)) +
         html_number_cell(readable(degrees(std::sqrt(squares / count)), 3));
}

std::string run_table(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  std::string rows;
  for (std::size_t r = 0; r < product.measurement.runs.size(); ++r) {
    if (r >= calibration.residuals_before.size() || r >= calibration.residuals_after.size()) break;
    const measurement::Run& run = product.measurement.runs[r];
    rows += "<tr>" + html_cell(run_words(run, product.measurement.load_unit));
    for (const auto* residuals : {&calibration.residuals_before[r], &calibration.residuals_after[r]}) {
      rows += direction_cells(run, *residuals, 1) + direction_cells(run, *residuals, -1);
    }
    rows += "</tr>";
  }
  if (rows.empty()) return "";
  const std::string table = html_table(
      {"run", "#before ↑ mean", "#rms", "#before ↓ mean", "#rms", "#after ↑ mean", "#rms", "#after ↓ mean", "#rms"},
      rows);
  const std::string title = "<h3>By run, direction and load, in degrees</h3>";
  // Long tables hide what comes after them.
  return product.measurement.runs.size() <= 12
             ? title + table
             : "<details><summary>By run, direction and load, in degrees</summary>" + table + "</details>";
}

std::string residuals_section(const CalibrationProduct& product) {
  const std::string map = residual_map_html(product);
  if (map.empty()) return "";
  return html_section("residuals", "Residuals",
                      map + residual_levels_html(product) + residual_runs_html(product) + run_table(product));
}

std::string empirical_curve_html(const CalibrationProduct& product) {
  const std::string words = curve_words(product);
  if (words.empty()) return "";
  return "<h3>The part that the table corrects</h3><p>" + safe_text(first_upper(words)) + ".</p>" + curve_html(product);
}

std::string discrepancy_list_html(const std::string& heading,
                                  const std::vector<calibration::DiscrepancyComponent>& parts) {
  std::string html = parts.empty() ? "" : "<h3>" + heading + "</h3>";
  for (const calibration::DiscrepancyComponent& part : parts)
    html += "<p>" + safe_text(first_upper(discrepancy_words(part))) + ".</p>" + discrepancy_html(part);
  return html;
}

std::string remainder_section(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  const std::string plot = residual_html(product);
  if (plot.empty()) return "";
  const std::string words = calibration.unexplained_where.empty()
                                ? "The residual is at the noise floor."
                                : "Unexplained beyond the noise: " + degree_words(calibration.unexplained_rms) +
                                      " rms, " + calibration.unexplained_where + ".";
  const std::string correlation = " The correlation of neighbouring rows is " +
                                  readable(calibration.residual_autocorrelation, 2) +
                                  "; that of noise is near 0. Dashed: the noise floor of a single row.";
  const std::string parts = discrepancy_list_html("Unmodelled, by what it depends on", calibration.discrepancy) +
                            empirical_curve_html(product);
  return html_section("unexplained", "Unexplained residual",
                      "<p class=\"lead\">" + safe_text(words + correlation) + "</p>" + plot + parts);
}

// ---- evidence -------------------------------------------------------------------------------------------------------

/// True if `name` is a further member of an identified effect's group.
bool is_equally_likely(const calibration::Calibration& calibration, const std::string& name) {
  return std::any_of(
      calibration.effects.begin(), calibration.effects.end(), [&](const calibration::FoundEffect& effect) {
        return name != effect.name && std::find(effect.group.begin(), effect.group.end(), name) != effect.group.end();
      });
}

std::string evidence_row(const calibration::Candidate& candidate, double largest_evidence, bool equally_likely) {
  const double width = largest_evidence > 0 ? std::clamp(100 * candidate.evidence / largest_evidence, 0.0, 100.0) : 0;
  return std::string("<tr") +
         (candidate.accepted ? " class=\"taken\""
          : equally_likely   ? " class=\"alike\""
                             : "") +
         ">" +
         html_cell((candidate.accepted ? "✓ "
                    : equally_likely   ? "≈ "
                                       : "") +
                   open_words(candidate.name)) +
         "<td class=\"bar\"><span style=\"width:" + fixed(width, 1) + "%\"></span></td>" +
         html_number_cell(std::isfinite(candidate.evidence) ? calibration::odds(candidate.evidence) : "–") +
         html_cell(candidate.why + (equally_likely ? "; equally likely in place of an identified effect" : "")) +
         "</tr>";
}

std::string evidence_section(const calibration::Calibration& calibration) {
  std::vector<calibration::Candidate> all = calibration.tried;
  std::stable_sort(all.begin(), all.end(), [](const calibration::Candidate& a, const calibration::Candidate& b) {
    return a.accepted != b.accepted ? a.accepted : a.evidence > b.evidence;
  });
  double largest_evidence = 0;
  for (const calibration::Candidate& candidate : all)
    largest_evidence =
        std::isfinite(candidate.evidence) ? std::max(largest_evidence, candidate.evidence) : largest_evidence;
  std::string rows;
  for (const calibration::Candidate& candidate : all)
    rows += evidence_row(candidate, largest_evidence,
                         !candidate.accepted && is_equally_likely(calibration, candidate.name));
  if (rows.empty()) return "";
  return html_section(
      "evidence", "Evidence",
      "<p class=\"lead\">How many times likelier the data are with an effect than without it. All other identified "
      "effects, and an unmodelled cause of any smooth shape, are allowed in both cases. A reported effect requires "
      "400 : 1.</p>" +
          html_table({"effect", "", "#odds", "why"}, rows));
}

std::string detectable_section(const calibration::Calibration& calibration) {
  std::string rows;
  for (const auto& [size, names] : detectable_groups(calibration))
    rows += "<tr>" + html_number_cell(degree_words(size)) + html_cell(open_words(joined(names, ", "))) + "</tr>";
  if (rows.empty()) return "";
  return html_section("detectable", "Detectable sizes",
                      "<p class=\"lead\">Effects that were not identified: each one moves the joint by less than this, "
                      "rms. These runs would have shown a larger one.</p>" +
                          html_table({"#at the joint", "effects"}, rows));
}

std::string data_section(const measurement::Measurement& measurement) {
  std::vector<std::string> notes = shortened_notes(measurement.notes);
  std::string html;
  if (!measurement.not_testable.empty())
    html += "<h3>Why nothing can be concluded</h3>" + html_list(measurement.not_testable) + "<h3>What was logged</h3>" +
            logged_html(measurement);
  if (!notes.empty()) html += (html.empty() ? "" : "<h3>Notes</h3>") + html_list(notes);
  return html_section("data", "About the data", html);
}

}  // namespace

std::string calibration_report_html(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  const std::size_t runs = product.measurement.runs.size();
  Page page{.title = "calibration",
            .kicker = "Calibration report",
            .name = product.file.mechanism.name,
            .source = std::to_string(runs) + (runs == 1 ? " run" : " runs") + " against <code>" +
                      safe_text(std::filesystem::path(product.file.path).filename().string()) + "</code>",
            .body = verdict_section(product) + cause_table_section(product) + input_error_section(product),
            .foot = "Angles in degrees at the joint, lengths in mm, forces in N.",
            .styles = {embedded::figure_css, embedded::page_css, embedded::calibration_css},
            .scripts = {embedded::readout_js, joint_script(product.file.mechanism)}};
  if (calibration.verdict != calibration::CalibrationVerdict::not_testable) {
    page.body += folded(summary_section(calibration)) + folded(action_section(product), true) +
                 folded(key_numbers(product)) + folded(effects_section(product)) + folded(moving_section(product)) +
                 folded(residuals_section(product), true) + folded(remainder_section(product)) +
                 folded(figures_section(product)) + folded(evidence_section(calibration)) +
                 folded(detectable_section(calibration));
  } else if (!calibration.next.empty()) {
    page.body += html_section("actions", "Measure next", html_list(next_texts(calibration), "ol", "next"));
  }
  page.body += folded(data_section(product.measurement));
  return html_page(page);
}

}  // namespace fusee::formats
