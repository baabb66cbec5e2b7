#include "measurement/strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "fusee/base.h"

namespace fusee::measurement {
namespace {

/// Return of α from its extreme that counts as a reversal, rad. `has_dwells`: α is constant in most rows.
double reversal_threshold(const std::vector<Sample>& samples, double quantum, bool has_dwells) {
  double least = samples.front().alpha, most = least;
  for (const Sample& sample : samples) {
    least = std::min(least, sample.alpha);
    most = std::max(most, sample.alpha);
  }
  const double noise = has_dwells ? noise_of_dwells(samples, &Sample::alpha) : noise_of(samples, &Sample::alpha);
  return std::min(std::max({0.01 * (most - least), 2.5 * quantum, 5.0 * noise}), 0.25 * (most - least));
}

/// True for scatter about one angle: successive values are independent, and the steps are below a degree rms
/// or hardly correlated with those of θ. Alternation between two ends, row by row, is a motion. Independence is tested
/// by the von Neumann ratio, the mean square step over the variance: it is 2 for white noise, and at least 1 counts as
/// independent.
bool only_jitters(const std::vector<Sample>& samples) {
  const double n = static_cast<double>(samples.size());
  double mean = 0, variance = 0;                         // of α
  double steps = 0, steps_of_theta = 0, covariance = 0;  // mean squares of the steps of α and θ, and their mean product
  for (const Sample& sample : samples) mean += sample.alpha / n;
  for (const Sample& sample : samples) variance += (sample.alpha - mean) * (sample.alpha - mean) / n;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double alpha = samples[i].alpha - samples[i - 1].alpha, theta = samples[i].theta - samples[i - 1].theta;
    steps += alpha * alpha / (n - 1);
    steps_of_theta += theta * theta / (n - 1);
    covariance += alpha * theta / (n - 1);
  }
  const bool joint_follows =
      steps > radians(1.0) * radians(1.0) && covariance * covariance > 0.8 * steps * steps_of_theta;
  return steps >= variance && !joint_follows;
}

/// One flag for each of `count` rows: true for the given rows.
std::vector<bool> flags_of(const std::vector<std::size_t>& rows, std::size_t count) {
  std::vector<bool> flags(count, false);
  for (const std::size_t row : rows) flags[row] = true;
  return flags;
}

class StrokeSplitter {
 public:
  StrokeSplitter(const std::vector<Sample>& samples, double threshold, std::vector<bool> follows_gap)
      : samples_(samples), threshold_(threshold), follows_gap_(std::move(follows_gap)) {}

  std::vector<Stroke> split() {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (follows_gap_[i]) {
        close(i - 1);
        begin(i);
      }
      take(i);
    }
    close(samples_.size() - 1);
    return std::move(strokes_);
  }

 private:
  void begin(std::size_t at) {
    first_ = high_ = low_ = at;
    direction_ = 0;
  }

  void take(std::size_t i) {
    const double alpha = samples_[i].alpha;
    // The last sample of a dwell at the extreme belongs to the stroke that led there.
    if (alpha >= samples_[high_].alpha) high_ = i;
    if (alpha <= samples_[low_].alpha) low_ = i;
    if (direction_ >= 0 && samples_[high_].alpha - alpha > threshold_) {
      turn(high_, i, -1);
    } else if (direction_ <= 0 && alpha - samples_[low_].alpha > threshold_) {
      turn(low_, i, 1);
    }
  }

  /// Ends the stroke at its extreme. If the direction was not known yet, the rows before the extreme are a stroke of
  /// their own only if they moved by the threshold.
  void turn(std::size_t extreme, std::size_t now, int direction) {
    if (direction_ != 0) {
      close(extreme);
      first_ = extreme + 1;
    } else if (extreme > first_ && std::abs(samples_[extreme].alpha - samples_[first_].alpha) > threshold_) {
      direction_ = -direction;
      close(extreme);
      first_ = extreme + 1;
    }
    direction_ = direction;
    high_ = low_ = now;
  }

  void close(std::size_t last) {
    if (direction_ == 0 || last < first_) return;
    Stroke stroke;
    stroke.first = first_;
    stroke.last = last;
    stroke.direction = direction_;
    stroke.partial = first_ > 0 && follows_gap_[first_];
    strokes_.push_back(stroke);
  }

  const std::vector<Sample>& samples_;
  double threshold_;
  std::vector<bool> follows_gap_;  ///< α moved unlogged before the row
  std::vector<Stroke> strokes_;
  std::size_t first_ = 0;           ///< row of the current stroke
  std::size_t high_ = 0, low_ = 0;  ///< rows of the largest and smallest α since the last reversal
  int direction_ = 0;               ///< 0 until α has moved by the threshold
};

/// True if a stroke begins where another stroke of its direction begins: then it is complete, although no stroke is
/// before it.
bool begins_at_reversal(const std::vector<Sample>& samples, const std::vector<Stroke>& strokes, std::size_t stroke,
                        double threshold) {
  const double start = samples[strokes[stroke].first].alpha;
  for (std::size_t i = 1; i < strokes.size(); ++i) {
    if (i == stroke || strokes[i].direction != strokes[stroke].direction || strokes[i].partial) continue;
    // The row at the reversal belongs to the stroke before.
    return std::abs(samples[strokes[i].first - 1].alpha - start) <= 3 * threshold;
  }
  // A single stroke each way is complete if the return ends where it began.
  return strokes.size() == 2 && std::abs(samples[strokes.back().last].alpha - start) <= 3 * threshold;
}

/// θ of a stroke at α, linear between rows; NaN outside the stroke.
double theta_at(const std::vector<Sample>& samples, const Stroke& stroke, double alpha) {
  for (std::size_t i = stroke.first; i < stroke.last; ++i) {
    const Sample &one = samples[i], &next = samples[i + 1];
    if (std::min(one.alpha, next.alpha) > alpha || std::max(one.alpha, next.alpha) < alpha) continue;
    const double step = next.alpha - one.alpha;
    return step == 0 ? one.theta : one.theta + (alpha - one.alpha) / step * (next.theta - one.theta);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Sums of squares over a third of a stroke: its deviation from the mean of its repeats, and their range.
struct Departure {
  double deviation = 0;
  double range = 0;

  void add(double theta, const std::vector<double>& repeats) {
    if (repeats.size() < 2 || !std::isfinite(theta)) return;
    const auto [least, most] = std::minmax_element(repeats.begin(), repeats.end());
    const double mean = std::accumulate(repeats.begin(), repeats.end(), 0.0) / static_cast<double>(repeats.size());
    deviation += (theta - mean) * (theta - mean);
    range += (*most - *least) * (*most - *least);
  }
};

/// True if play or friction was in another state before the log. Then the first stroke begins apart from at least two
/// repeats, by three times their range, and ends at most half as far apart.
bool begins_in_another_state(const std::vector<Sample>& samples, const std::vector<Stroke>& strokes) {
  constexpr int thirds = 3, places_a_third = 8;
  constexpr double least_departure = 3.0;    // in ranges of the repeats
  constexpr double largest_remainder = 0.5;  // at the end, as a share of the departure at the beginning
  const Stroke& first = strokes.front();
  const double from = samples[first.first].alpha, travel = samples[first.last].alpha - from;
  std::array<Departure, thirds> departures;
  for (int i = 0; i < thirds * places_a_third; ++i) {
    const double alpha = from + travel * (i + 0.5) / (thirds * places_a_third);
    std::vector<double> repeats;
    for (std::size_t s = 1; s < strokes.size(); ++s) {
      if (strokes[s].direction != first.direction || strokes[s].partial) continue;
      if (const double theta = theta_at(samples, strokes[s], alpha); std::isfinite(theta)) repeats.push_back(theta);
    }
    departures[static_cast<std::size_t>(i / places_a_third)].add(theta_at(samples, first, alpha), repeats);
  }
  const Departure &begin = departures.front(), &end = departures.back();
  return begin.deviation > least_departure * least_departure * begin.range &&
         end.deviation < largest_remainder * largest_remainder * begin.deviation;
}

}  // namespace

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Second differences of white noise have √6 of its standard deviation. The median magnitude of a normal distribution is
// 0.6745 of its standard deviation.
double white_noise_of(std::vector<double> second_differences) {
  return median_of(std::move(second_differences)) / (0.6745 * std::sqrt(6.0));
}

double noise_of(const std::vector<Sample>& samples, double Sample::*value) {
  std::vector<double> second_differences;
  for (std::size_t i = 2; i < samples.size(); ++i)
    second_differences.push_back(std::abs(samples[i].*value - 2 * samples[i - 1].*value + samples[i - 2].*value));
  return white_noise_of(std::move(second_differences));
}

double noise_of_dwells(const std::vector<Sample>& samples, double Sample::*value) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) steps.push_back(std::abs(samples[i].*value - samples[i - 1].*value));
  return median_of(std::move(steps)) / (0.6745 * std::sqrt(2.0));  // first differences have √2 of the deviation
}

std::vector<std::size_t> gaps_in(const std::vector<Sample>& samples, bool has_time) {
  if (samples.size() < 3) return {};
  std::vector<double> times, moves;  // from row to row: s, rad
  double least = samples.front().alpha, most = least;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (has_time) times.push_back(samples[i].time - samples[i - 1].time);
    moves.push_back(std::abs(samples[i].alpha - samples[i - 1].alpha));
    least = std::min(least, samples[i].alpha);
    most = std::max(most, samples[i].alpha);
  }
  const double shortest_pause = 20 * median_of(times);
  std::vector<double> sorted = moves;
  const auto large_move = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 19 / 20);  // 95th percentile
  std::nth_element(sorted.begin(), large_move, sorted.end());
  const double least_move = 0.02 * (most - least), jump = 5 * *large_move;
  std::vector<std::size_t> gaps;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const bool paused = has_time && times[i - 1] > shortest_pause;
    const bool moved_unlogged = moves[i - 1] > least_move && (paused || moves[i - 1] > jump);
    if (samples[i].after_break || moved_unlogged) gaps.push_back(i);
  }
  return gaps;
}

std::vector<Stroke> split_strokes(const std::vector<Sample>& samples, const std::vector<RowRange>& dwells,
                                  double alpha_quantum, bool has_time) {
  // A point-to-point log is a motion even if the joint does not follow.
  if (samples.size() < 3 || (dwells.empty() && only_jitters(samples))) return {};
  const double threshold = reversal_threshold(samples, alpha_quantum, !dwells.empty());
  if (!(threshold > 0)) return {};
  const std::vector<std::size_t> gaps = dwells.empty() ? gaps_in(samples, has_time) : std::vector<std::size_t>{};
  const std::vector<Sample> averaged = with_mean_alpha_in_dwells(samples, dwells);
  std::vector<Stroke> strokes = StrokeSplitter(averaged, threshold, flags_of(gaps, samples.size())).split();
  if (strokes.empty()) return strokes;
  // In a point-to-point log the play is known from the second dwell on, wherever the first one is.
  strokes.front().partial =
      dwells.empty() && (strokes.front().partial || !begins_at_reversal(samples, strokes, 0, threshold) ||
                         begins_in_another_state(samples, strokes));
  for (std::size_t i = 1; i < strokes.size(); ++i) {
    if (strokes[i].partial && samples[strokes[i].first].after_break)
      strokes[i].partial = !begins_at_reversal(samples, strokes, i, threshold);
  }
  // A cycle begins with each stroke in the direction of the first complete stroke.
  const std::size_t first = strokes.front().partial && strokes.size() > 1 ? 1 : 0;
  int cycle = -1;
  for (std::size_t i = first; i < strokes.size(); ++i) {
    if (strokes[i].direction == strokes[first].direction) ++cycle;
    strokes[i].cycle = cycle;
  }
  return strokes;
}

}  // namespace fusee::measurement
