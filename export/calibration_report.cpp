// report.html of a calibration: residuals before and after on the same axes, the evidence, and what to do.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "export/report/plot.h"
#include "export/report/tables.h"
#include "export/tool.h"
#include "fusee/base/text.h"
#include "fusee/export/calibration.h"
#include "export/report/report_parts.h"

namespace fusee {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t k_most_points = 700;  // of a direction in a plot
constexpr std::size_t k_most_runs = 24;     // with plots of their own

std::string degree_words(double value) { return with_unit(degrees(value), "deg", 3); }

std::string cell(const std::string& words) { return "<td>" + safe_text(words) + "</td>"; }
std::string number_cell(const std::string& words) { return "<td class=\"number\">" + safe_text(words) + "</td>"; }

std::string html_table(const std::vector<std::string>& titles, const std::string& rows) {
  std::string html = "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& title : titles) html += "<th>" + safe_text(title) + "</th>";
  return html + "</tr></thead><tbody>" + rows + "</tbody></table></div>";
}

std::string html_list(const std::vector<std::string>& items) {
  std::string html;
  for (const std::string& item : items) html += "<li>" + safe_text(item) + "</li>";
  return html.empty() ? "" : "<ul>" + html + "</ul>";
}

std::string section(const std::string& id, const std::string& title, const std::string& body) {
  return "<section id=\"" + id + "\"><h2>" + safe_text(title) + "</h2>" + body + "</section>\n";
}

// ---- residuals ------------------------------------------------------------------------------------------------------

/// Residuals of a run in one direction over α, a gap between strokes.
PlotSeries direction_series(const Run& run, const std::vector<double>& residuals, int direction) {
  PlotSeries series{direction > 0 ? "α growing" : "α falling", direction > 0 ? Ink::p1 : Ink::p2, {}, true};
  const std::size_t step = run.samples.size() / k_most_points + 1;
  for (const Stroke& stroke : run.strokes) {
    if (stroke.direction != direction || stroke.partial) continue;
    for (std::size_t i = stroke.first; i <= stroke.last && i < residuals.size(); i += step) {
      series.points.emplace_back(degrees(run.samples[i].alpha), degrees(residuals[i]));
    }
    series.points.emplace_back(k_nan, k_nan);
  }
  return series;
}

struct Extent {
  double low = 0;
  double high = 0;
};

/// Of all residuals, zero included: the same axis for every plot of the page.
Extent residual_extent(const Calibration& calibration) {
  Extent extent;
  for (const auto* all : {&calibration.residuals_before, &calibration.residuals_after}) {
    for (const auto& run : *all) {
      for (const double value : run) {
        if (!std::isfinite(value)) continue;
        extent.low = std::min(extent.low, degrees(value));
        extent.high = std::max(extent.high, degrees(value));
      }
    }
  }
  return extent;
}

std::string run_words(const Run& run, const std::string& load_unit) {
  std::string words = run.name;
  if (run.has_load) words += ", load " + rounded(run.mean_load, 3) + (load_unit.empty() ? "" : " " + load_unit);
  if (run.has_time) words += ", " + rounded(degrees(run.speed), 3) + " °/s";
  return words;
}

std::string residual_plot(const CalibrationProduct& product, std::size_t r, bool after, const Extent& extent) {
  const Calibration& calibration = product.calibration;
  const Run& run = product.measurement.runs[r];
  const std::vector<double>& residuals = (after ? calibration.residuals_after : calibration.residuals_before)[r];
  Plot plot{run_words(run, product.measurement.load_unit) + (after ? ": after" : ": before"),
            {"motor angle α", "°", {}, {}, 1e-6},
            {"measured less model", "°", extent.low, extent.high, 1e-3},
            {},
            {},
            {}};
  plot.series = {direction_series(run, residuals, 1), direction_series(run, residuals, -1)};
  plot.height = 240;
  return "<div>" + inline_svg(plot_figure(plot)) + "</div>\n";
}

std::string residual_plots(const CalibrationProduct& product) {
  const Calibration& calibration = product.calibration;
  const Extent extent = residual_extent(calibration);
  std::string html;
  std::size_t shown = 0;
  for (std::size_t r = 0; r < product.measurement.runs.size() && shown < k_most_runs; ++r) {
    if (r >= calibration.residuals_before.size() || r >= calibration.residuals_after.size()) break;
    if (calibration.residuals_before[r].empty()) continue;
    html += residual_plot(product, r, false, extent) + residual_plot(product, r, true, extent);
    ++shown;
  }
  if (html.empty()) return "";
  std::string lead = "<p class=\"lead\">Each run by direction, before on the left and after on the right, all on the same axis.";
  if (product.measurement.runs.size() > shown) lead += " The first " + std::to_string(shown) + " runs; the table has all.";
  return section("residuals", "Residuals", lead + "</p><div class=\"plots\">" + html + "</div>");
}

/// Mean and rms of a run's residuals in one direction.
std::string direction_cells(const Run& run, const std::vector<double>& residuals, int direction) {
  double sum = 0, squares = 0, count = 0;
  for (const Stroke& stroke : run.strokes) {
    if (stroke.direction != direction || stroke.partial) continue;
    for (std::size_t i = stroke.first; i <= stroke.last && i < residuals.size(); ++i) {
      if (!std::isfinite(residuals[i])) continue;
      sum += residuals[i];
      squares += residuals[i] * residuals[i];
      count += 1;
    }
  }
  if (count == 0) return number_cell("–") + number_cell("–");
  return number_cell(readable(degrees(sum / count), 3)) + number_cell(readable(degrees(std::sqrt(squares / count)), 3));
}

std::string run_table(const CalibrationProduct& product) {
  const Calibration& calibration = product.calibration;
  std::string rows;
  for (std::size_t r = 0; r < product.measurement.runs.size(); ++r) {
    if (r >= calibration.residuals_before.size() || r >= calibration.residuals_after.size()) break;
    const Run& run = product.measurement.runs[r];
    rows += "<tr>" + cell(run_words(run, product.measurement.load_unit));
    for (const auto* residuals : {&calibration.residuals_before[r], &calibration.residuals_after[r]}) {
      rows += direction_cells(run, *residuals, 1) + direction_cells(run, *residuals, -1);
    }
    rows += "</tr>";
  }
  if (rows.empty()) return "";
  return section("runs", "By run, direction and load, in degrees",
                 html_table({"Run", "before ↑ mean", "rms", "before ↓ mean", "rms", "after ↑ mean", "rms", "after ↓ mean", "rms"}, rows));
}

// ---- evidence -------------------------------------------------------------------------------------------------------

std::string parameter_words(const FoundEffect& effect) {
  std::string words;
  for (const FittedParameter& parameter : effect.parameters) {
    words += (words.empty() ? "" : "; ") + parameter.name + " = " + readable_rounded(parameter.value, 4) + " (95 %: " + readable_rounded(parameter.low, 4) + " … " +
             readable_rounded(parameter.high, 4) + ")";
  }
  return words;
}

std::string rivals_words(const FoundEffect& effect) {
  std::string words;
  for (const std::string& rival : effect.group) {
    if (rival != effect.name) words += (words.empty() ? "" : ", ") + plain_name(rival);
  }
  return words.empty() ? "none" : words;
}

std::string effects_section(const Calibration& calibration) {
  std::string rows;
  for (const FoundEffect& effect : calibration.effects) {
    rows += "<tr>" + cell(plain_name(effect.name)) + cell(effect.place) + cell(parameter_words(effect)) + number_cell(degree_words(effect.rms_drop)) +
            cell(rivals_words(effect)) + cell(effect.correctable_by.empty() ? "nothing here" : effect.correctable_by) + "</tr>";
  }
  if (rows.empty()) return section("effects", "Effects", "<p>None was accepted.</p>");
  return section("effects", "Effects", html_table({"Effect", "Place", "Numbers", "RMS drop", "Would do as well", "Taken out by"}, rows));
}

std::string evidence_section(const Calibration& calibration) {
  std::string rows;
  for (const Candidate& candidate : calibration.tried) {
    rows += "<tr>" + cell((candidate.accepted ? "✓ " : "") + plain_name(candidate.name)) + number_cell(degree_words(candidate.held_out_rms)) +
            number_cell(readable(candidate.margin, 1)) + number_cell(readable(candidate.delta_bic, 1)) + cell(candidate.why) + "</tr>";
  }
  if (rows.empty()) return "";
  return section("evidence", "Evidence",
                 "<p class=\"lead\">Every candidate that was tried, with the error on data that it was not fitted to. The margin is the fall of that error in "
                 "standard errors over runs.</p>" +
                     html_table({"Candidate", "Held-out RMS", "Margin", "BIC", "Why"}, rows));
}

std::string figures_row(const std::string& name, double before, double after) {
  return "<tr>" + cell(name) + number_cell(degree_words(before)) + number_cell(degree_words(after)) + "</tr>";
}

std::string figures_section(const CalibrationProduct& product) {
  const Calibration& c = product.calibration;
  std::string rows = figures_row("RMS", c.before.rms, c.after.rms) + figures_row("Largest", c.before.max, c.after.max) +
                     figures_row("RMS held out", c.before.held_out_rms, c.after.held_out_rms);
  rows += figures_row("ISO 230-2 A, accuracy", c.iso_before.A, c.iso_after.A) + figures_row("R, repeatability", c.iso_before.R, c.iso_after.R) +
          figures_row("B, reversal", c.iso_before.B, c.iso_after.B) + figures_row("E, systematic", c.iso_before.E, c.iso_after.E) +
          figures_row("M, mean bidirectional", c.iso_before.M, c.iso_after.M);
  std::string lead = "<p class=\"lead\">Noise floor " + safe_text(degree_words(c.noise.rms)) +
                     (c.noise.from_repeats ? ", from repeats" : ", from neighbouring rows: there are no repeats, it is a lower bound");
  if (c.noise.rms > 0) lead += "; the rest is " + readable_rounded(c.after.rms / c.noise.rms, 3) + " times that";
  if (!c.held_out_factors.empty()) {
    lead += ". Held out by ";
    for (std::size_t i = 0; i < c.held_out_factors.size(); ++i) lead += (i > 0 ? " and " : "") + safe_text(c.held_out_factors[i]);
  }
  return section("figures", "Before and after", lead + ".</p>" + html_table({"", "before", "after"}, rows));
}

std::string correction_section(const CalibrationProduct& product) {
  const Correction& correction = product.correction;
  std::vector<std::string> items;
  if (correction.has_pulley) {
    items.push_back("The pulley of corrected.toml takes away " + degree_words(correction.by_pulley) + " rms, by simulation: fusee build corrected.toml.");
    if (correction.round.r1 > 0) {
      items.push_back("With P1 round, at its best radius of " + with_unit(correction.round.r1, "mm", 5) + ", the joint would miss its law by up to " +
                      degree_words(correction.round.max_error) + (correction.round.suffices ? ": P1 stays round." : "; P1 is shaped as well, and it misses nothing."));
    }
  } else {
    items.push_back("Nothing was identified that another pulley would take out.");
  }
  items.push_back("compensation.csv" + std::string(correction.has_pulley ? ", for the corrected pulley," : "") + " takes away " + degree_words(correction.by_table) +
                  (correction.has_pulley ? " rms more." : " rms."));
  return section("correction", "Correction", html_list(items));
}

std::string open_questions(const Calibration& calibration) {
  std::string html;
  if (!calibration.unexplained_where.empty()) html += "<h3>Unexplained: " + safe_text(degree_words(calibration.unexplained_rms)) + " rms</h3><p>" + safe_text(calibration.unexplained_where) + "</p>";
  if (!calibration.next_runs.empty()) html += "<h3>What to measure next</h3>" + html_list(calibration.next_runs);
  std::string rows;
  for (const Detectable& detectable : calibration.detectable) {
    rows += "<tr>" + cell(plain_name(detectable.name)) + number_cell(degree_words(detectable.smallest)) + "</tr>";
  }
  if (!rows.empty()) html += "<h3>What would have been seen</h3>" + html_table({"Effect", "smallest, at the joint"}, rows);
  return html.empty() ? "" : section("open", "Open questions", html);
}

bool is_good(const std::string& verdict) { return verdict == "explained" || verdict == "no_effect"; }

std::string notes_section(const Measurement& measurement) {
  std::vector<std::string> notes = measurement.not_testable;
  notes.insert(notes.end(), measurement.notes.begin(), measurement.notes.end());
  constexpr std::size_t most = 60;
  if (notes.size() > most) {
    const std::size_t more = notes.size() - most;
    notes.resize(most);
    notes.push_back("and " + std::to_string(more) + " more; calibration.json has all");
  }
  return notes.empty() ? "" : section("data", "About the data", html_list(notes));
}

}  // namespace

std::string calibration_report_html(const CalibrationProduct& product) {
  const Calibration& calibration = product.calibration;
  const std::string name = product.file.mechanism.name.empty() ? "unnamed" : safe_text(product.file.mechanism.name);
  const bool good = is_good(calibration.verdict);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta name=\"color-scheme\" content=\"light dark\"/>\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\"/>\n<meta name=\"generator\" content=\"" +
      std::string(k_tool) + "\"/>\n<title>" + name + " – calibration</title>\n<style>" + std::string(embedded::figure_css) + std::string(embedded::page_css) +
      "</style>\n</head>\n<body>\n<header>\n<p class=\"kicker\">Calibration report</p>\n<h1>" + name + "</h1>\n<p class=\"source\">" +
      std::to_string(product.measurement.runs.size()) + " runs against <code>" + safe_text(std::filesystem::path(product.file.path).filename().string()) +
      "</code></p>\n</header>\n<main>\n";
  html += "<section class=\"verdict " + std::string(good ? "good" : "bad") + "\"><span class=\"sign\">" + (good ? "✓" : "?") + "</span><p><b>" +
          safe_text(plain_name(calibration.verdict)) + ".</b> " + safe_text(calibration.summary) + "</p></section>\n";
  html += figures_section(product) + effects_section(calibration) + correction_section(product) + residual_plots(product) + run_table(product) +
          evidence_section(calibration) + open_questions(calibration) + notes_section(product.measurement);
  return html + "</main>\n<footer><p>Made by " + std::string(k_tool) + ". Angles in degrees at the joint, lengths in mm, forces in N.</p></footer>\n</body>\n</html>\n";
}

}  // namespace fusee
