#include "cli/calibration_summary.h"

#include <cmath>

#include "base/text.h"
#include "calibration/words.h"
#include "cli/table.h"
#include "export/report/calibration_words.h"

namespace fusee::cli {
namespace {

std::string item(const std::string& words) { return wrapped(words, "  - ", "    "); }

std::string items(const std::string& title, const std::vector<std::string>& all) {
  std::string text = all.empty() ? "" : "\n" + title + "\n";
  for (const std::string& one : all) text += item(one);
  return text;
}

std::string deg(double value) { return fixed(degrees(value), 4); }

std::string figures_table(const calibration::Calibration& c) {
  const auto row = [](const std::string& name, double before, double after) {
    return std::vector<std::string>{name, deg(before), deg(after)};
  };
  return table(
      {{"deg at the joint"}, {"before", Align::right}, {"after", Align::right}},
      {row("  rms", c.before.rms, c.after.rms), row("  largest", c.before.max, c.after.max),
       row("  rms held out", c.before.held_out_rms, c.after.held_out_rms),
       row("  ISO 230-2 A", c.iso_before.A, c.iso_after.A), row("  ISO 230-2 R", c.iso_before.R, c.iso_after.R),
       row("  ISO 230-2 B", c.iso_before.B, c.iso_after.B), row("  ISO 230-2 E", c.iso_before.E, c.iso_after.E),
       row("  ISO 230-2 M", c.iso_before.M, c.iso_after.M)});
}

std::string headline_text(const formats::CalibrationProduct& product) {
  const formats::Headline first = formats::headline(product);
  std::string text;
  for (const std::string& line : {first.problem, first.cause, first.action})
    text += line.empty() ? "" : wrapped(line, "", "");
  return text;
}

std::string causes_table(const formats::CalibrationProduct& product) {
  std::vector<std::vector<std::string>> rows;
  for (const formats::CauseRow& row : formats::cause_rows(product))
    rows.push_back({row.cause, row.size, row.interval, row.share, row.corrected_by});
  if (rows.empty()) return "";
  const auto& titles = formats::CauseRow::k_titles;
  return "\n" + table({{titles[0]}, {titles[1]}, {titles[2]}, {titles[3], Align::right}, {titles[4]}}, rows);
}

std::string noise_text(const calibration::Calibration& c) {
  std::string words =
      "noise floor " + deg(c.noise.rms) + (c.noise.from_repeats ? " deg, from repeats" : " deg or more: no repeats");
  if (c.noise.rms > 0) words += "; the residual is " + rounded(c.after.rms / c.noise.rms, 3) + " times that";
  return wrapped(words, "  ", "  ") + (c.noise_varies.empty() ? "" : wrapped(c.noise_varies, "  ", "  "));
}

std::string effect_text(const calibration::FoundEffect& effect, const std::string& load_unit) {
  std::string words = effect.name + " (" + std::string(word(effect.place)) + ")";
  for (std::size_t i = 0; i < effect.parameters.size(); ++i)
    words += (i == 0 ? ": " : "; ") + formats::parameter_words(effect.parameters[i], load_unit);
  words += ". Reduces the error by " + deg(effect.rms_drop) + " deg rms";
  std::vector<std::string> rivals = formats::rivals_of(effect);
  std::erase(rivals, calibration::k_unmodelled);
  const std::string unmodelled = formats::unmodelled_words(effect);
  if (!rivals.empty())
    words += "; equally likely: " + formats::joined(rivals, ", ");
  else
    words += unmodelled.empty() ? "; nothing else is as likely" : "; no other cause of the catalogue is as likely";
  std::string sentences;
  for (const std::string& more : {formats::audit_words(effect), formats::beside_words(effect, load_unit), unmodelled})
    sentences += more.empty() ? "" : (sentences.empty() ? ". " : " ") + more;
  return words + sentences;
}

std::vector<std::string> effect_texts(const calibration::Calibration& c, const std::string& load_unit) {
  std::vector<std::string> texts;
  for (const calibration::FoundEffect& effect : c.effects) texts.push_back(effect_text(effect, load_unit));
  if (texts.empty()) texts.push_back("none accepted");
  if (!c.unexplained_where.empty())
    texts.push_back("unexplained: " + deg(c.unexplained_rms) + " deg rms beyond the noise, " + c.unexplained_where);
  for (const calibration::DiscrepancyComponent& part : c.discrepancy)
    texts.push_back("unmodelled: " + formats::discrepancy_words(part));
  return texts;
}

std::vector<std::string> correction_texts(const formats::CalibrationProduct& product) {
  const correction::Correction& correction = product.correction;
  std::vector<std::string> texts;
  if (correction.has_pulley) {
    texts.push_back("the pulley of corrected.toml removes " + deg(correction.by_pulley) + " deg rms");
    if (correction.round.r1 > 0) texts.push_back(formats::round_words(correction));
    if (correction.assembly_angle != 0) texts.push_back(formats::assembly_angle_words(correction));
  } else if (!correction.infeasible.empty()) {
    texts.push_back(formats::infeasible_words(correction));
  } else if (correction.why_no_pulley_file.empty()) {
    texts.push_back("nothing was identified that another pulley would correct");
  }
  if (!correction.why_no_pulley_file.empty())
    texts.push_back("corrected.toml is not written: " + correction.why_no_pulley_file);
  if (!correction.why_no_table.empty()) texts.push_back("compensation.csv is not written: " + correction.why_no_table);
  if (!correction.table.empty())
    texts.push_back("compensation.csv removes " + deg(correction.by_table) + " deg rms" +
                    (correction.has_pulley ? " beyond that" : ""));
  if (const std::string curve = formats::curve_words(product); !curve.empty()) texts.push_back(curve);
  return texts;
}

std::vector<std::string> detectable_texts(const calibration::Calibration& c) {
  std::vector<std::string> texts;
  for (const auto& [size, names] : formats::detectable_groups(c))
    texts.push_back(deg(size) + " deg: " + formats::joined(names, ", "));
  return texts;
}

std::string tried_table(const calibration::Calibration& c) {
  if (c.tried.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const calibration::Candidate& candidate : c.tried) {
    rows.push_back({"  " + candidate.name,
                    std::isfinite(candidate.evidence) ? calibration::odds(candidate.evidence) : "–",
                    candidate.accepted ? "taken" : ""});
  }
  return "\n" + table({{"Tried"}, {"odds", Align::right}, {""}}, rows);
}

}  // namespace

std::string calibration_summary(const formats::CalibrationProduct& product, bool verbose) {
  const calibration::Calibration& c = product.calibration;
  std::string text = headline_text(product) + causes_table(product) + "\n" + product.file.mechanism.name + ": " +
                     std::string(calibration::word(c.verdict)) + "\n" + wrapped(c.summary, "  ", "  ");
  text += items("Likely input error", formats::input_error_texts(product));
  if (c.verdict == calibration::CalibrationVerdict::not_testable)
    return text + items("Measure next", formats::next_texts(c));
  text += "\n" + figures_table(c) + noise_text(c) + items("Effects", effect_texts(c, product.measurement.load_unit));
  text += items("Not distinguished by these data", c.null_combinations) +
          items("Correction", correction_texts(product)) + items("Measure next", formats::next_texts(c));
  if (verbose || c.verdict == calibration::CalibrationVerdict::no_effect)
    text += items("Would have been seen, at the joint, rms", detectable_texts(c));
  return verbose ? text + tried_table(c) : text;
}

}  // namespace fusee::cli
