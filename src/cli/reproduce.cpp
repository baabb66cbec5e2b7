#include "base/text.h"
#include "cli/command.h"
#include "export/report/paper.h"
#include "fusee/base.h"

namespace fusee::cli {
namespace {

std::string table_4_text(const paper::Reproduction& reproduction) {
  std::string text = "Table 4: paper and certified optimum, max T_b/F_c " + fixed(reproduction.optimum, 4) + "\n";
  for (const paper::OptimumRow& row : reproduction.table_4) {
    std::string symbol = row.symbol;
    symbol.resize(8, ' ');
    text += "  " + symbol + rounded(row.paper) + " mm, computed " + rounded(row.computed, 6) + " mm (bounds " +
            rounded(row.lower) + " and " + rounded(row.upper) + ")\n";
  }
  return text;
}

/// A heading with a text next to it.
std::string beside(std::string_view heading, std::string_view words) {
  constexpr std::string_view k_indent = "             ";
  std::string first = "  " + std::string(heading);
  first.resize(k_indent.size(), ' ');
  return wrapped(words, first, k_indent);
}

std::string claim_text(const paper::Claim& claim) {
  return "\n" + claim.name + ": " + std::string(paper::verdict_text(claim.verdict)) + "\n" +
         beside("paper", claim.paper_says) + beside("equations", claim.equations_give) +
         beside("holds for", formats::claim_windows_text(claim));
}

std::string laws_text(const paper::Reproduction& reproduction) {
  std::string text = "\nboth laws on the paper's optimum\n";
  for (const paper::LawCost& law : reproduction.laws) {
    text +=
        beside(law.law, "theta within " + fixed(law.nonlinearity, 2) + " deg of a line, r2 up to " +
                            rounded(law.r2_most) + " mm, bend radius " + rounded(law.bend_radius, 3) + " mm, T_b/F_c " +
                            fixed(law.tension, 4) + ", torque/F_c " + rounded(law.torque) + " mm");
  }
  return text;
}

std::string assumed_text(const paper::PaperAssumptions& assumptions) {
  return "assumed: unit " + rounded(assumptions.unit) + " mm, r1 " + rounded(assumptions.r1) + " mm, EF " +
         rounded(assumptions.EF) + " mm, mu " + rounded(assumptions.mu) + ", F_c " + rounded(assumptions.tip_force) +
         " N\n\n";
}

Json windows_json(const std::vector<paper::ParameterWindows>& windows) {
  Json json = Json::object();
  for (const paper::ParameterWindows& entry : windows) {
    json[entry.parameter] = Json::array();
    for (const paper::Window& window : entry.windows) {
      json[entry.parameter].push_back(
          {{"low", window.low}, {"high", window.high}, {"open_low", window.open_low}, {"open_high", window.open_high}});
    }
  }
  return json;
}

Json reproduction_json(const paper::Reproduction& reproduction) {
  const paper::PaperAssumptions& assumptions = reproduction.assumptions;
  Json json;
  json["assumptions"] = {{"unit_mm", assumptions.unit},
                         {"r1_mm", assumptions.r1},
                         {"EF_mm", assumptions.EF},
                         {"mu", assumptions.mu},
                         {"tip_force_N", assumptions.tip_force}};
  json["optimum"] = reproduction.optimum;
  json["relative_gap"] = reproduction.relative_gap;
  for (const paper::OptimumRow& row : reproduction.table_4) {
    json["table_4"].push_back({{"symbol", row.symbol}, {"paper_mm", row.paper}, {"computed_mm", row.computed}});
  }
  for (const paper::Claim& claim : reproduction.claims) {
    json["claims"].push_back({{"name", claim.name},
                              {"verdict", paper::verdict_text(claim.verdict)},
                              {"paper_says", claim.paper_says},
                              {"equations_give", claim.equations_give},
                              {"windows", windows_json(claim.windows)}});
  }
  for (const paper::LawCost& law : reproduction.laws) {
    json["laws"].push_back({{"law", law.law},
                            {"nonlinearity_deg", law.nonlinearity},
                            {"r2_most_mm", law.r2_most},
                            {"bend_radius_mm", law.bend_radius},
                            {"tension", law.tension},
                            {"torque_mm", law.torque}});
  }
  for (const paper::MuWindow& window : reproduction.mu_windows) {
    paper::ParameterWindows of_mu;
    of_mu.parameter = "mu";
    of_mu.windows = window.windows;
    json["mu_windows"].push_back(
        {{"r1_mm", window.r1}, {"EF_mm", window.EF}, {"windows", windows_json({of_mu})["mu"]}});
  }
  return json;
}

std::vector<std::string> names_of(const std::vector<OutputFile>& files) {
  std::vector<std::string> names;
  for (const OutputFile& file : files) names.push_back(file.name);
  return names;
}

Reply run_reproduce(const Arguments& arguments, Console&, const RunContext& context) {
  const auto folder = arguments.text("--out");
  const paper::Reproduction reproduction = paper::reproduce_paper({}, context);
  Reply reply;
  reply.text = assumed_text(reproduction.assumptions) + table_4_text(reproduction);
  for (const paper::Claim& claim : reproduction.claims) reply.text += claim_text(claim);
  reply.text += laws_text(reproduction);
  reply.fields = reproduction_json(reproduction);
  if (!folder || arguments.has("--dry-run")) return reply;
  const std::vector<OutputFile> files = formats::paper_files(reproduction);
  OutputFolder out(*folder, arguments.has("--force"), context);
  out.claim(names_of(files));
  for (const OutputFile& file : files) out.stage(file);
  out.publish(reply.diagnostics);
  reply.text += "\n" + std::to_string(files.size()) + " files in " + *folder + "\n";
  reply.fields["outputs"] = names_of(files);
  return reply;
}

}  // namespace

Command reproduce_command() {
  return {"reproduce",
          "",
          "the paper, claim by claim",
          "Computes the table and the figures of the paper on which fusee is based from\n"
          "the paper's equations, and tests each of its claims: holds, holds only if ...,\n"
          "does not hold. Numbers that the paper omits are assumed and listed, and the\n"
          "windows in which a claim holds are determined.",
          {{"-o,--out", "DIR", "figures as SVG, numbers as CSV, and the page paper.md"}},
          {{"fusee reproduce", "the claims, one by one"},
           {"fusee reproduce -o paper", "with figures and numbers; read paper/paper.md"}},
          run_reproduce};
}

}  // namespace fusee::cli
