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

}  // namespace

bool as_good(const Evidence&, const Fit& rival, const Fit& best) {
  return rival.log_evidence > best.log_evidence - k_thresholds.as_good;
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
