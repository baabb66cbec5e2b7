// The first lines of a calibration: what the joint does wrong, why, and what to do now.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "calibration/words.h"
#include "export/report/calibration_words.h"
#include "export/report/svg.h"
#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::formats {
namespace {

constexpr std::size_t k_most_candidates = 3;

std::string angle_words(double angle) { return readable_rounded(std::abs(degrees(angle)), 2) + "°"; }

// ---- the problem ----------------------------------------------------------------------------------------------------

/// Linear regression of the error on one predictor, over all rows. `rows`: their number.
struct Regression {
  double sum = 0;        ///< of the predictor
  double sum_error = 0;  ///< of the error
  double squares = 0;    ///< sum of the predictor's squares
  double products = 0;   ///< sum of predictor times error
  double largest = 0;    ///< largest magnitude of the predictor

  void add(double value, double error) {
    sum += value;
    sum_error += error;
    squares += value * value;
    products += value * error;
    largest = std::max(largest, std::abs(value));
  }
  /// Sum of squared deviations of the predictor from its mean.
  double spread(double rows) const { return squares - sum * sum / rows; }
  double slope(double rows) const {
    const double spread = this->spread(rows);
    return spread > 0 ? (products - sum * sum_error / rows) / spread : 0.0;
  }
  /// Coefficient of an error that is proportional to the predictor.
  double proportion() const { return squares > 0 ? products / squares : 0.0; }
  /// Part of the sum of squares that the proportion explains.
  double explained_by_proportion() const { return proportion() * products; }
  /// Part of the sum of squares that the regression explains.
  double explained(double rows) const { return slope(rows) * slope(rows) * std::max(0.0, spread(rows)); }
};

/// Regressions of the error on the joint's angle, the direction and the load.
struct ErrorRegressions {
  Regression angle, direction, load;
  double rows = 0;     ///< number of rows
  double error = 0;    ///< sum of the error over the rows, rad
  double squares = 0;  ///< sum of the error's squares, rad²
};

ErrorRegressions error_regressions(const measurement::Measurement& measurement,
                                   const std::vector<std::vector<double>>& residuals) {
  ErrorRegressions all;
  for (std::size_t r = 0; r < std::min(measurement.runs.size(), residuals.size()); ++r) {
    const measurement::Run& run = measurement.runs[r];
    for (const measurement::Stroke& stroke : run.strokes) {
      for (std::size_t i = stroke.first; !stroke.partial && i <= stroke.last; ++i) {
        const double error = residuals[r][i];
        if (!std::isfinite(error)) continue;
        all.rows += 1;
        all.error += error;
        all.squares += error * error;
        const double predicted = run.samples[i].theta - error;
        all.angle.add(predicted, error);
        all.direction.add(stroke.direction, error);
        all.load.add(run.has_load ? run.samples[i].load : 0.0, error);
      }
    }
  }
  return all;
}

std::string gain_text(double slope) {
  return "The joint turns " + readable_rounded(std::abs(100 * slope), 2) + " % too " + (slope < 0 ? "little" : "far");
}

/// The mean, or the regression, that explains more than half of the squared error. If none does: the largest error.
std::string problem_words(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  const ErrorRegressions all = error_regressions(product.measurement, calibration.residuals_before);
  if (!(all.rows > 0) || calibration.verdict == calibration::CalibrationVerdict::no_effect)
    return "The joint does what its file declares, within " + angle_words(calibration.before.rms) + " rms.";
  const double mean = all.error / all.rows;
  const double slope = all.angle.slope(all.rows);
  const double explained_by_mean = all.rows * mean * mean;
  // If the mean explains at least this share of the squared error, the error is nearly the same at every angle.
  constexpr double k_everywhere = 0.9;
  const std::string where = explained_by_mean > k_everywhere * all.squares ? " everywhere" : " on average";
  // Explained sum of squares, and the sentence.
  const std::array<std::pair<double, std::string>, 5> explanations = {{
      {explained_by_mean, "The joint reads " + angle_words(mean) + (mean > 0 ? " high" : " low") + where},
      {all.angle.explained(all.rows), gain_text(slope)},
      {all.angle.explained_by_proportion(), gain_text(all.angle.proportion())},
      {all.direction.explained(all.rows),
       "The joint angle differs by " + angle_words(2 * all.direction.slope(all.rows)) + " between the two directions"},
      {all.load.explained(all.rows),
       "The joint moves by " + angle_words(all.load.slope(all.rows) * all.load.largest) + " under its largest load"},
  }};
  const auto best = std::max_element(explanations.begin(), explanations.end(),
                                     [](const auto& one, const auto& other) { return one.first < other.first; });
  const bool is_clear = best->first > 0.5 * all.squares;
  return (is_clear ? best->second : "The joint is wrong by up to " + angle_words(calibration.before.max)) + ": " +
         angle_words(calibration.before.held_out_rms) + " rms, " + angle_words(calibration.after.held_out_rms) +
         (calibration.curve.used ? " with the identified causes and an empirical curve."
                                 : " with the identified causes.");
}

// ---- why ------------------------------------------------------------------------------------------------------------

std::string number_words(const calibration::FittedParameter& number, const std::string& load_unit) {
  const auto [name, unit] = name_and_unit(number.name, load_unit);
  return name + " " + readable_rounded(number.value, 3) + unit;
}

/// A cause, and the fitted numbers of each effect that has this cause.
struct CandidateWords {
  std::string cause;
  std::vector<std::string> numbers;
};

/// True if the number is shown as 0.
bool is_shown_as_zero(const calibration::FittedParameter& number) { return readable_rounded(number.value, 3) == "0"; }

/// The numbers of an effect that matter, the largest effect on the joint first: those whose interval excludes zero, two
/// at most. If none does: the first one. None if that is zero.
std::vector<calibration::FittedParameter> leading_numbers(std::vector<calibration::FittedParameter> numbers) {
  constexpr std::size_t k_most_numbers = 2;
  constexpr double k_least_share = 0.1;  // of the largest effect on the joint
  std::stable_sort(numbers.begin(), numbers.end(), [](const auto& one, const auto& other) {
    return std::pair(one.excludes_zero, one.excludes_zero ? one.rms : 0) >
           std::pair(other.excludes_zero, other.excludes_zero ? other.rms : 0);
  });
  std::vector<calibration::FittedParameter> leading;
  for (const calibration::FittedParameter& number : numbers) {
    const bool is_first = leading.empty();
    const bool matters = number.excludes_zero && number.rms >= k_least_share * numbers.front().rms;
    if (!is_shown_as_zero(number) && (is_first || matters) && leading.size() < k_most_numbers)
      leading.push_back(number);
  }
  return leading;
}

/// "both pulleys are too small" and "scale −1.2 %". The cause is the effect's name if the number's sign has
/// no meaning in words.
CandidateWords candidate_words(const std::string& name, const std::vector<calibration::FittedParameter>& numbers,
                               const std::string& load_unit) {
  const std::vector<calibration::FittedParameter> leading = leading_numbers(numbers);
  if (leading.empty()) return {open_words(name), {}};
  std::vector<std::string> words;
  for (const calibration::FittedParameter& number : leading) words.push_back(number_words(number, load_unit));
  return {leading.front().sense.empty() ? open_words(name) : leading.front().sense, {joined(words, ", ")}};
}

bool may_be_unmodelled(const calibration::FoundEffect& effect) {
  return effect.group.back() == calibration::k_unmodelled;
}

/// The other members of an effect's group, in its order.
std::vector<CandidateWords> other_candidates(const calibration::FoundEffect& effect, const std::string& load_unit) {
  std::vector<CandidateWords> others;
  for (const std::string& member : rivals_of(effect)) {
    if (member == calibration::k_unmodelled) continue;
    const auto fitted = std::find_if(effect.alternatives.begin(), effect.alternatives.end(),
                                     [&](const calibration::GroupMember& other) { return other.name == member; });
    others.push_back(fitted == effect.alternatives.end() ? CandidateWords{open_words(member), {}}
                                                         : candidate_words(member, fitted->parameters, load_unit));
  }
  return others;
}

/// "either CAUSE, or CAUSE, or 1 more, or an unmodelled cause": the effect and its group.
std::string group_words(const calibration::FoundEffect& effect, const std::string& load_unit) {
  std::vector<CandidateWords> candidates = {candidate_words(effect.name, effect.parameters, load_unit)};
  std::size_t more = 0;
  for (const CandidateWords& other : other_candidates(effect, load_unit)) {
    const auto same = std::find_if(candidates.begin(), candidates.end(),
                                   [&](const CandidateWords& known) { return known.cause == other.cause; });
    if (same != candidates.end()) {
      same->numbers.insert(same->numbers.end(), other.numbers.begin(), other.numbers.end());
    } else if (candidates.size() < k_most_candidates) {
      candidates.push_back(other);
    } else {
      ++more;
    }
  }
  std::vector<std::string> words;
  for (const CandidateWords& one : candidates)
    words.push_back(one.cause + (one.numbers.empty() ? "" : " (" + joined(one.numbers, " or ") + ")"));
  std::string text = (words.size() > 1 ? "either " : "") + joined(words, ", or ");
  if (more > 0) text += more == 1 ? ", or 1 more" : ", or one of " + std::to_string(more) + " more";
  return text + (may_be_unmodelled(effect) ? ", or an unmodelled cause" : "");
}

const calibration::FoundEffect& largest_effect(const std::vector<calibration::FoundEffect>& effects) {
  return *std::max_element(effects.begin(), effects.end(),
                           [](const calibration::FoundEffect& one, const calibration::FoundEffect& other) {
                             return one.share < other.share;
                           });
}

std::string cause_words(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  if (calibration.effects.empty()) {
    if (calibration.verdict != calibration::CalibrationVerdict::unexplained) return "";
    return std::string("No known cause predicts it") +
           (calibration.discrepancy.empty() ? "." : "; it depends on " + calibration.discrepancy.front().factor + ".");
  }
  const calibration::FoundEffect& first = largest_effect(calibration.effects);
  std::string text = first_upper(group_words(first, product.measurement.load_unit));
  if (calibration.effects.size() > 1)
    text += "; and " + std::to_string(calibration.effects.size() - 1) + " more, below";
  return text + ".";
}

// ---- the action -----------------------------------------------------------------------------------------------------

/// The instruction up to its first colon outside brackets. The page shows all of it in the section "What to do".
std::string first_clause(const std::string& sentence) {
  std::size_t end = 0;
  for (int depth = 0; end < sentence.size(); ++end) {
    depth += sentence[end] == '(' ? 1 : sentence[end] == ')' ? -1 : 0;
    if (depth == 0 && sentence.compare(end, 2, ": ") == 0) break;
  }
  return first_upper(sentence.substr(0, end)) + ".";
}

/// The repair of an effect that is best corrected at its source; "" for others.
std::string repair_words(const calibration::FoundEffect& effect, const std::string& load_unit) {
  constexpr std::array<std::pair<const char*, const char*>, 6> k_repairs = {
      {{"zero_offset", "Re-zero the joint sensor"},
       {"motor_offset", "Re-zero the motor sensor"},
       {"joint_sensor_gain", "Check the joint sensor's scale"},
       {"slack", "Raise the pretension"},
       {"tendon_slip", "Tie the tendon where it slips"},
       {"sensor_lag", "Log both sensors at the same time"}}};
  const auto known =
      std::find_if(k_repairs.begin(), k_repairs.end(), [&](const auto& one) { return effect.name == one.first; });
  if (known == k_repairs.end() || effect.parameters.empty()) return "";
  const calibration::FittedParameter& number = effect.parameters.front();
  if (is_shown_as_zero(number)) return std::string(known->second) + ".";
  if (effect.name != "zero_offset") return std::string(known->second) + ": " + number_words(number, load_unit) + ".";
  return std::string(known->second) + ": it reads " + readable_rounded(std::abs(number.value), 3) + "° " +
         (number.value > 0 ? "high." : "low.");
}

std::string action_words(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  if (!product.input_errors.empty()) return "Check the file first: see below.";
  if (calibration.verdict == calibration::CalibrationVerdict::no_effect) return "Nothing to do.";
  const bool is_explained = calibration.verdict == calibration::CalibrationVerdict::explained;
  if (!is_explained && !calibration.next.empty()) return first_clause(calibration.next.front().words);
  if (!calibration.effects.empty()) {
    const std::string repair = repair_words(largest_effect(calibration.effects), product.measurement.load_unit);
    if (!repair.empty()) return repair;
  }
  if (product.correction.has_pulley) return "Build the corrected pulley from corrected.toml.";
  if (!product.correction.table.empty()) return "Load compensation.csv into the motor's controller.";
  return calibration.next.empty() ? "" : first_clause(calibration.next.front().words);
}

/// Size of a member of a group that was not fitted in the effect's place.
constexpr const char* k_no_size = "not determined";

void add_rows(const std::string& cause, const std::vector<calibration::FittedParameter>& numbers,
              const std::string& load_unit, std::vector<CauseRow>& rows) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const calibration::FittedParameter& number = numbers[i];
    const std::string unit = name_and_unit(number.name, load_unit).unit;
    // A searched number, such as the order of a harmonic, has no interval.
    const bool has_interval = number.low_if_only < number.high_if_only;
    const std::string interval = interval_words(number.low_if_only, number.high_if_only, 3) + unit;
    rows.push_back({i == 0 ? cause : "", number_words(number, load_unit), has_interval ? interval : "–", "", ""});
  }
  if (numbers.empty()) rows.push_back({cause, k_no_size, "–", "", ""});
}

}  // namespace

Headline headline(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  // Whatever else was found assumes that the runs were made and logged as the file says.
  if (!product.input_errors.empty() && !product.input_errors.front().remedy.empty())
    return {first_upper(calibration::input_error_words(product.input_errors.front())) + ".", "",
            "Calibrate again first: the results below assume the file and the log as they are."};
  if (calibration.verdict == calibration::CalibrationVerdict::not_testable)
    return {"These runs decide nothing.", calibration.summary,
            calibration.next.empty() ? "" : first_clause(calibration.next.front().words)};
  if (calibration.verdict == calibration::CalibrationVerdict::not_repeatable)
    return {"The joint does not repeat: the same angle, direction and load give different joint angles.", "",
            calibration.next.empty() ? "" : first_clause(calibration.next.front().words)};
  return {problem_words(product), cause_words(product), action_words(product)};
}

std::vector<CauseRow> cause_rows(const CalibrationProduct& product) {
  const std::string& load_unit = product.measurement.load_unit;
  std::vector<CauseRow> rows;
  for (const calibration::FoundEffect& effect : product.calibration.effects) {
    const std::size_t first = rows.size();
    add_rows(open_words(effect.name), effect.parameters, load_unit, rows);
    rows[first].share = share_words(effect.share);
    rows[first].corrected_by =
        effect.correctable_by == CorrectableBy::nothing ? "–" : fusee::word(effect.correctable_by);
    for (const std::string& member : rivals_of(effect)) {
      const auto fitted = std::find_if(effect.alternatives.begin(), effect.alternatives.end(),
                                       [&](const calibration::GroupMember& other) { return other.name == member; });
      const std::vector<calibration::FittedParameter> none;
      add_rows("or " + (member == calibration::k_unmodelled ? "an unmodelled cause" : open_words(member)),
               fitted == effect.alternatives.end() ? none : fitted->parameters, load_unit, rows);
      if (member == calibration::k_unmodelled) rows.back().size = "–";
    }
  }
  return rows;
}

}  // namespace fusee::formats
