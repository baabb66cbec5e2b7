#include "calibration/starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace fusee::calibration {
namespace {

constexpr std::size_t k_slip_times = 4;
/// Times at which a step is tested.
constexpr std::size_t k_tried_times = 96;

/// Times of the rows in use, by the bench's clock.
std::vector<double> times_of_rows(const Evidence& evidence) {
  std::vector<double> all, used;
  const std::vector<double> clock = joint::bench_clock(evidence.log);
  for (std::size_t i = 0; i < evidence.measurement.runs.size(); ++i) {
    for (const measurement::Sample& sample : evidence.measurement.runs[i].samples)
      all.push_back(clock[i] + sample.time);
  }
  for (const Eigen::Index row : evidence.rows()) used.push_back(all[static_cast<std::size_t>(row)]);
  return used;
}

/// Times halfway between rows, spread evenly over the rows.
std::vector<double> times_to_try(std::vector<double> rows) {
  std::sort(rows.begin(), rows.end());
  const std::size_t count = std::min(rows.size(), k_tried_times + 1);
  std::vector<double> times;
  for (std::size_t k = 1; k < count; ++k) {
    const std::size_t i = k * rows.size() / count;
    if (rows[i - 1] < rows[i]) times.push_back(0.5 * (rows[i - 1] + rows[i]));
  }
  return times;
}

/// Times ordered by the evidence of a step of any size at each, beside the base and the discrepancy; likeliest first.
std::vector<double> by_evidence(const Evidence& evidence, const Fit& base, const std::vector<double>& times) {
  const std::vector<double> rows = times_of_rows(evidence);
  Tangent tangent = tangent_of(evidence, base);
  const Eigen::Index own = tangent.x.size();
  const auto count = static_cast<Eigen::Index>(times.size());
  tangent.J.conservativeResize(Eigen::NoChange, own + count);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (Eigen::Index i = 0; i < tangent.J.rows(); ++i)
      tangent.J(i, own + k) = rows[static_cast<std::size_t>(i)] > times[static_cast<std::size_t>(k)] ? 1.0 : 0.0;
  }
  add_numbers(Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity()), tangent);
  const TangentSums sums = evidence.evidence_model->sums_of(tangent);
  const Amplitudes& amplitudes = base.posterior.amplitudes;
  const ReducedTangent reduced =
      evidence.evidence_model->reduced(sums, evidence.evidence_model->sized(amplitudes, sums.deflection_ratio));
  std::vector<Eigen::Index> columns(static_cast<std::size_t>(own) + 1);
  std::iota(columns.begin(), columns.end(), 0);
  std::vector<std::pair<double, double>> likely;
  for (Eigen::Index k = 0; k < count; ++k) {
    columns.back() = own + k;
    likely.emplace_back(-log_evidence_of(reduced, columns), times[static_cast<std::size_t>(k)]);
  }
  std::sort(likely.begin(), likely.end());
  std::vector<double> ordered;
  for (const auto& [evidence_lost, time] : likely) ordered.push_back(time);
  return ordered;
}

std::vector<double> steps_in_time(const Evidence& evidence, const Fit& base) {
  std::vector<double> times;
  const std::vector<double> tried = times_to_try(times_of_rows(evidence));
  if (tried.empty()) return times;
  const double spacing = 0.02 * (tried.back() - tried.front());
  for (const double time : by_evidence(evidence, base, tried)) {
    const bool new_place =
        std::none_of(times.begin(), times.end(), [&](double other) { return std::abs(other - time) < spacing; });
    if (new_place) times.push_back(time);
    if (times.size() == k_slip_times) break;
  }
  return times;
}

}  // namespace

std::vector<std::vector<double>> starts_of(const Evidence& evidence, const Fit& base, const fusee::Effect& effect) {
  std::vector<std::vector<double>> starts = effect.starts;
  if (effect.starts_in_time) {
    for (const double time : steps_in_time(evidence, base)) {
      for (const double size : {0.0, 10.0, -10.0, 50.0, -50.0})
        starts.push_back({size * effect.parameters.front().step, time});
    }
  }
  if (!is_searched(effect)) starts.insert(starts.begin(), std::vector<double>(effect.parameters.size(), 0.0));
  return starts;
}

std::vector<std::vector<double>> starts_that_differ(const Evidence& evidence, const Fit& base,
                                                    const fusee::Effect& effect) {
  std::vector<std::vector<double>> starts = starts_of(evidence, base, effect);
  if (effect.starts_in_time) std::erase_if(starts, [](const std::vector<double>& start) { return start.front() != 0; });
  return starts;
}

}  // namespace fusee::calibration
