#include "calibration/statistics.h"

#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "calibration/thresholds.h"

namespace fusee::calibration {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / std::max(1.0, static_cast<double>(values.size()));
}

}  // namespace

double equally_likely() { return -elementary::log(k_thresholds.most_false_positives); }

bool is_as_good(const Fit& rival, const Fit& best) { return rival.log_evidence > best.log_evidence - equally_likely(); }

double rms_of(const Eigen::VectorXd& values) {
  return values.size() > 0 ? std::sqrt(values.squaredNorm() / static_cast<double>(values.size())) : 0.0;
}

Eigen::VectorXd alphas(const measurement::Measurement& measurement) {
  std::vector<double> all;
  for (const measurement::Run& run : measurement.runs) {
    for (const measurement::Sample& sample : run.samples) all.push_back(sample.alpha);
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

double lag_one_correlation(const Evidence& evidence, const Eigen::VectorXd& residual) {
  double products = 0;
  double squares = 0;
  Eigen::Index row = 0;
  for (const Block& block : evidence.blocks) {
    for (std::size_t i = 0; i < block.rows.size(); ++i, ++row) {
      squares += residual[row] * residual[row];
      if (i > 0) products += residual[row] * residual[row - 1];
    }
  }
  return squares > 0 ? products / squares : 0.0;
}

namespace {

using Alike = std::tuple<std::size_t, int, std::size_t>;  ///< run, direction, Block::alike

/// Mean or tilt of each stroke, and the residual about it.
struct StrokeResiduals {
  std::map<Alike, std::vector<double>> numbers;
  double squares = 0;
  double products = 0;  ///< sum of products of neighbours
  double freedom = 0;   ///< rows minus fitted numbers
  double strokes = 0;
  double inverse_rows = 0;  ///< Σ 1 / rows of a stroke

  /// `about`: residual of a stroke, of which `taken` degrees of freedom are fitted.
  void add(const Alike& of, double number, const Eigen::VectorXd& about, double taken) {
    numbers[of].push_back(number);
    squares += about.squaredNorm();
    products += about.head(about.size() - 1).dot(about.tail(about.size() - 1));
    const auto count = static_cast<double>(about.size());
    freedom += count - taken;
    strokes += 1;
    inverse_rows += 1.0 / count;
  }

  double mean_square() const { return squares / freedom; }
  /// Variance of a stroke's number by noise alone.
  double of_noise() const {
    const double colour = squares > 0 ? std::clamp(products / squares, 0.0, 0.95) : 0.0;
    return mean_square() * (1.0 + colour) / (1.0 - colour) * inverse_rows / strokes;
  }
};

struct VarianceOfNumbers {
  double variance = 0;
  double freedom = 0;
};

/// Variance of numbers about the mean of their kind; 0 if no stroke repeats.
VarianceOfNumbers variance_of_numbers(const StrokeResiduals& sums) {
  double between = 0;
  double freedom = 0;
  for (const auto& [key, numbers] : sums.numbers) {
    const double centre = mean_of(numbers);
    for (const double number : numbers) between += (number - centre) * (number - centre);
    freedom += static_cast<double>(numbers.size()) - 1.0;
  }
  return {freedom > 0 ? between / freedom : 0.0, freedom};
}

/// rms of the numbers about their kind's mean, beyond noise.
double beyond_noise(const StrokeResiduals& sums) {
  const VarianceOfNumbers numbers = variance_of_numbers(sums);
  const double of_noise = sums.of_noise();
  const bool is_beyond = numbers.variance > of_noise * rarest_ratio(numbers.freedom, sums.freedom);
  return is_beyond ? std::sqrt(numbers.variance - of_noise) : 0.0;
}

}  // namespace

double rarest_ratio(double upper_freedom, double lower_freedom) {
  const double a = 2.0 / (9.0 * std::max(1.0, upper_freedom)), b = 2.0 / (9.0 * std::max(1.0, lower_freedom));
  const double square = k_thresholds.sure * k_thresholds.sure;
  const double leading = (1.0 - b) * (1.0 - b) - square * b;
  if (leading <= 0) return std::numeric_limits<double>::infinity();
  const double half = (1.0 - a) * (1.0 - b);
  const double root = (half + std::sqrt(half * half - leading * ((1.0 - a) * (1.0 - a) - square * a))) / leading;
  return root * root * root;
}

StrokeScatter stroke_scatter(const Evidence& evidence, const Fit& fit) {
  const Eigen::VectorXd alpha = alphas(evidence.measurement);
  // rms of α about its mean, for the first stroke of each kind: no two strokes are sampled alike.
  std::map<Alike, double> widths;
  StrokeResiduals means, tilts;
  for (const Block& block : evidence.blocks) {
    const std::vector<Eigen::Index> rows(block.rows.begin(), block.rows.end());
    const Alike of = {block.run, evidence.measurement.runs[block.run].strokes[block.stroke].direction, block.alike};
    const double mean = fit.residual(rows).mean();
    const Eigen::VectorXd about_mean = fit.residual(rows).array() - mean;
    means.add(of, mean, about_mean, 1.0);
    const Eigen::VectorXd place = alpha(rows).array() - alpha(rows).mean();
    if (place.isZero(0)) continue;
    const double slope = about_mean.dot(place) / place.squaredNorm();
    tilts.add(of, slope * widths.try_emplace(of, rms_of(place)).first->second, about_mean - slope * place, 2.0);
  }
  StrokeScatter scatter;
  if (means.freedom > 0) {
    scatter.within = std::sqrt(means.mean_square());
    scatter.between = beyond_noise(means);
  }
  if (tilts.freedom > 0) {
    scatter.about_tilts = std::sqrt(tilts.mean_square());
    scatter.tilts = beyond_noise(tilts);
  }
  return scatter;
}

bool is_scattering(const measurement::NoiseFloor& noise) {
  return noise.from_repeats && noise.within_stroke > 0 &&
         noise.rms > k_thresholds.most_repeat_scatter * noise.within_stroke;
}

bool is_walking(const StrokeScatter& scatter) {
  return scatter.between > k_thresholds.most_stroke_scatter * scatter.within ||
         scatter.tilts > k_thresholds.most_stroke_scatter * scatter.about_tilts;
}

}  // namespace fusee::calibration
