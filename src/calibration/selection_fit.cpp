#include "calibration/selection_fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>

namespace fusee {
namespace {

/// Rows of a run that a fit looks at: enough for every stroke's shape, and few enough for hundreds of fits.
constexpr std::size_t k_rows_a_run = 170;
constexpr std::size_t k_most_rows = 1500;
/// A joint declared by a ratio costs next to nothing to simulate.
constexpr std::size_t k_cheaper = 5;
constexpr std::size_t k_least_rows_a_block = 6;

/// Residuals beyond this many scales count linearly.
constexpr double k_robust = 5.0;

constexpr int k_resamples = 400;

/// θ = offset + α/ratio declares its offset free.
const EffectParameter& free_offset() {
  static const EffectParameter parameter{"offset_deg", &Imperfections::zero, -100.0, 100.0, 1e-2, shown::in_degrees};
  return parameter;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Every n-th row, and both ends of each stroke, which the motion's history needs. `counted`: the every n-th alone, lest ends weigh too much.
Run thinned(const Run& run, std::size_t most, std::vector<bool>& counted) {
  const std::size_t every = (run.samples.size() + most - 1) / std::max<std::size_t>(1, most);
  if (every <= 1) {
    counted.insert(counted.end(), run.samples.size(), true);
    return run;
  }
  std::set<std::size_t> ends;
  for (const Stroke& stroke : run.strokes) {
    ends.insert(stroke.first);
    ends.insert(stroke.last);
  }
  Run thin = run;
  thin.samples.clear();
  std::vector<std::size_t> place(run.samples.size());
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    place[i] = thin.samples.size();
    if (i % every != 0 && !ends.count(i)) continue;
    thin.samples.push_back(run.samples[i]);
    counted.push_back(i % every == 0);
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

/// Whole levels of load and speed, where enough is left to learn from; whole runs that no level holds; strokes of a lone run.
void choose_folds(Evidence& evidence) {
  const std::vector<Run>& runs = evidence.measurement.runs;
  const auto blocks_of = [&](const std::vector<std::size_t>& chosen) {
    std::vector<std::size_t> found;
    for (std::size_t b = 0; b < evidence.blocks.size(); ++b) {
      if (std::find(chosen.begin(), chosen.end(), evidence.blocks[b].run) != chosen.end()) found.push_back(b);
    }
    return found;
  };
  if (runs.size() == 1) {
    for (std::size_t b = 0; b < evidence.blocks.size(); ++b) evidence.folds.push_back({b});
    return;
  }
  std::set<std::size_t> held;
  const auto hold = [&](const std::string& factor, const std::vector<std::vector<std::size_t>>& all) {
    if (all.size() < 2) return;
    bool any = false;
    for (const std::vector<std::size_t>& level : all) {
      const std::vector<std::size_t> blocks = blocks_of(level);
      if (blocks.empty() || blocks.size() > 0.6 * static_cast<double>(evidence.blocks.size())) continue;
      evidence.folds.push_back(blocks);
      held.insert(level.begin(), level.end());
      any = true;
    }
    if (any) evidence.factors.push_back(factor);
  };
  hold("load", load_levels(evidence.measurement));
  hold("speed", speed_levels(evidence.measurement));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!held.count(i) && !blocks_of({i}).empty()) evidence.folds.push_back(blocks_of({i}));
  }
}

/// Rows of a stroke that lie with their neighbours: none of the effects makes a single row jump.
std::vector<std::size_t> without_outliers(const Eigen::VectorXd& residual, std::size_t first, std::size_t last, double floor) {
  std::vector<std::size_t> rows;
  for (std::size_t i = first; i <= last; ++i) {
    std::vector<double> near;
    const std::size_t from = i >= first + 2 ? i - 2 : first;
    for (std::size_t j = from; j <= std::min(last, i + 2); ++j) near.push_back(residual[static_cast<Eigen::Index>(j)]);
    const double middle = median(near);
    double spread = 0;
    for (const double value : near) spread = std::max(spread, value == residual[static_cast<Eigen::Index>(i)] ? 0.0 : std::abs(value - middle));
    if (std::abs(residual[static_cast<Eigen::Index>(i)] - middle) <= 6.0 * floor + 3.0 * spread) rows.push_back(i);
  }
  return rows;
}

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

/// Of many starts the two after which one step of the fit would go furthest.
std::vector<std::vector<double>> promising(const Effect& effect, const Imperfections& from, const Eigen::VectorXd& residual, Forward& forward) {
  constexpr std::size_t few = 2;
  if (effect.starts.size() <= 4) return effect.starts;
  const Eigen::VectorXd base = flat(forward(from));
  std::vector<std::pair<double, std::size_t>> gains;
  for (std::size_t i = 0; i < effect.starts.size(); ++i) {
    Imperfections moved = from;
    for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
      const EffectParameter& parameter = effect.parameters[k];
      moved.*parameter.member = parameter.searched ? effect.starts[i][k] : parameter.step;
    }
    const Eigen::VectorXd J = flat(forward(moved)) - base;
    const double gain = J.squaredNorm() > 0 ? std::pow(J.dot(residual), 2) / J.squaredNorm() : 0.0;
    gains.emplace_back(std::isfinite(gain) ? -gain : 0.0, i);
  }
  std::sort(gains.begin(), gains.end());
  std::vector<std::vector<double>> best;
  for (std::size_t i = 0; i < few; ++i) best.push_back(effect.starts[gains[i].second]);
  return best;
}

Imperfections placed(const std::vector<const EffectParameter*>& parameters, Imperfections at, const double* x) {
  for (std::size_t i = 0; i < parameters.size(); ++i) at.*parameters[i]->member = x[i] * parameters[i]->step;
  return at;
}

/// Robust residuals, in units of the scale, of the rows in use.
class Misfit : public ceres::CostFunction {
 public:
  Misfit(const Evidence& evidence, Forward& forward, const std::vector<const EffectParameter*>& parameters, const Imperfections& from, double scale)
      : evidence_(evidence), forward_(forward), parameters_(parameters), from_(from), scale_(scale) {
    for (const Block& block : evidence.blocks) rows_.insert(rows_.end(), block.rows.begin(), block.rows.end());
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
    set_num_residuals(static_cast<int>(rows_.size()));
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const Eigen::VectorXd at = model(x[0]);
    std::vector<double> slopes(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(rows_[i]);
      const double u = (evidence_.theta[row] - at[row]) / scale_;
      if (!std::isfinite(u)) return false;
      const double size = std::abs(u);
      const double robust = size <= k_robust ? size : std::sqrt(2.0 * k_robust * size - k_robust * k_robust);
      residuals[i] = std::copysign(robust, u);
      slopes[i] = size <= k_robust ? 1.0 : k_robust / robust;
    }
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    const std::size_t count = parameters_.size();
    std::vector<double> y(x[0], x[0] + count);
    for (std::size_t k = 0; k < count; ++k) {
      const double step = (y[k] + 1.0) * parameters_[k]->step <= parameters_[k]->most ? 1.0 : -1.0;
      y[k] += step;
      const Eigen::VectorXd moved = model(y.data());
      y[k] -= step;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(rows_[i]);
        const double slope = -(moved[row] - at[row]) / step / scale_ * slopes[i];
        jacobians[0][i * count + k] = std::isfinite(slope) ? slope : 0.0;
      }
    }
    return true;
  }

 private:
  Eigen::VectorXd model(const double* x) const { return flat(forward_(placed(parameters_, from_, x))); }

  const Evidence& evidence_;
  Forward& forward_;
  const std::vector<const EffectParameter*>& parameters_;
  Imperfections from_;
  double scale_;
  std::vector<std::size_t> rows_;
};

double solve(const Misfit& misfit, const std::vector<const EffectParameter*>& parameters, std::vector<double>& x) {
  if (parameters.empty()) return 0;
  ceres::Problem::Options borrowed;
  borrowed.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(borrowed);
  problem.AddResidualBlock(const_cast<Misfit*>(&misfit), nullptr, x.data());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    problem.SetParameterLowerBound(x.data(), static_cast<int>(i), parameters[i]->least / parameters[i]->step);
    problem.SetParameterUpperBound(x.data(), static_cast<int>(i), parameters[i]->most / parameters[i]->step);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.max_num_iterations = 8;
  options.function_tolerance = 1e-4;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.termination_type == ceres::FAILURE ? std::numeric_limits<double>::infinity() : summary.final_cost;
}

void silence_glog() {
  static const bool done = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  (void)done;
}

Eigen::VectorXd solved(const Eigen::MatrixXd& JJ, const Eigen::VectorXd& Jr, const Eigen::VectorXd& x, double floor) {
  // A wide prior about no effect: what the rows in hand cannot tell stays nothing.
  const double ridge = 1e-6 * floor * floor;
  const Eigen::MatrixXd A = JJ + ridge * Eigen::MatrixXd::Identity(JJ.rows(), JJ.cols());
  return A.ldlt().solve(Jr - ridge * x);
}

double error_of(const BlockSums& sums, const Eigen::VectorXd& step) {
  const double rr = sums.rr - 2.0 * step.dot(sums.Jr) + step.dot(sums.JJ * step);
  return std::max(0.0, rr) / sums.rows;
}

void sum_up(const Evidence& evidence, Fit& fit) {
  const Eigen::Index count = fit.x.size();
  double rows = 0;
  double squares = 0;
  for (const Block& block : evidence.blocks) {
    BlockSums sums{Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count), 0, 0};
    for (const std::size_t i : block.rows) {
      const auto row = static_cast<Eigen::Index>(i);
      const Eigen::VectorXd J = fit.J.row(row).transpose();
      sums.JJ += J * J.transpose();
      sums.Jr += J * fit.residual[row];
      sums.rr += fit.residual[row] * fit.residual[row];
    }
    sums.rows = static_cast<double>(block.rows.size());
    rows += sums.rows;
    squares += sums.rr;
    fit.sums.push_back(std::move(sums));
  }
  fit.mean_square = squares / rows;
}

void hold_out(const Evidence& evidence, Fit& fit) {
  const std::size_t blocks = evidence.blocks.size();
  std::vector<double> error(blocks, 0.0);
  std::vector<int> times(blocks, 0);
  for (const std::vector<std::size_t>& fold : evidence.folds) {
    Eigen::MatrixXd JJ = Eigen::MatrixXd::Zero(fit.x.size(), fit.x.size());
    Eigen::VectorXd Jr = Eigen::VectorXd::Zero(fit.x.size());
    for (std::size_t b = 0; b < blocks; ++b) {
      if (std::find(fold.begin(), fold.end(), b) != fold.end()) continue;
      JJ += fit.sums[b].JJ;
      Jr += fit.sums[b].Jr;
    }
    const Eigen::VectorXd step = fit.x.size() > 0 ? solved(JJ, Jr, fit.x, evidence.floor) : Eigen::VectorXd();
    for (const std::size_t b : fold) {
      error[b] += error_of(fit.sums[b], step);
      ++times[b];
    }
  }
  double rows = 0;
  double squares = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    fit.held_out.push_back(times[b] > 0 ? error[b] / times[b] : std::numeric_limits<double>::quiet_NaN());
    if (times[b] == 0) continue;
    rows += fit.sums[b].rows;
    squares += fit.sums[b].rows * fit.held_out[b];
  }
  fit.held_out_mean_square = rows > 0 ? squares / rows : fit.mean_square;
}

/// One-sided 95 % of Student's t.
double t95(double degrees_of_freedom) {
  const double n = std::max(1.0, degrees_of_freedom);
  if (n < 1.5) return 6.31;
  if (n < 2.5) return 2.92;
  const double z = 1.6449;
  return z + (z * z * z + z) / (4.0 * n) + (5.0 * std::pow(z, 5) + 16.0 * z * z * z + 3.0 * z) / (96.0 * n * n);
}

double t_of(const std::vector<double>& values, double* mean, double* standard_error) {
  const double n = static_cast<double>(values.size());
  const double average = std::accumulate(values.begin(), values.end(), 0.0) / std::max(1.0, n);
  double squares = 0;
  for (const double value : values) squares += (value - average) * (value - average);
  const double error = n > 1 ? std::sqrt(squares / (n - 1.0) / n) : std::numeric_limits<double>::infinity();
  if (mean) *mean = average;
  if (standard_error) *standard_error = error;
  return error > 0 ? average / error : 0.0;
}

/// Lag-1 autocorrelation within blocks.
double autocorrelation(const Evidence& evidence, const Fit& fit) {
  double products = 0;
  double squares = 0;
  for (const Block& block : evidence.blocks) {
    for (std::size_t i = 0; i < block.rows.size(); ++i) {
      const double r = fit.residual[static_cast<Eigen::Index>(block.rows[i])];
      squares += r * r;
      if (i > 0) products += r * fit.residual[static_cast<Eigen::Index>(block.rows[i - 1])];
    }
  }
  return squares > 0 ? std::clamp(products / squares, 0.0, 0.999) : 0.0;
}

/// A small generator of our own: the same intervals on every machine.
class Dice {
 public:
  std::size_t below(std::size_t n) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<std::size_t>((state_ >> 33) % n);
  }

 private:
  std::uint64_t state_ = 20180417;
};

}  // namespace

std::size_t Evidence::rows_used() const {
  std::size_t rows = 0;
  for (const Block& block : blocks) rows += block.rows.size();
  return rows;
}

std::vector<const EffectParameter*> varied(const Mechanism& declared, const EffectSet& effects) {
  std::vector<const EffectParameter*> parameters;
  if (declared.transmission) parameters.push_back(&free_offset());
  for (const Effect* effect : effects) {
    for (const EffectParameter& parameter : effect->parameters) {
      if (!parameter.searched) parameters.push_back(&parameter);
    }
  }
  return parameters;
}

Evidence gather(const Mechanism& declared, const Measurement& measurement, double floor) {
  Evidence evidence;
  evidence.declared = &declared;
  evidence.floor = floor;
  evidence.measurement = measurement;
  const std::size_t runs = std::max<std::size_t>(1, measurement.runs.size());
  const std::size_t cheaper = declared.transmission ? k_cheaper : 1;
  const std::size_t most = cheaper * std::min(k_rows_a_run, std::max<std::size_t>(60, k_most_rows / runs));
  std::vector<bool> counted;
  for (Run& run : evidence.measurement.runs) run = thinned(run, most, counted);
  Forward forward(declared, evidence.measurement);
  Readings theta;
  for (const Run& run : evidence.measurement.runs) {
    theta.emplace_back();
    for (const Sample& sample : run.samples) theta.back().push_back(sample.theta);
  }
  evidence.theta = flat(theta);
  const Eigen::VectorXd residual = evidence.theta - flat(forward({}));
  std::size_t offset = 0;
  for (std::size_t i = 0; i < evidence.measurement.runs.size(); ++i) {
    const Run& run = evidence.measurement.runs[i];
    for (std::size_t s = 0; s < run.strokes.size(); ++s) {
      // Where the play stood when the log began is not known: the first stroke finds out.
      if (run.strokes[s].partial || (s == 0 && run.strokes.size() > 2)) continue;
      Block block{i, s, without_outliers(residual, offset + run.strokes[s].first, offset + run.strokes[s].last, floor)};
      block.rows.erase(std::remove_if(block.rows.begin(), block.rows.end(), [&](std::size_t row) { return !counted[row]; }), block.rows.end());
      if (block.rows.size() >= k_least_rows_a_block) evidence.blocks.push_back(std::move(block));
    }
    offset += run.samples.size();
  }
  choose_folds(evidence);
  return evidence;
}

Fit fit_effects(const Evidence& evidence, Forward& forward, const EffectSet& effects, const Imperfections& from) {
  silence_glog();
  Fit fit;
  fit.effects = effects;
  const std::vector<const EffectParameter*> parameters = varied(*evidence.declared, effects);
  std::vector<double> near;
  const Eigen::VectorXd before = evidence.theta - flat(forward(from));
  for (const Block& block : evidence.blocks) {
    for (const std::size_t i : block.rows) near.push_back(before[static_cast<Eigen::Index>(i)]);
  }
  const double middle = median(near);
  for (double& value : near) value = std::abs(value - middle);
  const double scale = std::max(evidence.floor, 1.5 * median(near));
  // Every effect's own starts, the others where they were.
  std::vector<Imperfections> starts{from};
  if (evidence.declared->transmission && from.zero == 0) starts.front().zero = middle;
  for (const Effect* effect : effects) {
    bool known = false;
    for (const EffectParameter& parameter : effect->parameters) known = known || from.*parameter.member != 0;
    if (known) continue;
    for (const std::vector<double>& start : promising(*effect, starts.front(), before, forward)) {
      Imperfections at = starts.front();
      for (std::size_t k = 0; k < start.size(); ++k) at.*effect->parameters[k].member = start[k];
      starts.push_back(at);
    }
  }
  double best = std::numeric_limits<double>::infinity();
  for (const Imperfections& start : starts) {
    const Misfit misfit(evidence, forward, parameters, start, scale);
    std::vector<double> x;
    for (const EffectParameter* parameter : parameters) x.push_back(start.*parameter->member / parameter->step);
    double cost = solve(misfit, parameters, x);
    if (!(cost < best)) {
      if (best < std::numeric_limits<double>::infinity() || !parameters.empty()) continue;
    }
    best = cost;
    fit.at = placed(parameters, start, x.data());
    fit.x = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
    fit.usable = true;
  }
  if (!fit.usable) return fit;
  const Eigen::VectorXd at = flat(forward(fit.at));
  fit.residual = evidence.theta - at;
  fit.J.resize(at.size(), fit.x.size());
  for (Eigen::Index k = 0; k < fit.x.size(); ++k) {
    const EffectParameter& parameter = *parameters[static_cast<std::size_t>(k)];
    Imperfections moved = fit.at;
    const double step = fit.at.*parameter.member + parameter.step <= parameter.most ? 1.0 : -1.0;
    moved.*parameter.member += step * parameter.step;
    fit.J.col(k) = (flat(forward(moved)) - at) / step;
    // At its bound a parameter stays there, whatever part of the data it is fitted to.
    const double value = fit.at.*parameter.member;
    if (value <= parameter.least + 1e-9 * parameter.step || value >= parameter.most - 1e-9 * parameter.step) fit.J.col(k).setZero();
  }
  for (const Block& block : evidence.blocks) {
    for (const std::size_t i : block.rows) {
      const auto row = static_cast<Eigen::Index>(i);
      if (!std::isfinite(fit.residual[row]) || !fit.J.row(row).allFinite()) fit.usable = false;
    }
  }
  if (!fit.usable) return fit;
  sum_up(evidence, fit);
  hold_out(evidence, fit);
  return fit;
}

Comparison compare(const Evidence& evidence, const Fit& worse, const Fit& better) {
  Comparison comparison;
  std::vector<double> drops;
  std::map<std::size_t, std::vector<double>> by_run;
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b) {
    const double drop = worse.held_out[b] - better.held_out[b];
    if (!std::isfinite(drop)) continue;
    drops.push_back(drop);
    by_run[evidence.blocks[b].run].push_back(drop);
  }
  comparison.t = t_of(drops, &comparison.mean, &comparison.standard_error);
  comparison.needed_t = t95(static_cast<double>(drops.size()) - 1.0);
  std::vector<double> runs;
  for (const auto& [run, values] : by_run) runs.push_back(std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()));
  comparison.t_over_runs = runs.size() > 2 ? t_of(runs, nullptr, nullptr) : comparison.t;
  return comparison;
}

double bic_drop(const Evidence& evidence, const Fit& worse, const Fit& better) {
  const double r = autocorrelation(evidence, better);
  const double rows = static_cast<double>(evidence.rows_used());
  const double independent = std::max(rows * (1.0 - r) / (1.0 + r), static_cast<double>(evidence.blocks.size()));
  const double more = static_cast<double>(better.x.size() - worse.x.size());
  return independent * std::log(worse.mean_square / better.mean_square) - more * std::log(independent);
}

std::vector<Interval> intervals(const Fit& fit) {
  const auto count = static_cast<std::size_t>(fit.x.size());
  std::vector<std::vector<double>> values(count);
  Dice dice;
  const std::size_t blocks = fit.sums.size();
  for (int resample = 0; resample < k_resamples; ++resample) {
    Eigen::MatrixXd JJ = Eigen::MatrixXd::Zero(fit.x.size(), fit.x.size());
    Eigen::VectorXd Jr = Eigen::VectorXd::Zero(fit.x.size());
    for (std::size_t i = 0; i < blocks; ++i) {
      const BlockSums& sums = fit.sums[dice.below(blocks)];
      JJ += sums.JJ;
      Jr += sums.Jr;
    }
    const Eigen::VectorXd x = fit.x + solved(JJ, Jr, fit.x, 1e-6);
    for (std::size_t k = 0; k < count; ++k) values[k].push_back(x[static_cast<Eigen::Index>(k)]);
  }
  std::vector<Interval> found(count);
  for (std::size_t k = 0; k < count; ++k) {
    std::sort(values[k].begin(), values[k].end());
    found[k].low = values[k][k_resamples / 40];
    found[k].high = values[k][k_resamples - 1 - k_resamples / 40];
    found[k].deviation = 0.25 * (found[k].high - found[k].low);
  }
  return found;
}

}  // namespace fusee
