#include "calibration/evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "calibration/marginal.h"
#include "calibration/thresholds.h"
#include "measurement/strokes.h"
#include "transmission/declared_law.h"

namespace fusee {
namespace {

/// Rows of a run that a fit looks at: enough for every stroke's shape, and few enough for hundreds of fits.
constexpr std::size_t k_rows_a_run = 170;
constexpr std::size_t k_most_rows = 1500;
/// A joint declared by a ratio costs next to nothing to simulate.
constexpr std::size_t k_cheaper = 5;
constexpr std::size_t k_least_rows_a_block = 6;

/// Whole cycles, evenly spread, of so many strokes that enough rows of each are left; the ends of the others are
/// history.
std::vector<bool> looked_at(const Run& run, std::size_t most_rows) {
  const std::size_t pairs = (run.strokes.size() + 1) / 2;
  const std::size_t most_pairs = std::max<std::size_t>(1, most_rows / (4 * k_least_rows_a_block));
  std::vector<bool> chosen(run.strokes.size(), true);
  for (std::size_t i = 0; pairs > most_pairs && i < chosen.size(); ++i)
    chosen[i] = (i / 2) * most_pairs / pairs != (i / 2 + 1) * most_pairs / pairs;
  return chosen;
}

/// Every n-th row, and both ends of each stroke, which the motion's history needs. `counted`: the every n-th alone,
/// lest ends weigh too much.
Run thinned(const Run& run, std::size_t most, std::vector<bool>& counted) {
  if (run.samples.size() <= most) {
    counted.insert(counted.end(), run.samples.size(), true);
    return run;
  }
  const std::vector<bool> chosen = looked_at(run, most);
  // Rows before, between and after strokes are history where all strokes are looked at.
  std::vector<bool> inside(run.samples.size(), std::find(chosen.begin(), chosen.end(), false) == chosen.end());
  std::set<std::size_t> ends;
  for (std::size_t s = 0; s < run.strokes.size(); ++s) {
    const Stroke& stroke = run.strokes[s];
    ends.insert(stroke.first);
    ends.insert(stroke.last);
    for (std::size_t i = stroke.first; chosen[s] && i <= stroke.last; ++i) inside[i] = true;
  }
  const auto rows = static_cast<std::size_t>(std::count(inside.begin(), inside.end(), true));
  const std::size_t every = (rows + most - 1) / std::max<std::size_t>(1, most);
  Run thin = run;
  thin.samples.clear();
  std::vector<std::size_t> place(run.samples.size());
  std::size_t seen = 0;
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    place[i] = thin.samples.size();
    const bool takes = inside[i] && seen++ % every == 0;
    if (!takes && !ends.count(i)) continue;
    thin.samples.push_back(run.samples[i]);
    counted.push_back(takes);
  }
  for (Stroke& stroke : thin.strokes) {
    stroke.first = place[stroke.first];
    stroke.last = place[stroke.last];
  }
  return thin;
}

/// A run's level of load: the mean, or where it changes sign within the run, its size.
double load_of(const Run& run) {
  double sum = 0;
  double squares = 0;
  for (const Sample& sample : run.samples) {
    sum += sample.load;
    squares += sample.load * sample.load;
  }
  const double count = static_cast<double>(std::max<std::size_t>(1, run.samples.size()));
  const double size = std::sqrt(squares / count);
  return std::abs(sum / count) > 0.5 * size ? std::copysign(size, sum) : size;
}

/// Runs of about the same value.
std::vector<std::vector<std::size_t>> levels(const std::vector<double>& values, double tolerance) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<std::vector<std::size_t>> found;
  for (const std::size_t i : order) {
    if (found.empty() || values[i] - values[found.back().front()] > tolerance) found.emplace_back();
    found.back().push_back(i);
  }
  return found;
}

std::vector<std::vector<std::size_t>> load_levels(const Measurement& measurement) {
  std::vector<double> loads;
  for (const Run& run : measurement.runs) loads.push_back(run.has_load ? load_of(run) : 0.0);
  const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
  return levels(loads, std::max(1e-9, 0.08 * (*most - *least)));
}

std::vector<std::vector<std::size_t>> speed_levels(const Measurement& measurement) {
  std::vector<double> speeds;
  for (const Run& run : measurement.runs) speeds.push_back(run.has_time && run.speed > 0 ? std::log(run.speed) : 0.0);
  return levels(speeds, 0.15);
}

std::vector<std::size_t> blocks_of(const Evidence& evidence, const std::vector<std::size_t>& runs) {
  std::vector<std::size_t> found;
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b) {
    if (std::find(runs.begin(), runs.end(), evidence.blocks[b].run) != runs.end()) found.push_back(b);
  }
  return found;
}

/// Whole runs in turn; of a lone run its strokes.
std::vector<Fold> run_folds(const Evidence& evidence) {
  std::vector<Fold> folds;
  if (evidence.measurement.runs.size() == 1) {
    for (std::size_t b = 0; b < evidence.blocks.size(); ++b) folds.push_back({b});
    return folds;
  }
  for (std::size_t i = 0; i < evidence.measurement.runs.size(); ++i) {
    Fold fold = blocks_of(evidence, {i});
    if (!fold.empty()) folds.push_back(std::move(fold));
  }
  return folds;
}

/// Whole levels of load and speed, where enough is left to learn from; whole runs that no level holds.
void choose_factor_folds(Evidence& evidence) {
  const std::vector<Run>& runs = evidence.measurement.runs;
  std::set<std::size_t> held;
  const auto hold = [&](const std::string& factor, const std::vector<std::vector<std::size_t>>& all) {
    bool any = false;
    for (const std::vector<std::size_t>& level : all) {
      const Fold fold = blocks_of(evidence, level);
      if (all.size() < 2 || fold.empty() || fold.size() > 0.6 * static_cast<double>(evidence.blocks.size())) continue;
      evidence.factor_folds.push_back(fold);
      held.insert(level.begin(), level.end());
      any = true;
    }
    if (any) evidence.factors.push_back(factor);
  };
  hold("load", load_levels(evidence.measurement));
  hold("speed", speed_levels(evidence.measurement));
  if (evidence.factors.empty()) {
    evidence.factor_folds = evidence.run_folds;
    return;
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Fold fold = blocks_of(evidence, {i});
    if (!held.count(i) && !fold.empty()) evidence.factor_folds.push_back(fold);
  }
}

/// Rows of a stroke that lie with their neighbours: none of the effects makes a single row jump.
std::vector<std::size_t> without_outliers(const Eigen::VectorXd& residual, std::size_t first, std::size_t last,
                                          double floor) {
  std::vector<std::size_t> rows;
  for (std::size_t i = first; i <= last; ++i) {
    std::vector<double> near;
    const std::size_t from = i >= first + 2 ? i - 2 : first;
    for (std::size_t j = from; j <= std::min(last, i + 2); ++j) near.push_back(residual[static_cast<Eigen::Index>(j)]);
    const double middle = median_of(near);
    double spread = 0;
    for (const double value : near)
      spread = std::max(spread, value == residual[static_cast<Eigen::Index>(i)] ? 0.0 : std::abs(value - middle));
    if (std::abs(residual[static_cast<Eigen::Index>(i)] - middle) <= 6.0 * floor + 3.0 * spread) rows.push_back(i);
  }
  return rows;
}

// ---- what was measured by hand --------------------------------------------------------------------------------------

std::vector<HandReading> hand_readings(const DeclaredMechanism& declared) {
  std::vector<HandReading> readings;
  for (const Effect& effect : effects(kind_of(declared))) {
    for (const EffectParameter& parameter : effect.parameters) {
      if (parameter.by_hand.readings == nullptr) continue;
      for (const CaliperReading& reading : parameter.by_hand.readings(declared))
        readings.push_back({&parameter, reading.value, reading.uncertainty});
    }
  }
  return readings;
}

}  // namespace

Eigen::VectorXd flat(const Readings& readings) {
  std::size_t count = 0;
  for (const auto& run : readings) count += run.size();
  Eigen::VectorXd all(static_cast<Eigen::Index>(count));
  Eigen::Index i = 0;
  for (const auto& run : readings) {
    for (const double value : run) all[i++] = value;
  }
  return all;
}

std::vector<Eigen::Index> Evidence::rows() const {
  std::vector<Eigen::Index> all;
  for (const Block& block : blocks) {
    for (const std::size_t row : block.rows) all.push_back(static_cast<Eigen::Index>(row));
  }
  return all;
}

std::size_t Evidence::rows_used() const {
  std::size_t rows = 0;
  for (const Block& block : blocks) rows += block.rows.size();
  return rows;
}

namespace {

/// As many rows of each run as many fits can bear.
Measurement thinned(const Mechanism& declared, Measurement measurement, std::vector<bool>& counted) {
  const std::size_t runs = std::max<std::size_t>(1, measurement.runs.size());
  const std::size_t cheaper = declared.transmission ? k_cheaper : 1;
  const std::size_t most = cheaper * std::min(k_rows_a_run, std::max<std::size_t>(60, k_most_rows / runs));
  for (Run& run : measurement.runs) run = thinned(run, most, counted);
  return measurement;
}

Eigen::VectorXd measured_theta(const Measurement& measurement) {
  Readings theta;
  for (const Run& run : measurement.runs) {
    theta.emplace_back();
    for (const Sample& sample : run.samples) theta.back().push_back(sample.theta);
  }
  return flat(theta);
}

/// Strokes with enough rows of those that are `counted`, without outliers of what the declared joint leaves.
std::vector<Block> blocks_of(const Evidence& evidence, const std::vector<bool>& counted) {
  Forward forward(*evidence.declared, evidence.log);
  const Eigen::VectorXd residual = evidence.theta - flat(forward({}));
  std::vector<Block> blocks;
  std::size_t offset = 0;
  for (std::size_t i = 0; i < evidence.measurement.runs.size(); ++i) {
    const Run& run = evidence.measurement.runs[i];
    for (std::size_t s = 0; s < run.strokes.size(); ++s) {
      const Stroke& stroke = run.strokes[s];
      // Where the play stood when the log began is not known: the first stroke finds out.
      if (stroke.partial || (s == 0 && run.strokes.size() > 2)) continue;
      Block block{i, s, without_outliers(residual, offset + stroke.first, offset + stroke.last, evidence.floor)};
      std::erase_if(block.rows, [&](std::size_t row) { return !counted[row]; });
      if (block.rows.size() >= k_least_rows_a_block) blocks.push_back(std::move(block));
    }
    offset += run.samples.size();
  }
  return blocks;
}

}  // namespace

namespace {

/// By how much the declared joint gives way, all rows, rad; nothing of a joint declared by a ratio.
Eigen::VectorXd deflection(const Evidence& evidence, const Eigen::VectorXd& declared) {
  const DeclaredLaw law(*evidence.declared);
  if (evidence.declared->transmission || !law.exists()) return {};
  Eigen::VectorXd given = declared;
  Eigen::Index row = 0;
  for (const Run& run : evidence.measurement.runs) {
    for (const Sample& sample : run.samples) given[row++] -= law.theta_straight_on(sample.alpha);
  }
  for (double& angle : given) angle = std::isfinite(angle) ? angle : 0.0;
  return given;
}

/// From row to row within blocks, 0 … 1.
double colour_of(const Evidence& evidence, const Eigen::VectorXd& rest) {
  double products = 0;
  double squares = 0;
  Eigen::Index row = 0;
  for (const Block& block : evidence.blocks) {
    for (std::size_t i = 0; i < block.rows.size(); ++i, ++row) {
      squares += rest[row] * rest[row];
      if (i > 0) products += rest[row] * rest[row - 1];
    }
  }
  return squares > 0 ? std::clamp(products / squares, 0.0, 0.95) : 0.0;
}

}  // namespace

void weigh(Evidence& evidence) {
  Forward forward(*evidence.declared, evidence.log);
  const Eigen::VectorXd declared = flat(forward({}));
  Discrepancy unnamed = discrepancy_of(evidence, deflection(evidence, declared));
  const Eigen::VectorXd left = (evidence.theta - declared)(evidence.rows());
  Tangent nothing;
  nothing.residual = left.unaryExpr([](double angle) { return std::isfinite(angle) ? angle : 0.0; });
  nothing.J.resize(left.size(), 0);
  const Marginal blind(unnamed, evidence.floor, 1.0);
  const Eigen::VectorXd rest =
      nothing.residual - unnamed.columns * blind.best(nothing, blind.first_guess()).unnamed;
  const double colour = colour_of(evidence, rest);
  evidence.marginal = std::make_shared<const Marginal>(std::move(unnamed), evidence.floor, (1.0 - colour) / (1.0 + colour));
}

Measurement with_fewer_rows(Measurement measurement, std::size_t most_a_run) {
  std::vector<bool> counted;
  for (Run& run : measurement.runs) run = thinned(run, most_a_run, counted);
  return measurement;
}

Evidence gather(const DeclaredMechanism& declared, const Measurement& measurement, double floor) {
  Evidence evidence;
  evidence.declared = &declared;
  evidence.floor = floor;
  std::vector<bool> counted;
  evidence.measurement = thinned(declared, measurement, counted);
  evidence.log = bench_log(evidence.measurement);
  evidence.theta = measured_theta(evidence.measurement);
  evidence.blocks = blocks_of(evidence, counted);
  evidence.run_folds = run_folds(evidence);
  choose_factor_folds(evidence);
  evidence.readings = hand_readings(declared);
  weigh(evidence);
  return evidence;
}

}  // namespace fusee
