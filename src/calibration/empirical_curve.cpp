#include "calibration/empirical_curve.h"

#include <algorithm>
#include <cmath>

#include "calibration/statistics.h"
#include "calibration/thresholds.h"
#include "measurement/value_range.h"

// The curve is the posterior mean of the discrepancy's families of place and direction, beside all other factors of its
// description. It is validated on held-out data, run by run and level by level.

namespace fusee::calibration {
namespace {

constexpr int k_pieces = 60;
/// Largest gap between rows as a share of the measured range: twice the discrepancy's short length scale.
constexpr double k_widest_gap = 0.12;
/// Share of the gain that all rows together must show.
constexpr double k_least_gain_share = 0.5;

/// Rows in use of one direction, by rising α: α and curve. Behind a reversal the curve may have several values at a
/// place.
using Way = std::vector<std::pair<double, double>>;

double widest_gap(const Way& way) {
  double gap = 0;
  for (std::size_t i = 1; i < way.size(); ++i) gap = std::max(gap, way[i].first - way[i - 1].first);
  return gap;
}

/// Means over half a segment of the curve, far below its length scale.
Way smoothed(const Way& way, const measurement::ValueRange& seen) {
  const measurement::Bins bins{seen, 2 * k_pieces};
  Way means;
  int last = -1;
  double count = 0;
  for (const auto& [alpha, value] : way) {
    if (alpha < seen.least || alpha > seen.most) continue;
    const int bin = bins.bin(alpha);
    if (bin != last) {
      means.emplace_back(0.0, 0.0);
      count = 0;
    }
    last = bin;
    count += 1;
    means.back().first += (alpha - means.back().first) / count;
    means.back().second += (value - means.back().second) / count;
  }
  return means;
}

/// Linear interpolation.
double value_at(const Way& way, double alpha) {
  const auto above = std::lower_bound(way.begin() + 1, way.end() - 1, alpha,
                                      [](const auto& row, double value) { return row.first < value; });
  const auto& low = *(above - 1);
  const double span = above->first - low.first;
  const double share = span > 0 ? std::clamp((alpha - low.first) / span, 0.0, 1.0) : 0.0;
  return low.second + share * (above->second - low.second);
}

struct UpAndDown {
  Way up, down;
};

UpAndDown ways_of(const Evidence& evidence, const Eigen::VectorXd& curve) {
  const Eigen::VectorXd alpha = alphas(evidence.measurement);
  UpAndDown ways;
  Eigen::Index row = 0;
  for (const Block& block : evidence.blocks) {
    const int direction = evidence.measurement.runs[block.run].strokes[block.stroke].direction;
    for (const std::size_t sample : block.rows) {
      const double value = curve[row++];
      if (direction != 0)
        (direction > 0 ? ways.up : ways.down).emplace_back(alpha[static_cast<Eigen::Index>(sample)], value);
    }
  }
  for (Way* way : {&ways.up, &ways.down}) std::sort(way->begin(), way->end());
  return ways;
}

/// Range measured in both directions.
measurement::ValueRange seen_both_ways(const UpAndDown& ways) {
  measurement::ValueRange span;
  if (ways.up.size() < 2 || ways.down.size() < 2) return span;
  span.least = std::max(ways.up.front().first, ways.down.front().first);
  span.most = std::min(ways.up.back().first, ways.down.back().first);
  return span;
}

void draw(const UpAndDown& ways, const measurement::ValueRange& seen, EmpiricalCurve& curve) {
  const measurement::Bins pieces{seen, k_pieces};
  const Way up = smoothed(ways.up, seen), down = smoothed(ways.down, seen);
  for (int i = 0; i <= k_pieces; ++i) {
    const double alpha = pieces.edge(i);
    curve.alpha.push_back(alpha);
    curve.up.push_back(value_at(up, alpha));
    curve.down.push_back(value_at(down, alpha));
  }
}

/// Mean squares of held-out blocks of a fold.
struct Gain {
  double before = 0;
  double mean = 0;  ///< reduction by the curve
  double rows = 0;
};

/// Gain over a fold. A fold of one block has none, because it would be chance.
Gain gain_in(const Evidence& evidence, const HeldOutWithDiscrepancy& held, const Fold& fold) {
  Gain gain;
  for (const std::size_t block : fold) {
    const double before = held.effects.by_block[block];
    if (!std::isfinite(before) || fold.size() < 2) continue;
    const auto count = static_cast<double>(evidence.blocks[block].rows.size());
    gain.rows += count;
    gain.before += count * before;
    gain.mean += count * (before - held.with_place.by_block[block]);
  }
  if (gain.rows == 0) return gain;
  gain.before /= gain.rows;
  gain.mean /= gain.rows;
  return gain;
}

Fold all_blocks(const Evidence& evidence) {
  Fold all;
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b) all.push_back(b);
  return all;
}

/// True if the curve worsens a level of load or speed by more than it improves all.
bool harms_a_level(const Evidence& evidence, const HeldOutWithDiscrepancy& held, const Gain& all) {
  return std::any_of(evidence.factor_folds.begin(), evidence.factor_folds.end(),
                     [&](const Fold& fold) { return gain_in(evidence, held, fold).mean < -all.mean; });
}

/// Standard error of the gain: 2 rms(curve) rms(residual) / √(independent rows).
double error_of(const Evidence& evidence, const Gain& gain, double curve_rms) {
  const double residual_rms = std::sqrt(std::max(0.0, gain.before - gain.mean));
  return 2.0 * curve_rms * residual_rms /
         std::sqrt(std::max(1.0, gain.rows * evidence.evidence_model->independent_share()));
}

std::string why_not(const Evidence& evidence, const HeldOutWithDiscrepancy& by_factor, const Gain& gain,
                    double curve_rms) {
  if (gain.mean < elementary::pow(k_thresholds.usual_discrepancy * evidence.floor, 2) ||
      gain.mean < k_thresholds.sure * error_of(evidence, gain, curve_rms))
    return "on held-out data it corrects no more than chance would";
  if (harms_a_level(evidence, by_factor, gain))
    return "it worsens a held-out level of load or speed by more than it improves all";
  return "";
}

/// Squares over rows within the range of the curve.
struct Squares {
  double without = 0;
  double with = 0;
  double rows = 0;

  double gain() const { return rows > 0 ? (without - with) / rows : 0.0; }
};

bool covers(const EmpiricalCurve& curve, double alpha) {
  return !curve.alpha.empty() && alpha >= curve.alpha.front() && alpha <= curve.alpha.back();
}

void add(const measurement::Run& run, const std::vector<double>& residuals, const EmpiricalCurve& curve,
         Squares& squares) {
  const std::vector<double> removed = curve_at_samples(run, curve);
  for (const measurement::Stroke& stroke : run.strokes) {
    if (stroke.partial || stroke.direction == 0) continue;
    for (std::size_t i = stroke.first; i <= stroke.last; ++i) {
      if (!std::isfinite(residuals[i]) || !covers(curve, run.samples[i].alpha)) continue;
      squares.without += residuals[i] * residuals[i];
      squares.with += elementary::pow(residuals[i] - removed[i], 2);
      squares.rows += 1;
    }
  }
}

/// Limits the gain to that of the curve itself: behind a reversal the discrepancy is no curve.
void limit_gain(EmpiricalCurve& curve, double gain) {
  curve.gain = std::sqrt(gain);
  curve.held_out_rms = std::sqrt(std::max(0.0, curve.held_out_effects * curve.held_out_effects - gain));
}

void reject(EmpiricalCurve& curve, const std::string& why) {
  curve.used = false;
  curve.why = why;
}

bool depends_on_place(const Discrepancy& discrepancy, const Amplitudes& amplitudes) {
  for (std::size_t f = 0; f < discrepancy.families.size(); ++f) {
    if (is_of_place(discrepancy.families[f].factor) && amplitudes.families[static_cast<Eigen::Index>(f)] > 0)
      return true;
  }
  return false;
}

}  // namespace

double EmpiricalCurve::at(double place, bool rising) const {
  const std::vector<double>& values = rising ? up : down;
  const measurement::Bins pieces{{alpha.front(), alpha.back()}, static_cast<int>(alpha.size()) - 1};
  const auto i = static_cast<std::size_t>(pieces.bin(place));
  const double share = pieces.place(place) - static_cast<double>(i);
  return values[i] + share * (values[i + 1] - values[i]);
}

Amplitudes amplitudes_beside(const Evidence& evidence, const Fit& fit, const DiscrepancyFit& unmodelled) {
  Amplitudes amplitudes = unmodelled.posterior.amplitudes;
  const std::vector<Family>& families = evidence.evidence_model->discrepancy().families;
  const double deflection_ratio = tangent_of(evidence, fit).deflection_ratio;
  for (std::size_t f = 0; f < families.size(); ++f) {
    if (families[f].fixed > 0) amplitudes.families[static_cast<Eigen::Index>(f)] *= deflection_ratio;
  }
  return amplitudes;
}

EmpiricalCurve empirical_curve(const Evidence& evidence, const Fit& fit, const DiscrepancyFit& unmodelled) {
  const Discrepancy& discrepancy = evidence.evidence_model->discrepancy();
  EmpiricalCurve curve;
  if (!depends_on_place(discrepancy, unmodelled.posterior.amplitudes)) {
    curve.why = "no part of it depends on place and direction alone";
    return curve;
  }
  const Eigen::VectorXd at_rows = sum_of_families(discrepancy, unmodelled.posterior.coefficients, is_of_place);
  const UpAndDown ways = ways_of(evidence, at_rows);
  const measurement::ValueRange seen = seen_both_ways(ways),
                                all = measurement::value_range(evidence.measurement, &measurement::Sample::alpha);
  if (!seen.any() || std::max(widest_gap(ways.up), widest_gap(ways.down)) > k_widest_gap * all.size()) {
    curve.why = "parts of the range were not measured in both directions";
    return curve;
  }
  const Amplitudes amplitudes = amplitudes_beside(evidence, fit, unmodelled);
  const HeldOutWithDiscrepancy by_run = hold_out_with_discrepancy(evidence, fit, amplitudes, evidence.run_folds);
  const HeldOutWithDiscrepancy by_factor = hold_out_with_discrepancy(evidence, fit, amplitudes, evidence.factor_folds);
  const Gain gain = gain_in(evidence, by_run, all_blocks(evidence));
  curve.why = why_not(evidence, by_factor, gain, at_rows.norm() / std::sqrt(static_cast<double>(at_rows.size())));
  curve.used = curve.why.empty();
  draw(ways, seen, curve);
  curve.held_out_effects = std::sqrt(by_run.effects.mean_square);
  curve.held_out_rms = std::sqrt(by_run.with_place.mean_square);
  curve.gain = std::sqrt(std::max(0.0, gain.mean));
  return curve;
}

std::vector<double> curve_at_samples(const measurement::Run& run, const EmpiricalCurve& curve) {
  std::vector<double> values(run.samples.size(), 0.0);
  for (const measurement::Stroke& stroke : run.strokes) {
    for (std::size_t i = stroke.first; stroke.direction != 0 && i <= stroke.last; ++i) {
      if (covers(curve, run.samples[i].alpha)) values[i] = curve.at(run.samples[i].alpha, stroke.direction > 0);
    }
  }
  return values;
}

void validate_curve(const measurement::Measurement& measurement, const std::vector<std::vector<double>>& residuals,
                    const std::vector<std::string>& kept, EmpiricalCurve& curve) {
  if (!curve.used) return;
  Squares fitted, validation;
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    const measurement::Run& run = measurement.runs[r];
    const bool is_kept = std::find(kept.begin(), kept.end(), run.name) != kept.end();
    add(run, residuals[r], curve, is_kept ? validation : fitted);
  }
  // A wave shorter than the spacing of the rows in use appears as a slow one in them.
  if (fitted.gain() < k_least_gain_share * curve.gain * curve.gain)
    return reject(curve, "it does not hold in rows between the fitted ones: the error varies faster");
  limit_gain(curve, std::min(curve.gain * curve.gain, fitted.gain()));
  if (validation.rows == 0) return;
  curve.held_out_effects = std::sqrt(validation.without / validation.rows);
  curve.held_out_rms = std::sqrt(validation.with / validation.rows);
  curve.gain = std::sqrt(std::max(0.0, validation.gain()));
  if (!(curve.gain > 0)) reject(curve, "it makes the runs for validation worse");
}

}  // namespace fusee::calibration
