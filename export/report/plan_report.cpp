// plan.html: the instructions for the bench, step by step, and the expected results.

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text.h"
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

const char* const k_all_runs = "run_*.csv";

std::string size_words(double angle) { return with_unit(degrees(angle), "deg", 2); }
std::string minutes_words(double minutes) { return fixed(minutes, 1) + " min"; }

/// Underscores become spaces in the names of causes only: a step's own words may contain a key of the file.
std::vector<std::string> more_items(const std::vector<plan::PlanStep>& steps) {
  std::vector<std::string> items;
  for (const plan::PlanStep& step : steps) items.push_back(minute_words(step, open_words(gain_words(step))));
  return items;
}

/// Instructions for a run, in order.
std::vector<std::string> things_to_do(const PlanProduct& product, std::size_t step) {
  const plan::PlannedRun& run = *product.plan.steps[step].run;
  std::vector<std::string> things;
  if (run.change != plan::BenchChange::none)
    things.push_back("first " + std::string(plan::words(run.change)) +
                     ", drive to home and set both zeros again; turn it back after the run");
  const std::string hanging = hanging_words(product, run);
  things.push_back(hanging.empty() ? "nothing hangs on the joint" : hanging);
  things.push_back("drive the motor between " + readable(degrees(run.from), 1) + "° and " +
                   readable(degrees(run.to), 1) + "°, " + std::to_string(run.cycles) + " times there and back, at " +
                   rounded(degrees(run.speed), 3) + "°/s; begin at " + readable(degrees(run.from), 1) + "°");
  if (run.dwell > 0) things.push_back("hold it for " + rounded(run.dwell, 3) + " s at both ends, and go on logging");
  things.push_back("log time, motor angle and joint angle into " + run_file_name(product.plan, step));
  return things;
}

std::string step_item(const PlanProduct& product, std::size_t i) {
  const plan::PlanStep& step = product.plan.steps[i];
  std::string html =
      "<li><div class=\"box\"></div><div><h3>" + std::to_string(i + 1) + ". " + safe_text(step.words) + "</h3>";
  if (step.run) {
    html += html_list(things_to_do(product, i), "ul", "do");
  } else if (step.reading != nullptr) {
    html +=
        "<p>three times, at different places: <span class=\"value\">&#160;</span> <span "
        "class=\"value\">&#160;</span> <span class=\"value\">&#160;</span></p>";
  }
  const bool is_inspection = !step.run && step.reading == nullptr;
  if (!is_inspection) html += "<p class=\"tells\">" + safe_text(open_words(gain_words(step))) + "</p>";
  return html + "</div><div class=\"when\">" + safe_text(minutes_words(step.minutes)) + ", <br/>done after " +
         safe_text(minutes_words(step.end_minute)) + "</div></li>";
}

std::string step_items(const PlanProduct& product) {
  std::string items;
  for (std::size_t i = 0; i < product.plan.steps.size(); ++i) items += step_item(product, i);
  return "<ol class=\"steps\">" + items + "</ol>";
}

std::string steps_section(const PlanProduct& product) {
  return html_section(
      "steps", "At the bench",
      "<p class=\"lead\">Keep this order: each step is the most informative one for its minutes, so you can stop "
      "after any of them. Begin every run at the end of the range, coming from home. Do not reset zeros between "
      "runs unless a step says so.</p>" +
          (product.plan.taut_load ? "<p>" + safe_text("At the bench, " + product.plan.slack_words()) + ".</p>" : "") +
          step_items(product));
}

/// `runs`: the arguments of the command.
std::string after_section(const PlanProduct& product, const std::string& runs) {
  const std::string spec = std::filesystem::path(product.file.path).filename().string();
  const bool has_readings = std::any_of(product.plan.steps.begin(), product.plan.steps.end(),
                                        [](const plan::PlanStep& step) { return step.reading != nullptr; });
  return html_section(
      "after", "Then",
      (has_readings ? std::string("<p>Write what was read by hand into <code>[prior]</code> of the file, and</p>")
                    : "") +
          "<p><code>fusee calibrate " + safe_text(spec + " " + runs) + "</code></p>");
}

std::string causes_section(const plan::Plan& plan) {
  std::string rows;
  for (const plan::PlannedCause& cause : plan.causes) {
    rows += "<tr><td>" + safe_text(open_words(cause.name)) + "</td><td class=\"number\">" +
            safe_text(size_words(cause.usual)) + "</td><td class=\"number\">" + safe_text(size_words(cause.smallest)) +
            "</td><td class=\"number\">" +
            safe_text(cause.smallest_alone ? size_words(*cause.smallest_alone) : std::string("–")) + "</td><td>" +
            safe_text(open_words(joined(cause.rivals, ", "))) + "</td></tr>";
  }
  return html_section(
      "causes", "What these runs can show",
      "<p class=\"lead\">Error at the joint, rms over the runs: of each cause at its usual size, at the smallest size "
      "that these runs detect, and at the smallest that they identify alone. The last column has the causes from "
      "which they do not distinguish it.</p>"
      "<div class=\"scroll\"><table><thead><tr><th>cause</th><th class=\"number\">usual</th><th "
      "class=\"number\">detected from</th><th class=\"number\">identified from</th><th>not distinguished from</th>"
      "</tr></thead><tbody>" +
          rows + "</tbody></table></div>");
}

std::string left_out_section(const plan::Plan& plan) {
  if (plan.left_out.empty()) return "";
  std::vector<std::string> lines;
  for (const auto& [name, why] : plan.left_out) lines.push_back(open_words(name) + ": " + why);
  return html_section("left_out", "Not planned for", html_list(lines));
}

std::string key_numbers(const PlanProduct& product) {
  const plan::Plan& plan = product.plan;
  std::size_t alone = 0;
  for (const plan::PlannedCause& cause : plan.causes) alone += cause.smallest_alone.has_value();
  KeyNumbers numbers;
  numbers.add("Minutes", fixed(plan.minutes, 1), "of " + rounded(product.minutes, 4));
  numbers.add("Causes identified individually", std::to_string(alone), "of " + std::to_string(plan.causes.size()));
  numbers.add("Noise of the joint's sensor", size_words(product.noise), "assumed");
  numbers.add("Motor", readable(degrees(plan.from), 1) + "° … " + readable(degrees(plan.to), 1) + "°");
  return html_section("numbers", "In short", numbers.html());
}

}  // namespace

std::string plan_steps_html(const PlanProduct& product) {
  return steps_section(product) + after_section(product, k_all_runs);
}

std::string next_html(const PlanProduct& product, const std::vector<std::string>& measured) {
  std::string runs;
  for (const std::string& name : measured) runs += (runs.empty() ? "" : " ") + name;
  for (std::size_t i = 0; i < product.plan.steps.size(); ++i) {
    if (product.plan.steps[i].run) runs += " " + run_file_name(product.plan, i);
  }
  return html_page({.title = "measure next",
                    .kicker = "Measure next",
                    .name = product.file.mechanism.name,
                    .source = "for " + source_html(product.file),
                    .body = html_section("steps", "At the bench",
                                         "<p class=\"lead\">The most decisive first: do it, calibrate again, and go on "
                                         "only if the answer still names more than one cause.</p>" +
                                             step_items(product)) +
                            after_section(product, runs),
                    .foot = "Angles of the motor are those its sensor shows, zero at home.",
                    .styles = {embedded::page_css, embedded::plan_css},
                    .scripts = {}});
}

std::string plan_html(const PlanProduct& product) {
  Page page{.title = "measuring plan",
            .kicker = "Measuring plan",
            .name = product.file.mechanism.name,
            .source = "for " + source_html(product.file),
            .body = key_numbers(product) + steps_section(product) + after_section(product, k_all_runs),
            .foot = "Angles of the motor are those its sensor shows, zero at home.",
            .styles = {embedded::page_css, embedded::plan_css},
            .scripts = {}};
  if (!product.plan.beyond.empty())
    page.body += html_section("more", "What more minutes would show", html_list(more_items(product.plan.beyond)));
  page.body += causes_section(product.plan) +
               html_section("false_positives", "False-positive rate", html_list(false_positive_words(product.plan))) +
               left_out_section(product.plan);
  return html_page(page);
}

}  // namespace fusee::formats
