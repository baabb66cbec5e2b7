// ISO 230-2. Notation: position i, directions ↑ and ↓; x̄ is the mean deviation at a position in a direction, s the
// standard deviation of its repeats.
//   B = max |x̄i↑ − x̄i↓|            E = max x̄ − min x̄, all positions, both directions
//   R = max over i of max[2si↑ + 2si↓ + |Bi|; 4si↑; 4si↓]
//   M = range of (x̄i↑ + x̄i↓)/2     A = max(x̄ + 2s) − min(x̄ − 2s), both directions

#include <algorithm>
#include <cmath>
#include <limits>

#include "fusee/measurement.h"

namespace fusee::measurement {
namespace {

struct Spread {
  double mean = 0;
  double deviation = 0;  ///< standard deviation; 0 for a single repeat
};

Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  const double n = static_cast<double>(values.size());
  for (const double value : values) spread.mean += value / n;
  if (values.size() < 2) return spread;
  for (const double value : values) spread.deviation += (value - spread.mean) * (value - spread.mean) / (n - 1);
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double range() const { return most >= least ? most - least : 0; }
};

/// Residual where the stroke passes `alpha`; NaN if it does not.
double residual_at(const Run& run, const Stroke& stroke, const std::vector<double>& residuals, double alpha) {
  for (std::size_t i = stroke.first; i < stroke.last; ++i) {
    const double before = run.samples[i].alpha, after = run.samples[i + 1].alpha;
    const bool are_on_one_side = (before - alpha) * (after - alpha) > 0;
    if (are_on_one_side || before == after) continue;
    return residuals[i] + (residuals[i + 1] - residuals[i]) * (alpha - before) / (after - before);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Number of positions of α at which the deviations are compared.
constexpr int k_positions = 21;

/// α of a position as a share of the range of α: evenly from 5 % to 95 %.
double share_of(int position) { return 0.05 + 0.9 * position / (k_positions - 1); }

/// `deviations[i][d][k]`, rad: position i, direction d (0 up, 1 down), repeat k.
using Deviations = std::vector<std::array<std::vector<double>, 2>>;

/// Adds the mean of each dwell to the position nearest to it.
void add_dwells(const Run& run, const std::vector<double>& residuals, const Extent& alphas, Deviations& deviations) {
  for (const Segment& segment : run.segments) {
    const Stroke& stroke = run.strokes[segment.stroke];
    if (!segment.is_dwell || stroke.partial) continue;
    std::vector<double> rows(residuals.begin() + static_cast<std::ptrdiff_t>(segment.first),
                             residuals.begin() + static_cast<std::ptrdiff_t>(segment.last) + 1);
    std::erase_if(rows, [](double value) { return !std::isfinite(value); });
    const double mean = spread_of(rows).mean;
    const double share = (run.samples[segment.first].alpha - alphas.least) / alphas.range();
    const long nearest = std::lround((share - share_of(0)) / (share_of(1) - share_of(0)));
    const auto position = static_cast<std::size_t>(std::clamp(nearest, 0L, k_positions - 1L));
    if (std::isfinite(mean)) deviations[position][stroke.direction > 0 ? 0 : 1].push_back(mean);
  }
}

}  // namespace

Iso230 iso230(const std::vector<std::array<std::vector<double>, 2>>& deviations) {
  Iso230 figures;
  Extent systematic, mean, accuracy;
  for (const auto& position : deviations) {
    if (position[0].empty() || position[1].empty()) continue;
    const Spread up = spread_of(position[0]), down = spread_of(position[1]);
    const double reversal = std::abs(up.mean - down.mean);
    figures.B = std::max(figures.B, reversal);
    figures.R =
        std::max({figures.R, 2 * up.deviation + 2 * down.deviation + reversal, 4 * up.deviation, 4 * down.deviation});
    for (const Spread& spread : {up, down}) {
      systematic.add(spread.mean);
      accuracy.add(spread.mean + 2 * spread.deviation);
      accuracy.add(spread.mean - 2 * spread.deviation);
    }
    mean.add(0.5 * (up.mean + down.mean));
  }
  figures.E = systematic.range();
  figures.M = mean.range();
  figures.A = accuracy.range();
  return figures;
}

Iso230 iso230(const Measurement& measurement, const std::vector<std::vector<double>>& residuals) {
  // Positions cover the range of all strokes. The range common to all could be empty because of one short stroke.
  Extent alphas;
  for (const Run& run : measurement.runs) {
    for (const Stroke& stroke : run.strokes) {
      if (stroke.partial) continue;
      alphas.add(run.samples[stroke.first].alpha);
      alphas.add(run.samples[stroke.last].alpha);
    }
  }
  if (!(alphas.range() > 0)) return {};
  Deviations deviations(k_positions);
  for (std::size_t r = 0; r < measurement.runs.size() && r < residuals.size(); ++r) {
    const Run& run = measurement.runs[r];
    if (residuals[r].size() != run.samples.size()) continue;
    if (is_from_point_to_point(run)) add_dwells(run, residuals[r], alphas, deviations);
    for (const Stroke& stroke : run.strokes) {
      if (stroke.partial || is_from_point_to_point(run)) continue;
      for (int i = 0; i < k_positions; ++i) {
        const double alpha = alphas.least + alphas.range() * share_of(i);
        const double value = residual_at(run, stroke, residuals[r], alpha);
        if (std::isfinite(value))
          deviations[static_cast<std::size_t>(i)][stroke.direction > 0 ? 0 : 1].push_back(value);
      }
    }
  }
  return iso230(deviations);
}

}  // namespace fusee::measurement
