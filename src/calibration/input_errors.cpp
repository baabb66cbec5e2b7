#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "calibration/fit.h"
#include "calibration/input_error_hypotheses.h"
#include "calibration/thresholds.h"
#include "fusee/calibration.h"
#include "transmission/target_motion.h"

namespace fusee::calibration {
namespace {

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
  return is_within(trial, k_thresholds.input_error_alone) &&
         baseline.declared > k_thresholds.input_error_large * trial.floor;
}

/// True if the corrected file is so much nearer to the data that another cause beside the error may stay unexplained.
bool is_clear(const Trial& trial, const Baseline& baseline) {
  return std::isfinite(baseline.by_effects) ? trial.residual * k_thresholds.input_error_clear < baseline.by_effects
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
