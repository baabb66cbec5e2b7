// The page of an analysis: the moving joint, its loads, its angular error and the causes of that error.

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text.h"
#include "export/report/analysis.h"
#include "export/report/html.h"
#include "export/report/input_json.h"
#include "export/report/moving_joint.h"
#include "export/report/picture.h"
#include "export/report/plot.h"
#include "export/report/report_parts.h"
#include "export/report/svg.h"
#include "export/report/tables.h"
#include "export/report/under_load.h"
#include "fusee/base.h"
#include "mechanism/lengths.h"
#include "transmission/torque.h"

namespace fusee::formats {
namespace {

std::string at_words(double alpha) { return "at α = " + readable(degrees(alpha), 1) + "°"; }

std::string key_numbers_of(const analysis::AnalysisResult& result, const Mechanism& mechanism) {
  const analysis::TensionExtreme& most = result.largest_tension;
  KeyNumbers numbers;
  numbers.add("Largest tension", with_unit(most.tension, "N"),
              analysis::place_words(most, mechanism) + ", " + at_words(most.alpha));
  numbers.add("By the paper’s formulas", with_unit(result.largest_paper_tension.value, "N"),
              at_words(result.largest_paper_tension.alpha));
  if (result.strength)
    numbers.add("Strength of the tendon", with_unit(result.strength->tension, "N"),
                with_unit(result.strength->at_knot, "N") + " at a knot");
  if (const auto factor = result.safety_factor())
    numbers.add("Safety factor", readable_rounded(*factor, 3), "against breaking");
  numbers.add("Motor torque", with_unit(result.largest_torque.value, "N·mm"), at_words(result.largest_torque.alpha));
  numbers.add("Hysteresis", with_unit(degrees(result.hysteresis.value), "deg"), at_words(result.hysteresis.alpha));
  numbers.add("Joint angle error", with_unit(degrees(result.theta_error.value), "deg"),
              load_words(mechanism) + ", " + at_words(result.theta_error.alpha));
  numbers.add("Tendon 1 slack", slack_words(result, result.slack1), pretension_words(result, result.slack1));
  numbers.add("Tendon 2 slack", slack_words(result, result.slack2), pretension_words(result, result.slack2));
  add_motor(numbers, result);
  return numbers.html(mechanism.units);
}

// Plots ---------------------------------------------------------------------------------------------------------------

template <typename Value>
std::vector<Vec2> over_rows(const analysis::AnalysisResult& result, Value value) {
  std::vector<Vec2> points;
  for (const analysis::AnalysisRow& row : result.rows) points.emplace_back(degrees(row.declared.alpha), value(row));
  return points;
}

PlotAxis axis_of(const std::string& label, const std::string& unit, double least_span) {
  return {label, unit, {}, {}, least_span};
}

std::vector<Vec2> wanted_torque_points(const analysis::AnalysisResult& result, const Mechanism& mechanism) {
  std::vector<double> thetas;
  for (const analysis::AnalysisRow& row : result.rows) thetas.push_back(row.declared.theta);
  std::vector<double> torques = transmission::wanted_torques(mechanism, thetas);
  // One torque for each row, in the same order.
  return over_rows(result, [next = torques.begin()](const auto&) mutable { return *next++; });
}

/// With law = torque, the wanted torque is drawn, and the axis is no narrower than half of it: a nearly constant torque
/// looks constant.
Plot torque_plot(const analysis::AnalysisResult& result, const Mechanism& mechanism) {
  Plot torque{"Motor torque", axis_of("pulley angle α", "°", 1e-6), axis_of("torque", "N·mm", 0.1), {}, {}, {}};
  torque.series = {{"α growing", Ink::main, over_rows(result, [](const auto& r) { return r.rising.motor_torque; })},
                   {"α falling", Ink::p2, over_rows(result, [](const auto& r) { return r.falling.motor_torque; })}};
  if (mechanism.pulley.law != Law::torque) return torque;
  const std::vector<Vec2> wanted = wanted_torque_points(result, mechanism);
  torque.series.push_back({"wanted", Ink::third, wanted});
  for (const Vec2& point : wanted) torque.y.least_span = std::max(torque.y.least_span, 0.5 * std::abs(point.y()));
  return torque;
}

std::vector<Figure> figures(const analysis::AnalysisResult& result, const Mechanism& mechanism) {
  const PlotAxis alpha = axis_of("pulley angle α", "°", 1e-6);
  const std::string where = mechanism.sheath.is_there()                 ? "behind the sheaths, at the pulley"
                            : mechanism.guides.kind == GuideKind::idler ? "below the idlers"
                                                                        : "below the pins";
  Plot tension{"Tension " + where + ", α growing", alpha, axis_of("tension", "N", 0.1), {}, {}, {}};
  tension.series = {{"tendon 1", Ink::p1, over_rows(result, [](const auto& r) { return r.rising.t1.lower; })},
                    {"tendon 2", Ink::p2, over_rows(result, [](const auto& r) { return r.rising.t2.lower; })},
                    {"the paper’s T_b", Ink::third, over_rows(result, [](const auto& r) { return r.paper.Tb; }), true}};
  Plot error{"Joint angle minus the target motion", alpha, axis_of("Δθ", "°", 1e-3), {}, {}, {}};
  const auto theta_error = [](const joint::EquilibriumPoint& point, const analysis::AnalysisRow& row) {
    return degrees(point.theta - row.declared.theta);
  };
  error.series = {{"α growing", Ink::main, over_rows(result, [&](const auto& r) { return theta_error(r.rising, r); })},
                  {"α falling", Ink::p2, over_rows(result, [&](const auto& r) { return theta_error(r.falling, r); })}};
  Plot stiffness{"Stiffness about the joint, pulley held", alpha, axis_of("stiffness", "N·mm/°", 0.1), {}, {}, {}};
  const auto per_degree = [](double per_radian) { return per_radian * radians(1); };
  stiffness.series = {
      {"small disturbances", Ink::main,
       over_rows(result, [&](const auto& r) { return per_degree(r.rising.stiffness_stuck); })},
      {"large ones", Ink::p2, over_rows(result, [&](const auto& r) { return per_degree(r.rising.stiffness); })}};
  return {plot_figure(tension), plot_figure(torque_plot(result, mechanism)), plot_figure(error),
          plot_figure(stiffness)};
}

std::string plots(const analysis::AnalysisResult& result, const Mechanism& mechanism) {
  std::string html;
  for (const Figure& figure : figures(result, mechanism)) html += in_div(figure);
  return "<div class=\"plots\">" + html + "</div>";
}

/// The figures two by two below the mechanism's name.
Figure picture_of(const MechanismFile& file, const analysis::AnalysisResult& result) {
  constexpr double k_heading_height = 34, k_spacing = 24;
  const std::string& name = file.mechanism.name;
  Figure all{0, k_heading_height, name + ": analysis", svg_words("heading", {2, 20}, name), {}};
  double left = 0, top = k_heading_height, lowest = k_heading_height;
  for (const Figure& figure : figures(result, file.mechanism)) {
    all.body += "<g transform=\"translate(" + svg_number(left) + " " + svg_number(top) + ")\">" + figure.body + "</g>";
    all.width = std::max(all.width, left + figure.width);
    lowest = std::max(lowest, top + figure.height);
    const bool is_left_column = left == 0;
    left = is_left_column ? figure.width + k_spacing : 0;
    if (!is_left_column) top = lowest + k_spacing;
  }
  all.height = lowest;
  return all;
}

// Tables --------------------------------------------------------------------------------------------------------------

std::string angle_cell(double angle, int decimals) { return html_number_cell(readable(degrees(angle), decimals)); }

std::string sources_table(const std::vector<analysis::ErrorSource>& sources) {
  std::string rows;
  for (const analysis::ErrorSource& source : sources)
    rows += "<tr>" + html_cell(source.meaning) + angle_cell(source.least, 4) + angle_cell(source.most, 4) +
            angle_cell(source.worst_at, 1) + "</tr>";
  return html_table({"error of θ from", "#from (°)", "#to (°)", "#worst at α (°)"}, rows);
}

std::string tolerances_table(const std::vector<analysis::ToleranceEffect>& effects) {
  std::string rows;
  for (const analysis::ToleranceEffect& effect : effects)
    rows += "<tr>" + html_cell(effect.key) + angle_cell(effect.theta_by_derivative, 4) +
            angle_cell(effect.theta_by_monte_carlo, 4) + angle_cell(effect.theta_at, 1) +
            html_number_cell(readable(effect.excess_by_derivative, 4)) +
            html_number_cell(readable(effect.excess_by_monte_carlo, 4)) + "</tr>";
  return html_table({"tolerance of", "#θ (°)", "#sampled", "#at α (°)", "#excess length of tendon 2 (mm)", "#sampled"},
                    rows);
}

std::string remarks_section(const std::vector<Diagnostic>& remarks, LengthUnit units) {
  if (remarks.empty()) return "";
  std::vector<std::string> lines;
  for (const Diagnostic& diagnostic : remarks)
    lines.push_back(lengths_in(units, diagnostic.message + (diagnostic.hint.empty() ? "" : " – " + diagnostic.hint)));
  return "<section class=\"warnings\">" + html_list(lines) + "</section>\n";
}

std::vector<analysis::StrokePoint> stroke_of(const analysis::AnalysisResult& result) {
  std::vector<analysis::StrokePoint> stroke;
  for (const analysis::AnalysisRow& row : result.rows) stroke.push_back({row.rising, row.falling});
  return stroke;
}

}  // namespace

std::string analysis_svg(const MechanismFile& file, const analysis::AnalysisResult& result) {
  return standalone_svg(picture_of(file, result));
}

std::string analysis_png(const MechanismFile& file, const analysis::AnalysisResult& result) {
  const Figure picture = picture_of(file, result);
  return png_of(standalone_svg(picture), picture.width, picture.height);
}

std::string analysis_pdf(const MechanismFile& file, const analysis::AnalysisResult& result) {
  const Figure picture = picture_of(file, result);
  return pdf_of(standalone_svg(picture), picture.width, picture.height);
}

std::string analysis_html(const MechanismFile& file, const analysis::AnalysisResult& result,
                          const analysis::AnalysisOptions& options, const std::vector<Diagnostic>& remarks) {
  const std::string moving = moving_joint(file.mechanism, result.synthesis, stroke_of(result));
  return html_page(
      {.title = "analysis",
       .kicker = "Analysis",
       .name = file.mechanism.name,
       .source = "of " + source_html(file),
       .body = remarks_section(remarks, file.mechanism.units) +
               html_section("numbers", "Key numbers", key_numbers_of(result, file.mechanism)) +
               html_section("moving", "The joint moves", moving.empty() ? "" : std::string(k_moving_words) + moving) +
               html_section("forces", "Over the range", plots(result, file.mechanism)) +
               html_section("budget", "Causes of the angular error", sources_table(result.sources)) +
               html_section("tolerances", "Tolerances",
                            "<p class=\"lead\">Each dimension within " +
                                safe_text(with_unit(options.dimension_tolerance, "mm")) +
                                " (95 %), and the resulting limits of joint angle and excess length.</p>" +
                                tolerances_table(result.tolerances)),
       .foot =
           "Lengths in mm, angles in degrees, forces in N. Tensions are the full model’s in its third cycle, unless "
           "they are marked as the paper’s.",
       .styles = {embedded::figure_css, embedded::page_css},
       .scripts = {embedded::readout_js, joint_script(file.mechanism)}});
}

}  // namespace fusee::formats
