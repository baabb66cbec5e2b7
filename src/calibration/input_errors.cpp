#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/text.h"
#include "calibration/fit.h"
#include "calibration/thresholds.h"
#include "fusee/calibration.h"
#include "fusee/mechanism_file.h"
#include "transmission/target_motion.h"

namespace fusee::calibration {
namespace {

/// Corrected input error, before it is compared with data.
struct InputErrorHypothesis {
  LikelyInputError error;   ///< the error, without its rms
  DeclaredMechanism joint;  ///< corrected joint
  DeclaredMechanism drawn;  ///< joint for which its pulley was made
  double alpha = 1;         ///< factor on the logged angles
  double theta = 1;
};

/// Relative difference below which values are equal.
constexpr double k_alike = 0.01;

/// Hypothesis that the keys should have the values `would_be`; none if they are equal or invalid in a file.
std::optional<InputErrorHypothesis> with_values(const DeclaredMechanism& declared, const std::string& name,
                                                const std::vector<std::string>& keys,
                                                const std::vector<double>& would_be, const char* question) {
  InputErrorHypothesis hypothesis{{name, {}, would_be, question}, declared, declared};
  bool differs = false;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const NumberKey key = *find_number_key(keys[i]);
    const double value = key.get(declared);
    const bool allowed = would_be[i] >= key.field->least && would_be[i] <= key.field->most;
    if (!allowed || !is_used(*key.field, declared)) return std::nullopt;
    differs = differs || std::abs(would_be[i] - value) > k_alike * std::abs(value);
    hypothesis.error.declared.push_back(value);
    key.set(hypothesis.joint, would_be[i]);
  }
  if (!differs) return std::nullopt;
  hypothesis.drawn = hypothesis.joint;
  return hypothesis;
}

std::optional<InputErrorHypothesis> scaled(const DeclaredMechanism& declared, const char* key, double factor,
                                           const char* question) {
  return with_values(declared, key, {key}, {factor * find_number_key(key)->get(declared)}, question);
}

std::optional<InputErrorHypothesis> inverted(const DeclaredMechanism& declared, const char* key) {
  return with_values(declared, key, {key}, {1.0 / find_number_key(key)->get(declared)}, "is it alpha per theta?");
}

std::optional<InputErrorHypothesis> exchanged_pins(const DeclaredMechanism& declared) {
  return with_values(declared, "guides.EB_mm, guides.ED_mm", {"guides.EB_mm", "guides.ED_mm"},
                     {declared.guides.ED, declared.guides.EB}, "are the two exchanged?");
}

std::optional<InputErrorHypothesis> range_in_radians(const DeclaredMechanism& declared) {
  const Joint& joint = declared.joint;
  return with_values(declared, "joint.range_deg", {"joint.range_deg[0]", "joint.range_deg[1]"},
                     {degrees(degrees(joint.theta_min)), degrees(degrees(joint.theta_max))}, "is it in radians?");
}

/// The corrected joint with the pulley of the uncorrected file.
std::optional<InputErrorHypothesis> with_pulley_as_declared(std::optional<InputErrorHypothesis> hypothesis,
                                                            const DeclaredMechanism& declared) {
  if (!hypothesis) return hypothesis;
  hypothesis->drawn = declared;
  hypothesis->error.pulley_as_declared = true;
  return hypothesis;
}

struct DataError {
  const char* angles;
  double alpha, theta;
  const char* question;
};
constexpr const char* k_sign = "is the sign right?";
constexpr const char* k_unit = "is the unit right?";
constexpr const char* k_radians = "is the log in radians?";
constexpr DataError k_data_errors[] = {
    {"alpha", -1.0, 1.0, k_sign},
    {"theta", 1.0, -1.0, k_sign},
    {"alpha and theta", -1.0, -1.0, k_sign},
    {"alpha", degrees(1.0), 1.0, k_radians},
    {"theta", 1.0, degrees(1.0), k_radians},
    {"alpha and theta", degrees(1.0), degrees(1.0), k_radians},
};

/// Likely input errors of `declared` and its data, one at a time.
std::vector<InputErrorHypothesis> input_error_hypotheses(const DeclaredMechanism& declared) {
  std::vector<InputErrorHypothesis> all;
  const auto add = [&all](std::optional<InputErrorHypothesis> hypothesis) {
    if (hypothesis) all.push_back(std::move(*hypothesis));
  };
  for (const auto& geometry : {scaled(declared, "guides.OE_mm", -1.0, k_sign), exchanged_pins(declared)}) {
    add(geometry);
    add(with_pulley_as_declared(geometry, declared));
  }
  add(range_in_radians(declared));
  for (const char* length :
       {"joint.length_mm", "guides.EB_mm", "guides.ED_mm", "guides.OE_mm", "pulley.EF_mm", "pulley.r1_mm"}) {
    for (const double factor : {10.0, 0.1}) add(scaled(declared, length, factor, k_unit));
  }
  add(scaled(declared, "tendon.modulus_MPa", 1000.0, "is it in GPa?"));
  for (const char* ratio : {"pulley.ratio", "transmission.ratio"}) add(inverted(declared, ratio));
  for (const DataError& data : k_data_errors) {
    const double factor = data.alpha != 1.0 ? data.alpha : data.theta;
    all.push_back({{data.angles, {1.0}, {factor}, data.question}, declared, declared, data.alpha, data.theta});
  }
  return all;
}

/// Rows of a run: ten times those of a fit.
constexpr std::size_t k_rows = 2000;

measurement::Measurement corrected_data(measurement::Measurement data, const InputErrorHypothesis& hypothesis) {
  for (measurement::Run& run : data.runs) {
    for (measurement::Sample& sample : run.samples) {
      sample.alpha *= hypothesis.alpha;
      sample.theta *= hypothesis.theta;
    }
    for (measurement::Stroke& stroke : run.strokes) stroke.direction *= hypothesis.alpha < 0 ? -1 : 1;
    run.speed *= std::abs(hypothesis.alpha);
  }
  measurement::compare_with_declared(hypothesis.joint, data);
  return data;
}

/// Hypothesis compared with the data.
struct Trial {
  InputErrorHypothesis hypothesis;
  double residual = std::numeric_limits<double>::infinity();  ///< held-out rms with nothing fitted, rad
  double floor = 0;                                           ///< rad
};

Trial test_hypothesis(InputErrorHypothesis hypothesis, const measurement::Measurement& as_read, double floor) {
  Trial trial{std::move(hypothesis)};
  trial.floor = floor * std::abs(trial.hypothesis.theta);
  if (!transmission::TargetMotion(trial.hypothesis.joint).exists() ||
      !transmission::TargetMotion(trial.hypothesis.drawn).exists())
    return trial;
  const measurement::Measurement data = corrected_data(as_read, trial.hypothesis);
  if (!data.not_testable.empty()) return trial;
  const Evidence evidence = gather(trial.hypothesis.joint, data, trial.floor);
  if (evidence.blocks.size() < 2) return trial;
  joint::Forward forward(trial.hypothesis.joint, evidence.log, trial.hypothesis.drawn);
  const Fit fit = Fitter(evidence, forward).fit({}, {});
  if (fit.usable) trial.residual = held_out_rms(fit);
  return trial;
}

std::vector<Trial> test_hypotheses(const DeclaredMechanism& declared, const measurement::Measurement& as_read,
                                   double floor) {
  std::vector<Trial> all;
  for (InputErrorHypothesis& hypothesis : input_error_hypotheses(declared))
    all.push_back(test_hypothesis(std::move(hypothesis), as_read, floor));
  std::stable_sort(all.begin(), all.end(), [](const Trial& a, const Trial& b) { return a.residual < b.residual; });
  return all;
}

bool is_explained(const Calibration& found) {
  return found.verdict == CalibrationVerdict::explained || found.verdict == CalibrationVerdict::confounded ||
         found.verdict == CalibrationVerdict::no_effect;
}

bool is_within(const Trial& trial, double floors) { return trial.residual <= floors * trial.floor; }

/// Errors that a hypothesis must reduce, rad.
struct Baseline {
  double declared = 0;    ///< held-out rms of the declared file
  double by_effects = 0;  ///< held-out rms of the effects found in it
  bool is_explained = false;
};

/// If nothing could be tested, any error is an improvement.
Baseline baseline_of(const Calibration& found) {
  constexpr double nothing = std::numeric_limits<double>::infinity();
  if (found.verdict == CalibrationVerdict::not_testable) return {nothing, nothing};
  return {found.before.held_out_rms, found.after_effects.held_out_rms, is_explained(found)};
}

/// True if the corrected file alone explains data far from the declared joint, even if effects explain them as well.
bool is_simpler(const Trial& trial, const Baseline& baseline) {
  return is_within(trial, k_thresholds.input_error_gain) &&
         baseline.declared > k_thresholds.input_error_large * trial.floor;
}

/// True if the corrected file is so much nearer to the data that another cause beside the error may stay unexplained.
bool is_clear(const Trial& trial, const Baseline& baseline) {
  return std::isfinite(baseline.by_effects) ? trial.residual * k_thresholds.input_error_large < baseline.by_effects
                                            : is_within(trial, k_thresholds.input_error_large);
}

/// True if the corrected file explains the data, alone or with effects, by the rules of every calibration.
bool explains(Trial& trial, const measurement::Measurement& as_read, const Baseline& baseline) {
  LikelyInputError& error = trial.hypothesis.error;
  error.rms = trial.residual;
  if (is_simpler(trial, baseline)) return true;
  if (baseline.is_explained || k_thresholds.input_error_gain * trial.residual > baseline.by_effects) return false;
  if (error.pulley_as_declared || !is_within(trial, k_thresholds.input_error_large)) return is_clear(trial, baseline);
  const Calibration found = calibrate(trial.hypothesis.joint, corrected_data(as_read, trial.hypothesis));
  if (!is_explained(found)) return is_clear(trial, baseline);
  for (const FoundEffect& effect : found.effects) error.beside.push_back(effect.name);
  error.rms = found.after_effects.held_out_rms;
  return true;
}

std::string numbers_text(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + rounded(value, 5);
  return text;
}

std::string beside_text(const std::vector<std::string>& effects) {
  std::string text;
  for (const std::string& name : effects) text += (text.empty() ? ", with " : ", ") + name;
  return text.empty() ? text : text + " beside it";
}

/// False for a file that contains identified effects: it was compared with data before.
bool can_have_input_errors(const DeclaredMechanism& declared, const measurement::Measurement& as_read) {
  return as_read.not_testable.empty() && declared.identified == Imperfections{};
}

}  // namespace

bool is_input_error_obvious(const DeclaredMechanism& declared, const measurement::Measurement& as_read) {
  if (!can_have_input_errors(declared, as_read)) return false;
  const measurement::Measurement data = with_fewer_rows(as_read, k_rows);
  const double floor = std::max(measurement::noise_floor(as_read).rms, 1e-9);
  const Trial as_it_stands = test_hypothesis({{}, declared, declared}, data, floor);
  if (!std::isfinite(as_it_stands.residual) || is_within(as_it_stands, k_thresholds.input_error_large)) return false;
  const std::vector<Trial> all = test_hypotheses(declared, data, floor);
  if (all.empty()) return false;
  const Baseline baseline{as_it_stands.residual, as_it_stands.residual, false};
  // A fault of any known size may be present beside the error.
  return is_simpler(all.front(), baseline) ||
         (is_within(all.front(), k_thresholds.input_error_large) && is_clear(all.front(), baseline));
}

std::vector<LikelyInputError> find_input_errors(const DeclaredMechanism& declared,
                                                const measurement::Measurement& as_read, const Calibration& found) {
  if (!can_have_input_errors(declared, as_read) || found.verdict == CalibrationVerdict::not_repeatable ||
      found.verdict == CalibrationVerdict::no_effect)
    return {};
  const Baseline baseline = baseline_of(found);
  const double floor = std::max(measurement::noise_floor(as_read).rms, 1e-9);
  const measurement::Measurement data = with_fewer_rows(as_read, k_rows);
  std::vector<LikelyInputError> errors;
  double best = 0;  // held-out rms of the best
  for (Trial& trial : test_hypotheses(declared, data, floor)) {
    const bool ties = errors.empty() || trial.residual <= best / k_thresholds.residual_share;
    if (!ties || !explains(trial, data, baseline)) break;
    if (errors.empty()) best = trial.residual;
    errors.push_back(trial.hypothesis.error);
  }
  return errors;
}

std::string input_error_words(const LikelyInputError& error) {
  const bool of_file = error.key.find('.') != std::string::npos;
  const std::string meant =
      of_file ? error.key + " = " + numbers_text(error.would_be) + " in place of " + numbers_text(error.declared)
              : "the logged " + error.key + " times " + numbers_text(error.would_be);
  return meant + (error.pulley_as_declared ? ", with the pulley that was made from this file," : "") +
         " would explain the data to " + rounded(degrees(error.rms), 2) + "°" + beside_text(error.beside) + ": " +
         error.question;
}

}  // namespace fusee::calibration
