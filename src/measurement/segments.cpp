#include "measurement/segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "measurement/strokes.h"
#include "measurement/value_range.h"

// A point-to-point log has few rows, or none, during motion. It does not show the shape of a stroke, but θ at each
// dwell, approached from one side, under one load. Thresholds are shares of the run's own span and scatter;
// tests/measurement/segments_test.cpp checks them against sweeps, sines, quantised and noisy logs without dwells.

namespace fusee::measurement {
namespace {

/// Fewer rows at one α are a slow part of a motion.
constexpr std::size_t k_min_dwell_rows = 3;
/// A stroke of fewer rows shows no shape: it is taken as a sequence of dwells of one row each. As for a block in
/// evidence.cpp.
constexpr std::size_t k_min_shape_rows = 6;
/// Largest drift of α during a dwell, as a share of the run's span of α.
constexpr double k_drift = 1e-3;
/// Number of levels from which on they are steps of a sensor. Fewer levels are dwell angles.
constexpr double k_fewest_sensor_steps = 40;
/// Rows whose α lies within a width form a dwell if at the run's mean pace they would have moved by this many widths.
/// Rows of a slow sweep would have moved by one width.
constexpr double k_widths_of_a_dwell = 5;
/// Smallest distance of load levels, as a share of the load's range in the run.
constexpr double k_level_distance = 0.12;
/// Width of the pieces that a load ramp is cut into, as a share of the load's range: three or four pieces.
constexpr double k_ramp_piece = 0.3;
/// Half the range of 10⁶ normal samples, in standard deviations.
constexpr double k_noise_limit = 5;

double mean_of(const std::vector<Sample>& samples, double Sample::*value, const RowRange& rows) {
  double sum = 0;
  for (std::size_t i = rows.first; i <= rows.last; ++i) sum += samples[i].*value;
  return sum / static_cast<double>(rows.last - rows.first + 1);
}

std::size_t count_of(const RowRange& rows) { return rows.last - rows.first + 1; }

/// The longest range of rows from `first` up to `end` whose values lie within `width` of each other.
RowRange rows_within(const std::vector<Sample>& samples, double Sample::*value, std::size_t first, std::size_t end,
                     double width) {
  ValueRange span;
  std::size_t last = first;
  for (std::size_t i = first; i <= end; ++i) {
    span.take(samples[i].*value);
    if (span.size() > width) break;
    last = i;
  }
  return {first, last};
}

/// Adds a dwell, or joins it to the preceding one if a noise peak split the two.
void add_or_join(std::vector<RowRange>& dwells, const RowRange& next, const std::vector<Sample>& samples,
                 double width) {
  const bool follows = !dwells.empty() && dwells.back().last + 1 == next.first;
  if (follows && std::abs(mean_of(samples, &Sample::alpha, dwells.back()) - mean_of(samples, &Sample::alpha, next)) <
                     0.5 * width) {
    dwells.back().last = next.last;
  } else {
    dwells.push_back(next);
  }
}

/// Step of the motor's sensor; 0 if `quantum` is so wide that it may be the distance of dwells.
double sensor_step(const std::vector<Sample>& samples, double quantum) {
  return k_fewest_sensor_steps * quantum < value_range(samples, &Sample::alpha).size() ? quantum : 0;
}

/// All dwells of a log. `step`: of the sensor; `noise`: standard deviation of α, both rad.
std::vector<RowRange> dwells_among(const std::vector<Sample>& samples, double step, double noise) {
  double path = 0;  // of α, rad
  for (std::size_t i = 1; i < samples.size(); ++i) path += std::abs(samples[i].alpha - samples[i - 1].alpha);
  const double width =
      std::max({k_drift * value_range(samples, &Sample::alpha).size(), 1.5 * step, 2 * k_noise_limit * noise});
  // White noise adds 2/√π = 1.13 of its standard deviation to the path from row to row.
  const double rows = static_cast<double>(samples.size());
  const double pace = path / rows - 1.13 * noise;  // rad a row
  std::vector<RowRange> dwells;
  for (std::size_t i = 0; i < samples.size();) {
    const RowRange next = rows_within(samples, &Sample::alpha, i, samples.size() - 1, width);
    const std::size_t count = count_of(next);
    const bool is_dwell = count >= k_min_dwell_rows && static_cast<double>(count) * pace > k_widths_of_a_dwell * width;
    if (is_dwell) add_or_join(dwells, next, samples, width);
    // Only half of other rows is skipped: a dwell may begin among them.
    i += is_dwell ? count : std::max<std::size_t>(1, count / 2);
  }
  return dwells;
}

/// True for a sweep with a coarse sensor of α. Then θ moves during the apparent dwells: by more than a quarter of its
/// change to the next one.
bool is_coarse_sweep(const std::vector<Sample>& samples, const std::vector<RowRange>& dwells) {
  std::vector<double> shares;
  for (std::size_t k = 1; k < dwells.size(); ++k) {
    const RowRange& here = dwells[k - 1];
    const std::size_t third = count_of(here) / 3;
    const double to_next = mean_of(samples, &Sample::theta, dwells[k]) - mean_of(samples, &Sample::theta, here);
    const double within_dwell = mean_of(samples, &Sample::theta, {here.last + 1 - third, here.last}) -
                                mean_of(samples, &Sample::theta, {here.first, here.first + third - 1});
    if (to_next != 0) shares.push_back(within_dwell / to_next);
  }
  return median_of(std::move(shares)) > 0.25;
}

// ---- levels of load -------------------------------------------------------------------------------------------------

/// Load levels of a run, in the unit of the loads.
struct Levels {
  double width = 0;  ///< loads within this width are one level
  double span = 0;   ///< range of all loads
};

/// Empty if the range of the load is below a tenth of its largest magnitude, or below 15 standard deviations of its
/// noise.
std::optional<Levels> levels_of(const Run& run) {
  if (!run.has_load || run.samples.empty()) return std::nullopt;
  const ValueRange span = value_range(run.samples, &Sample::load);
  const double largest = std::max(std::abs(span.least), std::abs(span.most));
  const double width =
      std::max(k_level_distance * span.size(), 2 * k_noise_limit * noise_of(run.samples, &Sample::load));
  if (span.size() <= 0.1 * largest || span.size() <= 1.5 * width) return std::nullopt;
  return Levels{width, span.size()};
}

/// True if half of the load's change happens within three rows.
bool is_stepped(const Run& run, const RowRange& rows) {
  ValueRange span;
  double step = 0;
  for (std::size_t i = rows.first; i <= rows.last; ++i) {
    span.take(run.samples[i].load);
    if (i >= rows.first + 2) step = std::max(step, std::abs(run.samples[i].load - run.samples[i - 2].load));
  }
  return span.any() && step >= 0.5 * span.size();
}

/// Cuts rows into pieces whose loads lie within `width`. Pieces of fewer than `fewest` rows join a neighbour.
std::vector<RowRange> pieces_of(const Run& run, const RowRange& rows, double width, std::size_t fewest) {
  std::vector<RowRange> pieces;
  for (std::size_t i = rows.first; i <= rows.last;) {
    const RowRange next = rows_within(run.samples, &Sample::load, i, rows.last, width);
    // Rows between two levels form no piece of their own.
    if (!pieces.empty() && (count_of(next) < fewest || count_of(pieces.back()) < fewest)) {
      pieces.back().last = next.last;
    } else {
      pieces.push_back(next);
    }
    i = next.last + 1;
  }
  if (pieces.size() > 1 && count_of(pieces.back()) < fewest) {
    pieces[pieces.size() - 2].last = pieces.back().last;
    pieces.pop_back();
  }
  return pieces;
}

/// Mean load of a stroke in eight bins of α; empty where there are no rows.
using LoadByAlpha = std::array<std::optional<double>, 8>;

LoadByAlpha load_by_alpha(const Run& run, const Stroke& stroke, const ValueRange& alphas) {
  LoadByAlpha loads;
  std::array<double, 8> counts{};
  const Bins bins{alphas, 8};
  for (std::size_t i = stroke.first; i <= stroke.last; ++i) {
    const auto bin = static_cast<std::size_t>(bins.bin(run.samples[i].alpha));
    loads[bin] = loads[bin].value_or(0.0) + run.samples[i].load;
    counts[bin] += 1;
  }
  for (std::size_t i = 0; i < loads.size(); ++i) {
    if (loads[i]) *loads[i] /= counts[i];
  }
  return loads;
}

/// True if all strokes of a direction have the same load at the same α, as with a spring or a weight on a link.
bool is_function_of_alpha(const Run& run, const Levels& levels) {
  const ValueRange alphas = value_range(run.samples, &Sample::alpha);
  std::array<std::optional<LoadByAlpha>, 2> first;  // loads of the first stroke in each direction
  for (const Stroke& stroke : run.strokes) {
    const LoadByAlpha loads = load_by_alpha(run, stroke, alphas);
    std::optional<LoadByAlpha>& expected = first[stroke.direction > 0 ? 0 : 1];
    if (!expected) expected = loads;
    for (std::size_t i = 0; i < loads.size(); ++i) {
      if (loads[i] && (*expected)[i] && std::abs(*loads[i] - *(*expected)[i]) > levels.width) return false;
    }
  }
  return true;
}

// ---- cutting --------------------------------------------------------------------------------------------------------

class SegmentCutter {
 public:
  SegmentCutter(const Run& run, const std::vector<RowRange>& dwells)
      : run_(run),
        dwells_(dwells),
        levels_(levels_of(run)),
        cuts_ramps_(levels_ && !is_function_of_alpha(run, *levels_)),
        cuts_steps_(cuts_ramps_ || run.strokes.size() < 3) {}

  std::vector<Segment> cut() {
    for (std::size_t s = 0; s < run_.strokes.size(); ++s) cut_stroke(s);
    return std::move(segments_);
  }

 private:
  void cut_stroke(std::size_t s) {
    const Stroke& stroke = run_.strokes[s];
    std::size_t from = stroke.first;
    for (; next_dwell_ < dwells_.size() && dwells_[next_dwell_].first <= stroke.last; ++next_dwell_) {
      const RowRange& dwell = dwells_[next_dwell_];
      const RowRange inside{std::max(dwell.first, stroke.first), std::min(dwell.last, stroke.last)};
      if (inside.last < inside.first) continue;
      if (inside.first > from) add_moving(s, {from, inside.first - 1});
      add_dwell(s, inside);
      from = inside.last + 1;
      if (dwell.last > stroke.last) break;  // the remainder belongs to the next stroke
    }
    if (from <= stroke.last) add_moving(s, {from, stroke.last});
  }

  void add(std::size_t stroke, const RowRange& rows, bool is_dwell, int pull) {
    segments_.push_back({rows.first, rows.last, stroke, is_dwell, pull});
  }

  void add_moving(std::size_t stroke, const RowRange& rows) {
    const bool is_whole_stroke = count_of(rows) == count_of({run_.strokes[stroke].first, run_.strokes[stroke].last});
    if (is_whole_stroke && count_of(rows) < k_min_shape_rows) {
      for (std::size_t i = rows.first; i <= rows.last; ++i) add(stroke, {i, i}, /*is_dwell=*/true, 0);
      return;
    }
    for (const RowRange& piece : moving_pieces(rows)) add(stroke, piece, /*is_dwell=*/false, 0);
  }

  std::vector<RowRange> moving_pieces(const RowRange& rows) const {
    if (!levels_) return {rows};
    if (cuts_steps_ && is_stepped(run_, rows)) return pieces_of(run_, rows, levels_->width, k_min_shape_rows);
    return cuts_ramps_ ? pieces_of(run_, rows, k_ramp_piece * levels_->span, k_min_shape_rows)
                       : std::vector<RowRange>{rows};
  }

  void add_dwell(std::size_t stroke, const RowRange& rows) {
    if (!levels_) return add(stroke, rows, /*is_dwell=*/true, 0);
    double load_before = 0;
    for (const RowRange& piece : pieces_of(run_, rows, levels_->width, k_min_dwell_rows)) {
      const double load = mean_of(run_.samples, &Sample::load, piece);
      const int pull = piece.first == rows.first ? 0 : load > load_before ? 1 : -1;
      add(stroke, piece, /*is_dwell=*/true, pull);
      load_before = load;
    }
  }

  const Run& run_;
  const std::vector<RowRange>& dwells_;
  std::optional<Levels> levels_;
  bool cuts_ramps_ = false;  ///< cut slow load changes: they are no function of α
  bool cuts_steps_ = false;  ///< cut sudden ones; also with a single stroke each way, which shows no dependence on α
  std::size_t next_dwell_ = 0;
  std::vector<Segment> segments_;
};

}  // namespace

std::vector<RowRange> dwells_in(const std::vector<Sample>& samples, double alpha_quantum) {
  if (samples.size() < k_min_dwell_rows) return {};
  const double step = sensor_step(samples, alpha_quantum);
  for (const double noise : {noise_of(samples, &Sample::alpha), noise_of_dwells(samples, &Sample::alpha)}) {
    std::vector<RowRange> dwells = dwells_among(samples, step, noise);
    std::size_t rows = 0;
    for (const RowRange& dwell : dwells) rows += count_of(dwell);
    if (2 * rows >= samples.size() && !is_coarse_sweep(samples, dwells)) return dwells;
  }
  return {};
}

double sensor_quantum(const std::vector<RowRange>& dwells, const std::vector<Sample>& samples, double Sample::*angle,
                      double quantum) {
  return dwells.empty() || k_fewest_sensor_steps * quantum < value_range(samples, angle).size() ? quantum : 0;
}

std::vector<Sample> with_mean_alpha_in_dwells(std::vector<Sample> samples, const std::vector<RowRange>& dwells) {
  for (const RowRange& dwell : dwells) {
    const double alpha = mean_of(samples, &Sample::alpha, dwell);
    for (std::size_t i = dwell.first; i <= dwell.last; ++i) samples[i].alpha = alpha;
  }
  return samples;
}

bool has_levels_of_load(const Run& run) { return levels_of(run).has_value(); }

std::vector<Segment> cut_segments(const Run& run, const std::vector<RowRange>& dwells) {
  return SegmentCutter(run, dwells).cut();
}

std::vector<Segment> segments_of(const Run& run) {
  if (!run.segments.empty()) return run.segments;
  std::vector<Segment> whole;
  for (std::size_t s = 0; s < run.strokes.size(); ++s)
    whole.push_back({run.strokes[s].first, run.strokes[s].last, s, false, 0});
  return whole;
}

bool is_from_point_to_point(const Run& run) {
  return std::any_of(run.segments.begin(), run.segments.end(), [](const Segment& segment) { return segment.is_dwell; });
}

}  // namespace fusee::measurement
