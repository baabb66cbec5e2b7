#include "calibration/statistics.h"

#include <limits>
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

double rms_of(const Eigen::VectorXd& values) {
  return values.size() > 0 ? std::sqrt(values.squaredNorm() / static_cast<double>(values.size())) : 0.0;
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
  double strokes = 0;
  double inverse_rows = 0;  ///< Σ 1 / rows of a stroke

  /// Each stroke's mean has taken one.
  double freedom() const { return rows - strokes; }
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
    sums.strokes += 1;
    sums.inverse_rows += 1.0 / static_cast<double>(block.rows.size());
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

double rarest_ratio(double upper_freedom, double lower_freedom) {
  constexpr double k_deviations = 3.0;
  const double a = 2.0 / (9.0 * std::max(1.0, upper_freedom)), b = 2.0 / (9.0 * std::max(1.0, lower_freedom));
  const double square = k_deviations * k_deviations;
  const double leading = (1.0 - b) * (1.0 - b) - square * b;
  if (leading <= 0) return std::numeric_limits<double>::infinity();
  const double half = (1.0 - a) * (1.0 - b);
  const double root = (half + std::sqrt(half * half - leading * ((1.0 - a) * (1.0 - a) - square * a))) / leading;
  return root * root * root;
}

StrokeScatter stroke_scatter(const Evidence& evidence, const Fit& fit) {
  const Within sums = within_strokes(evidence, fit);
  StrokeScatter scatter;
  if (sums.freedom() <= 0) return scatter;
  scatter.within = std::sqrt(sums.squares / sums.freedom());
  const double colour = sums.squares > 0 ? std::clamp(sums.products / sums.squares, 0.0, 0.95) : 0.0;
  const double of_noise =
      scatter.within * scatter.within * (1.0 + colour) / (1.0 - colour) * sums.inverse_rows / sums.strokes;
  const VarianceOfMeans means = variance_of_means(sums);
  if (means.variance > of_noise * rarest_ratio(means.freedom, sums.freedom()))
    scatter.between = std::sqrt(means.variance - of_noise);
  return scatter;
}

bool is_walking(const StrokeScatter& scatter) { return scatter.between > k_thresholds.walks * scatter.within; }

}  // namespace fusee
