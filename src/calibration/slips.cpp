#include "fusee/calibration/slips.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/fit.h"
#include "calibration/suspects.h"
#include "calibration/thresholds.h"
#include "fusee/base/text.h"
#include "transmission/declared_law.h"

namespace fusee {
namespace {

/// Rows of a run: ten times those of a fit.
constexpr std::size_t k_rows_a_slip = 2000;

Measurement as_meant(Measurement data, const Suspect& suspect) {
  for (Run& run : data.runs) {
    for (Sample& sample : run.samples) {
      sample.alpha *= suspect.alpha;
      sample.theta *= suspect.theta;
    }
    for (Stroke& stroke : run.strokes) stroke.direction *= suspect.alpha < 0 ? -1 : 1;
    run.speed *= std::abs(suspect.alpha);
  }
  compare_with_declared(suspect.joint, data);
  return data;
}

/// Hypothesis compared with the data.
struct Trial {
  Suspect suspect;
  double left = std::numeric_limits<double>::infinity();  ///< held-out rms with nothing fitted, rad
  double floor = 0;                                       ///< rad
};

Trial tried(Suspect suspect, const Measurement& read, double floor) {
  Trial trial{std::move(suspect)};
  trial.floor = floor * std::abs(trial.suspect.theta);
  if (!DeclaredLaw(trial.suspect.joint).exists() || !DeclaredLaw(trial.suspect.drawn).exists()) return trial;
  const Measurement data = as_meant(read, trial.suspect);
  if (!data.not_testable.empty()) return trial;
  const Evidence evidence = gather(trial.suspect.joint, data, trial.floor);
  if (evidence.blocks.size() < 2) return trial;
  Forward forward(trial.suspect.joint, evidence.log, trial.suspect.drawn);
  const Fit fit = Fitter(evidence, forward).fit({}, {});
  if (fit.usable) trial.left = held_out_rms(fit);
  return trial;
}

std::vector<Trial> trials(const DeclaredMechanism& declared, const Measurement& read, double floor) {
  std::vector<Trial> all;
  for (Suspect& suspect : suspects(declared)) all.push_back(tried(std::move(suspect), read, floor));
  std::stable_sort(all.begin(), all.end(), [](const Trial& a, const Trial& b) { return a.left < b.left; });
  return all;
}

bool is_explained(const Calibration& found) {
  return found.verdict == CalibrationVerdict::explained || found.verdict == CalibrationVerdict::confounded ||
         found.verdict == CalibrationVerdict::no_effect;
}

bool is_within(const Trial& trial, double floors) { return trial.left <= floors * trial.floor; }

/// Errors that a hypothesis must reduce, rad.
struct Stakes {
  double declared = 0;    ///< held-out rms of the file as it is
  double by_effects = 0;  ///< held-out rms of the effects found in it
  bool explained = false;
};

/// If nothing could be tested, any error is an improvement.
Stakes stakes_of(const Calibration& found) {
  constexpr double nothing = std::numeric_limits<double>::infinity();
  if (found.verdict == CalibrationVerdict::not_testable) return {nothing, nothing};
  return {found.before.held_out_rms, found.after.held_out_rms, is_explained(found)};
}

/// True if the corrected file alone explains data that several large effects explain equally well.
bool is_simpler(const Trial& trial, const Stakes& stakes) {
  return is_within(trial, k_thresholds.slip_alone) && stakes.declared > k_thresholds.slip_large * trial.floor;
}

/// True if the corrected file is so much nearer to the data that another cause beside the error may stay unexplained.
bool is_clear(const Trial& trial, const Stakes& stakes) {
  return std::isfinite(stakes.by_effects) ? trial.left * k_thresholds.slip_clear < stakes.by_effects
                                          : is_within(trial, k_thresholds.slip_large);
}

/// True if the corrected file explains the data, alone or with effects, by the rules of every calibration.
bool explains(Trial& trial, const Measurement& read, const Stakes& stakes) {
  UndoneSlip& slip = trial.suspect.slip;
  slip.rms = trial.left;
  if (is_simpler(trial, stakes)) return true;
  if (stakes.explained || k_thresholds.slip_gain * trial.left > stakes.by_effects) return false;
  if (slip.pulley_as_declared || !is_within(trial, k_thresholds.slip_large)) return is_clear(trial, stakes);
  const Calibration found = calibrate(trial.suspect.joint, as_meant(read, trial.suspect));
  if (!is_explained(found)) return is_clear(trial, stakes);
  for (const FoundEffect& effect : found.effects) slip.beside.push_back(effect.name);
  slip.rms = found.after.held_out_rms;
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
bool can_have_slips(const DeclaredMechanism& declared, const Measurement& as_read) {
  return as_read.not_testable.empty() && declared.identified == Imperfections{};
}

}  // namespace

bool is_plainly_a_slip(const DeclaredMechanism& declared, const Measurement& as_read) {
  if (!can_have_slips(declared, as_read)) return false;
  const Measurement data = with_fewer_rows(as_read, k_rows_a_slip);
  const double floor = std::max(noise_floor(as_read).rms, 1e-9);
  const Trial as_it_stands = tried({{}, declared, declared}, data, floor);
  if (!std::isfinite(as_it_stands.left) || is_within(as_it_stands, k_thresholds.slip_large)) return false;
  const std::vector<Trial> all = trials(declared, data, floor);
  if (all.empty()) return false;
  const Stakes stakes{as_it_stands.left, as_it_stands.left, false};
  // A fault of any known size may be present beside the error.
  return is_simpler(all.front(), stakes) ||
         (is_within(all.front(), k_thresholds.slip_large) && is_clear(all.front(), stakes));
}

std::vector<UndoneSlip> slips_that_explain(const DeclaredMechanism& declared, const Measurement& as_read,
                                           const Calibration& found) {
  if (!can_have_slips(declared, as_read) || found.verdict == CalibrationVerdict::not_repeatable ||
      found.verdict == CalibrationVerdict::no_effect)
    return {};
  const Stakes stakes = stakes_of(found);
  const double floor = std::max(noise_floor(as_read).rms, 1e-9);
  const Measurement data = with_fewer_rows(as_read, k_rows_a_slip);
  std::vector<UndoneSlip> slips;
  double best = 0;  // held-out rms of the best
  for (Trial& trial : trials(declared, data, floor)) {
    const bool ties = slips.empty() || trial.left <= k_thresholds.slip_tie * best;
    if (!ties || !explains(trial, data, stakes)) break;
    if (slips.empty()) best = trial.left;
    slips.push_back(trial.suspect.slip);
  }
  return slips;
}

std::string slip_words(const UndoneSlip& slip) {
  const bool of_file = slip.key.find('.') != std::string::npos;
  const std::string meant =
      of_file ? slip.key + " = " + numbers_text(slip.would_be) + " in place of " + numbers_text(slip.declared)
              : "the logged " + slip.key + " times " + numbers_text(slip.would_be);
  return meant + (slip.pulley_as_declared ? ", with the pulley that was made from this file," : "") +
         " would explain the data to " + rounded(degrees(slip.rms), 2) + "°" + beside_text(slip.beside) + ": " +
         slip.question;
}

}  // namespace fusee
