#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fusee/measurement/measurement.h"
#include "measurement/seen_span.h"
#include "measurement/strokes.h"

// Strokes of one direction, load and speed repeat one another. A row's distance from what its neighbours in that
// sequence show at the same α is scatter: (2θ − θbefore − θafter)/√6, which a steady drift leaves alone. What else
// there is:
//
// - Single wild rows: the mean square is taken without what lies far outside the bulk, unless that is a part of it.
//
// - Colour: neighbouring rows say the same thing. Degrees of freedom count what is left, n (1 − r²)/(1 + r²).
//
// - Held points repeat one another where α, the side it came from, the load and the side that came from are alike. Rows
// are compared at the same share of the stand; what α misses the place by is taken out by the run's slope.
//
// - Runs: between two something may have been changed. Where that shows, in differences that are smooth from row to row
// and larger than what scatters within the runs, the runs are no repeats.
//
// - A coarse sensor: repeats that fall on the same step hide the step's own error, quantum/√12 of either sensor: a
// lower bound.

namespace fusee {
namespace {

/// Enough differences, and of repeats so few that they are better than rows at different places.
constexpr std::size_t k_enough = 20;
constexpr std::size_t k_few = 6;

/// Differences scaled to the spread of a single row, in sequences of neighbours.
class Scatter {
 public:
  /// `worth`: independent differences in each, for those of overlapping strokes. `places`: α of each, or none.
  void add(const std::vector<double>& differences, double worth, const std::vector<double>& places = {}) {
    for (std::size_t i = 0; i < differences.size(); ++i) {
      values_.push_back(differences[i]);
      follows_.push_back(i > 0);
      worth_ += worth;
    }
    places_.insert(places_.end(), places.begin(), places.end());
  }

  std::size_t count() const { return values_.size(); }

  /// Noise of most differences, rad: up to a third of them may be jumps.
  double typical() const {
    std::vector<double> sizes;
    for (const double value : values_) sizes.push_back(std::abs(value));
    return sizes.empty() ? 0.0 : median_of(std::move(sizes)) / 0.6745;
  }

  /// α about which the differences, each with its place, have the largest mean square.
  double largest_at() const {
    constexpr int k_places = 12;
    SeenSpan span;
    for (const double place : places_) span.take(place);
    if (!span.any() || places_.size() != values_.size()) return 0;
    const Bins bins{span, k_places};
    std::array<double, k_places> squares{}, counts{};
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const auto bin = static_cast<std::size_t>(bins.bin(places_[i]));
      squares[bin] += values_[i] * values_[i];
      counts[bin] += 1;
    }
    int largest = 0;
    double most = -1;
    for (int bin = 0; bin < k_places; ++bin) {
      const auto k = static_cast<std::size_t>(bin);
      if (counts[k] > 0 && squares[k] / counts[k] > most) most = squares[k] / counts[k], largest = bin;
    }
    return 0.5 * (bins.edge(largest) + bins.edge(largest + 1));
  }

  struct Result {
    double variance = 0;
    double degrees_of_freedom = 0;
    double colour = 0;  ///< correlation of neighbours, 0 … 0.99
    double pairs = 0;   ///< that it was seen in
  };

  /// `least_limit`: what is never an outlier, rad.
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
    return {variance, worth_ * count / static_cast<double>(values_.size()) * (1 - r * r) / (1 + r * r), r, pairs};
  }

 private:
  double limit_of(double least_limit) const {
    std::vector<double> sizes;
    for (const double value : values_) sizes.push_back(std::abs(value));
    const double limit = std::max(5.0 * median_of(sizes) / 0.6745, least_limit);
    const auto beyond = std::count_if(sizes.begin(), sizes.end(), [limit](double size) { return size > limit; });
    return 10 * static_cast<std::size_t>(beyond) > sizes.size() ? std::numeric_limits<double>::infinity() : limit;
  }

  std::vector<double> values_;
  std::vector<double> places_;
  std::vector<bool> follows_;
  double worth_ = 0;
};

/// θ at α on a stroke, and the sum of squares of the weights of the rows it comes from; nothing outside.
struct Looked {
  bool inside = false;
  double theta = 0;
  double load = 0;
  double weight = 1;
};

/// The cubic through four rows. Rows that stand nearly on one another (a dwell, a quantum) make none.
Looked on_cubic(const Run& run, std::size_t first, double alpha, double least_gap) {
  const auto at = [&](std::size_t i) -> const Sample& { return run.samples[i]; };
  Looked looked{true, 0, 0, 0};
  for (std::size_t j = first; j < first + 4; ++j) {
    double weight = 1;
    for (std::size_t k = first; k < first + 4; ++k) {
      const double gap = at(j).alpha - at(k).alpha;
      if (k == j) continue;
      if (std::abs(gap) < least_gap || gap == 0) return {};
      weight *= (alpha - at(k).alpha) / gap;
    }
    looked.theta += weight * at(j).theta;
    looked.weight += weight * weight;
  }
  return looked.weight < 3 ? looked : Looked{};
}

/// The straight line through a small part of a stroke: for logs so dense that α stands still or jitters from row to
/// row.
Looked on_line(const Run& run, const Stretch& stroke, std::size_t place, double alpha) {
  const double longest = std::abs(run.samples[stroke.last].alpha - run.samples[stroke.first].alpha) / 25;
  for (std::size_t half = 4; half <= (stroke.last - stroke.first) / 8; half *= 2) {
    const std::size_t first = place > stroke.first + half ? place - half : stroke.first,
                      last = std::min(stroke.last, place + half);
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

Looked look_up(const Run& run, const Stretch& stroke, double sign, double alpha) {
  const auto at = [&](std::size_t i) -> const Sample& { return run.samples[i]; };
  std::size_t low = stroke.first, high = stroke.last;
  if (high - low < 4 || sign * alpha < sign * at(low).alpha || sign * alpha > sign * at(high).alpha) return {};
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (sign * at(middle).alpha <= sign * alpha ? low : high) = middle;
  }
  const std::size_t first = std::clamp(low, stroke.first + 1, stroke.last - 2) - 1;
  Looked looked = on_cubic(run, first, alpha, 0.05 * std::abs(at(high).alpha - at(low).alpha));
  if (!looked.inside) looked = on_line(run, stroke, low, alpha);
  looked.load = at(low).load;
  return looked;
}

/// Away from reversals, where play and friction are still on their way.
bool is_inner(const Run& run, const Stretch& stroke, double alpha) {
  const double from = run.samples[stroke.first].alpha, to = run.samples[stroke.last].alpha;
  const double share = (alpha - from) / (to - from);
  return share > 0.03 && share < 0.97;
}

/// A stretch, and what makes another one its repeat.
struct Pass {
  const Run* run = nullptr;
  Stretch rows;
  int direction = 0;
  double load = 0;   ///< in its middle
  double alpha = 0;  ///< held: where
  double slope = 0;  ///< dθ/dα of the run on the whole
};

/// The run's rows at the same share of a stand; its α is a little elsewhere.
Looked look_up_held(const Pass& pass, double share, double alpha) {
  const auto rows = static_cast<double>(pass.rows.last - pass.rows.first);
  const Sample& sample = pass.run->samples[pass.rows.first + static_cast<std::size_t>(std::lround(share * rows))];
  return {true, sample.theta + pass.slope * (alpha - sample.alpha), sample.load, 1};
}

/// How far two loads may be apart that count as one: a part of all there are, or the load cell's own noise.
double load_tolerance(const Measurement& measurement) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::vector<double> bends;
  for (const Run& run : measurement.runs) {
    for (std::size_t i = 0; run.has_load && i < run.samples.size(); ++i) {
      least = std::min(least, run.samples[i].load);
      most = std::max(most, run.samples[i].load);
      if (i > 1) bends.push_back(std::abs(run.samples[i].load - 2 * run.samples[i - 1].load + run.samples[i - 2].load));
    }
  }
  return most > least ? std::max(0.1 * (most - least), 4.0 * white_noise_of(std::move(bends))) + 1e-9 : 0;
}

bool same_speed(const Run& a, const Run& b) { return std::abs(a.speed - b.speed) <= 0.15 * std::max(a.speed, b.speed); }

Pass pass_of(const Run& run, const Stretch& stretch, double slope) {
  const Sample& middle = run.samples[stretch.first + (stretch.last - stretch.first) / 2];
  return {&run, stretch, run.strokes[stretch.stroke].direction, run.has_load ? middle.load : 0, middle.alpha, slope};
}

/// Of several strokes the first is not judged by (evidence.cpp): play, and what must bed in, are still on their way. Of
/// held points the first.
bool is_still_settling(const Run& run, const Stretch& stretch) {
  if (is_from_point_to_point(run)) return stretch.first == run.stretches.front().first && run.stretches.size() > 2;
  return stretch.stroke == 0 && run.strokes.size() > 2;
}

/// dθ/dα of a run on the whole, by its ends.
double slope_of(const Run& run) {
  const auto [least, most] = std::minmax_element(run.samples.begin(), run.samples.end(),
                                                 [](const Sample& a, const Sample& b) { return a.alpha < b.alpha; });
  return most->alpha > least->alpha ? (most->theta - least->theta) / (most->alpha - least->alpha) : 0;
}

/// How close two passes must be to repeat one another.
struct Alike {
  double load = 0;
  double alpha = 0;  ///< of held points: a share of all there are, or three steps of the sensor
  bool across_runs = false;

  bool operator()(const Pass& a, const Pass& b) const {
    const bool same_run =
        a.run == b.run || (across_runs && a.run->has_load == b.run->has_load && same_speed(*a.run, *b.run));
    const bool same_kind = a.rows.held == b.rows.held && a.rows.pull == b.rows.pull && a.direction == b.direction;
    return same_run && same_kind && std::abs(a.load - b.load) <= load &&
           (!a.rows.held || std::abs(a.alpha - b.alpha) <= alpha);
  }
};

Alike alike_in(const Measurement& measurement, bool across_runs) {
  const SeenSpan alphas = seen_span(measurement, &Sample::alpha);
  return {load_tolerance(measurement),
          std::max(2e-3 * (alphas.any() ? alphas.size() : 0.0), 3 * measurement.alpha_quantum), across_runs};
}

/// Of more stands than that every n-th pair is looked at: each is compared with every group.
constexpr std::size_t k_most_stands = 4000;

/// Stretches that repeat one another, in the order in which they were made.
std::vector<std::vector<Pass>> repeats(const Measurement& measurement, const Alike& alike) {
  std::vector<std::vector<Pass>> groups;
  for (const Run& run : measurement.runs) {
    const std::vector<Stretch> stretches = stretches_of(run);
    const std::size_t every = stretches.size() / k_most_stands + 1;
    const double slope = run.samples.empty() ? 0 : slope_of(run);
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const Stretch& stretch = stretches[i];
      if (run.strokes[stretch.stroke].partial || is_still_settling(run, stretch) ||
          (stretch.held && i / 2 % every != 0))
        continue;
      const Pass pass = pass_of(run, stretch, slope);
      const auto group = std::find_if(groups.begin(), groups.end(),
                                      [&](const std::vector<Pass>& g) { return alike(g.front(), pass); });
      if (group != groups.end()) {
        group->push_back(pass);
      } else {
        groups.push_back({pass});
      }
    }
  }
  return groups;
}

/// Of second differences over `triples` neighbouring triples, which share strokes: what one of them is worth on its
/// own.
double worth_of(std::size_t triples) {
  const double n = static_cast<double>(triples);
  return n / (n + 2 * (n - 1) * (4.0 / 9.0) + 2 * std::max(0.0, n - 2) / 36.0);
}

/// Second differences over three strokes leave out a steady drift; first differences of two do with what there is.
void add_repeats(const std::vector<Pass>& group, double tolerance, Scatter& scatter) {
  if (group.size() < 2) return;
  const bool triples = group.size() > 2;
  const std::size_t count = triples ? group.size() - 2 : 1;
  for (std::size_t k = 1; k <= count; ++k) {
    std::vector<double> differences, places;
    const Run& run = *group[k].run;
    const Stretch& rows = group[k].rows;
    const auto look = [&](const Pass& pass, std::size_t row) {
      const Sample& sample = run.samples[row];
      const double share =
          static_cast<double>(row - rows.first) / static_cast<double>(std::max<std::size_t>(1, rows.last - rows.first));
      const Looked looked = rows.held ? look_up_held(pass, share, sample.alpha)
                                      : look_up(*pass.run, pass.rows, pass.direction, sample.alpha);
      return !run.has_load || std::abs(looked.load - sample.load) <= tolerance ? looked : Looked{};
    };
    for (std::size_t i = rows.first; i <= rows.last; ++i) {
      const Sample& sample = run.samples[i];
      if (!rows.held && !is_inner(run, rows, sample.alpha)) continue;
      const Looked before = look(group[k - 1], i);
      if (!before.inside) continue;
      if (!triples) {
        places.push_back(sample.alpha);
        differences.push_back((sample.theta - before.theta) / std::sqrt(1 + before.weight));
        continue;
      }
      const Looked after = look(group[k + 1], i);
      if (!after.inside) continue;
      places.push_back(sample.alpha);
      differences.push_back((2 * sample.theta - before.theta - after.theta) /
                            std::sqrt(4 + before.weight + after.weight));
    }
    scatter.add(differences, worth_of(count), places);
  }
}

/// Third differences of neighbouring rows: what is left where there are no repeats. Noise with colour hides from them.
/// One of white noise is correlated with the next three by −3/4, 3/10, −1/20.
void add_neighbours(const Run& run, Scatter& scatter) {
  const double worth = 1 / (1 + 2 * (0.75 * 0.75 + 0.3 * 0.3 + 0.05 * 0.05));
  for (const Stretch& stretch : stretches_of(run)) {
    std::vector<double> differences;
    for (std::size_t i = stretch.first + 3; i <= stretch.last; ++i) {
      const auto& s = run.samples;
      differences.push_back((s[i].theta - 3 * s[i - 1].theta + 3 * s[i - 2].theta - s[i - 3].theta) / std::sqrt(20.0));
    }
    scatter.add(differences, worth);
  }
}

Scatter scatter_of_neighbours(const Measurement& measurement) {
  Scatter scatter;
  for (const Run& run : measurement.runs) add_neighbours(run, scatter);
  return scatter;
}

/// A row that lies on the parabola of three others but for their noise: the others' weights.
std::array<double, 3> parabola_weights(double at, const std::array<double, 3>& places) {
  std::array<double, 3> weights{1, 1, 1};
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (k != j) weights[j] *= (at - places[k]) / (places[j] - places[k]);
    }
  }
  return weights;
}

/// Four held points, one after another, a row of each: what the second is off the parabola of the others.
void add_stands(const std::array<const Sample*, 4>& rows, std::vector<double>& differences) {
  const std::array<double, 3> weights =
      parabola_weights(rows[1]->alpha, {rows[0]->alpha, rows[2]->alpha, rows[3]->alpha});
  const double squares = 1 + weights[0] * weights[0] + weights[1] * weights[1] + weights[2] * weights[2];
  if (!std::isfinite(squares)) return;
  const double off =
      rows[1]->theta - weights[0] * rows[0]->theta - weights[1] * rows[2]->theta - weights[2] * rows[3]->theta;
  differences.push_back(off / std::sqrt(squares));
}

/// Held points with a row each have no neighbours but one another: from stand to stand on a stroke, under one load.
Scatter scatter_of_stands(const Measurement& measurement) {
  constexpr double worth = 1 / (1 + 2 * (0.75 * 0.75 + 0.3 * 0.3 + 0.05 * 0.05));  // as in add_neighbours()
  const double tolerance = load_tolerance(measurement);
  Scatter scatter;
  for (const Run& run : measurement.runs) {
    const std::vector<Stretch> stands = stretches_of(run);
    std::vector<double> differences;
    for (std::size_t i = 3; i < stands.size(); ++i) {
      std::array<const Sample*, 4> rows{};
      bool alike = true;
      for (std::size_t k = 0; k < 4; ++k) {
        const Stretch& stand = stands[i - 3 + k];
        rows[k] = &run.samples[stand.first];
        alike = alike && stand.held && stand.stroke == stands[i].stroke && stand.pull == stands[i].pull &&
                (!run.has_load || std::abs(rows[k]->load - rows[0]->load) <= tolerance);
      }
      if (alike) add_stands(rows, differences);
    }
    scatter.add(differences, worth);
  }
  return scatter;
}

/// Repeats of one load and speed, either way and in any run.
struct ScatterAtLevel {
  NoiseLevel level;
  Scatter scatter;
};

std::vector<NoiseLevel> noise_levels(const Measurement& measurement, double least_limit) {
  const Alike alike = alike_in(measurement, false);
  std::vector<ScatterAtLevel> all;
  for (const std::vector<Pass>& group : repeats(measurement, alike)) {
    const double load = group.front().load, speed = group.front().run->speed;
    auto at = std::find_if(all.begin(), all.end(), [&](const ScatterAtLevel& other) {
      const double faster = std::max(speed, other.level.speed);
      return std::abs(other.level.load - load) <= alike.load && std::abs(other.level.speed - speed) <= 0.15 * faster;
    });
    if (at == all.end()) at = all.insert(all.end(), ScatterAtLevel{{load, speed, 0, 0, 0}, {}});
    add_repeats(group, alike.load, at->scatter);
  }
  std::vector<NoiseLevel> levels;
  for (const ScatterAtLevel& at : all) {
    if (at.scatter.count() < k_enough) continue;
    const Scatter::Result result = at.scatter.result(least_limit);
    levels.push_back({at.level.load, at.level.speed, std::sqrt(result.variance), result.degrees_of_freedom,
                      at.scatter.largest_at()});
  }
  return levels;
}

Scatter scatter_within_runs(const Measurement& measurement) {
  const Alike alike = alike_in(measurement, false);
  Scatter scatter;
  for (const std::vector<Pass>& group : repeats(measurement, alike)) add_repeats(group, alike.load, scatter);
  return scatter;
}

/// Variance of noise that third differences show, of which neighbours are correlated by r: rᵏ against their weights
/// 20, −15, 6, −1.
double seen_by_neighbours(double r) { return 1 + (-15 * r + 6 * r * r - r * r * r) / 10; }

/// Whether differences go on from row to row, and are twice as large as noise that neighbours scatter by could make
/// them. Noise may have a colour of its own; what goes on by more than 0.7 is taken for none. Tests: a joint wired anew
/// between two runs; noise alone, white and coloured.
bool is_smooth(const Scatter::Result& differences, double variance_of_neighbours) {
  const double noise = variance_of_neighbours / seen_by_neighbours(std::min(differences.colour, 0.7));
  return differences.colour > 0.3 && differences.colour * std::sqrt(differences.pairs) > 3.0 &&
         differences.variance > 2.0 * noise;
}

/// What runs that repeat one another differ by.
struct BetweenRuns {
  Scatter noise;
  double smooth_squares = 0;  ///< of what is no noise, rad²
  double smooth_count = 0;
};

BetweenRuns scatter_between_runs(const Measurement& measurement, double least_limit) {
  const Alike alike = alike_in(measurement, true);
  const double neighbours = scatter_of_neighbours(measurement).result(least_limit).variance;
  BetweenRuns found;
  for (const std::vector<Pass>& group : repeats(measurement, alike)) {
    // Run by run: what was changed once is not to be lost among those that agree.
    for (std::size_t k = 1; k < group.size(); ++k) {
      Scatter pair;
      add_repeats({group[k - 1], group[k]}, alike.load, pair);
      const Scatter::Result result = pair.result(least_limit);
      if (is_smooth(result, neighbours)) {
        found.smooth_squares += result.variance * static_cast<double>(pair.count());
        found.smooth_count += static_cast<double>(pair.count());
      }
    }
    if (found.smooth_count == 0) add_repeats(group, alike.load, found.noise);
  }
  return found;
}

/// Error of both sensors' own steps, as θ shows it.
double step_error(const Measurement& measurement) {
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
  return std::hypot(measurement.theta_quantum, slope * measurement.alpha_quantum) / std::sqrt(12.0);
}

}  // namespace

NoiseFloor noise_floor(const Measurement& measurement) {
  const double least_limit = 3 * measurement.theta_quantum;
  NoiseFloor floor;
  // Within a run nothing was touched in between; runs that repeat one another do where each is a single cycle.
  Scatter scatter = scatter_within_runs(measurement);
  if (scatter.count() < k_enough) {
    BetweenRuns between = scatter_between_runs(measurement, least_limit);
    if (between.smooth_count > 0)
      floor.between_runs = std::sqrt(2 * between.smooth_squares / between.smooth_count);
    else
      scatter = std::move(between.noise);
  }
  floor.from_repeats = scatter.count() >= k_enough;
  const Scatter neighbours = scatter_of_neighbours(measurement);
  if (neighbours.count() >= k_enough) floor.within_stroke = std::max(neighbours.typical(), step_error(measurement));
  if (!floor.from_repeats) {
    floor.from_repeats = neighbours.count() < k_enough && scatter.count() >= k_few;
    if (!floor.from_repeats) scatter = neighbours.count() < k_enough ? scatter_of_stands(measurement) : neighbours;
  }
  const Scatter::Result result = scatter.result(least_limit);
  floor.rms = std::max(std::sqrt(result.variance), step_error(measurement));
  floor.degrees_of_freedom = result.degrees_of_freedom;
  floor.colour = floor.from_repeats ? result.colour : 0;
  floor.levels = noise_levels(measurement, least_limit);
  return floor;
}

double NoiseFloor::effective_rows(double rows, double every) const {
  const double r = std::pow(colour, every);
  return rows * (1 - r) / (1 + r);
}

}  // namespace fusee
