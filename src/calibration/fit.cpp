#include "calibration/fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <numeric>

#include "measurement/strokes.h"

namespace fusee {
namespace {

/// Residuals beyond this many scales count linearly.
constexpr double k_robust = 5.0;

constexpr int k_resamples = 400;

/// Steps of a candidate's fit, and the share of the squares below which one more is not worth it.
constexpr int k_chords = 4;
constexpr double k_settled = 1e-3;

constexpr std::size_t k_slip_times = 4;

/// Of what all blocks know of a direction, what must be left without a fold for the fold to be held out.
constexpr double k_least_known = 0.03;

/// θ = offset + α/ratio declares its offset free.
const EffectParameter& free_offset() {
  static const EffectParameter parameter{"offset_deg", &Imperfections::zero, -100.0, 100.0, 1e-2, shown::in_degrees};
  return parameter;
}

/// What a model says of the logged angles.
struct Said {
  Eigen::VectorXd residual;  ///< measured − model; beyond the play where the model's joint is loose
  Eigen::VectorXd loose;     ///< half that play
};

Said said(const Evidence& evidence, Forward& forward, const Imperfections& at) {
  Said words{evidence.theta - flat(forward(at)), flat(forward.looseness(at))};
  for (Eigen::Index i = 0; i < words.residual.size(); ++i) {
    const double beyond = std::max(0.0, std::abs(words.residual[i]) - words.loose[i]);
    if (words.loose[i] > 0) words.residual[i] = std::copysign(beyond, words.residual[i]);
  }
  return words;
}

/// A loose joint may stand anywhere, which explains any reading and so each one less well: the likelihood of a place
/// within the play against that of a reading with noise alone, as a square of residuals.
double price_of_play(double loose, double floor) {
  return 2.0 * floor * floor * std::log1p(2.0 * loose / (std::sqrt(k_two_pi) * floor));
}

Imperfections placed(const std::vector<const EffectParameter*>& parameters, Imperfections at, const double* x) {
  for (std::size_t i = 0; i < parameters.size(); ++i) at.*parameters[i]->member = x[i] * parameters[i]->step;
  return at;
}

/// Robust residuals, in units of the scale, of the rows in use and of what was measured by hand.
class Misfit : public ceres::CostFunction {
 public:
  Misfit(const Evidence& evidence, Forward& forward, const std::vector<const EffectParameter*>& parameters,
         const Imperfections& from, double scale)
      : evidence_(evidence), forward_(forward), parameters_(parameters), from_(from), scale_(scale) {
    for (const Block& block : evidence.blocks) rows_.insert(rows_.end(), block.rows.begin(), block.rows.end());
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
    set_num_residuals(static_cast<int>(rows_.size() + evidence.readings.size()));
  }

  /// Half the sum of squares; infinite where there is no equilibrium.
  double cost(const double* x) const {
    std::vector<double> residuals(static_cast<std::size_t>(num_residuals()));
    if (!Evaluate(&x, residuals.data(), nullptr)) return std::numeric_limits<double>::infinity();
    return 0.5 * std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const Eigen::VectorXd at = residual(x[0]);
    std::vector<double> slopes(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(rows_[i]);
      const double u = at[row] / scale_;
      if (!std::isfinite(u)) return false;
      const double size = std::abs(u);
      const double robust = size <= k_robust ? size : std::sqrt(2.0 * k_robust * size - k_robust * k_robust);
      residuals[i] = std::copysign(robust, u);
      slopes[i] = size <= k_robust ? 1.0 : k_robust / robust;
    }
    const Imperfections here = placed(parameters_, from_, x[0]);
    for (std::size_t i = 0; i < evidence_.readings.size(); ++i) {
      const HandReading& reading = evidence_.readings[i];
      residuals[rows_.size() + i] =
          (reading.value - here.*reading.member) / reading.uncertainty * evidence_.floor / scale_;
    }
    if (jacobians != nullptr && jacobians[0] != nullptr) differentiate(x[0], at, slopes, jacobians[0]);
    return true;
  }

 private:
  void differentiate(const double* x, const Eigen::VectorXd& at, const std::vector<double>& slopes,
                     double* jacobian) const {
    const std::size_t count = parameters_.size();
    std::vector<double> y(x, x + count);
    for (std::size_t k = 0; k < count; ++k) {
      const EffectParameter& parameter = *parameters_[k];
      const double step = (y[k] + 1.0) * parameter.step <= parameter.most ? 1.0 : -1.0;
      y[k] += step;
      const Eigen::VectorXd moved = residual(y.data());
      y[k] -= step;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(rows_[i]);
        const double slope = (moved[row] - at[row]) / step / scale_ * slopes[i];
        jacobian[i * count + k] = std::isfinite(slope) ? slope : 0.0;
      }
      for (std::size_t i = 0; i < evidence_.readings.size(); ++i) {
        const HandReading& reading = evidence_.readings[i];
        const bool own = reading.member == parameter.member;
        jacobian[(rows_.size() + i) * count + k] =
            own ? -parameter.step / reading.uncertainty * evidence_.floor / scale_ : 0.0;
      }
    }
  }

  Eigen::VectorXd residual(const double* x) const {
    return said(evidence_, forward_, placed(parameters_, from_, x)).residual;
  }

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
  static std::once_flag once;
  std::call_once(once, [] { FLAGS_minloglevel = google::GLOG_FATAL; });
}

// ---- normal equations -----------------------------------------------------------------------------------------------

BlockSums no_sums(Eigen::Index count) {
  return {Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count), 0, 0};
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

/// A caliper's reading is worth a row of the floor's noise that shows the member alone.
void sum_up_readings(const Evidence& evidence, const std::vector<const EffectParameter*>& parameters, Fit& fit) {
  fit.readings = no_sums(fit.x.size());
  fit.against_readings = 0;
  for (const HandReading& reading : evidence.readings) {
    fit.against_readings += std::pow((reading.value - fit.at.*reading.member) / reading.uncertainty, 2);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (parameters[k]->member != reading.member) continue;
      const auto i = static_cast<Eigen::Index>(k);
      const double slope = parameters[k]->step / reading.uncertainty * evidence.floor;
      fit.readings.JJ(i, i) += slope * slope;
      fit.readings.Jr[i] += slope * (reading.value - fit.at.*reading.member) / reading.uncertainty * evidence.floor;
    }
  }
}

/// dθ/dx of a row. Of a fit without parameters J holds nothing, not even a place to point at.
Eigen::VectorXd slopes_of(const Fit& fit, Eigen::Index row) {
  return fit.x.size() > 0 ? Eigen::VectorXd(fit.J.row(row).transpose()) : Eigen::VectorXd();
}

void sum_up(const Evidence& evidence, Fit& fit) {
  double rows = 0;
  double squares = 0;
  double prices = 0;
  fit.sums.clear();
  for (const Block& block : evidence.blocks) {
    BlockSums sums = no_sums(fit.x.size());
    for (const std::size_t i : block.rows) {
      const auto row = static_cast<Eigen::Index>(i);
      const Eigen::VectorXd J = slopes_of(fit, row);
      sums.JJ += J * J.transpose();
      sums.Jr += J * fit.residual[row];
      const double price = price_of_play(fit.loose[row], evidence.floor);
      sums.rr += fit.residual[row] * fit.residual[row] + price;
      prices += price;
    }
    sums.rows = static_cast<double>(block.rows.size());
    rows += sums.rows;
    squares += sums.rr;
    fit.sums.push_back(std::move(sums));
  }
  fit.mean_square = squares / rows;
  fit.price = prices / rows;
}

/// Whether the blocks outside a fold say enough of every direction that all of them together know: a level that alone
/// carries what is known of a number cannot be held out.
bool can_do_without(const Eigen::MatrixXd& rest, const Eigen::MatrixXd& all) {
  if (all.rows() == 0) return true;
  const Eigen::VectorXd size = all.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = size.asDiagonal() * all * size.asDiagonal();
  const Eigen::MatrixXd part = size.asDiagonal() * rest * size.asDiagonal();
  const Eigen::MatrixXd ridge = 1e-9 * Eigen::MatrixXd::Identity(all.rows(), all.cols());
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> shares(part + ridge, scaled + ridge,
                                                                         Eigen::EigenvaluesOnly);
  return shares.eigenvalues().minCoeff() > k_least_known;
}

/// One step of the fit from all of the data to those without a fold.
HeldOut hold_out(const Evidence& evidence, const Fit& fit, const std::vector<Fold>& folds) {
  const std::size_t blocks = evidence.blocks.size();
  BlockSums all = fit.readings;
  for (const BlockSums& sums : fit.sums) {
    all.JJ += sums.JJ;
    all.Jr += sums.Jr;
  }
  std::vector<double> error(blocks, 0.0);
  std::vector<int> times(blocks, 0);
  const auto leave_out = [&](const Fold& fold, bool whole) {
    Eigen::MatrixXd JJ = all.JJ;
    Eigen::VectorXd Jr = all.Jr;
    for (const std::size_t b : fold) {
      JJ -= fit.sums[b].JJ;
      Jr -= fit.sums[b].Jr;
    }
    if (whole && !can_do_without(JJ, all.JJ)) return false;
    const Eigen::VectorXd step = fit.x.size() > 0 ? solved(JJ, Jr, fit.x, evidence.floor) : Eigen::VectorXd();
    for (const std::size_t b : fold) {
      error[b] += error_of(fit.sums[b], step);
      ++times[b];
    }
    return true;
  };
  for (const Fold& fold : folds) {
    if (leave_out(fold, true)) continue;
    for (const std::size_t b : fold) leave_out({b}, false);
  }
  HeldOut held;
  double rows = 0;
  double squares = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    held.by_block.push_back(times[b] > 0 ? error[b] / times[b] : std::numeric_limits<double>::quiet_NaN());
    if (times[b] == 0) continue;
    rows += fit.sums[b].rows;
    squares += fit.sums[b].rows * held.by_block[b];
  }
  held.mean_square = rows > 0 ? squares / rows : fit.mean_square;
  return held;
}

// ---- one fit --------------------------------------------------------------------------------------------------------

Eigen::VectorXd slope_at(const Evidence& evidence, Forward& forward, const Imperfections& at,
                         const EffectParameter& parameter, const Eigen::VectorXd& residual) {
  Imperfections moved = at;
  const double step = at.*parameter.member + parameter.step <= parameter.most ? 1.0 : -1.0;
  moved.*parameter.member += step * parameter.step;
  return (residual - said(evidence, forward, moved).residual) / step;
}

bool at_bound(const Imperfections& at, const EffectParameter& parameter) {
  const double value = at.*parameter.member;
  return value <= parameter.least + 1e-9 * parameter.step || value >= parameter.most - 1e-9 * parameter.step;
}

void linearise(const Evidence& evidence, Forward& forward, const std::vector<const EffectParameter*>& parameters,
               Fit& fit) {
  Said words = said(evidence, forward, fit.at);
  fit.residual = std::move(words.residual);
  fit.loose = std::move(words.loose);
  fit.J.resize(fit.residual.size(), fit.x.size());
  for (Eigen::Index k = 0; k < fit.x.size(); ++k) {
    const EffectParameter& parameter = *parameters[static_cast<std::size_t>(k)];
    fit.J.col(k) = slope_at(evidence, forward, fit.at, parameter, fit.residual);
    // At its bound a parameter stays there, whatever part of the data it is fitted to.
    if (at_bound(fit.at, parameter)) fit.J.col(k).setZero();
  }
}

void judge(const Evidence& evidence, const std::vector<const EffectParameter*>& parameters, Fit& fit) {
  for (const Block& block : evidence.blocks) {
    for (const std::size_t i : block.rows) {
      const auto row = static_cast<Eigen::Index>(i);
      if (!std::isfinite(fit.residual[row]) || !slopes_of(fit, row).allFinite()) fit.usable = false;
    }
  }
  if (!fit.usable) return;
  sum_up_readings(evidence, parameters, fit);
  sum_up(evidence, fit);
  fit.by_factor = hold_out(evidence, fit, evidence.factor_folds);
  fit.by_run = hold_out(evidence, fit, evidence.run_folds);
}

/// Sums over all rows in use and what was measured by hand: what one linear step needs.
struct Normal {
  Eigen::MatrixXd JJ;
  Eigen::VectorXd Jr;
  double rr = 0;
  bool finite = true;

  Eigen::VectorXd step(const Eigen::VectorXd& x, double floor) const {
    return x.size() > 0 ? solved(JJ, Jr, x, floor) : Eigen::VectorXd();
  }
  double promised(const Eigen::VectorXd& step) const { return rr - 2.0 * step.dot(Jr) + step.dot(JJ * step); }
};

Normal normal_equations(const Evidence& evidence, const Fit& fit) {
  Normal normal{fit.readings.JJ, fit.readings.Jr, 0, true};
  for (const Block& block : evidence.blocks) {
    for (const std::size_t i : block.rows) {
      const auto row = static_cast<Eigen::Index>(i);
      if (!std::isfinite(fit.residual[row]) || !slopes_of(fit, row).allFinite()) normal.finite = false;
      if (!normal.finite) return normal;
      const Eigen::VectorXd J = slopes_of(fit, row);
      normal.JJ.noalias() += J * J.transpose();
      normal.Jr.noalias() += fit.residual[row] * J;
      normal.rr += fit.residual[row] * fit.residual[row] + price_of_play(fit.loose[row], evidence.floor);
    }
  }
  return normal;
}

/// `base` and one effect more, whose parameters stand at `at`: slopes of the effect's own parameters anew, those of the
/// others as they were.
Fit widened(const Evidence& evidence, Forward& forward, const Fit& base,
            const std::vector<const EffectParameter*>& parameters, const Imperfections& at) {
  Fit wider;
  wider.at = at;
  Said words = said(evidence, forward, at);
  wider.residual = std::move(words.residual);
  wider.loose = std::move(words.loose);
  wider.x.resize(static_cast<Eigen::Index>(parameters.size()));
  wider.J.resize(wider.residual.size(), wider.x.size());
  wider.J.leftCols(base.x.size()) = base.J;
  for (Eigen::Index k = 0; k < wider.x.size(); ++k) {
    const EffectParameter& parameter = *parameters[static_cast<std::size_t>(k)];
    wider.x[k] = at.*parameter.member / parameter.step;
    if (k >= base.x.size()) wider.J.col(k) = slope_at(evidence, forward, at, parameter, wider.residual);
  }
  sum_up_readings(evidence, parameters, wider);
  return wider;
}

/// A step of the fit, kept within bounds.
Imperfections stepped(const std::vector<const EffectParameter*>& parameters, const Fit& fit,
                      const Eigen::VectorXd& step) {
  Imperfections at = fit.at;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const EffectParameter& parameter = *parameters[k];
    at.*parameter.member =
        std::clamp((fit.x[static_cast<Eigen::Index>(k)] + step[static_cast<Eigen::Index>(k)]) * parameter.step,
                   parameter.least, parameter.most);
  }
  return at;
}

/// Where a tendon may have slipped: the places of the bench's clock at which a step would take most out of the
/// residual.
std::vector<double> steps_in_time(const Evidence& evidence, const Fit& base) {
  struct Row {
    double time, residual;
  };
  std::vector<Row> rows;
  const std::vector<double> clock = bench_clock(evidence.measurement);
  std::size_t offset = 0;
  for (std::size_t i = 0; i < evidence.measurement.runs.size(); ++i) {
    const Run& run = evidence.measurement.runs[i];
    for (const Sample& sample : run.samples)
      rows.push_back({clock[i] + sample.time, base.residual[static_cast<Eigen::Index>(offset++)]});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.time < b.time; });
  double total = 0;
  for (const Row& row : rows) total += row.residual;
  const double count = static_cast<double>(rows.size());
  std::vector<std::pair<double, std::size_t>> gains;
  double sum = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    sum += rows[i - 1].residual;
    const double before = static_cast<double>(i);
    const double step = (total - sum) / (count - before) - sum / before;
    gains.emplace_back(-step * step * before * (count - before), i);
  }
  std::sort(gains.begin(), gains.end());
  std::vector<double> times;
  for (const auto& [gain, i] : gains) {
    const double time = 0.5 * (rows[i - 1].time + rows[i].time);
    const double apart = 0.02 * (rows.back().time - rows.front().time);
    const bool new_place = std::none_of(times.begin(), times.end(),
                                        [&, place = time](double other) { return std::abs(other - place) < apart; });
    if (new_place) times.push_back(time);
    if (times.size() == k_slip_times) break;
  }
  return times;
}

/// As things are, and the effect's own starts.
std::vector<std::vector<double>> starts_of(const Evidence& evidence, const Fit& base, const Effect& effect) {
  std::vector<std::vector<double>> starts = effect.starts;
  if (effect.starts_in_time) {
    for (const double time : steps_in_time(evidence, base)) {
      for (const double size : {0.0, 10.0, -10.0, 50.0, -50.0})
        starts.push_back({size * effect.parameters.front().step, time});
    }
  }
  const bool has_searched = std::any_of(effect.parameters.begin(), effect.parameters.end(),
                                        [](const EffectParameter& p) { return p.searched; });
  if (!has_searched) starts.insert(starts.begin(), std::vector<double>(effect.parameters.size(), 0.0));
  return starts;
}

// ---- statistics -----------------------------------------------------------------------------------------------------

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

StrokeScatter stroke_scatter(const Evidence& evidence, const Fit& fit) {
  std::map<std::pair<std::size_t, int>, std::vector<double>> alike;
  double squares = 0;
  double products = 0;
  double rows = 0;
  for (const Block& block : evidence.blocks) {
    double mean = 0;
    for (const std::size_t i : block.rows)
      mean += fit.residual[static_cast<Eigen::Index>(i)] / static_cast<double>(block.rows.size());
    alike[{block.run, evidence.measurement.runs[block.run].strokes[block.stroke].direction}].push_back(mean);
    double last = 0;
    for (const std::size_t i : block.rows) {
      const double deviation = fit.residual[static_cast<Eigen::Index>(i)] - mean;
      squares += deviation * deviation;
      products += deviation * last;
      last = deviation;
    }
    rows += static_cast<double>(block.rows.size());
  }
  double between = 0;
  double freedom = 0;
  for (const auto& [key, means] : alike) {
    const double centre = std::accumulate(means.begin(), means.end(), 0.0) / static_cast<double>(means.size());
    for (const double mean : means) between += (mean - centre) * (mean - centre);
    freedom += static_cast<double>(means.size()) - 1.0;
  }
  StrokeScatter scatter;
  scatter.within = rows > 0 ? std::sqrt(squares / rows) : 0.0;
  const double colour = squares > 0 ? std::clamp(products / squares, 0.0, 0.95) : 0.0;
  const double rows_a_stroke = rows / static_cast<double>(std::max<std::size_t>(1, evidence.blocks.size()));
  const double of_noise =
      scatter.within * scatter.within * (1.0 + colour) / (1.0 - colour) / std::max(1.0, rows_a_stroke);
  if (freedom > 0) scatter.between = std::sqrt(std::max(0.0, between / freedom - of_noise));
  return scatter;
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

Fit fit_effects(const Evidence& evidence, Forward& forward, const EffectSet& effects, const Imperfections& from) {
  silence_glog();
  Fit fit;
  fit.effects = effects;
  const std::vector<const EffectParameter*> parameters = varied(*evidence.declared, effects);
  std::vector<double> near;
  const Eigen::VectorXd before = said(evidence, forward, from).residual;
  for (const Block& block : evidence.blocks) {
    for (const std::size_t i : block.rows) near.push_back(before[static_cast<Eigen::Index>(i)]);
  }
  const double middle = median_of(near);
  for (double& value : near) value = std::abs(value - middle);
  const double scale = std::max(evidence.floor, 1.5 * median_of(near));
  Imperfections start = from;
  if (evidence.declared->transmission && from.zero == 0) start.zero = middle;
  const Misfit misfit(evidence, forward, parameters, start, scale);
  std::vector<double> x;
  for (const EffectParameter* parameter : parameters) x.push_back(start.*parameter->member / parameter->step);
  const double cost = parameters.empty() ? misfit.cost(x.data()) : solve(misfit, parameters, x);
  fit.usable = std::isfinite(cost);
  if (!fit.usable) return fit;
  fit.at = placed(parameters, start, x.data());
  fit.x = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  linearise(evidence, forward, parameters, fit);
  judge(evidence, parameters, fit);
  return fit;
}

// Chords instead of tangents: the slopes of the parameters that `base` has are its own, those of the effect are found
// anew at every step. So a candidate costs a dozen simulations, whatever stands beside it.
Fit with_effect(const Evidence& evidence, Forward& forward, const Fit& base, const Effect& effect) {
  EffectSet effects = base.effects;
  effects.push_back(&effect);
  const std::vector<const EffectParameter*> parameters = varied(*evidence.declared, effects);
  Fit best;
  Eigen::VectorXd step;
  double promised = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& values : starts_of(evidence, base, effect)) {
    Imperfections start = base.at;
    for (std::size_t k = 0; k < values.size(); ++k) start.*effect.parameters[k].member = values[k];
    Fit wider = widened(evidence, forward, base, parameters, start);
    const Normal normal = normal_equations(evidence, wider);
    if (!normal.finite) continue;
    const Eigen::VectorXd first = normal.step(wider.x, evidence.floor);
    if (!(normal.promised(first) < promised)) continue;
    promised = normal.promised(first);
    step = first;
    wider.mean_square = normal.rr;
    best = std::move(wider);
  }
  if (!std::isfinite(promised)) return best;
  double sum = best.mean_square;
  for (int i = 0; i < k_chords; ++i) {
    Fit next = widened(evidence, forward, base, parameters, stepped(parameters, best, step));
    const Normal normal = normal_equations(evidence, next);
    if (!normal.finite || !(normal.rr < sum)) {
      step *= 0.3;
      continue;
    }
    const bool settled = normal.rr > (1.0 - k_settled) * sum;
    sum = normal.rr;
    step = normal.step(next.x, evidence.floor);
    best = std::move(next);
    if (settled) break;
  }
  best.effects = effects;
  best.usable = true;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (at_bound(best.at, *parameters[k])) best.J.col(static_cast<Eigen::Index>(k)).setZero();
  }
  judge(evidence, parameters, best);
  return best;
}

Fit with_direction(const Evidence& evidence, Forward& forward, const Fit& fit, const Effect& effect) {
  Fit wider = fit;
  wider.effects.push_back(&effect);
  const std::vector<std::vector<double>> starts = starts_of(evidence, fit, effect);
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const EffectParameter& parameter = effect.parameters[k];
    if (parameter.searched && !starts.empty()) wider.at.*parameter.member = starts.front()[k];
  }
  const std::vector<const EffectParameter*> parameters = varied(*evidence.declared, wider.effects);
  wider.x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
  wider.x.head(fit.x.size()) = fit.x;
  wider.J.conservativeResize(Eigen::NoChange, wider.x.size());
  for (Eigen::Index k = fit.x.size(); k < wider.x.size(); ++k) {
    wider.J.col(k) = slope_at(evidence, forward, wider.at, *parameters[static_cast<std::size_t>(k)], fit.residual);
  }
  judge(evidence, parameters, wider);
  return wider;
}

Comparison compare(const Evidence& evidence, const Fit& worse, const Fit& better) {
  Comparison comparison;
  std::vector<double> drops;
  std::map<std::size_t, std::vector<double>> by_run;
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b) {
    const double drop = worse.by_factor.by_block[b] - better.by_factor.by_block[b];
    if (!std::isfinite(drop)) continue;
    drops.push_back(drop);
    by_run[evidence.blocks[b].run].push_back(drop);
  }
  comparison.t = t_of(drops, &comparison.mean, &comparison.standard_error);
  comparison.needed_t = t95(static_cast<double>(drops.size()) - 1.0);
  std::vector<double> runs;
  for (const auto& [run, values] : by_run)
    runs.push_back(std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()));
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

namespace {

/// Spread of the fitted x that the scatter between runs makes (clusters); zero with fewer than three runs.
Eigen::VectorXd scatter_between_runs(const Evidence& evidence, const Fit& fit, const Eigen::MatrixXd& inverse) {
  std::map<std::size_t, Eigen::VectorXd> pulls;
  for (std::size_t b = 0; b < fit.sums.size(); ++b) {
    auto [place, added] = pulls.try_emplace(evidence.blocks[b].run, Eigen::VectorXd::Zero(fit.x.size()));
    place->second += fit.sums[b].Jr;
  }
  const double runs = static_cast<double>(pulls.size());
  if (runs < 3) return Eigen::VectorXd::Zero(fit.x.size());
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(fit.x.size(), fit.x.size());
  for (const auto& [run, pull] : pulls) scatter += pull * pull.transpose();
  return (runs / (runs - 1.0) * inverse * scatter * inverse).diagonal().cwiseMax(0.0).cwiseSqrt();
}

}  // namespace

std::vector<Interval> intervals(const Evidence& evidence, const Fit& fit) {
  const auto count = static_cast<std::size_t>(fit.x.size());
  std::vector<std::vector<double>> values(count);
  Dice dice;
  const std::size_t blocks = fit.sums.size();
  const double ridge = 1e-6;
  for (int resample = 0; resample < k_resamples; ++resample) {
    Eigen::MatrixXd JJ = fit.readings.JJ;
    Eigen::VectorXd Jr = fit.readings.Jr;
    for (std::size_t i = 0; i < blocks; ++i) {
      const BlockSums& sums = fit.sums[dice.below(blocks)];
      JJ += sums.JJ;
      Jr += sums.Jr;
    }
    const Eigen::VectorXd x = fit.x + solved(JJ, Jr, fit.x, ridge);
    for (std::size_t k = 0; k < count; ++k) values[k].push_back(x[static_cast<Eigen::Index>(k)]);
  }
  Eigen::MatrixXd information = fit.readings.JJ + 1e-18 * Eigen::MatrixXd::Identity(fit.x.size(), fit.x.size());
  for (const BlockSums& sums : fit.sums) information += sums.JJ;
  const Eigen::VectorXd between = scatter_between_runs(
      evidence, fit, information.ldlt().solve(Eigen::MatrixXd::Identity(fit.x.size(), fit.x.size())));
  std::vector<Interval> found(count);
  for (std::size_t k = 0; k < count; ++k) {
    std::sort(values[k].begin(), values[k].end());
    const double centre = fit.x[static_cast<Eigen::Index>(k)];
    const double half = 1.96 * between[static_cast<Eigen::Index>(k)];
    found[k].low = std::min(values[k][k_resamples / 40], centre - half);
    found[k].high = std::max(values[k][k_resamples - 1 - k_resamples / 40], centre + half);
    found[k].deviation = 0.25 * (found[k].high - found[k].low);
  }
  return found;
}

}  // namespace fusee
