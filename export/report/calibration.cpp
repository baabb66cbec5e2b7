// calibration.json and manifest.json of a calibration. Keys of schema 1 keep their first names, also where the code has
// others now: "worlds" are simulated joints, "unknown" is the discrepancy, "covered" the empirical curve, "slips" are
// likely input errors, "rest_autocorrelation" is that of residuals, and "tied_at_deg" the assembly angle.

#include <cmath>
#include <filesystem>

#include "base/output_list.h"
#include "calibration/words.h"
#include "export/report/calibration_words.h"
#include "export/report/input_json.h"
#include "export/tool.h"
#include "fusee/base.h"
#include "fusee/export.h"
#include "mechanism/effect.h"

namespace fusee::formats {
namespace {

/// Null where no joints were simulated.
Json audit_json(const calibration::Audit& audit) {
  return audit.data_sets > 0 ? Json({{"worlds", audit.data_sets}, {"named", audit.false_positives}}) : Json();
}

Json parameters_json(const std::vector<calibration::FittedParameter>& parameters) {
  Json json = Json::object();
  for (const calibration::FittedParameter& parameter : parameters) {
    json[parameter.name] = {{"value", result_json(parameter.value)},
                            {"ci95_if_only", {result_json(parameter.low_if_only), result_json(parameter.high_if_only)}},
                            {"ci95", {result_json(parameter.low), result_json(parameter.high)}}};
  }
  return json;
}

Json effect_json(const calibration::FoundEffect& effect) {
  Json json = {{"name", effect.name},
               {"group", effect.group},
               {"place", fusee::word(effect.place)},
               {"parameters", parameters_json(effect.parameters)},
               {"rms_drop_deg", angle_json(effect.rms_drop)},
               {"share", result_json(effect.share)},
               {"evidence", result_json(effect.evidence)},
               {"audit", audit_json(effect.audit)},
               {"correctable_by", fusee::word(effect.correctable_by)}};
  // The key exists only if the cause may be unmodelled.
  if (effect.group.back() == calibration::k_unmodelled) {
    json["unmodelled"] = {{"behind", result_json(effect.unmodelled.log_odds)}, {"words", unmodelled_words(effect)}};
  }
  for (const calibration::GroupMember& member : effect.alternatives)
    json["instead"].push_back({{"name", member.name}, {"parameters", parameters_json(member.parameters)}});
  for (const calibration::GroupMember& member : effect.beside)
    json["beside"].push_back({{"name", member.name}, {"parameters", parameters_json(member.parameters)}});
  return json;
}

/// Components of the discrepancy.
Json discrepancy_json(const std::vector<calibration::DiscrepancyComponent>& components) {
  Json list = Json::array();
  for (const calibration::DiscrepancyComponent& component : components) {
    Json json = {{"factor", component.factor},
                 {"rms_deg", angle_json(component.rms)},
                 {"evidence", result_json(component.evidence)},
                 {"words", component.words}};
    if (component.order > 0) json["order"] = result_json(component.order);
    list.push_back(json);
  }
  return list;
}

Json angles_json(const std::vector<double>& angles) {
  Json list = Json::array();
  for (const double angle : angles) list.push_back(angle_json(angle));
  return list;
}

/// Null if the effects explain the data.
Json empirical_curve_json(const CalibrationProduct& product) {
  const calibration::EmpiricalCurve& curve = product.calibration.curve;
  if (!curve.used && curve.why.empty()) return {};
  Json json = {{"used", curve.used}, {"words", curve_words(product)}};
  if (!curve.used) json["why"] = curve.why;
  if (curve.alpha.empty()) return json;
  json["gain_rms_deg"] = angle_json(curve.gain);
  json["held_out_rms_deg"] = {{"effects_alone", angle_json(curve.held_out_effects)},
                              {"with_curve", angle_json(curve.held_out_rms)}};
  json["curve"] = {{"alpha_deg", angles_json(curve.alpha)},
                   {"theta_up_deg", angles_json(curve.up)},
                   {"theta_down_deg", angles_json(curve.down)}};
  return json;
}

Json figures_json(const calibration::ErrorFigures& figures) {
  return {{"rms_deg", angle_json(figures.rms)},
          {"max_deg", angle_json(figures.max)},
          {"held_out_rms_deg", angle_json(figures.held_out_rms)}};
}

Json iso_json(const measurement::Iso230& iso) {
  return {{"A_deg", angle_json(iso.A)},
          {"R_deg", angle_json(iso.R)},
          {"B_deg", angle_json(iso.B)},
          {"E_deg", angle_json(iso.E)},
          {"M_deg", angle_json(iso.M)}};
}

Json tried_json(const std::vector<calibration::Candidate>& tried) {
  Json list = Json::array();
  for (const calibration::Candidate& candidate : tried) {
    list.push_back({{"name", candidate.name},
                    {"evidence", result_json(candidate.evidence)},
                    {"accepted", candidate.accepted},
                    {"why", candidate.why}});
  }
  return list;
}

Json noise_levels_json(const measurement::NoiseFloor& noise) {
  Json list = Json::array();
  for (const measurement::NoiseLevel& level : noise.levels) {
    list.push_back({{"load", result_json(level.load)},
                    {"speed_deg_per_s", angle_json(level.speed)},
                    {"rms_deg", angle_json(level.rms)},
                    {"largest_at_alpha_deg", angle_json(level.largest_at)}});
  }
  return list;
}

Json effects_json(const calibration::Calibration& calibration) {
  Json list = Json::array();
  for (const calibration::FoundEffect& effect : calibration.effects) list.push_back(effect_json(effect));
  return list;
}

/// A single number, or a list if the input error concerns several keys.
Json numbers_json(const std::vector<double>& values) {
  if (values.size() == 1) return result_json(values.front());
  Json list = Json::array();
  for (const double value : values) list.push_back(result_json(value));
  return list;
}

Json input_errors_json(const std::vector<calibration::LikelyInputError>& errors) {
  Json list = Json::array();
  for (const calibration::LikelyInputError& error : errors) {
    list.push_back({{"key", error.key},
                    {"declared", numbers_json(error.declared)},
                    {"would_be", numbers_json(error.would_be)},
                    {"rms_deg", angle_json(error.rms)},
                    {"pulley_as_declared", error.pulley_as_declared},
                    {"beside", error.beside},
                    {"words", calibration::input_error_words(error)}});
  }
  return list;
}

Json detectable_json(const calibration::Calibration& calibration) {
  Json list = Json::array();
  for (const calibration::Detectable& detectable : calibration.detectable)
    list.push_back({{"name", detectable.name}, {"smallest_deg", angle_json(detectable.smallest)}});
  return list;
}

Json correctable_json(const correction::Correction& correction) {
  Json json = {{"by_pulley_rms_deg", angle_json(correction.by_pulley)},
               {"by_table_rms_deg", angle_json(correction.by_table)}};
  if (correction.by_curve > 0) json["by_empirical_curve_rms_deg"] = angle_json(correction.by_curve);
  if (!correction.why_no_pulley_file.empty()) json["no_corrected_toml"] = correction.why_no_pulley_file;
  if (!correction.why_no_table.empty()) json["no_compensation_csv"] = correction.why_no_table;
  if (!correction.infeasible.empty()) json["infeasible"] = correction.infeasible;
  if (correction.assembly_angle != 0) json["tied_at_deg"] = angle_json(correction.assembly_angle);
  if (correction.round.r1 > 0) {
    json["p1_round"] = {{"best_r1_mm", result_json(correction.round.r1)},
                        {"max_error_deg", angle_json(correction.round.max_error)},
                        {"suffices", correction.round.suffices}};
  }
  return json;
}

Json next_json(const CalibrationProduct& product) {
  Json list = Json::array();
  for (std::size_t i = 0; i < product.calibration.next.size(); ++i) {
    const plan::NextMeasurement& next = product.calibration.next[i];
    Json json = {{"kind", next.kind()}};
    if (next.run) json["file"] = next_file_name(product, i);
    if (!next.readings.empty()) json["key"] = next.readings.front()->by_hand.key;
    if (next.readings.size() > 1) {
      for (const EffectParameter* reading : next.readings) json["keys"].push_back(reading->by_hand.key);
    }
    json["separates"] = next.separates;
    json["minutes"] = result_json(next.minutes);
    json["text"] = next.text();
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace

std::string calibration_json(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  Json json = {{"schema", 1}, {"verdict", calibration::word(calibration.verdict)}, {"summary", calibration.summary}};
  const Headline first = headline(product);
  json["headline"] = {{"problem", first.problem}, {"cause", first.cause}, {"action", first.action}};
  json["effects"] = effects_json(calibration);
  json["noise_floor_deg"] = angle_json(calibration.noise.rms);
  json["noise_floor"] = {{"degrees_of_freedom", result_json(calibration.noise.degrees_of_freedom)},
                         {"from_repeats", calibration.noise.from_repeats},
                         {"within_stroke_deg", angle_json(calibration.noise.within_stroke)},
                         {"levels", noise_levels_json(calibration.noise)}};
  json["before"] = figures_json(calibration.before);
  json["after"] = figures_json(calibration.after);
  json["after_per_noise_floor"] =
      calibration.noise.rms > 0 ? result_json(calibration.after.rms / calibration.noise.rms) : Json();
  json["held_out"] = {{"factors", calibration.held_out_factors}, {"runs", calibration.held_out_runs}};
  json["rest_autocorrelation"] = result_json(calibration.residual_autocorrelation);
  json["unexplained_rms_deg"] = angle_json(calibration.unexplained_rms);
  json["dropped"] = calibration.dropped;
  json["unexplained_where"] = calibration.unexplained_where;
  json["unknown"] = discrepancy_json(calibration.discrepancy);
  json["instead"] = Json::array();  // always empty; readers of the schema expect the key
  json["covered"] = empirical_curve_json(product);
  json["slips"] = input_errors_json(product.input_errors);
  json["detectable"] = detectable_json(calibration);
  json["next"] = next_json(product);
  json["null_combinations"] = calibration.null_combinations;
  json["iso230"] = {{"before", iso_json(calibration.iso_before)}, {"after", iso_json(calibration.iso_after)}};
  json["correctable"] = correctable_json(product.correction);
  json["tried"] = tried_json(calibration.tried);
  json["not_testable"] = product.measurement.not_testable;
  json["notes"] = product.measurement.notes;
  return json_text(json, 1);
}

std::string calibration_manifest_json(const CalibrationProduct& product, const std::vector<OutputFile>& outputs) {
  Json json = {{"schema", 1}, {"tool", std::string(k_tool)}};
  json["input"] = input_json(product.file);
  json["runs"] = Json::array();
  for (const measurement::Run& run : product.measurement.runs) json["runs"].push_back(run.name);
  json["verdict"] = calibration::word(product.calibration.verdict);
  if (product.correction.by_curve > 0) json["empirical"] = {"compensation.csv"};
  json["outputs"] = output_list(outputs);
  return json_text(json, 1);
}

}  // namespace fusee::formats
