#include "measurement/clock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "measurement/row_reader.h"
#include "measurement/strokes.h"

namespace fusee::measurement {
namespace {

constexpr double k_no_time = std::numeric_limits<double>::quiet_NaN();
/// Periods of overflowing counters, s: microseconds, milliseconds and nanoseconds of 32 bits; milliseconds and
/// microseconds of 16 bits; microseconds and milliseconds of 31 bits; a day, half a day, an hour.
constexpr std::array k_periods = {4294.967296, 4294967.296, 4.294967296, 65.536,  0.065536,
                                  2147.483648, 2147483.648, 86400.0,     43200.0, 3600.0};
/// Longest sequence of late rows. If more rows are below the latest time, the clock was set back.
constexpr std::size_t k_most_late_rows = 3;

void drop_time(Run& run) {
  run.has_time = false;
  for (Sample& sample : run.samples) sample.time = k_no_time;
}

std::string times_text(std::size_t count) { return std::to_string(count) + (count == 1 ? " time" : " times"); }

/// Interpolates missing times; false if more than one in ten rows, or an end, has none.
bool fill_time(std::vector<Sample>& samples, const NoteSink& add_note) {
  const auto has_no_time = [](const Sample& sample) { return std::isnan(sample.time); };
  const auto lost = static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), has_no_time));
  if (lost == 0) return true;
  if (10 * lost > samples.size() || has_no_time(samples.front()) || has_no_time(samples.back())) {
    add_note(rows_text(lost) + " without a time: time is not used");
    return false;
  }
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (!has_no_time(samples[i])) continue;
    std::size_t next = i;
    while (has_no_time(samples[next])) ++next;
    samples[i].time =
        samples[i - 1].time + (samples[next].time - samples[i - 1].time) / static_cast<double>(next - i + 1);
  }
  add_note(rows_text(lost) + " without a time: interpolated");
  return true;
}

/// Joins the pieces of a clock that overflows, restarts or is delivered late.
class ClockJoiner {
 public:
  explicit ClockJoiner(std::vector<Sample>& samples) : samples_(samples) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!std::isnan(samples[i].time)) rows_.push_back(i);
    }
    std::vector<double> steps;
    for (std::size_t k = 1; k < rows_.size(); ++k) {
      if (const double step = time(k) - time(k - 1); step > 0) steps.push_back(step);
    }
    usual_step_ = median_of(std::move(steps));
  }

  /// False if the clock goes back so often that it is no clock.
  bool join(const NoteSink& add_note) {
    if (rows_.empty()) return true;
    std::vector<double> joined(rows_.size(), time(0));
    double shift = 0;       // from the logged clock to the continued one, s
    double high = time(0);  // latest logged time since the last restart or overflow
    double first = high;    // logged time at the last restart
    for (std::size_t k = 1; k < rows_.size(); ++k) {
      const bool restarts_here = samples_[rows_[k]].after_break;  // at a repeated header
      if (!restarts_here && time(k) < high) {
        if (const double period = period_over(high, time(k)); period > 0) {
          shift += period;
          ++overflows_;
        } else if (const std::size_t late = late_rows(k, first, high); late > 0) {
          for (const std::size_t end = k + late; k < end; ++k) joined[k] = time(k) + shift;
          late_count_ += late;
        } else {
          restarts_.push_back(k);
        }
      }
      if (restarts_here || (!restarts_.empty() && restarts_.back() == k)) {
        shift += high - time(k) + usual_step_;
        first = time(k);
      }
      high = time(k);
      joined[k] = high + shift;
    }
    const bool goes_back_often = 20 * restarts_.size() > rows_.size() && restarts_.size() > 1;
    if (goes_back_often) {
      add_note("the clock goes back " + times_text(restarts_.size()) + " in " + rows_text(rows_.size()) +
               ": time is not used");
      return false;
    }
    apply(joined, add_note);
    return true;
  }

 private:
  double time(std::size_t k) const { return samples_[rows_[k]].time; }

  /// Period of the counter that overflowed between two times; 0 for none. A clock of 12 hours reaches 12:59:59, 8 %
  /// beyond its period.
  double period_over(double before, double here) const {
    for (const double period : k_periods) {
      if (std::max(std::abs(before), std::abs(here)) > 1.1 * period) continue;
      const double step = here - before + period;
      if (step > 0 && step <= 3 * usual_step_) return period;
    }
    return 0;
  }

  bool same_reading(std::size_t k, std::size_t other) const {
    const Sample &one = samples_[rows_[k]], &two = samples_[rows_[other]];
    return one.alpha == two.alpha && one.theta == two.theta;
  }

  /// Number of late rows from `k` on; 0 if they are not late. After late rows the clock continues beyond `high`. Each
  /// late row lies in a gap between the times of nearby rows, or repeats the reading of one of them.
  std::size_t late_rows(std::size_t k, double first, double high) const {
    std::size_t end = k;
    while (end < rows_.size() && end < k + k_most_late_rows + 1 && !(time(end) > high)) ++end;
    if (end == rows_.size() || end > k + k_most_late_rows) return 0;
    const std::size_t begin = k > 3 * k_most_late_rows ? k - 3 * k_most_late_rows : 0;
    for (std::size_t row = k; row < end; ++row) {
      if (time(row) < first) return 0;
      for (std::size_t other = begin; other < end; ++other) {
        const bool is_near = std::abs(time(row) - time(other)) < 0.5 * usual_step_;
        if (other != row && is_near && !same_reading(row, other)) return 0;
      }
    }
    return end - k;
  }

  void apply(const std::vector<double>& joined, const NoteSink& add_note) {
    if (overflows_ > 0) add_note("the clock's counter ran over " + times_text(overflows_) + ": the time is continued");
    if (!restarts_.empty()) {
      const std::size_t k = restarts_.front();
      add_note("the clock goes back " + times_text(restarts_.size()) + ", first from " + rounded(time(k - 1)) + " to " +
               rounded(time(k)) + " s: the log restarts there, and rows keep their order");
    }
    for (const std::size_t k : restarts_) samples_[rows_[k]].after_break = true;
    for (std::size_t k = 0; k < rows_.size(); ++k) samples_[rows_[k]].time = joined[k];
    if (late_count_ == 0) return;
    add_note(rows_text(late_count_) + " delivered late, after rows of a later time: moved back between them");
    std::vector<Sample> in_order;
    for (const std::size_t row : rows_) in_order.push_back(samples_[row]);
    const auto by_time = [](const Sample& a, const Sample& b) { return a.time < b.time; };
    std::stable_sort(in_order.begin(), in_order.end(), by_time);
    for (std::size_t k = 0; k < rows_.size(); ++k) samples_[rows_[k]] = in_order[k];
  }

  std::vector<Sample>& samples_;
  std::vector<std::size_t> rows_;  ///< indices of the samples with a time
  double usual_step_ = 0;          ///< median time between rows, s
  std::size_t overflows_ = 0, late_count_ = 0;
  std::vector<std::size_t> restarts_;  ///< indices into rows_
};

Sample mean_of(const std::vector<Sample>& samples, std::size_t first, std::size_t end) {
  Sample mean = samples[first];
  for (double Sample::*value :
       {&Sample::alpha, &Sample::theta, &Sample::load, &Sample::temperature_C, &Sample::tension1, &Sample::tension2}) {
    double sum = 0;
    for (std::size_t i = first; i < end; ++i) sum += samples[i].*value / static_cast<double>(end - first);
    mean.*value = sum;
  }
  return mean;
}

/// Handles rows of equal time: a row that was logged repeatedly, or a clock coarser than the log.
void separate_equal_times(Run& run, const NoteSink& add_note) {
  std::vector<Sample>& samples = run.samples;
  std::vector<std::size_t> ticks;  // first row of each distinct time
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i == 0 || samples[i].time != samples[i - 1].time) ticks.push_back(i);
  }
  const std::size_t same = samples.size() - ticks.size();
  if (same == 0) return;
  if (ticks.size() == 1) {
    add_note("the clock stands still: time is not used");
    return drop_time(run);
  }
  const bool is_coarse = samples.size() >= 3 * ticks.size();  // three or more rows share a tick on average
  const std::vector<Sample> rows = std::move(samples);
  samples.clear();
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const std::size_t first = ticks[k], end = k + 1 < ticks.size() ? ticks[k + 1] : rows.size();
    if (!is_coarse) {
      samples.push_back(mean_of(rows, first, end));
      continue;
    }
    // The last tick is as long as the one before it.
    const double tick =
        k + 1 < ticks.size() ? rows[end].time - rows[first].time : rows[first].time - rows[ticks[k - 1]].time;
    for (std::size_t i = first; i < end; ++i) {
      samples.push_back(rows[i]);
      samples.back().time += tick * static_cast<double>(i - first) / static_cast<double>(end - first);
    }
  }
  add_note(rows_text(same) + " with the time of the preceding row: " +
           (is_coarse ? "the clock is coarser than the log, they are spread over its ticks" : "averaged"));
}

}  // namespace

void order_time(Run& run, const NoteSink& add_note) {
  if (!ClockJoiner(run.samples).join(add_note) || !fill_time(run.samples, add_note)) return drop_time(run);
  separate_equal_times(run, add_note);
}

}  // namespace fusee::measurement
