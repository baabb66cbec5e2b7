#include "calibration/verdict.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text.h"
#include "calibration/statistics.h"
#include "calibration/unmodelled_alternatives.h"
#include "measurement/value_range.h"

namespace fusee::calibration {
namespace {

constexpr int k_bins = 12;

std::string in_degrees(double angle) { return rounded(degrees(angle), 3) + "°"; }

struct Mean {
  double sum = 0;
  double count = 0;
  double value() const { return count > 0 ? sum / count : 0; }
};

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Means of a residual by place and direction, over all runs.
class Places {
 public:
  explicit Places(const measurement::Measurement& measurement)
      : alpha_(alphas(measurement)),
        bins_{measurement::value_range(measurement, &measurement::Sample::alpha), k_bins} {}

  void add(std::size_t row, int direction, double residual) {
    Mean& mean = means_[{bins_.bin(alpha_[static_cast<Eigen::Index>(row)]), direction}];
    mean.sum += residual;
    mean.count += 1;
  }

  /// Place of the largest mean, in words; "" without a row.
  std::string largest() const {
    const auto found = std::max_element(means_.begin(), means_.end(), [](const auto& a, const auto& b) {
      return std::abs(a.second.value()) < std::abs(b.second.value());
    });
    if (found == means_.end()) return "";
    const auto& [place, mean] = *found;
    const double from = bins_.edge(place.first);
    return "largest at alpha " + rounded(degrees(from), 3) + " … " +
           rounded(degrees(from + bins_.span.size() / k_bins), 3) + "°, " + (place.second > 0 ? "rising" : "falling") +
           ": " + in_degrees(mean.value()) + " on average";
  }

 private:
  Eigen::VectorXd alpha_;  ///< α of every row
  measurement::Bins bins_;
  std::map<std::pair<int, int>, Mean> means_;  ///< means by place and direction
};

std::string group_words(const FoundEffect& effect) {
  const bool may_be_unmodelled = effect.group.back() == k_unmodelled;
  const std::vector<std::string> names(effect.group.begin(), effect.group.end() - (may_be_unmodelled ? 1 : 0));
  return (names.size() > 1 ? "one of {" + list(names) + "}" : effect.name) +
         (may_be_unmodelled ? " or an unmodelled cause with the same effect" : "");
}

std::string effects_words(const std::vector<FoundEffect>& effects) {
  std::vector<std::string> names;
  for (const FoundEffect& effect : effects) names.push_back(group_words(effect));
  return list(names);
}

/// True if an effect beside the found set is reported.
bool any_beside(const std::vector<FoundEffect>& effects) {
  return std::any_of(effects.begin(), effects.end(), [](const FoundEffect& effect) { return !effect.beside.empty(); });
}

CalibrationVerdict verdict_of(bool walks, bool above_floor, const std::vector<FoundEffect>& effects) {
  const auto is_group = [](const FoundEffect& effect) { return effect.group.size() > 1; };
  if (walks) return CalibrationVerdict::not_repeatable;
  if (above_floor) return CalibrationVerdict::unexplained;
  if (effects.empty()) return CalibrationVerdict::no_effect;
  return std::any_of(effects.begin(), effects.end(), is_group) ? CalibrationVerdict::confounded
                                                               : CalibrationVerdict::explained;
}

std::string level_words(const measurement::NoiseLevel& level, const std::string& load_unit) {
  std::string words;
  if (!load_unit.empty()) words += "load " + rounded(level.load, 2) + " " + load_unit;
  if (level.speed > 0) words += (words.empty() ? "" : ", ") + rounded(degrees(level.speed), 2) + "°/s";
  return words;
}

bool is_quieter(const measurement::NoiseLevel& one, const measurement::NoiseLevel& other) {
  return one.rms < other.rms;
}

/// Sentence on scatter between repeats that far exceeds a sensor's noise, with its largest place.
std::string scatter_words(const Calibration& calibration, const std::string& load_unit) {
  const measurement::NoiseFloor& noise = calibration.noise;
  std::string words = "The same angle, direction and load give joint angles that differ by " + in_degrees(noise.rms) +
                      " rms from stroke to stroke, " + rounded(noise.rms / noise.within_stroke, 2) +
                      " times the scatter within a stroke";
  if (!noise.levels.empty()) {
    const measurement::NoiseLevel& most = *std::max_element(noise.levels.begin(), noise.levels.end(), is_quieter);
    const std::string level = level_words(most, load_unit);
    words += ", most at alpha " + rounded(degrees(most.largest_at), 3) + "°" + (level.empty() ? "" : ", " + level);
  }
  return words + ": look for something loose, or a sensor that holds its reading, before any correction.";
}

/// Sentence on noise that differs between loads or speeds by more than chance, and by more than half; "" otherwise.
std::string noise_words(const measurement::NoiseFloor& noise, const std::string& load_unit) {
  if (noise.levels.size() < 2) return "";
  const auto [least, most] = std::minmax_element(noise.levels.begin(), noise.levels.end(), is_quieter);
  const double ratio = most->rms / least->rms;
  const bool is_other =
      ratio > 1.5 && ratio * ratio > rarest_ratio(most->degrees_of_freedom, least->degrees_of_freedom);
  if (!is_other || level_words(*least, load_unit) == level_words(*most, load_unit)) return "";
  return "Noise is " + in_degrees(least->rms) + " at " + level_words(*least, load_unit) + " and " +
         in_degrees(most->rms) + " at " + level_words(*most, load_unit) + ".";
}

/// Finding in a sentence that the user can act on.
std::string finding(const Calibration& calibration, const StrokeScatter& scatter, double floor,
                    const std::string& load_unit) {
  const std::string names = effects_words(calibration.effects);
  switch (calibration.verdict) {
    case CalibrationVerdict::not_repeatable:
      if (is_scattering(calibration.noise)) return scatter_words(calibration, load_unit);
      return "The same angle, direction and load give joint angles that differ by " +
             in_degrees(elementary::hypot(scatter.between, scatter.tilts)) +
             " rms from stroke to stroke: look for something loose before any correction.";
    case CalibrationVerdict::unexplained:
      return (names.empty() ? "No effect of the catalogue explains what was measured" : "Found " + names) + "; " +
             (any_beside(calibration.effects) ? "with these alone " : "") +
             in_degrees(elementary::hypot(calibration.unexplained_rms, floor)) + " rms remain, of which noise is " +
             in_degrees(floor) + ": the residual is unexplained, " + calibration.unexplained_where + "." +
             (calibration.discrepancy.empty() ? "" : " It depends on " + calibration.discrepancy.front().factor + ".") +
             (calibration.dropped.empty() ? ""
                                          : " Not reported, since rows that were not fitted are predicted worse with "
                                            "it than as declared: " +
                                                list(calibration.dropped) + ".");
    case CalibrationVerdict::confounded:
      return (calibration.next.empty() ? "" : "Measure this first: " + calibration.next.front().text() + ". ") +
             "The data are explained by " + names + ", but do not decide between the alternatives.";
    case CalibrationVerdict::explained:
      return "The data are explained by " + names + ".";
    case CalibrationVerdict::no_effect:
      return "The joint does what its file declares, as far as the data show.";
    case CalibrationVerdict::not_testable:
      break;  // decided before any fit
  }
  return "";
}

std::string left_out_words(std::size_t rows) {
  if (rows == 0) return "";
  return (rows == 1 ? " One row is" : " " + std::to_string(rows) + " rows are") +
         std::string(" far from the neighbouring rows: no fit and no figure contains ") + (rows == 1 ? "it." : "them.");
}

std::string figures(const Calibration& calibration, double floor) {
  return "Held-out error " + in_degrees(calibration.before.held_out_rms) + " before, " +
         in_degrees(calibration.after.held_out_rms) + " after, noise floor " + in_degrees(floor) + "." +
         left_out_words(calibration.rows_left_out);
}

}  // namespace

ResidualStructure describe_residual(const Evidence& evidence, const Fit& fit) {
  ResidualStructure structure;
  structure.autocorrelation = lag_one_correlation(evidence, fit.residual(evidence.rows()));
  Places places(evidence.measurement);
  for (const Block& block : evidence.blocks) {
    const int direction = evidence.measurement.runs[block.run].strokes[block.stroke].direction;
    for (const std::size_t row : block.rows) {
      const double residual = fit.residual[static_cast<Eigen::Index>(row)];
      places.add(row, direction, residual);
    }
  }
  structure.where = places.largest();
  return structure;
}

void conclude(const Evidence& evidence, const Selection& selection, const ValidatedAnswer& answer,
              Calibration& calibration) {
  const ResidualStructure structure = describe_residual(evidence, answer.reported.estimate.fit);
  const StrokeScatter scatter = stroke_scatter(evidence, selection.best);
  const bool unexplained = is_unexplained(answer.unmodelled, evidence.floor);
  calibration.residual_autocorrelation = structure.autocorrelation;
  if (unexplained) {
    calibration.unexplained_rms = answer.residual.rms;
    calibration.unexplained_where = structure.where;
    calibration.discrepancy = answer.residual.parts;
  }
  const bool walks = is_walking(scatter) || is_scattering(calibration.noise);
  const std::string& load_unit = evidence.measurement.load_unit;
  calibration.noise_varies = noise_words(calibration.noise, load_unit);
  add_unmodelled(unexplained || walks, selection, calibration.effects);
  calibration.verdict = verdict_of(walks, unexplained, calibration.effects);
}

void summarize(const Evidence& evidence, const Selection& selection, Calibration& calibration) {
  const StrokeScatter scatter = stroke_scatter(evidence, selection.best);
  calibration.summary = finding(calibration, scatter, evidence.floor, evidence.measurement.load_unit) + " " +
                        figures(calibration, evidence.floor);
}

}  // namespace fusee::calibration
