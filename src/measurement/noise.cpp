#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fusee/measurement.h"
#include "measurement/strokes.h"
#include "measurement/value_range.h"

// Strokes of equal direction, load and speed are repeats. The scatter of a row is (2θ − θbefore − θafter)/√6, with θ of
// the neighbouring repeats at the same α; a steady drift cancels. Further influences:
//
// - Outliers: the mean square omits values far outside the bulk, unless more than a tenth of all values are so.
//
// - Coloured noise: neighbouring rows are correlated by r, and rows k apart by rᵏ. Degrees of freedom of the variance
// of n rows are n (1 − r²)/(1 + r²).
//
// - Dwells repeat one another if α, its direction, the load and the load's direction agree. Rows are compared at the
// same share of the dwell; differences in α are corrected by the run's slope.
//
// - Runs: the joint may have changed between two runs. If their differences are smooth from row to row and larger than
// the scatter within runs, they are not repeats.
//
// - Quantisation: repeats on the same sensor step hide its error. quantum/√12 of either sensor is a lower bound.

namespace fusee::measurement {
namespace {

/// Differences needed for an estimate; with fewer, differences of neighbouring rows are more accurate.
constexpr std::size_t k_enough = 20;
/// Differences needed if there are too few neighbouring rows as well.
constexpr std::size_t k_few = 6;
/// Median magnitude of a normal distribution, in standard deviations.
constexpr double k_median_magnitude = 0.6745;
/// Largest relative difference of equal speeds.
constexpr double k_same_speed = 0.15;
/// Independent differences in each of many neighbouring third differences of white noise, 1/(1 + 2 Σ ρₖ²): their
/// correlations ρₖ at lags 1, 2 and 3 are −3/4, 3/10 and −1/20.
constexpr double k_worth_of_third_difference = 1 / (1 + 2 * (0.75 * 0.75 + 0.3 * 0.3 + 0.05 * 0.05));

/// Differences of θ, rad, scaled to the standard deviation of one row.
class Scatter {
 public:
  /// Adds a sequence of neighbours. `worth`: number of independent differences in each, below 1 if differences share
  /// rows. `alphas`: α of each, or empty.
  void add(const std::vector<double>& differences, double worth, const std::vector<double>& alphas = {}) {
    for (std::size_t i = 0; i < differences.size(); ++i) {
      values_.push_back(differences[i]);
      follows_.push_back(i > 0);
      worth_ += worth;
    }
    alphas_.insert(alphas_.end(), alphas.begin(), alphas.end());
  }

  std::size_t count() const { return values_.size(); }

  /// Noise of most differences, rad; up to a third of them may be jumps.
  double typical() const {
    std::vector<double> sizes;
    for (const double value : values_) sizes.push_back(std::abs(value));
    return sizes.empty() ? 0.0 : median_of(std::move(sizes)) / k_median_magnitude;
  }

  /// α at which the differences have the largest mean square.
  double alpha_of_largest() const {
    constexpr int k_bins = 12;
    ValueRange span;
    for (const double alpha : alphas_) span.take(alpha);
    if (!span.any() || alphas_.size() != values_.size()) return 0;
    const Bins bins{span, k_bins};
    std::array<double, k_bins> squares{}, counts{};
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const auto bin = static_cast<std::size_t>(bins.bin(alphas_[i]));
      squares[bin] += values_[i] * values_[i];
      counts[bin] += 1;
    }
    int largest = 0;
    double largest_square = -1;
    for (int bin = 0; bin < k_bins; ++bin) {
      const auto k = static_cast<std::size_t>(bin);
      if (!(counts[k] > 0) || !(squares[k] / counts[k] > largest_square)) continue;
      largest_square = squares[k] / counts[k];
      largest = bin;
    }
    return 0.5 * (bins.edge(largest) + bins.edge(largest + 1));
  }

  struct Result {
    double variance = 0;  ///< rad²
    double degrees_of_freedom = 0;
    double colour = 0;  ///< correlation of neighbours, 0 … 0.99
    double pairs = 0;   ///< number of pairs of neighbours from which `colour` is estimated
  };

  /// `least_limit`: differences below it are never outliers, rad.
  Result result(double least_limit) const {
    const double limit = limit_of(least_limit);
    double squares = 0, products = 0, count = 0, pairs = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (std::abs(values_[i]) > limit) continue;
      squares += values_[i] * values_[i];
      count += 1;
      if (!follows_[i] || std::abs(values_[i - 1]) > limit) continue;
      products += values_[i] * values_[i - 1];
      pairs += 1;
    }
    if (count == 0) return {};
    const double variance = squares / count;
    const double r = squares > 0 && pairs > 0 ? std::clamp(products / pairs / variance, 0.0, 0.99) : 0.0;
    const double freedom = worth_ * count / static_cast<double>(values_.size()) * (1 - r * r) / (1 + r * r);
    return {variance, freedom, r, pairs};
  }

 private:
  /// Magnitude beyond which a difference is an outlier. There is none if more than a tenth would be outliers.
  double limit_of(double least_limit) const {
    std::vector<double> sizes;
    for (const double value : values_) sizes.push_back(std::abs(value));
    const double limit = std::max(5.0 * median_of(sizes) / k_median_magnitude, least_limit);
    const auto beyond = std::count_if(sizes.begin(), sizes.end(), [limit](double size) { return size > limit; });
    return 10 * static_cast<std::size_t>(beyond) > sizes.size() ? std::numeric_limits<double>::infinity() : limit;
  }

  std::vector<double> values_;
  std::vector<double> alphas_;
  std::vector<bool> follows_;  ///< true if the preceding value is of the neighbouring row
  double worth_ = 0;           ///< number of independent differences
};

/// θ at α on a stroke.
struct InterpolatedAngle {
  bool inside = false;  ///< false: α is outside of the stroke, or θ cannot be interpolated there
  double theta = 0;
  double load = 0;
  double weight = 1;  ///< sum of the squared weights of the rows: variance of `theta` per variance of a row
};

/// Cubic through the four rows from `first` on (Lagrange). Not inside if two rows are closer in α than `least_gap`,
/// rad, as in a dwell or by quantisation.
InterpolatedAngle on_cubic(const Run& run, std::size_t first, double alpha, double least_gap) {
  const auto at = [&](std::size_t i) -> const Sample& { return run.samples[i]; };
  InterpolatedAngle interpolated{true, 0, 0, 0};
  for (std::size_t j = first; j < first + 4; ++j) {
    double weight = 1;
    for (std::size_t k = first; k < first + 4; ++k) {
      if (k == j) continue;
      const double gap = at(j).alpha - at(k).alpha;
      if (std::abs(gap) < least_gap || gap == 0) return {};
      weight *= (alpha - at(k).alpha) / gap;
    }
    interpolated.theta += weight * at(j).theta;
    interpolated.weight += weight * weight;
  }
  constexpr double k_largest_weight = 3;  // uneven rows amplify their noise
  return interpolated.weight < k_largest_weight ? interpolated : InterpolatedAngle{};
}

/// Line fitted to a small part of a stroke about `row`, for logs so dense that α is constant or jitters from row to
/// row. The part grows until it determines θ at α, but to 1/25 of the stroke's α at most.
InterpolatedAngle on_line(const Run& run, const Segment& stroke, std::size_t row, double alpha) {
  const double longest = std::abs(run.samples[stroke.last].alpha - run.samples[stroke.first].alpha) / 25;
  for (std::size_t half = 4; half <= (stroke.last - stroke.first) / 8; half *= 2) {
    const std::size_t first = row > stroke.first + half ? row - half : stroke.first,
                      last = std::min(stroke.last, row + half);
    const double n = static_cast<double>(last - first + 1);
    double mean_alpha = 0, mean_theta = 0, squares = 0, products = 0;
    for (std::size_t i = first; i <= last; ++i) {
      mean_alpha += run.samples[i].alpha / n;
      mean_theta += run.samples[i].theta / n;
    }
    for (std::size_t i = first; i <= last; ++i) {
      const double off = run.samples[i].alpha - mean_alpha;
      squares += off * off;
      products += off * (run.samples[i].theta - mean_theta);
    }
    if (std::abs(run.samples[last].alpha - run.samples[first].alpha) > longest) return {};
    const double off = alpha - mean_alpha;
    if (!(squares > 0) || off * off > squares) continue;
    return {true, mean_theta + products / squares * off, 0, 1 / n + off * off / squares};
  }
  return {};
}

/// θ of a stroke at α, between its rows. `direction`: sign of dα/dt.
InterpolatedAngle interpolate(const Run& run, const Segment& stroke, double direction, double alpha) {
  const auto at = [&](std::size_t i) -> const Sample& { return run.samples[i]; };
  std::size_t low = stroke.first, high = stroke.last;
  if (high - low < 4 || direction * alpha < direction * at(low).alpha || direction * alpha > direction * at(high).alpha)
    return {};
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (direction * at(middle).alpha <= direction * alpha ? low : high) = middle;
  }
  const std::size_t first = std::clamp(low, stroke.first + 1, stroke.last - 2) - 1;
  InterpolatedAngle interpolated = on_cubic(run, first, alpha, 0.05 * std::abs(at(high).alpha - at(low).alpha));
  if (!interpolated.inside) interpolated = on_line(run, stroke, low, alpha);
  interpolated.load = at(low).load;
  return interpolated;
}

/// True between 3 % and 97 % of the stroke: away from reversals, where play and friction are still being taken up.
bool is_inner(const Run& run, const Segment& stroke, double alpha) {
  const double from = run.samples[stroke.first].alpha, to = run.samples[stroke.last].alpha;
  const double share = (alpha - from) / (to - from);
  return share > 0.03 && share < 0.97;
}

/// A segment, and the conditions in which another one repeats it.
struct Pass {
  const Run* run = nullptr;
  Segment rows;
  int direction = 0;  ///< of α
  double load = 0;    ///< of the middle row, as in Sample
  double alpha = 0;   ///< of the middle row, rad; compared for dwells
  double slope = 0;   ///< mean dθ/dα of the run
};

/// θ of a dwell at `share` of its rows (0 … 1), corrected for the difference in α.
InterpolatedAngle interpolate_in_dwell(const Pass& pass, double share, double alpha) {
  const auto rows = static_cast<double>(pass.rows.last - pass.rows.first);
  const Sample& sample = pass.run->samples[pass.rows.first + static_cast<std::size_t>(std::lround(share * rows))];
  return {true, sample.theta + pass.slope * (alpha - sample.alpha), sample.load, 1};
}

/// Largest difference of two loads that count as equal: a tenth of their range, or four times the load cell's noise.
double load_tolerance(const Measurement& measurement) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::vector<double> second_differences;
  for (const Run& run : measurement.runs) {
    for (std::size_t i = 0; run.has_load && i < run.samples.size(); ++i) {
      least = std::min(least, run.samples[i].load);
      most = std::max(most, run.samples[i].load);
      if (i > 1)
        second_differences.push_back(
            std::abs(run.samples[i].load - 2 * run.samples[i - 1].load + run.samples[i - 2].load));
    }
  }
  constexpr double rounding = 1e-9;  // of equal loads, in the unit of the loads
  return most > least ? std::max(0.1 * (most - least), 4.0 * white_noise_of(std::move(second_differences))) + rounding
                      : 0;
}

bool same_speed(const Run& a, const Run& b) {
  return std::abs(a.speed - b.speed) <= k_same_speed * std::max(a.speed, b.speed);
}

Pass pass_of(const Run& run, const Segment& segment, double slope) {
  const Sample& middle = run.samples[segment.first + (segment.last - segment.first) / 2];
  return {&run, segment, run.strokes[segment.stroke].direction, run.has_load ? middle.load : 0, middle.alpha, slope};
}

/// True for the first of several strokes or dwells: play and bedding-in are not settled. As in evidence.cpp.
bool is_still_settling(const Run& run, const Segment& segment) {
  if (is_from_point_to_point(run)) return segment.first == run.segments.front().first && run.segments.size() > 2;
  return segment.stroke == 0 && run.strokes.size() > 2;
}

/// Mean dθ/dα of a run, from its ends.
double slope_of(const Run& run) {
  const auto [least, most] = std::minmax_element(run.samples.begin(), run.samples.end(),
                                                 [](const Sample& a, const Sample& b) { return a.alpha < b.alpha; });
  return most->alpha > least->alpha ? (most->theta - least->theta) / (most->alpha - least->alpha) : 0;
}

/// Tolerances within which two passes repeat one another.
struct RepeatTolerance {
  double load = 0;
  double alpha = 0;          ///< of dwells, rad: 0.2 % of the range, or three sensor steps
  bool across_runs = false;  ///< passes of two runs may be repeats

  bool are_repeats(const Pass& a, const Pass& b) const {
    const bool are_comparable_runs =
        a.run == b.run || (across_runs && a.run->has_load == b.run->has_load && same_speed(*a.run, *b.run));
    const bool have_same_history =
        a.rows.is_dwell == b.rows.is_dwell && a.rows.pull == b.rows.pull && a.direction == b.direction;
    return are_comparable_runs && have_same_history && std::abs(a.load - b.load) <= load &&
           (!a.rows.is_dwell || std::abs(a.alpha - b.alpha) <= alpha);
  }
};

RepeatTolerance repeat_tolerance(const Measurement& measurement, bool across_runs) {
  const ValueRange alphas = value_range(measurement, &Sample::alpha);
  const double range = alphas.any() ? alphas.size() : 0.0;
  return {load_tolerance(measurement), std::max(2e-3 * range, 3 * measurement.alpha_quantum), across_runs};
}

/// Largest number of dwells that are compared, since each is compared with every group. Of more, only every n-th pair
/// is.
constexpr std::size_t k_max_dwells = 4000;

/// Groups of segments that repeat one another, in order of time.
std::vector<std::vector<Pass>> groups_of_repeats(const Measurement& measurement, const RepeatTolerance& tolerance) {
  std::vector<std::vector<Pass>> groups;
  for (const Run& run : measurement.runs) {
    const std::vector<Segment> segments = segments_of(run);
    const std::size_t every = segments.size() / k_max_dwells + 1;
    const double slope = run.samples.empty() ? 0 : slope_of(run);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const Segment& segment = segments[i];
      const bool is_left_out = segment.is_dwell && i / 2 % every != 0;
      if (run.strokes[segment.stroke].partial || is_still_settling(run, segment) || is_left_out) continue;
      const Pass pass = pass_of(run, segment, slope);
      const auto group = std::find_if(groups.begin(), groups.end(), [&](const std::vector<Pass>& g) {
        return tolerance.are_repeats(g.front(), pass);
      });
      if (group != groups.end()) {
        group->push_back(pass);
      } else {
        groups.push_back({pass});
      }
    }
  }
  return groups;
}

/// Independent differences in each of n neighbouring second differences (−1, 2, −1)/√6, which share strokes: n over the
/// sum of their squared correlations. These are (2/3)² at lag 1 and (1/6)² at lag 2.
double worth_of_second_difference(std::size_t triples) {
  const double n = static_cast<double>(triples);
  return n / (n + 2 * (n - 1) * (4.0 / 9.0) + 2 * std::max(0.0, n - 2) / 36.0);
}

/// Adds the differences of the passes of a group. Second differences of three passes cancel a steady drift; with two
/// passes only first differences exist. Rows whose loads differ by more than `most_load_difference` are not compared.
void add_repeats(const std::vector<Pass>& group, double most_load_difference, Scatter& scatter) {
  if (group.size() < 2) return;
  const bool triples = group.size() > 2;
  const std::size_t count = triples ? group.size() - 2 : 1;
  for (std::size_t k = 1; k <= count; ++k) {
    std::vector<double> differences, alphas;
    const Run& run = *group[k].run;
    const Segment& rows = group[k].rows;
    const auto angle_of = [&](const Pass& pass, std::size_t row) {
      const Sample& sample = run.samples[row];
      const double share =
          static_cast<double>(row - rows.first) / static_cast<double>(std::max<std::size_t>(1, rows.last - rows.first));
      const InterpolatedAngle interpolated = rows.is_dwell
                                                 ? interpolate_in_dwell(pass, share, sample.alpha)
                                                 : interpolate(*pass.run, pass.rows, pass.direction, sample.alpha);
      const bool same_load = !run.has_load || std::abs(interpolated.load - sample.load) <= most_load_difference;
      return same_load ? interpolated : InterpolatedAngle{};
    };
    for (std::size_t i = rows.first; i <= rows.last; ++i) {
      const Sample& sample = run.samples[i];
      if (!rows.is_dwell && !is_inner(run, rows, sample.alpha)) continue;
      const InterpolatedAngle before = angle_of(group[k - 1], i);
      if (!before.inside) continue;
      if (!triples) {
        alphas.push_back(sample.alpha);
        differences.push_back((sample.theta - before.theta) / std::sqrt(1 + before.weight));
        continue;
      }
      const InterpolatedAngle after = angle_of(group[k + 1], i);
      if (!after.inside) continue;
      alphas.push_back(sample.alpha);
      differences.push_back((2 * sample.theta - before.theta - after.theta) /
                            std::sqrt(4 + before.weight + after.weight));
    }
    scatter.add(differences, worth_of_second_difference(count), alphas);
  }
}

/// Third differences of neighbouring rows, for data without repeats. They miss coloured noise. Those of white noise
/// have √20 of its standard deviation.
void add_neighbours(const Run& run, Scatter& scatter) {
  for (const Segment& segment : segments_of(run)) {
    std::vector<double> differences;
    for (std::size_t i = segment.first + 3; i <= segment.last; ++i) {
      const auto& s = run.samples;
      differences.push_back((s[i].theta - 3 * s[i - 1].theta + 3 * s[i - 2].theta - s[i - 3].theta) / std::sqrt(20.0));
    }
    scatter.add(differences, k_worth_of_third_difference);
  }
}

Scatter scatter_of_neighbours(const Measurement& measurement) {
  Scatter scatter;
  for (const Run& run : measurement.runs) add_neighbours(run, scatter);
  return scatter;
}

/// Weights of three rows at these α in the value of their parabola at `alpha` (Lagrange).
std::array<double, 3> parabola_weights(double alpha, const std::array<double, 3>& alphas) {
  std::array<double, 3> weights{1, 1, 1};
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (k != j) weights[j] *= (alpha - alphas[k]) / (alphas[j] - alphas[k]);
    }
  }
  return weights;
}

/// Adds the distance of the second of four successive dwells from the parabola through the others.
void add_distance_from_parabola(const std::array<const Sample*, 4>& rows, std::vector<double>& differences) {
  const std::array<double, 3> weights =
      parabola_weights(rows[1]->alpha, {rows[0]->alpha, rows[2]->alpha, rows[3]->alpha});
  const double squares = 1 + weights[0] * weights[0] + weights[1] * weights[1] + weights[2] * weights[2];
  if (!std::isfinite(squares)) return;
  const double off =
      rows[1]->theta - weights[0] * rows[0]->theta - weights[1] * rows[2]->theta - weights[2] * rows[3]->theta;
  differences.push_back(off / std::sqrt(squares));
}

/// Scatter of dwells of one row each, for data without repeats: their neighbours are the next dwells of the same stroke
/// under the same load.
Scatter scatter_of_dwells(const Measurement& measurement) {
  const double tolerance = load_tolerance(measurement);
  Scatter scatter;
  for (const Run& run : measurement.runs) {
    const std::vector<Segment> dwells = segments_of(run);
    std::vector<double> differences;
    for (std::size_t i = 3; i < dwells.size(); ++i) {
      std::array<const Sample*, 4> rows{};
      bool comparable = true;
      for (std::size_t k = 0; k < 4; ++k) {
        const Segment& dwell = dwells[i - 3 + k];
        rows[k] = &run.samples[dwell.first];
        comparable = comparable && dwell.is_dwell && dwell.stroke == dwells[i].stroke && dwell.pull == dwells[i].pull &&
                     (!run.has_load || std::abs(rows[k]->load - rows[0]->load) <= tolerance);
      }
      if (comparable) add_distance_from_parabola(rows, differences);
    }
    scatter.add(differences, k_worth_of_third_difference);
  }
  return scatter;
}

/// Repeats at one load and speed, of either direction and any run.
struct ScatterAtLevel {
  NoiseLevel level;
  Scatter scatter;
};

std::vector<NoiseLevel> noise_levels(const Measurement& measurement, double least_limit) {
  const RepeatTolerance tolerance = repeat_tolerance(measurement, /*across_runs=*/false);
  std::vector<ScatterAtLevel> all;
  for (const std::vector<Pass>& group : groups_of_repeats(measurement, tolerance)) {
    const double load = group.front().load, speed = group.front().run->speed;
    auto at = std::find_if(all.begin(), all.end(), [&](const ScatterAtLevel& other) {
      const double faster = std::max(speed, other.level.speed);
      return std::abs(other.level.load - load) <= tolerance.load &&
             std::abs(other.level.speed - speed) <= k_same_speed * faster;
    });
    if (at == all.end()) at = all.insert(all.end(), ScatterAtLevel{{load, speed, 0, 0, 0}, {}});
    add_repeats(group, tolerance.load, at->scatter);
  }
  std::vector<NoiseLevel> levels;
  for (const ScatterAtLevel& at : all) {
    if (at.scatter.count() < k_enough) continue;
    const Scatter::Result result = at.scatter.result(least_limit);
    levels.push_back({at.level.load, at.level.speed, std::sqrt(result.variance), result.degrees_of_freedom,
                      at.scatter.alpha_of_largest()});
  }
  return levels;
}

Scatter scatter_within_runs(const Measurement& measurement) {
  const RepeatTolerance tolerance = repeat_tolerance(measurement, /*across_runs=*/false);
  Scatter scatter;
  for (const std::vector<Pass>& group : groups_of_repeats(measurement, tolerance))
    add_repeats(group, tolerance.load, scatter);
  return scatter;
}

/// Share of the variance of coloured noise, with correlation rᵏ at lag k, that third differences show. The
/// autocorrelation of their weights (1, −3, 3, −1) is 20, −15, 6, −1.
double share_seen_by_neighbours(double r) { return 1 + (-15 * r + 6 * r * r - r * r * r) / 10; }

/// True if differences are correlated from row to row and have twice the variance that the neighbours' scatter
/// explains. The noise may be coloured itself: a correlation up to 0.7 is ascribed to it.
bool is_smooth(const Scatter::Result& differences, double variance_of_neighbours) {
  const double noise = variance_of_neighbours / share_seen_by_neighbours(std::min(differences.colour, 0.7));
  // The correlation of n pairs of white noise scatters by 1/√n.
  const bool is_significant = differences.colour * std::sqrt(differences.pairs) > 3.0;
  return differences.colour > 0.3 && is_significant && differences.variance > 2.0 * noise;
}

/// Differences between runs that should repeat one another.
struct BetweenRuns {
  Scatter noise;              ///< used only without smooth differences
  double smooth_squares = 0;  ///< sum of squares of the smooth differences, rad²
  double smooth_count = 0;    ///< number of smooth differences
};

BetweenRuns scatter_between_runs(const Measurement& measurement, double least_limit) {
  const RepeatTolerance tolerance = repeat_tolerance(measurement, /*across_runs=*/true);
  const double neighbours = scatter_of_neighbours(measurement).result(least_limit).variance;
  BetweenRuns found;
  for (const std::vector<Pass>& group : groups_of_repeats(measurement, tolerance)) {
    // Pair by pair: a single change is visible even among many runs that agree.
    for (std::size_t k = 1; k < group.size(); ++k) {
      Scatter pair;
      add_repeats({group[k - 1], group[k]}, tolerance.load, pair);
      const Scatter::Result result = pair.result(least_limit);
      if (is_smooth(result, neighbours)) {
        found.smooth_squares += result.variance * static_cast<double>(pair.count());
        found.smooth_count += static_cast<double>(pair.count());
      }
    }
    if (found.smooth_count == 0) add_repeats(group, tolerance.load, found.noise);
  }
  return found;
}

/// Quantisation error of both sensors as an error of θ, rad: standard deviation quantum/√12 of a uniform distribution.
double quantisation_error(const Measurement& measurement) {
  double slope = 0;
  for (const Run& run : measurement.runs) {
    if (run.samples.empty()) continue;
    const auto span = [&](double Sample::*angle) {
      const auto [least, most] =
          std::minmax_element(run.samples.begin(), run.samples.end(),
                              [&](const Sample& a, const Sample& b) { return a.*angle < b.*angle; });
      return (*most).*angle - (*least).*angle;
    };
    const double alpha = span(&Sample::alpha);
    if (alpha > 0) slope = std::max(slope, span(&Sample::theta) / alpha);
  }
  return elementary::hypot(measurement.theta_quantum, slope * measurement.alpha_quantum) / std::sqrt(12.0);
}

}  // namespace

NoiseFloor noise_floor(const Measurement& measurement) {
  const double least_limit = 3 * measurement.theta_quantum;
  NoiseFloor floor;
  // Repeats within a run are preferred: between runs the joint may have changed.
  Scatter scatter = scatter_within_runs(measurement);
  if (scatter.count() < k_enough) {
    BetweenRuns between = scatter_between_runs(measurement, least_limit);
    // The differences are scaled to one row; the difference of two runs has twice that variance.
    if (between.smooth_count > 0)
      floor.between_runs = std::sqrt(2 * between.smooth_squares / between.smooth_count);
    else
      scatter = std::move(between.noise);
  }
  floor.from_repeats = scatter.count() >= k_enough;
  const Scatter neighbours = scatter_of_neighbours(measurement);
  if (neighbours.count() >= k_enough)
    floor.within_stroke = std::max(neighbours.typical(), quantisation_error(measurement));
  const bool has_neighbours = neighbours.count() >= k_enough;
  if (!floor.from_repeats) {
    floor.from_repeats = !has_neighbours && scatter.count() >= k_few;
    if (!floor.from_repeats) scatter = has_neighbours ? neighbours : scatter_of_dwells(measurement);
  }
  const Scatter::Result result = scatter.result(least_limit);
  floor.rms = std::max(std::sqrt(result.variance), quantisation_error(measurement));
  floor.degrees_of_freedom = result.degrees_of_freedom;
  floor.colour = floor.from_repeats ? result.colour : 0;
  floor.levels = noise_levels(measurement, least_limit);
  return floor;
}

// The mean of n rows with correlation rᵏ at lag k has the variance of a mean of n (1 − r)/(1 + r) independent rows.
double NoiseFloor::effective_rows(double rows, double every) const {
  const double r = elementary::pow(colour, every);
  return rows * (1 - r) / (1 + r);
}

}  // namespace fusee::measurement
