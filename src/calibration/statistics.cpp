#include "calibration/statistics.h"

#include <map>
#include <numeric>
#include <tuple>

#include "calibration/thresholds.h"

namespace fusee {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / std::max(1.0, static_cast<double>(values.size()));
}

/// One-sided 95 % of Student's t.
double t95(double degrees_of_freedom) {
  const double n = std::max(1.0, degrees_of_freedom);
  if (n < 1.5) return 6.31;
  if (n < 2.5) return 2.92;
  const double z = 1.6449;
  return z + (z * z * z + z) / (4.0 * n) + (5.0 * std::pow(z, 5) + 16.0 * z * z * z + 3.0 * z) / (96.0 * n * n);
}

/// Infinite of a single value.
double standard_error_of(const std::vector<double>& values, double mean) {
  const double n = static_cast<double>(values.size());
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return n > 1 ? std::sqrt(squares / (n - 1.0) / n) : std::numeric_limits<double>::infinity();
}

double t_of(double mean, double standard_error) { return standard_error > 0 ? mean / standard_error : 0.0; }

double t_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  return t_of(mean, standard_error_of(values, mean));
}

}  // namespace

Comparison compare(const Evidence& evidence, const Fit& worse, const Fit& better) {
  std::vector<double> drops;
  std::map<std::size_t, std::vector<double>> by_run;
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b) {
    const double drop = worse.by_factor.by_block[b] - better.by_factor.by_block[b];
    if (!std::isfinite(drop)) continue;
    drops.push_back(drop);
    by_run[evidence.blocks[b].run].push_back(drop);
  }
  Comparison comparison;
  comparison.mean = mean_of(drops);
  comparison.standard_error = standard_error_of(drops, comparison.mean);
  comparison.t = t_of(comparison.mean, comparison.standard_error);
  comparison.needed_t = t95(static_cast<double>(drops.size()) - 1.0);
  std::vector<double> runs;
  for (const auto& [run, values] : by_run) runs.push_back(mean_of(values));
  comparison.t_over_runs = runs.size() > 2 ? t_of(runs) : comparison.t;
  return comparison;
}

bool as_good(const Evidence& evidence, const Fit& rival, const Fit& best) {
  if (rival.against_readings > best.against_readings + k_thresholds.contradicted) return false;
  const Comparison worse = compare(evidence, rival, best);
  return worse.mean <= std::max(worse.standard_error, std::pow(k_thresholds.least_drop * evidence.floor, 2));
}

double bic_drop(const Evidence& evidence, const Fit& worse, const Fit& better) {
  const double r = std::clamp(lag_one_correlation(evidence, better), 0.0, 0.999);
  const double rows = static_cast<double>(evidence.rows_used());
  const double independent = std::max(rows * (1.0 - r) / (1.0 + r), static_cast<double>(evidence.blocks.size()));
  const double more = static_cast<double>(better.x.size() - worse.x.size());
  return independent * std::log(worse.mean_square / better.mean_square) - more * std::log(independent);
}

double lag_one_correlation(const Evidence& evidence, const Fit& fit) {
  double products = 0;
  double squares = 0;
  for (const Block& block : evidence.blocks) {
    for (std::size_t i = 0; i < block.rows.size(); ++i) {
      const double r = fit.residual[static_cast<Eigen::Index>(block.rows[i])];
      squares += r * r;
      if (i > 0) products += r * fit.residual[static_cast<Eigen::Index>(block.rows[i - 1])];
    }
  }
  return squares > 0 ? products / squares : 0.0;
}

namespace {

/// Sums of squares of a residual about the means of its strokes.
struct Within {
  std::map<std::tuple<std::size_t, int, std::size_t>, std::vector<double>> means;  ///< run, direction, Block::alike
  double squares = 0;
  double products = 0;  ///< of neighbours
  double rows = 0;
};

Within within_strokes(const Evidence& evidence, const Fit& fit) {
  Within sums;
  for (const Block& block : evidence.blocks) {
    double mean = 0;
    for (const std::size_t row : block.rows)
      mean += fit.residual[static_cast<Eigen::Index>(row)] / static_cast<double>(block.rows.size());
    const int direction = evidence.measurement.runs[block.run].strokes[block.stroke].direction;
    sums.means[{block.run, direction, block.alike}].push_back(mean);
    double last = 0;
    for (const std::size_t row : block.rows) {
      const double deviation = fit.residual[static_cast<Eigen::Index>(row)] - mean;
      sums.squares += deviation * deviation;
      sums.products += deviation * last;
      last = deviation;
    }
    sums.rows += static_cast<double>(block.rows.size());
  }
  return sums;
}

struct VarianceOfMeans {
  double variance = 0;
  double freedom = 0;
};

/// Mean square of means about those that are alike; zero where no stroke has a like.
VarianceOfMeans variance_of_means(const Within& sums) {
  double between = 0;
  double freedom = 0;
  for (const auto& [key, means] : sums.means) {
    const double centre = mean_of(means);
    for (const double mean : means) between += (mean - centre) * (mean - centre);
    freedom += static_cast<double>(means.size()) - 1.0;
  }
  return {freedom > 0 ? between / freedom : 0.0, freedom};
}

}  // namespace

StrokeScatter stroke_scatter(const Evidence& evidence, const Fit& fit) {
  const Within sums = within_strokes(evidence, fit);
  StrokeScatter scatter;
  scatter.within = sums.rows > 0 ? std::sqrt(sums.squares / sums.rows) : 0.0;
  const double colour = sums.squares > 0 ? std::clamp(sums.products / sums.squares, 0.0, 0.95) : 0.0;
  const double rows_a_stroke = sums.rows / static_cast<double>(std::max<std::size_t>(1, evidence.blocks.size()));
  const double of_noise =
      scatter.within * scatter.within * (1.0 + colour) / (1.0 - colour) / std::max(1.0, rows_a_stroke);
  const VarianceOfMeans means = variance_of_means(sums);
  // Few means of few rows differ by more than that now and then: three standard errors of a variance.
  const double by_chance = of_noise * (1.0 + 3.0 * std::sqrt(2.0 / std::max(1.0, means.freedom)));
  if (means.variance > by_chance) scatter.between = std::sqrt(means.variance - of_noise);
  return scatter;
}

bool is_walking(const StrokeScatter& scatter) { return scatter.between > k_thresholds.walks * scatter.within; }

}  // namespace fusee
