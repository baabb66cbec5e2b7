#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/text.h"
#include "calibration/fit.h"
#include "calibration/thresholds.h"
#include "fusee/calibration.h"
#include "fusee/mechanism_file.h"
#include "fusee/transmission.h"
#include "transmission/load.h"
#include "transmission/target_motion.h"

namespace fusee::calibration {
namespace {

/// Readings of both sensors at home, rad.
struct HomeReading {
  double alpha = 0;
  double theta = 0;
  bool is_at_end = false;  ///< both sensors were set to zero at an end of the range
};

/// Corrected input error, before it is compared with data.
struct InputErrorHypothesis {
  LikelyInputError error;   ///< the error, without its rms
  DeclaredMechanism joint;  ///< corrected joint
  DeclaredMechanism drawn;  ///< joint for which its pulley was made
  double alpha = 1;         ///< factor on the logged angles
  double theta = 1;
  HomeReading home = {};  ///< readings at home, subtracted from the logged angles
};

/// Key of the readings of both sensors at home.
constexpr const char* k_at_home = "alpha and theta at home";
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

// ---- conditions of the runs -----------------------------------------------------------------------------------------

bool any_without_load(const measurement::Measurement& data) {
  return std::any_of(data.runs.begin(), data.runs.end(), [](const measurement::Run& run) { return !run.has_load; });
}

/// True if the load defines θ(α): with another load in the file, another pulley would be assumed.
bool is_law_of_load(const DeclaredMechanism& declared) { return declared.pulley.law == Law::torque; }

/// Hypothesis that the joint carried none of the loads `keys` in the runs without a load column. None if the file has
/// no such load. The pulley stays as it was made.
std::optional<InputErrorHypothesis> without_load(const DeclaredMechanism& declared,
                                                 const std::vector<std::string>& keys) {
  InputErrorHypothesis hypothesis{{}, declared, declared};
  transmission::keep_law(hypothesis.joint);
  LikelyInputError& error = hypothesis.error;
  std::string options;
  for (const std::string& name : keys) {
    const NumberKey key = *find_number_key(name);
    if (key.get(declared) == 0) continue;
    error.key += (error.key.empty() ? "" : ", ") + name;
    error.declared.push_back(key.get(declared));
    error.would_be.push_back(0);
    options += (options.empty() ? "--set " : " --set ") + name + "=0";
    key.set(hypothesis.joint, 0);
  }
  if (error.key.empty()) return std::nullopt;
  const std::string column = "log the load as load_N";
  error.question = "did nothing hang on the joint?";
  error.remedy =
      is_law_of_load(declared) ? "If so, " + column + " (0)" : "If so, give " + options + "; otherwise " + column;
  return hypothesis;
}

/// The loads that the runs cannot show: without tip force and torque, and without the weight of the link, too.
std::vector<InputErrorHypothesis> unloaded(const DeclaredMechanism& declared, const measurement::Measurement& data) {
  std::vector<InputErrorHypothesis> all;
  if (declared.transmission || !any_without_load(data)) return all;
  const auto hung = without_load(declared, {"load.tip_force_N", "load.torque_Nmm"});
  const auto any = without_load(declared, {"load.tip_force_N", "load.torque_Nmm", "load.mass_kg"});
  if (hung) all.push_back(*hung);
  if (any && (!hung || any->error.key != hung->error.key)) all.push_back(*any);
  return all;
}

std::string reading_text(double angle) { return rounded(degrees(angle), 4); }

InputErrorHypothesis with_home(const DeclaredMechanism& declared, const HomeReading& home, const std::string& end) {
  InputErrorHypothesis hypothesis{{}, declared, declared};
  hypothesis.home = home;
  LikelyInputError& error = hypothesis.error;
  error.key = k_at_home;
  error.declared = {0, 0};
  error.would_be = {degrees(home.alpha), degrees(home.theta)};
  error.question = end.empty() ? "is that what the sensors read at home?"
                               : "were both zeros set at the " + end + " end of the range?";
  error.remedy = "If so, give --home-reading alpha=" + reading_text(home.alpha) +
                 " --home-reading theta=" + reading_text(home.theta) + ", in the log's units (here degrees)";
  return hypothesis;
}

/// Likely input errors of `declared` and its data, one at a time.
std::vector<InputErrorHypothesis> input_error_hypotheses(const DeclaredMechanism& declared,
                                                         const measurement::Measurement& as_read) {
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
  for (InputErrorHypothesis& hypothesis : unloaded(declared, as_read)) all.push_back(std::move(hypothesis));
  return all;
}

/// Rows of a run: ten times those of a fit.
constexpr std::size_t k_rows = 2000;

measurement::Measurement corrected_data(measurement::Measurement data, const InputErrorHypothesis& hypothesis) {
  for (measurement::Run& run : data.runs) {
    for (measurement::Sample& sample : run.samples) {
      sample.alpha = hypothesis.alpha * (sample.alpha - hypothesis.home.alpha);
      sample.theta = hypothesis.theta * (sample.theta - hypothesis.home.theta);
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

// ---- readings at home -----------------------------------------------------------------------------------------------

/// Error of the law θ(α) for a reading of the motor's sensor at home.
struct LawError {
  double mean = 0;     ///< mean of measured − declared θ: the reading of the joint's sensor at home, rad
  double scatter = 0;  ///< rms about the mean, rad
};

LawError law_error(const transmission::TargetMotion& law, const measurement::Measurement& data, double alpha_at_home) {
  double count = 0, sum = 0, squares = 0;
  for (const measurement::Run& run : data.runs) {
    for (const measurement::Sample& sample : run.samples) {
      const double error = sample.theta - law.theta_extrapolated(sample.alpha - alpha_at_home);
      count += 1;
      sum += error;
      squares += error * error;
    }
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

/// Readings at home by the law alone, the motor's in steps over twice the declared range.
HomeReading home_by_law(const transmission::TargetMotion& law, const measurement::Measurement& data) {
  constexpr int k_steps = 200;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int i = -k_steps; i <= k_steps; ++i) {
    const double alpha = law.alpha_range() * i / k_steps;
    const double scatter = law_error(law, data, alpha).scatter;
    if (scatter < least) best = alpha, least = scatter;
  }
  return {best, law_error(law, data, best).mean};
}

/// One step of Gauss and Newton with the joint's tendons; none if the data do not determine the motor's reading.
std::optional<HomeReading> refined(const DeclaredMechanism& declared, const measurement::Measurement& as_read,
                                   double floor, const HomeReading& home) {
  constexpr double k_step = radians(0.5);            // of α, for the slope
  constexpr double k_most_uncertain = radians(0.3);  // of α at home: where the law is straight, it is free
  const measurement::Measurement data = corrected_data(as_read, with_home(declared, home, ""));
  if (!data.not_testable.empty()) return std::nullopt;
  const Evidence evidence = gather(declared, data, floor);
  if (evidence.rows_used() < 2) return std::nullopt;
  const auto residual = [&](double alpha) {
    joint::BenchLog log = evidence.log;
    for (joint::BenchRun& run : log) {
      for (joint::BenchRow& row : run.rows) row.alpha -= alpha;
    }
    joint::Forward forward(declared, log);
    const Eigen::VectorXd all = evidence.theta - flat(forward(Imperfections{}));
    return Eigen::VectorXd(all(evidence.rows()));
  };
  const Eigen::VectorXd here = residual(0), beyond = residual(k_step);
  const Eigen::VectorXd slope = (beyond - here) / k_step;
  const Eigen::VectorXd curve = slope.array() - slope.mean();
  const double squares = curve.squaredNorm();
  if (!(floor < k_most_uncertain * std::sqrt(squares))) return std::nullopt;
  const double alpha = -curve.dot(here) / squares;
  return HomeReading{home.alpha + alpha, home.theta + here.mean() + alpha * slope.mean()};
}

/// "lower" or "upper" if both readings at home are those of zeros at that end of the range; "" otherwise.
std::string end_of(const DeclaredMechanism& declared, const HomeReading& home) {
  constexpr double k_near = 0.05;  // of the range: a stop is not exactly at the declared end
  const transmission::Transmission law(declared);
  const double low = declared.joint.theta_min, high = declared.joint.theta_max;
  const double near_theta = k_near * (high - low), near_alpha = k_near * std::abs(law.alpha(high) - law.alpha(low));
  const auto is_at = [&](double theta) {
    return std::abs(home.theta + theta) < near_theta && std::abs(home.alpha + law.alpha(theta)) < near_alpha;
  };
  return is_at(low) ? "lower" : is_at(high) ? "upper" : "";
}

/// Hypothesis that neither sensor reads zero at home. None for a joint without a home, and for data that do not
/// determine both readings.
std::optional<InputErrorHypothesis> zeros_elsewhere(const DeclaredMechanism& declared,
                                                    const measurement::Measurement& as_read, double floor) {
  const transmission::TargetMotion law(declared);
  if (declared.transmission || !law.exists() || !law.has_zero() || as_read.runs.empty()) return std::nullopt;
  std::optional<HomeReading> home = home_by_law(law, as_read);
  for (int step = 0; step < 2 && home; ++step) home = refined(declared, as_read, floor, *home);
  if (!home || !std::isfinite(home->alpha) || !std::isfinite(home->theta)) return std::nullopt;
  const std::string end = end_of(declared, *home);
  home->is_at_end = !end.empty();
  return with_home(declared, *home, end);
}

/// True for a pair of readings at home that is at no end of the range.
bool is_free_pair(const Trial& trial) {
  const HomeReading& home = trial.hypothesis.home;
  return !home.is_at_end && (home.alpha != 0 || home.theta != 0);
}

/// Rank of a trial, the lowest first: what a bench often omits comes before a misprint that explains as much, and a
/// fitted pair of readings after it.
double rank_of(const Trial& trial) {
  const double share = k_thresholds.residual_share;
  const bool is_of_bench = !trial.hypothesis.error.remedy.empty();
  return is_free_pair(trial) ? trial.residual / share : is_of_bench ? trial.residual * share : trial.residual;
}

std::vector<Trial> test_hypotheses(const DeclaredMechanism& declared, const measurement::Measurement& as_read,
                                   double floor, bool is_far) {
  std::vector<InputErrorHypothesis> hypotheses = input_error_hypotheses(declared, as_read);
  if (is_far) {
    if (auto zeros = zeros_elsewhere(declared, as_read, floor)) hypotheses.push_back(std::move(*zeros));
  }
  std::vector<Trial> all;
  for (InputErrorHypothesis& hypothesis : hypotheses)
    all.push_back(test_hypothesis(std::move(hypothesis), as_read, floor));
  std::stable_sort(all.begin(), all.end(), [](const Trial& a, const Trial& b) { return rank_of(a) < rank_of(b); });
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

/// True if joint and file differ by nothing but the load, which a log without a load column leaves open: a smaller gain
/// suffices than for a misprint.
bool is_unloaded(const Trial& trial, const Baseline& baseline) {
  return trial.hypothesis.error.key.rfind("load.", 0) == 0 && is_within(trial, k_thresholds.input_error_gain) &&
         baseline.declared > k_thresholds.input_error_gain * trial.residual;
}

/// True if a pair of readings at home may be reported: it leaves noise alone, and no effect explains the data, or it is
/// larger than any offset among the effects.
bool is_eligible(const Trial& trial, const Baseline& baseline) {
  constexpr double k_noise_alone = 1.5;   // floors
  constexpr double k_most_offset = 0.35;  // rad: bound of zero_offset and motor_offset
  if (!is_free_pair(trial)) return true;
  const HomeReading& home = trial.hypothesis.home;
  const bool is_large = std::max(std::abs(home.alpha), std::abs(home.theta)) > k_most_offset;
  return is_within(trial, k_noise_alone) && (is_large || !baseline.is_explained);
}

/// True if the corrected file explains the data, alone or with effects, by the rules of every calibration.
bool explains(Trial& trial, const measurement::Measurement& as_read, const Baseline& baseline) {
  LikelyInputError& error = trial.hypothesis.error;
  error.rms = trial.residual;
  if (is_simpler(trial, baseline) || is_unloaded(trial, baseline)) return true;
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
  // Offsets of any size that effects have may be effects.
  const Baseline baseline{as_it_stands.residual, as_it_stands.residual, true};
  std::vector<Trial> all = test_hypotheses(declared, data, floor, true);
  std::erase_if(all, [&](const Trial& trial) { return !is_eligible(trial, baseline); });
  if (all.empty()) return false;
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
  const bool is_far = baseline.declared > k_thresholds.input_error_large * floor;
  std::vector<LikelyInputError> errors;
  double best = 0;  // held-out rms of the best
  for (Trial& trial : test_hypotheses(declared, data, floor, is_far)) {
    if (!is_eligible(trial, baseline)) continue;
    // Beside a likely condition of the bench no misprint is worth a mention.
    if (!errors.empty() && errors.front().remedy.empty() != trial.hypothesis.error.remedy.empty()) continue;
    const bool ties = errors.empty() || trial.residual <= best / k_thresholds.residual_share;
    if (!ties || !explains(trial, data, baseline)) break;
    if (errors.empty()) best = trial.residual;
    errors.push_back(trial.hypothesis.error);
  }
  return errors;
}

std::string input_error_words(const LikelyInputError& error) {
  const std::string explains = " would explain the data to " + rounded(degrees(error.rms), 2) + "°" +
                               beside_text(error.beside) + ": " + error.question;
  if (error.key == k_at_home)
    return "readings of alpha = " + rounded(error.would_be[0], 4) + "° and theta = " + rounded(error.would_be[1], 4) +
           "° at home in place of 0" + explains + " " + error.remedy;
  if (!error.remedy.empty())
    return "no load in the runs without a load column, in place of " + error.key + " = " +
           numbers_text(error.declared) + "," + explains + " " + error.remedy;
  const bool of_file = error.key.find('.') != std::string::npos;
  const std::string meant =
      of_file ? error.key + " = " + numbers_text(error.would_be) + " in place of " + numbers_text(error.declared)
              : "the logged " + error.key + " times " + numbers_text(error.would_be);
  return meant + (error.pulley_as_declared ? ", with the pulley that was made from this file," : "") + explains;
}

}  // namespace fusee::calibration
