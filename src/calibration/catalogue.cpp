#include "calibration/catalogue.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <vector>

#include "calibration/statistics.h"
#include "calibration/thresholds.h"
#include "joint/joint_effects.h"
#include "measurement/value_range.h"

// The known size of a number comes from all joints, also those with large errors. On a joint with a small error it
// penalises each number of an effect, so that an effect of four numbers would lose to an effect of one.

namespace fusee::calibration {
namespace {

/// Temperature range below which all data are at one temperature.
constexpr double k_least_warming = 1.0;  // K

bool all(const measurement::Measurement& measurement, bool measurement::Run::*has) {
  return std::all_of(measurement.runs.begin(), measurement.runs.end(),
                     [&](const measurement::Run& run) { return run.*has; });
}

bool has_load(const Mechanism& declared, const measurement::Measurement& measurement) {
  if (declared.load.tip_force != 0 || declared.load.torque != 0 || declared.load.mass_kg > 0 ||
      declared.spring != Spring{})
    return true;
  return std::any_of(measurement.runs.begin(), measurement.runs.end(), [](const measurement::Run& run) {
    return run.has_load && std::any_of(run.samples.begin(), run.samples.end(),
                                       [](const measurement::Sample& sample) { return std::abs(sample.load) > 0; });
  });
}

bool has_warming(const measurement::Measurement& measurement) {
  return all(measurement, &measurement::Run::has_temperature) &&
         measurement::value_range(measurement, &measurement::Sample::temperature_C).size() > k_least_warming;
}

bool can_be_seen(const Needs& needs, const Mechanism& declared, const measurement::Measurement& measurement) {
  return !(needs.time && !all(measurement, &measurement::Run::has_time)) &&
         !(needs.load && !has_load(declared, measurement)) && !(needs.temperature && !has_warming(measurement)) &&
         joint::has_part(declared, needs);
}

}  // namespace

std::vector<const fusee::Effect*> catalogue(const Mechanism& declared, const measurement::Measurement& measurement,
                                            std::span<const fusee::Effect* const> more,
                                            std::span<const std::string> without) {
  std::vector<const fusee::Effect*> all(more.begin(), more.end());
  for (const fusee::Effect& effect : effects(kind_of(declared))) {
    const auto is_replaced = [&](const fusee::Effect* other) { return other->name == effect.name; };
    if (std::none_of(more.begin(), more.end(), is_replaced)) all.push_back(&effect);
  }
  std::erase_if(all, [&](const fusee::Effect* effect) {
    return !effect->is_tested || !can_be_seen(effect->needs, declared, measurement) ||
           std::find(without.begin(), without.end(), effect->name) != without.end();
  });
  std::stable_sort(all.begin(), all.end(), [](const fusee::Effect* a, const fusee::Effect* b) {
    return std::tie(a->place, a->rank) < std::tie(b->place, b->rank);
  });
  return all;
}

namespace {

constexpr std::size_t k_slip_times = 4;
/// Times at which a step is tested over the whole session, and between the neighbours of each likely one.
constexpr std::size_t k_tried_times = 96;
constexpr std::size_t k_refined_times = 24;

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

/// At most `most` times between rows, evenly among them. `rows`: sorted.
std::vector<double> times_between(const std::vector<double>& rows, std::size_t most) {
  const std::size_t count = std::min(rows.size(), most + 1);
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
  const ReducedTangent beside =
      evidence.evidence_model->reduced(sums, evidence.evidence_model->sized(amplitudes, sums.deflection_ratio));
  std::vector<Eigen::Index> columns(static_cast<std::size_t>(own) + 1);
  std::iota(columns.begin(), columns.end(), 0);
  std::vector<std::pair<double, double>> likely;
  for (Eigen::Index k = 0; k < count; ++k) {
    columns.back() = own + k;
    likely.emplace_back(-log_evidence_of(beside, columns), times[static_cast<std::size_t>(k)]);
  }
  std::sort(likely.begin(), likely.end());
  std::vector<double> ordered;
  for (const auto& [evidence_lost, time] : likely) ordered.push_back(time);
  return ordered;
}

/// The time next to each of `times` at which a step is likeliest. Rows between the time of a step and its estimate keep
/// an error of the whole step. `rows`: sorted; `tried`: times that were tested, sorted.
std::vector<double> refined(const Evidence& evidence, const Fit& base, const std::vector<double>& rows,
                            const std::vector<double>& tried, std::vector<double> times) {
  std::vector<std::vector<double>> near;
  std::vector<double> all;
  for (const double time : times) {
    const auto at = std::lower_bound(tried.begin(), tried.end(), time);
    const double from = at == tried.begin() ? rows.front() : at[-1];
    const double until = at + 1 == tried.end() ? rows.back() : at[1];
    near.push_back(times_between(
        {std::lower_bound(rows.begin(), rows.end(), from), std::upper_bound(rows.begin(), rows.end(), until)},
        k_refined_times));
    all.insert(all.end(), near.back().begin(), near.back().end());
  }
  const std::vector<double> ordered = by_evidence(evidence, base, all);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto likeliest = std::find_first_of(ordered.begin(), ordered.end(), near[i].begin(), near[i].end());
    if (likeliest != ordered.end()) times[i] = *likeliest;
  }
  return times;
}

std::vector<double> steps_in_time(const Evidence& evidence, const Fit& base) {
  std::vector<double> rows = times_of_rows(evidence);
  std::sort(rows.begin(), rows.end());
  const std::vector<double> tried = times_between(rows, k_tried_times);
  std::vector<double> times;
  if (tried.empty()) return times;
  const double spacing = 0.02 * (tried.back() - tried.front());
  for (const double time : by_evidence(evidence, base, tried)) {
    const bool new_place =
        std::none_of(times.begin(), times.end(), [&](double other) { return std::abs(other - time) < spacing; });
    if (new_place) times.push_back(time);
    if (times.size() == k_slip_times) break;
  }
  return refined(evidence, base, rows, tried, std::move(times));
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

namespace {

/// Chords over the known sizes; empty if the joint cannot be simulated.
struct Chords {
  Parameters parameters;
  Tangent tangent;
};

}  // namespace

std::map<const EffectParameter*, double> expected_sizes(const EffectSet& catalogue, const Evidence& evidence,
                                                        FitterPool& pool) {
  std::map<const EffectParameter*, double> sizes;
  const Fit none = pool.one().fit({}, {});
  if (!none.usable) return sizes;
  const double seen = std::max(k_thresholds.most_expected * rms_of(tangent_of(evidence, none).residual),
                               k_thresholds.least_expected * evidence.floor);
  std::vector<Chords> all(catalogue.size());
  pool.each(catalogue.size(), [&](const Fitter& fitter, std::size_t i) {
    const Fit wider = fitter.add_chords(none, *catalogue[i]);
    if (wider.usable) all[i] = {wider.parameters, tangent_of(evidence, wider)};
  });
  for (const Chords& of_one : all) {
    for (Eigen::Index k = none.x.size(); k < of_one.tangent.x.size(); ++k) {
      const double size = of_one.tangent.prior[k];
      const double moved = size * rms_of(of_one.tangent.J.col(k));
      if (moved > seen) sizes[of_one.parameters[static_cast<std::size_t>(k)]] = size * seen / moved;
    }
  }
  return sizes;
}

}  // namespace fusee::calibration
