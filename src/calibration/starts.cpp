#include "calibration/starts.h"

#include <algorithm>
#include <cmath>

namespace fusee {
namespace {

constexpr std::size_t k_slip_times = 4;

/// What a fit leaves at a time of the bench's clock.
struct Left {
  double time = 0;
  double residual = 0;
};

std::vector<Left> left_in_time(const Evidence& evidence, const Fit& base) {
  std::vector<Left> rows;
  const std::vector<double> clock = bench_clock(evidence.log);
  for (std::size_t i = 0; i < evidence.measurement.runs.size(); ++i) {
    for (const Sample& sample : evidence.measurement.runs[i].samples)
      rows.push_back({clock[i] + sample.time, base.residual[static_cast<Eigen::Index>(rows.size())]});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Left& a, const Left& b) { return a.time < b.time; });
  return rows;
}

/// Rows before which a step would stand, the one first that takes most squares out.
std::vector<std::size_t> by_gain(const std::vector<Left>& rows) {
  double total = 0;
  for (const Left& row : rows) total += row.residual;
  const double count = static_cast<double>(rows.size());
  std::vector<std::pair<double, std::size_t>> gains;
  double sum = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    sum += rows[i - 1].residual;
    const double before = static_cast<double>(i);
    const double step = (total - sum) / (count - before) - sum / before;
    gains.emplace_back(-step * step * before * (count - before), i);
  }
  std::sort(gains.begin(), gains.end());
  std::vector<std::size_t> places;
  for (const auto& [gain, i] : gains) places.push_back(i);
  return places;
}

std::vector<double> steps_in_time(const Evidence& evidence, const Fit& base) {
  const std::vector<Left> rows = left_in_time(evidence, base);
  std::vector<double> times;
  for (const std::size_t i : by_gain(rows)) {
    const double time = 0.5 * (rows[i - 1].time + rows[i].time);
    const double apart = 0.02 * (rows.back().time - rows.front().time);
    const bool new_place =
        std::none_of(times.begin(), times.end(), [&](double other) { return std::abs(other - time) < apart; });
    if (new_place) times.push_back(time);
    if (times.size() == k_slip_times) break;
  }
  return times;
}

}  // namespace

std::vector<std::vector<double>> starts_of(const Evidence& evidence, const Fit& base, const Effect& effect) {
  std::vector<std::vector<double>> starts = effect.starts;
  if (effect.starts_in_time) {
    for (const double time : steps_in_time(evidence, base)) {
      for (const double size : {0.0, 10.0, -10.0, 50.0, -50.0})
        starts.push_back({size * effect.parameters.front().step, time});
    }
  }
  const bool has_searched = std::any_of(effect.parameters.begin(), effect.parameters.end(),
                                        [](const EffectParameter& p) { return p.searched; });
  if (!has_searched) starts.insert(starts.begin(), std::vector<double>(effect.parameters.size(), 0.0));
  return starts;
}

std::vector<std::vector<double>> starts_that_differ(const Evidence& evidence, const Fit& base, const Effect& effect) {
  std::vector<std::vector<double>> starts = starts_of(evidence, base, effect);
  if (effect.starts_in_time) std::erase_if(starts, [](const std::vector<double>& start) { return start.front() != 0; });
  return starts;
}

}  // namespace fusee
