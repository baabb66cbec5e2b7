#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/measurement.h"
#include "fusee/transmission.h"
#include "measurement/strokes.h"
#include "transmission/load.h"
#include "transmission/target_motion.h"

namespace fusee::measurement {
namespace {

/// Evenly spaced rows, 500 at most: enough to compare a long run with the declared joint.
std::vector<Sample> thinned(const Run& run) {
  constexpr std::size_t most_rows = 500;
  std::vector<Sample> samples;
  const std::size_t every = run.samples.size() / most_rows + 1;
  for (std::size_t i = 0; i < run.samples.size(); i += every) samples.push_back(run.samples[i]);
  return samples;
}

// ---- whole turns ----------------------------------------------------------------------------------------------------

/// Median of measured minus declared θ, with `alpha_shift` added to the measured α; rad.
double offset_from_declared(const std::vector<Sample>& samples, const transmission::TargetMotion& law,
                            double alpha_shift) {
  std::vector<double> values;
  for (const Sample& sample : samples)
    values.push_back(sample.theta - law.theta_extrapolated(sample.alpha + alpha_shift));
  return median_of(std::move(values));
}

/// Whole turns to add to the angles of a run, rad.
struct TurnOffset {
  double alpha = 0;
  double theta = 0;
  double remaining = 0;  ///< offset of θ from the expected one, with these turns added
};

/// The smallest number of whole turns that removes the offset of a run from the declared motion, up to the `expected`
/// offset, rad.
TurnOffset best_turns(const std::vector<Sample>& samples, const transmission::TargetMotion& law, double expected) {
  constexpr int most = 3;  // turns of each angle
  TurnOffset best{0, 0, offset_from_declared(samples, law, 0) - expected};
  const double before = std::abs(best.remaining);
  std::vector<double> alphas;
  for (const Sample& sample : samples) alphas.push_back(sample.alpha);
  const double middle = median_of(std::move(alphas));
  int fewest = 0;  // turns of the best so far; 0: none is accepted yet
  for (int alpha_turns = -most; alpha_turns <= most; ++alpha_turns) {
    if (!law.reaches(middle + alpha_turns * k_two_pi)) continue;
    const double offset = offset_from_declared(samples, law, alpha_turns * k_two_pi) - expected;
    const int theta_turns = std::clamp(static_cast<int>(-std::round(offset / k_two_pi)), -most, most);
    const double remaining = std::abs(offset + theta_turns * k_two_pi);
    const int turns = std::abs(alpha_turns) + std::abs(theta_turns);
    // Turns are accepted only if they nearly remove a large offset: a wrong zero is another fault.
    if (remaining > 0.25 * before || before < radians(45.0)) continue;
    const bool is_worse = turns > fewest || (turns == fewest && remaining >= std::abs(best.remaining));
    if (fewest > 0 && is_worse) continue;
    fewest = turns;
    best = {alpha_turns * k_two_pi, theta_turns * k_two_pi, offset + theta_turns * k_two_pi};
  }
  return best;
}

/// Removes offsets of whole turns, as of a single-turn encoder that had wrapped before the log began. A joint declared
/// without a zero takes the offset of its first run as expected.
void remove_whole_turns(const transmission::TargetMotion& law, Measurement& measurement) {
  double expected = 0;
  for (std::size_t i = 0; i < measurement.runs.size(); ++i) {
    Run& run = measurement.runs[i];
    const std::vector<Sample> samples = thinned(run);
    if (i == 0 && !law.has_zero()) {
      expected = offset_from_declared(samples, law, 0);
      continue;
    }
    const TurnOffset turns = best_turns(samples, law, expected);
    if (turns.alpha == 0 && turns.theta == 0) continue;
    for (Sample& sample : run.samples) {
      sample.alpha += turns.alpha;
      sample.theta += turns.theta;
    }
    const auto words = [](const char* name, double turn) {
      return rounded(degrees(turn)) + " deg to " + std::string(name);
    };
    std::string moved = turns.alpha != 0 ? words("alpha", turns.alpha) : "";
    if (turns.theta != 0) moved += (moved.empty() ? "" : " and ") + words("theta", turns.theta);
    measurement.notes.push_back(run.name + ": the log begins whole turns away from " +
                                (law.has_zero() ? "the declared angles" : "the first run") + ": added " + moved);
  }
}

/// Message about an offset of 30° or more, too large for a sensor's zero and for any effect; "" if there is none.
std::string wrong_zero_message(const transmission::TargetMotion& law, const Measurement& measurement) {
  if (!law.has_zero()) return {};
  for (const Run& run : measurement.runs) {
    const double off = offset_from_declared(thinned(run), law, 0);
    if (std::abs(off) < radians(30.0)) continue;
    return run.name + ": theta is " + rounded(degrees(off), 3) +
           " deg away from the declared angle at the same alpha: set both zeros at home (alpha = theta = 0), or give "
           "what the sensors read there, in the log's units: --home-reading alpha=X --home-reading theta=X";
  }
  return {};
}

// ---- slopes ---------------------------------------------------------------------------------------------------------

/// Straight lines fitted to measured and declared θ over the same α.
struct Slopes {
  double measured = 0;    ///< dθ/dα
  double declared = 0;    ///< dθ/dα
  double alpha_span = 0;  ///< of the run that moves farthest, rad
  double scatter = 0;     ///< rms of θ about its line, rad
};

/// True if α is constant and the load alone moves the joint: there is no slope.
bool is_moved_by_load(const Run& run) { return run.strokes.size() == 1 && run.strokes.front().direction == 0; }

/// Least squares over all runs: a common slope, and for each run an intercept of its own.
Slopes slopes_of(const transmission::TargetMotion& law, const Measurement& measurement) {
  double products = 0, declared_products = 0, squares = 0, theta_squares = 0, count = 0;
  Slopes slopes;
  for (const Run& run : measurement.runs) {
    if (is_moved_by_load(run)) continue;
    const std::vector<Sample> samples = thinned(run);
    const double n = static_cast<double>(samples.size());
    double alpha = 0, theta = 0, least = samples.front().alpha, most = least;
    for (const Sample& sample : samples) {
      alpha += sample.alpha / n;
      theta += sample.theta / n;
      least = std::min(least, sample.alpha);
      most = std::max(most, sample.alpha);
    }
    for (const Sample& sample : samples) {
      products += (sample.alpha - alpha) * (sample.theta - theta);
      declared_products += (sample.alpha - alpha) * law.theta_extrapolated(sample.alpha);
      squares += (sample.alpha - alpha) * (sample.alpha - alpha);
      theta_squares += (sample.theta - theta) * (sample.theta - theta);
    }
    count += n;
    slopes.alpha_span = std::max(slopes.alpha_span, most - least);
  }
  if (!(squares > 0)) return slopes;
  slopes.measured = products / squares;
  slopes.declared = declared_products / squares;
  slopes.scatter = std::sqrt(std::max(0.0, theta_squares - products * slopes.measured) / count);
  return slopes;
}

/// True within a factor of 1.5 of `expected`: mistakes of unit or sign are far larger than errors of a joint.
bool is_about(double value, double expected) { return value / expected > 0.67 && value / expected < 1.5; }

std::string slope_text(const Slopes& slopes) {
  return "theta changes by " + rounded(slopes.measured, 3) + " deg per degree of alpha, but " +
         rounded(slopes.declared, 3) + " is declared: ";
}

const char* const k_radians_advice = "; end the column's name in _rad, or give --unit alpha=rad or theta=rad";

/// Message about a slope that cannot be the declared joint's, with its likely cause; "" if the slope agrees.
std::string slope_message(const transmission::TargetMotion& law, const Slopes& slopes) {
  const double ratio = slopes.measured / slopes.declared;
  const double exchanged = 1.0 / (law.slope() * law.slope());  // ratio if α and θ are exchanged
  const double degrees_per_rad = degrees(1.0), range = law.alpha_range();
  // Both angles in radians, read as degrees: the slope agrees, and the range is 57 times too small.
  if (range > 0 && is_about(ratio, 1.0) && slopes.alpha_span < 0.06 * range &&
      slopes.alpha_span * degrees_per_rad > 0.25 * range) {
    return "alpha moves over " + rounded(degrees(slopes.alpha_span), 3) + " deg of the declared " +
           rounded(degrees(range), 4) + ": both angles look like radians" + k_radians_advice;
  }
  // Errors of a joint change its slope by less than a factor of 2.5.
  if (ratio > 0.4 && ratio < 2.5) return {};
  const double expected = std::abs(slopes.declared) * slopes.alpha_span;
  if (expected < 3 * slopes.scatter && std::abs(slopes.measured) * slopes.alpha_span < 3 * slopes.scatter) {
    return "alpha moves over " + rounded(degrees(slopes.alpha_span), 3) + " deg, which should turn the joint by " +
           rounded(degrees(expected), 3) + " deg; theta scatters by " + rounded(degrees(slopes.scatter), 3) +
           " deg rms, which hides that: use a larger range";
  }
  if (is_about(ratio, degrees_per_rad)) return slope_text(slopes) + "alpha looks like radians" + k_radians_advice;
  if (is_about(ratio, 1.0 / degrees_per_rad)) return slope_text(slopes) + "theta looks like radians" + k_radians_advice;
  if (is_about(std::abs(ratio), exchanged) && !is_about(exchanged, 1.0)) {
    return slope_text(slopes) + "alpha and theta look exchanged" + (ratio < 0 ? ", with one sign turned" : "") +
           "; --column alpha=theta_deg --column theta=alpha_deg exchanges them";
  }
  if (ratio < -0.4 && ratio > -2.5) {
    return slope_text(slopes) +
           "one of the two has the opposite sign; alpha > 0 turns the pulley clockwise and increases theta: reverse "
           "the sign of one column";
  }
  return slope_text(slopes) + "this is not the declared joint, or a column has another unit";
}

/// Adds a note if α moves by 6.28° at most: a turn in radians, read as degrees. A joint declared by a ratio has no zero
/// and no range to compare with.
void note_small_range(const transmission::TargetMotion& law, const Slopes& slopes, Measurement& measurement) {
  if (law.has_zero() || slopes.declared == 0 || slopes.alpha_span > radians(k_two_pi)) return;
  measurement.notes.push_back("alpha moves over only " + rounded(degrees(slopes.alpha_span), 3) +
                              " deg in any run: if these are radians, end the columns' names in _rad");
}

void compare_with_law(const Mechanism& declared, Measurement& measurement) {
  if (!measurement.not_testable.empty() || measurement.runs.empty()) return;
  const transmission::TargetMotion law(declared);
  if (!law.exists()) {
    measurement.not_testable.push_back(
        "the declared joint has no law over its range (a dead centre, or C meets a pin): there is nothing to compare "
        "the data with; 'fusee build' shows where");
    return;
  }
  if (!std::isfinite(law.slope()) || law.slope() == 0) return;
  remove_whole_turns(law, measurement);
  const Slopes slopes = slopes_of(law, measurement);
  note_small_range(law, slopes, measurement);
  std::string problem = slopes.declared != 0 ? slope_message(law, slopes) : "";
  if (problem.empty()) problem = wrong_zero_message(law, measurement);
  if (!problem.empty()) measurement.not_testable.push_back(problem);
}

// ---- loads ----------------------------------------------------------------------------------------------------------

/// Names of the runs without a load column, three at most.
std::string runs_without_load(const Measurement& measurement) {
  constexpr std::size_t k_most = 3;
  std::vector<std::string> names;
  for (const Run& run : measurement.runs) {
    if (!run.has_load) names.push_back(run.name);
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), k_most); ++i) text += (i == 0 ? "" : ", ") + names[i];
  return text + (names.size() > k_most ? " and " + std::to_string(names.size() - k_most) + " more" : "");
}

/// Adds a note on the load that is assumed in runs without a load column.
void note_assumed_load(const Mechanism& declared, Measurement& measurement) {
  const std::string runs = runs_without_load(measurement);
  if (declared.transmission || runs.empty()) return;
  std::string load, options;
  const auto add = [&](const std::string& key, double value) {
    if (value == 0) return;
    load += (load.empty() ? "" : ", ") + key + " = " + rounded(value, 4);
    options += (options.empty() ? "--set " : " --set ") + key + "=0";
  };
  add("load.tip_force_N", declared.load.tip_force);
  add("load.torque_Nmm", declared.load.torque);
  if (load.empty()) return;
  // With law = "torque" the load defines the pulley, and must stay in the file.
  const std::string remedy =
      declared.pulley.law == Law::torque
          ? "log the load as load_N (0 if nothing hung on the joint)"
          : "if nothing hung on the joint, give " + options + "; otherwise log the load as load_N";
  measurement.notes.push_back(runs + ": no load column, so the load of the file is assumed, " + load + ": " + remedy);
}

/// Tip force across OC for one unit of the load column, N; 0 if it is not a torque. `length`: OC, mm.
double force_of_unit(const std::string& unit, double length) {
  return unit == "Nm" ? 1000.0 / length : unit == "Nmm" ? 1.0 / length : 0.0;
}

}  // namespace

MeasurementOptions expecting(const Mechanism& declared, MeasurementOptions options) {
  if (!declared.transmission) {
    const Load& load = declared.load;
    options.tip_force = load.tip_force;
    options.load_scale =
        std::abs(load.tip_force) + (std::abs(load.torque) + transmission::weight_moment(load)) / declared.joint.R;
  }
  const transmission::TargetMotion law(declared);
  if (!law.exists() || !std::isfinite(law.slope())) return options;
  options.alpha_span = law.alpha_range();
  options.theta_span = std::abs(law.slope()) * law.alpha_range();
  return options;
}

void take_torques_as_forces(const Mechanism& declared, Measurement& measurement) {
  const double per_unit = declared.transmission ? 0.0 : force_of_unit(measurement.load_unit, declared.joint.R);
  if (per_unit == 0) return;
  for (Run& run : measurement.runs) {
    for (Sample& sample : run.samples) sample.load *= per_unit;
    run.mean_load *= per_unit;
  }
  measurement.notes.push_back("the load column is a torque in " + measurement.load_unit +
                              ": taken as a tip force across OC, positive against +theta");
  measurement.load_unit = "N";
}

void compare_with_declared(const Mechanism& declared, Measurement& measurement) {
  note_assumed_load(declared, measurement);
  compare_with_law(declared, measurement);
  take_torques_as_forces(declared, measurement);
}

}  // namespace fusee::measurement
