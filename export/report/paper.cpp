#include "export/report/paper.h"

#include "base/output_list.h"
#include "base/text.h"
#include "export/report/calibration_words.h"
#include "export/report/plot.h"
#include "export/tool.h"
#include "paper/windows.h"

namespace fusee::formats {
namespace {

std::string two_digits(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

Figure drawn_figure(const paper::PaperFigure& figure) {
  constexpr Ink inks[] = {Ink::main, Ink::p1, Ink::p2, Ink::third};
  Plot plot;
  plot.title = "Fig. " + std::to_string(figure.number) + ": " + figure.title;
  plot.x.label = figure.x_name;
  plot.x.unit = figure.x_unit;
  plot.y.label = figure.y_name;
  plot.y.unit = figure.y_unit;
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    PlotSeries series;
    series.name = figure.curves[i].name;
    series.ink = inks[i % std::size(inks)];
    series.points = figure.curves[i].points;
    plot.series.push_back(std::move(series));
  }
  return plot_figure(plot);
}

std::string unit_in_name(const std::string& unit) { return unit.empty() ? "" : unit == "°" ? "_deg" : "_" + unit; }

std::string column_name(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_')
      plain += c;
    else if (c == ' ')
      plain += '_';
  }
  return plain;
}

/// All curves of a figure have the same x.
std::string figure_csv(const paper::PaperFigure& figure) {
  std::string csv = (figure.x_unit == "°" ? "alpha_deg" : "generation");
  for (const paper::Curve& curve : figure.curves) csv += "," + column_name(curve.name) + unit_in_name(figure.y_unit);
  csv += "\n";
  for (std::size_t i = 0; i < figure.curves.front().points.size(); ++i) {
    csv += fixed(figure.curves.front().points[i].x(), 6);
    for (const paper::Curve& curve : figure.curves) csv += "," + fixed(curve.points[i].y(), 6);
    csv += "\n";
  }
  return csv;
}

std::string quoted(const std::string& text) {
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + "\"";
}

std::string claims_csv(const paper::Reproduction& all) {
  std::string csv = "claim,verdict,paper_says,equations_give,holds_where\n";
  for (const paper::Claim& claim : all.claims) {
    csv += claim.name + "," + std::string(paper::verdict_text(claim.verdict)) + "," + quoted(claim.paper_says) + "," +
           quoted(claim.equations_give) + "," + quoted(claim_windows_text(claim)) + "\n";
  }
  return csv;
}

std::string table_4_csv(const paper::Reproduction& all) {
  std::string csv = "symbol,lower_mm,upper_mm,paper_mm,computed_mm\n";
  for (const paper::OptimumRow& row : all.table_4) {
    csv += row.symbol + "," + fixed(row.lower, 6) + "," + fixed(row.upper, 6) + "," + fixed(row.paper, 6) + "," +
           fixed(row.computed, 6) + "\n";
  }
  return csv;
}

std::string laws_csv(const paper::Reproduction& all) {
  std::string csv =
      "law,nonlinearity_deg,r1_least_mm,r1_most_mm,r2_least_mm,r2_most_mm,bend_radius_mm,tension,torque_mm,torque_"
      "ripple\n";
  for (const paper::LawCost& law : all.laws) {
    csv += law.law;
    for (const double value : {law.nonlinearity, law.r1_least, law.r1_most, law.r2_least, law.r2_most, law.bend_radius,
                               law.tension, law.torque, law.torque_ripple}) {
      csv += "," + fixed(value, 6);
    }
    csv += "\n";
  }
  return csv;
}

std::string mu_windows_text(const paper::MuWindow& window) {
  constexpr double k_searched_from = 0.01, k_searched_to = 0.51;  // as in paper/reproduction.cpp
  return paper::windows_text({"mu", "", k_searched_from, k_searched_to, window.windows});
}

std::string mu_windows_csv(const paper::Reproduction& all) {
  std::string csv = "r1_mm,EF_mm,mu\n";
  for (const paper::MuWindow& window : all.mu_windows)
    csv += fixed(window.r1, 3) + "," + fixed(window.EF, 3) + "," + quoted(mu_windows_text(window)) + "\n";
  return csv;
}

// ---- the page -------------------------------------------------------------------------------------------------------

std::string row(std::initializer_list<std::string> cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string assumptions_text(const paper::PaperAssumptions& a) {
  return "Not in the paper, and assumed here: its unit of length " + rounded(a.unit) + " mm, r1 " + rounded(a.r1) +
         " mm, EF " + rounded(a.EF) + " mm (so BG " + rounded(elementary::hypot(0.5 * a.unit, a.EF), 4) + " mm), μ " +
         rounded(a.mu) + ", F_c " + rounded(a.tip_force) + " N. From the paper: θ ±30°, a tendon of " +
         rounded(a.diameter) + " mm and " + rounded(a.modulus) +
         " MPa, point pins. With these, T_b/F_c, r2 and θ do not depend on the tendon; elongation and error do.\n";
}

std::string claims_section(const paper::Reproduction& all) {
  std::string text =
      "## Claims\n\nA claim \"holds\" if it holds for all searched values of μ, r1 and EF, varied one at a time. If it "
      "holds for some of them, the last column lists these. The windows are found with 41 values, then by bisection at "
      "each border.\n\n";
  text += row({"claim", "the paper says", "its equations give", "verdict", "it holds for"}) + "|---|---|---|---|---|\n";
  for (const paper::Claim& claim : all.claims) {
    text += row({open_words(claim.name), claim.paper_says, claim.equations_give,
                 "**" + std::string(paper::verdict_text(claim.verdict)) + "**", claim_windows_text(claim)});
  }
  return text;
}

std::string table_4_section(const paper::Reproduction& all) {
  std::string text = "## Table 4: the optimum\n\n" + row({"", "lower", "upper", "paper", "certified optimum", "unit"}) +
                     "|---|---|---|---|---|---|\n";
  for (const paper::OptimumRow& r : all.table_4)
    text += row({r.symbol, rounded(r.lower), rounded(r.upper), rounded(r.paper), rounded(r.computed, 6), "mm"});
  text += "\nLargest T_b/F_c there: " + fixed(all.optimum, 4) +
          "; no design of the box is better by more than a millionth (branch and bound with intervals). "
          "With μ = 0 it is one of a whole surface of optima with T_b/F_c = 2: every ED = R/2 with OE low enough.\n";
  text += "\nThe μ for which Table 4 is the optimum, by r1 and EF:\n\n" + row({"r1 (mm)", "EF (mm)", "μ"}) +
          "|---|---|---|\n";
  for (const paper::MuWindow& window : all.mu_windows)
    text += row({rounded(window.r1), rounded(window.EF), mu_windows_text(window)});
  return text;
}

std::string laws_section(const paper::Reproduction& all) {
  std::string text =
      "## Both laws on the paper's optimum\n\n`compensate` is the paper's: P1 round, P2 follows. `linear` makes both "
      "non-circular, for the same turn of the motor.\n\n";
  text += row({"law", "deviation of θ(α) from its best line", "r1", "r2", "smallest bend radius", "largest T_b/F_c",
               "largest torque/F_c", "torque, largest/smallest"}) +
          "|---|---|---|---|---|---|---|---|\n";
  for (const paper::LawCost& law : all.laws) {
    text += row({law.law, "±" + fixed(law.nonlinearity, 2) + "°",
                 rounded(law.r1_least) + " … " + rounded(law.r1_most) + " mm",
                 rounded(law.r2_least) + " … " + rounded(law.r2_most) + " mm", rounded(law.bend_radius, 3) + " mm",
                 fixed(law.tension, 4), rounded(law.torque) + " mm", rounded(law.torque_ripple, 3)});
  }
  return text +
         "\nA negative bend radius is a concave place, which no tendon follows: with these r1 and EF, and a tendon "
         "without thickness, the pulley cannot be made.\n";
}

std::string figures_section(const paper::Reproduction& all) {
  std::string text =
      "## Figures\n\n`fusee reproduce -o DIR` draws them and writes their numbers. The paper's text is not part of "
      "this project: the table states how each figure is interpreted.\n\n";
  text += row({"figure", "interpreted as", "files"}) + "|---|---|---|\n";
  for (const paper::PaperFigure& figure : all.figures) {
    const std::string name = "fig_" + two_digits(figure.number);
    text += row({std::to_string(figure.number), figure.reading, name + ".svg, " + name + ".csv"});
  }
  return text;
}

/// Names and hashes of the files, by which a later run recognises them.
std::string manifest_of(const std::vector<OutputFile>& files) {
  Json json = {{"schema", 1}, {"tool", k_tool}};
  json["outputs"] = output_list(files);
  return json_text(json, 2);
}

}  // namespace

std::string claim_windows_text(const paper::Claim& claim) {
  std::string text;
  for (const paper::ParameterWindows& parameter : claim.windows) {
    text += text.empty() ? "" : "; ";
    if (parameter.windows.empty())
      text += "no " + parameter.parameter + " from " + paper::searched_text(parameter) + " makes it hold";
    else
      text += parameter.parameter + " " + paper::windows_text(parameter);
  }
  return text.empty() ? "does not depend on assumed numbers" : text;
}

std::string paper_page(const paper::Reproduction& reproduction) {
  return "# The paper, claim by claim\n\nWritten by `fusee reproduce`; a test keeps it current. Do not edit.\n\n" +
         assumptions_text(reproduction.assumptions) + "\n" + claims_section(reproduction) + "\n" +
         table_4_section(reproduction) + "\n" + laws_section(reproduction) + "\n" + figures_section(reproduction);
}

std::vector<OutputFile> paper_files(const paper::Reproduction& reproduction) {
  std::vector<OutputFile> files;
  for (const paper::PaperFigure& figure : reproduction.figures) {
    const std::string name = "fig_" + two_digits(figure.number);
    files.push_back({name + ".svg", standalone_svg(drawn_figure(figure))});
    files.push_back({name + ".csv", figure_csv(figure)});
  }
  files.push_back({"table_4.csv", table_4_csv(reproduction)});
  files.push_back({"claims.csv", claims_csv(reproduction)});
  files.push_back({"laws.csv", laws_csv(reproduction)});
  files.push_back({"mu_windows.csv", mu_windows_csv(reproduction)});
  files.push_back({"paper.md", paper_page(reproduction)});
  files.push_back({"manifest.json", manifest_of(files)});
  return files;
}

}  // namespace fusee::formats
