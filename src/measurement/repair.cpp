#include "measurement/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "fusee/base/text.h"
#include "fusee/base/units.h"
#include "measurement/row_reader.h"
#include "measurement/strokes.h"

namespace fusee {
namespace {

constexpr double k_no_time = std::numeric_limits<double>::quiet_NaN();
/// With fewer rows there is no telling what is usual.
constexpr std::size_t k_fewest_rows = 20;

// ---- time -----------------------------------------------------------------------------------------------------------

void drop_time(Run& run) {
  run.has_time = false;
  for (Sample& sample : run.samples) sample.time = k_no_time;
}

/// Between the rows that have one; false when more than one in ten has none, or an end.
bool fill_time(std::vector<Sample>& samples, const Say& say) {
  const auto is_lost = [](const Sample& sample) { return std::isnan(sample.time); };
  const auto lost = static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), is_lost));
  if (lost == 0) return true;
  if (10 * lost > samples.size() || is_lost(samples.front()) || is_lost(samples.back())) {
    say(rows_text(lost) + " without a time: time is not used");
    return false;
  }
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (!is_lost(samples[i])) continue;
    std::size_t next = i;
    while (is_lost(samples[next])) ++next;
    samples[i].time =
        samples[i - 1].time + (samples[next].time - samples[i - 1].time) / static_cast<double>(next - i + 1);
  }
  say(rows_text(lost) + " without a time: it was taken from the rows beside");
  return true;
}

void join_restarts(std::vector<Sample>& samples, const Say& say) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) steps.push_back(std::abs(samples[i].time - samples[i - 1].time));
  const double usual = median_of(steps);
  const double first = samples.front().time;
  std::size_t back = 0, restarts = 0;
  double shift = 0, last = first;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double here = samples[i].time;
    if (here < last) {
      const bool restart = std::abs(here - first) < 2 * usual && last - here > 10 * usual;
      if (restart) shift += last - here + usual;
      ++(restart ? restarts : back);
    }
    last = here;
    samples[i].time = here + shift;
  }
  if (restarts > 0)
    say("the clock starts again " + std::to_string(restarts) + (restarts == 1 ? " time" : " times") +
        ": taken as one motion");
  if (back == 0) return;
  std::stable_sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.time < b.time; });
  say("time goes back " + std::to_string(back) + (back == 1 ? " time" : " times") + ": rows were put in order");
}

Sample mean_of(const std::vector<Sample>& samples, std::size_t first, std::size_t end) {
  Sample mean = samples[first];
  for (double Sample::*value :
       {&Sample::alpha, &Sample::theta, &Sample::load, &Sample::temperature, &Sample::tension1, &Sample::tension2}) {
    double sum = 0;
    for (std::size_t i = first; i < end; ++i) sum += samples[i].*value / static_cast<double>(end - first);
    mean.*value = sum;
  }
  return mean;
}

/// Rows of one time: one row logged more than once, or a clock that ticks more slowly than the log is written.
void part_ticks(Run& run, const Say& say) {
  std::vector<Sample>& samples = run.samples;
  std::vector<std::size_t> ticks;  // the first row of each
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i == 0 || samples[i].time != samples[i - 1].time) ticks.push_back(i);
  }
  const std::size_t same = samples.size() - ticks.size();
  if (same == 0) return;
  if (ticks.size() == 1) {
    say("the clock stands still: time is not used");
    return drop_time(run);
  }
  const bool coarse = samples.size() >= 3 * ticks.size();
  const std::vector<Sample> rows = std::move(samples);
  samples.clear();
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const std::size_t first = ticks[k], end = k + 1 < ticks.size() ? ticks[k + 1] : rows.size();
    if (!coarse) {
      samples.push_back(mean_of(rows, first, end));
      continue;
    }
    const double tick =
        k + 1 < ticks.size() ? rows[end].time - rows[first].time : rows[first].time - rows[ticks[k - 1]].time;
    for (std::size_t i = first; i < end; ++i) {
      samples.push_back(rows[i]);
      samples.back().time += tick * static_cast<double>(i - first) / static_cast<double>(end - first);
    }
  }
  say(rows_text(same) + " with the time of the row before: " +
      (coarse ? "the clock is coarser than the log, they were spread over its ticks" : "taken together, their mean"));
}

// ---- outliers -------------------------------------------------------------------------------------------------------

double middle_of_five(const std::vector<double>& values, std::size_t i) {
  std::array<double, 5> near{};
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i - 2), 5, near.begin());
  std::nth_element(near.begin(), near.begin() + 2, near.end());
  return near[2];
}

/// How far a row may lie off the middle of its neighbours: by the scatter there is, and by as far as the values go from
/// row to row.
struct Wild {
  double limit = 0;
  std::vector<std::size_t> rows;
};

Wild wild_rows(const std::vector<double>& values) {
  std::vector<double> off(values.size()), steps;
  // At its ends a log cannot tell a wild row from a step.
  for (std::size_t i = 2; i + 2 < values.size(); ++i) off[i] = std::abs(values[i] - middle_of_five(values, i));
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(std::abs(values[i] - values[i - 1]));
  const auto ninth = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 9 / 10);
  std::nth_element(steps.begin(), ninth, steps.end());
  Wild wild{12 * median_of(off) + 4 * *ninth + radians(0.02), {}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (off[i] > wild.limit) wild.rows.push_back(i);
  }
  return wild;
}

/// θ without the part that goes with α: what is left hardly moves from row to row.
std::vector<double> beside_line(const std::vector<Sample>& samples) {
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

void drop_wild(std::vector<Sample>& samples, const Wild& wild, const std::string& name, const Say& say) {
  if (wild.rows.empty()) return;
  const std::string words = rows_text(wild.rows.size()) + " with " + name + " more than " +
                            rounded(degrees(wild.limit), 2) + " deg off their neighbours: ";
  if (wild.rows.size() > samples.size() / 50 + 1) return say(words + "too many to be outliers, kept");
  std::vector<Sample> kept;
  kept.reserve(samples.size());
  auto next = wild.rows.begin();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (next != wild.rows.end() && *next == i) {
      ++next;
    } else {
      kept.push_back(samples[i]);
    }
  }
  samples = std::move(kept);
  say(words + "dropped as outliers");
}

}  // namespace

void order_time(Run& run, const Say& say) {
  if (!fill_time(run.samples, say)) return drop_time(run);
  join_restarts(run.samples, say);
  part_ticks(run, say);
}

namespace {

/// Without the hundredth that may be wild.
double span_of_theta(const std::vector<Sample>& samples) {
  std::vector<double> thetas;
  for (const Sample& sample : samples) thetas.push_back(sample.theta);
  const auto at = [&](std::size_t place) {
    std::nth_element(thetas.begin(), thetas.begin() + static_cast<std::ptrdiff_t>(place), thetas.end());
    return thetas[place];
  };
  return at(thetas.size() - 1 - thetas.size() / 200) - at(thetas.size() / 200);
}

}  // namespace

void unwrap(std::vector<Sample>& samples, double Sample::*angle, const std::string& name, const Say& say) {
  double shift = 0;
  std::size_t wraps = 0;
  double before = samples.front().*angle;
  const bool of_motor = angle == &Sample::alpha;
  const double far = of_motor ? 0.25 * span_of_theta(samples) : 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double here = samples[i].*angle;
    const double jump = here - before;
    before = here;
    const bool joint_moves = of_motor && std::abs(samples[i].theta - samples[i - 1].theta) > far;
    if (!joint_moves && std::abs(std::abs(jump) - k_two_pi) < radians(80.0)) {
      shift -= jump > 0 ? k_two_pi : -k_two_pi;
      ++wraps;
    }
    samples[i].*angle = here + shift;
  }
  if (wraps > 0)
    say(name + " jumps by a turn " + std::to_string(wraps) + (wraps == 1 ? " time" : " times") + ": unwrapped");
}

void drop_outliers(Run& run, const Say& say) {
  if (run.samples.size() < k_fewest_rows) return;
  std::vector<double> alphas;
  for (const Sample& sample : run.samples) alphas.push_back(sample.alpha);
  drop_wild(run.samples, wild_rows(alphas), "alpha", say);
  drop_wild(run.samples, wild_rows(beside_line(run.samples)), "theta", say);
}

bool fill_gaps(std::vector<Sample>& samples, double Sample::*value, const std::string& name, const Say& say) {
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
  if (lost > 0) say(rows_text(lost) + " without a " + name + ": the " + name + " before was taken");
  return true;
}

// Values on a grid: sorted, their distances are multiples of one step. A joint that moves evenly and is logged without
// noise shows equal steps too, but always the same number of them from row to row; a sensor that rounds shows now one
// step, now none or two.
double quantum_of(const std::vector<Sample>& samples, double Sample::*angle) {
  constexpr std::size_t enough = 20000;
  constexpr double same = radians(1e-7);
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
  // A lone value off the grid does not hide it; rounding to decimals makes single steps differ a little.
  const double least = steps[steps.size() / 20];
  double sum = 0, singles = 0;
  for (const double step : steps) {
    if (step < 0.8 * least || step > 1.2 * least) continue;
    sum += step;
    singles += 1;
  }
  const double quantum = sum / singles;
  const auto multiple = [quantum](double distance) { return std::round(distance / quantum); };
  const auto on_grid = [&](double step) {
    return multiple(step) >= 1 && std::abs(step / quantum - multiple(step)) < 0.15;
  };
  if (10 * std::count_if(steps.begin(), steps.end(), on_grid) < 9 * static_cast<std::ptrdiff_t>(steps.size())) return 0;
  std::map<double, std::size_t> rows;
  for (std::size_t i = 1; i < in_order.size(); ++i) ++rows[multiple(std::abs(in_order[i] - in_order[i - 1]))];
  const auto often =
      std::count_if(rows.begin(), rows.end(), [&](const auto& entry) { return 50 * entry.second > in_order.size(); });
  return often > 1 ? quantum : 0;
}

}  // namespace fusee
