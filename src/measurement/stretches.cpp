#include "measurement/stretches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "measurement/seen_span.h"
#include "measurement/strokes.h"

// A log from point to point has few rows, or none, while it moves. What stands in it for a stroke's shape is the level
// of θ at each held angle, come to from one side, under one load. Everything here is by shares of what the run itself
// spans and scatters by; tests/measurement/stretches_test.cpp holds them against sweeps, sines, quanta and noise, which
// are none.

namespace fusee {
namespace {

/// Fewer are a slow row of a motion.
constexpr std::size_t k_fewest_held = 3;
/// A stroke of fewer rows is stops of one row each: no shape can be seen between them. As of a block (evidence.cpp).
constexpr std::size_t k_fewest_of_a_shape = 6;
/// α wanders by this part of its span while a motor is held.
constexpr double k_wander = 1e-3;
/// A sensor has more steps over a motion; held angles are fewer.
constexpr double k_steps_of_a_sensor = 40;
/// Standing must save this many times the way that counts as standing: a slow sweep saves one.
constexpr double k_standing = 5;
/// Levels of load are wider apart than this part of what the run's load spans, …
constexpr double k_one_level = 0.12;
/// … and pieces of a ramp as wide as this: three or four of a whole one.
constexpr double k_piece_of_ramp = 0.3;
/// Half the range of noise of 10⁶ rows, in spreads of a row.
constexpr double k_beyond_noise = 5;

double mean_of(const std::vector<Sample>& samples, double Sample::*value, const Hold& rows) {
  double sum = 0;
  for (std::size_t i = rows.first; i <= rows.last; ++i) sum += samples[i].*value;
  return sum / static_cast<double>(rows.last - rows.first + 1);
}

std::size_t count_of(const Hold& rows) { return rows.last - rows.first + 1; }

/// From `first` on, not beyond `end`: as many rows as stay within `width` of one another.
Hold within(const std::vector<Sample>& samples, double Sample::*value, std::size_t first, std::size_t end,
            double width) {
  SeenSpan span;
  std::size_t last = first;
  for (std::size_t i = first; i <= end; ++i) {
    span.take(samples[i].*value);
    if (span.size() > width) break;
    last = i;
  }
  return {first, last};
}

/// Noise now and then reaches beyond the width of a hold: its parts are one.
void add_or_join(std::vector<Hold>& holds, const Hold& next, const std::vector<Sample>& samples, double width) {
  const bool follows = !holds.empty() && holds.back().last + 1 == next.first;
  if (follows &&
      std::abs(mean_of(samples, &Sample::alpha, holds.back()) - mean_of(samples, &Sample::alpha, next)) < 0.5 * width) {
    holds.back().last = next.last;
  } else {
    holds.push_back(next);
  }
}

/// What may be the step of the motor's sensor; 0 where steps are as wide as between held angles.
double sensor_step(const std::vector<Sample>& samples, double quantum) {
  return k_steps_of_a_sensor * quantum < seen_span(samples, &Sample::alpha).size() ? quantum : 0;
}

std::vector<Hold> standing(const std::vector<Sample>& samples, double step, double noise) {
  double way = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) way += std::abs(samples[i].alpha - samples[i - 1].alpha);
  const double width =
      std::max({k_wander * seen_span(samples, &Sample::alpha).size(), 1.5 * step, 2 * k_beyond_noise * noise});
  // What noise adds to the way is none: 2/√π of its spread from row to row.
  const double rows = static_cast<double>(samples.size());
  const double pace = way / rows - 1.13 * noise;
  std::vector<Hold> holds;
  for (std::size_t i = 0; i < samples.size();) {
    const Hold next = within(samples, &Sample::alpha, i, samples.size() - 1, width);
    const std::size_t count = count_of(next);
    const bool stands = count >= k_fewest_held && static_cast<double>(count) * pace > k_standing * width;
    if (stands) add_or_join(holds, next, samples, width);
    i += stands ? count : std::max<std::size_t>(1, count / 2);
  }
  return holds;
}

/// A sweep seen by a coarse sensor: α seems to stand while θ goes on to where it stands next.
bool goes_on_meanwhile(const std::vector<Sample>& samples, const std::vector<Hold>& holds) {
  std::vector<double> shares;
  for (std::size_t k = 1; k < holds.size(); ++k) {
    const Hold& here = holds[k - 1];
    const std::size_t third = count_of(here) / 3;
    const double next = mean_of(samples, &Sample::theta, holds[k]) - mean_of(samples, &Sample::theta, here);
    const double meanwhile = mean_of(samples, &Sample::theta, {here.last + 1 - third, here.last}) -
                             mean_of(samples, &Sample::theta, {here.first, here.first + third - 1});
    if (next != 0) shares.push_back(meanwhile / next);
  }
  return median_of(std::move(shares)) > 0.25;
}

// ---- levels of load -------------------------------------------------------------------------------------------------

/// What a run's load does.
struct Levels {
  double width = 0;  ///< of one level
  double span = 0;
};

/// Nothing where the load never changes by more than a tenth of itself, or than its own noise.
std::optional<Levels> levels_of(const Run& run) {
  if (!run.has_load || run.samples.empty()) return std::nullopt;
  const SeenSpan span = seen_span(run.samples, &Sample::load);
  const double largest = std::max(std::abs(span.least), std::abs(span.most));
  const double width = std::max(k_one_level * span.size(), 2 * k_beyond_noise * noise_of(run.samples, &Sample::load));
  if (span.size() <= 0.1 * largest || span.size() <= 1.5 * width) return std::nullopt;
  return Levels{width, span.size()};
}

/// Whether half of what the load changes by comes within three rows.
bool is_stepped(const Run& run, const Hold& rows) {
  SeenSpan span;
  double step = 0;
  for (std::size_t i = rows.first; i <= rows.last; ++i) {
    span.take(run.samples[i].load);
    if (i >= rows.first + 2) step = std::max(step, std::abs(run.samples[i].load - run.samples[i - 2].load));
  }
  return span.any() && step >= 0.5 * span.size();
}

/// Rows cut into pieces of loads within `width`; pieces shorter than `fewest` go with the one before or after.
std::vector<Hold> pieces_of(const Run& run, const Hold& rows, double width, std::size_t fewest) {
  std::vector<Hold> pieces;
  for (std::size_t i = rows.first; i <= rows.last;) {
    const Hold next = within(run.samples, &Sample::load, i, rows.last, width);
    // A row on the way from level to level is none.
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

/// Mean load of a stroke over eight places of α; nothing where it has no row.
using LoadByPlace = std::array<std::optional<double>, 8>;

LoadByPlace load_by_place(const Run& run, const Stroke& stroke, const SeenSpan& alphas) {
  LoadByPlace loads;
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

/// Whether all strokes of a direction meet the same load at the same place: a spring, a weight on a link.
bool is_bound_to_place(const Run& run, const Levels& levels) {
  const SeenSpan alphas = seen_span(run.samples, &Sample::alpha);
  std::array<std::optional<LoadByPlace>, 2> first;
  for (const Stroke& stroke : run.strokes) {
    const LoadByPlace loads = load_by_place(run, stroke, alphas);
    std::optional<LoadByPlace>& other = first[stroke.direction > 0 ? 0 : 1];
    if (!other) other = loads;
    for (std::size_t i = 0; i < loads.size(); ++i) {
      if (loads[i] && (*other)[i] && std::abs(*loads[i] - *(*other)[i]) > levels.width) return false;
    }
  }
  return true;
}

// ---- cutting --------------------------------------------------------------------------------------------------------

class Cutter {
 public:
  Cutter(const Run& run, const std::vector<Hold>& holds)
      : run_(run),
        holds_(holds),
        levels_(levels_of(run)),
        ramps_(levels_ && !is_bound_to_place(run, *levels_)),
        steps_(ramps_ || run.strokes.size() < 3) {}

  std::vector<Stretch> cut() {
    for (std::size_t s = 0; s < run_.strokes.size(); ++s) cut_stroke(s);
    return std::move(stretches_);
  }

 private:
  void cut_stroke(std::size_t s) {
    const Stroke& stroke = run_.strokes[s];
    std::size_t from = stroke.first;
    for (; next_hold_ < holds_.size() && holds_[next_hold_].first <= stroke.last; ++next_hold_) {
      const Hold& hold = holds_[next_hold_];
      const Hold inside{std::max(hold.first, stroke.first), std::min(hold.last, stroke.last)};
      if (inside.last < inside.first) continue;
      if (inside.first > from) add_moving(s, {from, inside.first - 1});
      add_held(s, inside);
      from = inside.last + 1;
      if (hold.last > stroke.last) break;  // the rest is the next stroke's
    }
    if (from <= stroke.last) add_moving(s, {from, stroke.last});
  }

  void add(std::size_t stroke, const Hold& rows, bool held, int pull) {
    stretches_.push_back({rows.first, rows.last, stroke, held, pull});
  }

  void add_moving(std::size_t stroke, const Hold& rows) {
    if (count_of(rows) < k_fewest_of_a_shape &&
        count_of(rows) == count_of({run_.strokes[stroke].first, run_.strokes[stroke].last})) {
      for (std::size_t i = rows.first; i <= rows.last; ++i) add(stroke, {i, i}, true, 0);
      return;
    }
    for (const Hold& piece : moving_pieces(rows)) add(stroke, piece, false, 0);
  }

  std::vector<Hold> moving_pieces(const Hold& rows) const {
    if (!levels_) return {rows};
    if (steps_ && is_stepped(run_, rows)) return pieces_of(run_, rows, levels_->width, k_fewest_of_a_shape);
    return ramps_ ? pieces_of(run_, rows, k_piece_of_ramp * levels_->span, k_fewest_of_a_shape)
                  : std::vector<Hold>{rows};
  }

  void add_held(std::size_t stroke, const Hold& rows) {
    if (!levels_) return add(stroke, rows, true, 0);
    double before = 0;
    for (const Hold& piece : pieces_of(run_, rows, levels_->width, k_fewest_held)) {
      const double load = mean_of(run_.samples, &Sample::load, piece);
      add(stroke, piece, true, piece.first == rows.first ? 0 : load > before ? 1 : -1);
      before = load;
    }
  }

  const Run& run_;
  const std::vector<Hold>& holds_;
  std::optional<Levels> levels_;
  bool ramps_ = false;  ///< slow changes of the load are the load's own and not the place's
  bool steps_ = false;  ///< so are sudden ones; of a stroke each way nothing says that they belong to the place
  std::size_t next_hold_ = 0;
  std::vector<Stretch> stretches_;
};

}  // namespace

std::vector<Hold> holds_in(const std::vector<Sample>& samples, double alpha_quantum) {
  if (samples.size() < k_fewest_held) return {};
  const double step = sensor_step(samples, alpha_quantum);
  for (const double noise : {noise_of(samples, &Sample::alpha), noise_of_stands(samples, &Sample::alpha)}) {
    std::vector<Hold> holds = standing(samples, step, noise);
    std::size_t rows = 0;
    for (const Hold& hold : holds) rows += count_of(hold);
    if (2 * rows >= samples.size() && !goes_on_meanwhile(samples, holds)) return holds;
  }
  return {};
}

double quantum_beside(const std::vector<Hold>& holds, const std::vector<Sample>& samples, double Sample::*angle,
                      double quantum) {
  return holds.empty() || k_steps_of_a_sensor * quantum < seen_span(samples, angle).size() ? quantum : 0;
}

std::vector<Sample> settled(std::vector<Sample> samples, const std::vector<Hold>& holds) {
  for (const Hold& hold : holds) {
    const double alpha = mean_of(samples, &Sample::alpha, hold);
    for (std::size_t i = hold.first; i <= hold.last; ++i) samples[i].alpha = alpha;
  }
  return samples;
}

bool has_levels_of_load(const Run& run) { return levels_of(run).has_value(); }

std::vector<Stretch> cut_stretches(const Run& run, const std::vector<Hold>& holds) { return Cutter(run, holds).cut(); }

std::vector<Stretch> stretches_of(const Run& run) {
  if (!run.stretches.empty()) return run.stretches;
  std::vector<Stretch> whole;
  for (std::size_t s = 0; s < run.strokes.size(); ++s)
    whole.push_back({run.strokes[s].first, run.strokes[s].last, s, false, 0});
  return whole;
}

bool is_from_point_to_point(const Run& run) {
  return std::any_of(run.stretches.begin(), run.stretches.end(), [](const Stretch& stretch) { return stretch.held; });
}

}  // namespace fusee
