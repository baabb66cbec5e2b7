#include "measurement/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/text.h"
#include "fusee/base.h"
#include "measurement/row_reader.h"
#include "measurement/strokes.h"

namespace fusee::measurement {
namespace {

/// The scatter of a log cannot be estimated from fewer rows.
constexpr std::size_t k_fewest_rows = 20;

// ---- outliers -------------------------------------------------------------------------------------------------------

/// Median of a value and its two neighbours on either side.
double median_of_five(const std::vector<double>& values, std::size_t i) {
  std::array<double, 5> near{};
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i - 2), 5, near.begin());
  std::nth_element(near.begin(), near.begin() + 2, near.end());
  return near[2];
}

/// Outliers of a run: rows farther from the median of their neighbours than the scatter and the motion from row to row
/// explain.
struct Outliers {
  double limit = 0;  ///< rad
  std::vector<std::size_t> rows;
};

Outliers outliers_in(const std::vector<double>& values) {
  std::vector<double> off(values.size()), steps;
  // At the ends of a log a spike is indistinguishable from a step.
  for (std::size_t i = 2; i + 2 < values.size(); ++i) off[i] = std::abs(values[i] - median_of_five(values, i));
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(std::abs(values[i] - values[i - 1]));
  const auto large_step = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 9 / 10);  // 90th percentile
  std::nth_element(steps.begin(), large_step, steps.end());
  // 12 times the usual distance and 4 times a large step; 0.02° for logs without scatter.
  Outliers outliers{12 * median_of(off) + 4 * *large_step + radians(0.02), {}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (off[i] > outliers.limit) outliers.rows.push_back(i);
  }
  return outliers;
}

/// θ without its linear part in α: this residual hardly changes from row to row.
std::vector<double> residuals_of_line(const std::vector<Sample>& samples) {
  double alpha = 0, theta = 0, products = 0, squares = 0;
  for (const Sample& sample : samples) {
    alpha += sample.alpha / static_cast<double>(samples.size());
    theta += sample.theta / static_cast<double>(samples.size());
  }
  for (const Sample& sample : samples) {
    products += (sample.alpha - alpha) * (sample.theta - theta);
    squares += (sample.alpha - alpha) * (sample.alpha - alpha);
  }
  const double slope = squares > 0 ? products / squares : 0;
  std::vector<double> values;
  for (const Sample& sample : samples) values.push_back(sample.theta - slope * sample.alpha);
  return values;
}

void drop_rows(std::vector<Sample>& samples, const Outliers& outliers, const std::string& name,
               const NoteSink& add_note) {
  if (outliers.rows.empty()) return;
  const std::string words = rows_text(outliers.rows.size()) + " with " + name + " more than " +
                            rounded(degrees(outliers.limit), 2) + " deg off their neighbours: ";
  if (outliers.rows.size() > samples.size() / 50 + 1)
    return add_note(words + "too many to be outliers, kept in the log. A calibration leaves them out");
  std::vector<Sample> kept;
  kept.reserve(samples.size());
  auto next = outliers.rows.begin();
  bool after_break = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    after_break = after_break || samples[i].after_break;
    if (next != outliers.rows.end() && *next == i) {
      ++next;
    } else {
      kept.push_back(samples[i]);
      kept.back().after_break = std::exchange(after_break, false);
    }
  }
  samples = std::move(kept);
  add_note(words + "dropped as outliers");
}

/// Range of the known θ without the outermost 0.5 % at either end, which may be outliers. 0 if no θ is known.
double span_of_theta(const std::vector<Sample>& samples) {
  std::vector<double> thetas;
  for (const Sample& sample : samples) {
    if (!std::isnan(sample.theta)) thetas.push_back(sample.theta);
  }
  if (thetas.empty()) return 0;
  const auto at_rank = [&](std::size_t rank) {
    std::nth_element(thetas.begin(), thetas.begin() + static_cast<std::ptrdiff_t>(rank), thetas.end());
    return thetas[rank];
  };
  return at_rank(thetas.size() - 1 - thetas.size() / 200) - at_rank(thetas.size() / 200);
}

/// Change of θ at each row: from the last known θ before it to the first known θ at or after it. Where θ is missing,
/// the joint may have moved at any row between both. NaN if no θ is known before or after.
std::vector<double> steps_of_theta(const std::vector<Sample>& samples) {
  std::vector<double> steps(samples.size());
  double next = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = samples.size(); i-- > 0;) {
    if (!std::isnan(samples[i].theta)) next = samples[i].theta;
    steps[i] = next;
  }
  double last = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    steps[i] -= last;
    if (!std::isnan(samples[i].theta)) last = samples[i].theta;
  }
  return steps;
}

}  // namespace

void unwrap(std::vector<Sample>& samples, double Sample::*angle, const std::string& name, const NoteSink& add_note) {
  double shift = 0;
  std::size_t wraps = 0;
  double before = samples.front().*angle;
  const bool of_motor = angle == &Sample::alpha;
  const double large_step_of_theta = of_motor ? 0.25 * span_of_theta(samples) : 0;
  const std::vector<double> theta_steps = of_motor ? steps_of_theta(samples) : std::vector<double>();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double here = samples[i].*angle;
    const double jump = here - before;
    before = here;
    const bool joint_moves = of_motor && std::abs(theta_steps[i]) > large_step_of_theta;
    const bool is_about_a_turn = std::abs(std::abs(jump) - k_two_pi) < radians(80.0);
    if (!joint_moves && is_about_a_turn) {
      shift -= jump > 0 ? k_two_pi : -k_two_pi;
      ++wraps;
    }
    samples[i].*angle = here + shift;
  }
  if (wraps > 0)
    add_note(name + " jumps by a turn " + std::to_string(wraps) + (wraps == 1 ? " time" : " times") + ": unwrapped");
}

void drop_outliers(Run& run, const NoteSink& add_note) {
  if (run.samples.size() < k_fewest_rows) return;
  std::vector<double> alphas;
  for (const Sample& sample : run.samples) alphas.push_back(sample.alpha);
  drop_rows(run.samples, outliers_in(alphas), "alpha", add_note);
  drop_rows(run.samples, outliers_in(residuals_of_line(run.samples)), "theta", add_note);
}

bool fill_gaps(std::vector<Sample>& samples, double Sample::*value, const std::string& name, const NoteSink& add_note) {
  const auto known =
      std::find_if(samples.begin(), samples.end(), [&](const Sample& sample) { return !std::isnan(sample.*value); });
  if (known == samples.end()) return false;
  double last = *known.*value;
  std::size_t lost = 0;
  for (Sample& sample : samples) {
    if (std::isnan(sample.*value)) {
      sample.*value = last;
      ++lost;
    }
    last = sample.*value;
  }
  if (lost > 0) add_note(rows_text(lost) + " without a " + name + ": the preceding " + name + " is used");
  return true;
}

// Values on a grid have differences that are multiples of one step. A steady noiseless motion also has equal steps, but
// always the same number of them from row to row; a quantised sensor alternates between one step, none and two.
double quantum_of(const std::vector<Sample>& samples, double Sample::*angle) {
  constexpr std::size_t enough = 20000;   // rows
  constexpr double same = radians(1e-7);  // closer values are equal
  std::vector<double> values;
  for (std::size_t i = 0; i < samples.size() && i < enough; ++i) values.push_back(samples[i].*angle);
  const std::vector<double> in_order = values;
  std::sort(values.begin(), values.end());
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] - values[i - 1] > same) steps.push_back(values[i] - values[i - 1]);
  }
  if (steps.empty()) return 0;
  std::sort(steps.begin(), steps.end());
  // The 5th percentile ignores a few values off the grid. Decimal rounding makes single steps differ slightly: their
  // mean is the quantum.
  const double single = steps[steps.size() / 20];
  double sum = 0, singles = 0;
  for (const double step : steps) {
    if (step < 0.8 * single || step > 1.2 * single) continue;
    sum += step;
    singles += 1;
  }
  const double quantum = sum / singles;
  const auto multiple = [quantum](double distance) { return std::round(distance / quantum); };
  const auto on_grid = [&](double step) {
    return multiple(step) >= 1 && std::abs(step / quantum - multiple(step)) < 0.15;
  };
  if (10 * std::count_if(steps.begin(), steps.end(), on_grid) < 9 * static_cast<std::ptrdiff_t>(steps.size())) return 0;
  std::map<double, std::size_t> rows_by_multiple;
  for (std::size_t i = 1; i < in_order.size(); ++i)
    ++rows_by_multiple[multiple(std::abs(in_order[i] - in_order[i - 1]))];
  // Multiples by which more than 2 % of the rows differ from the preceding row.
  const auto frequent_multiples = std::count_if(rows_by_multiple.begin(), rows_by_multiple.end(),
                                                [&](const auto& entry) { return 50 * entry.second > in_order.size(); });
  return frequent_multiples > 1 ? quantum : 0;
}

}  // namespace fusee::measurement
