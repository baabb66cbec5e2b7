#include "calibration/validation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/thresholds.h"
#include "fusee/joint.h"

namespace fusee::calibration {
namespace {

/// Standard errors over strokes by which a level may get worse by chance.
constexpr double k_errors_by_chance = 2.0;
/// Rows of a run that was kept for validation.
constexpr std::size_t k_rows_a_kept_run = 400;

std::string names_of(const Evidence& evidence, const Fold& fold) {
  std::string text;
  for (const std::string& name : evidence.run_names(fold)) text += (text.empty() ? "" : ", ") + name;
  return text;
}

double mean_square(const measurement::Run& run, const measurement::Stroke& stroke, const std::vector<double>& model,
                   double& rows) {
  double squares = 0;
  rows = 0;
  for (std::size_t i = stroke.first; i <= stroke.last; ++i) {
    const double error = run.samples[i].theta - model[i];
    if (!std::isfinite(error)) continue;
    squares += error * error;
    rows += 1;
  }
  return rows > 0 ? squares / rows : 0.0;
}

}  // namespace

Estimate declared_estimate(FitterPool& pool, const Selection& selection) {
  if (selection.none.x.size() == 0) return {selection.none, {}};
  Fit fit = pool.one().fit_least_squares(selection.none);
  return {fit.usable ? std::move(fit) : selection.none, {}};
}

HeldOut hold_out(const Evidence& evidence, const Estimate& estimate, const std::vector<Fold>& folds) {
  if (estimate.beside) return hold_out_with_discrepancy(evidence, estimate.fit, *estimate.beside, folds).effects;
  return hold_out(evidence, estimate.fit, folds);
}

std::vector<Imperfections> estimates_without(const Evidence& evidence, const Estimate& estimate,
                                             const std::vector<Fold>& folds) {
  const Fit& fit = estimate.fit;
  const Amplitudes* beside = estimate.beside ? &*estimate.beside : nullptr;
  std::vector<Imperfections> all;
  for (const Eigen::VectorXd& x : numbers_without(evidence, fit, beside, folds)) {
    Imperfections at = fit.at;
    for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
      const EffectParameter& parameter = *fit.parameters[k];
      const double value = x[static_cast<Eigen::Index>(k)] * parameter.step;
      set_value(at, parameter, std::clamp(value, parameter.least, parameter.most));
    }
    all.push_back(at);
  }
  return all;
}

HeldOutRows::HeldOutRows(const Evidence& evidence, const Estimate& declared, measurement::Measurement kept)
    : evidence_(evidence), declared_(declared), kept_(with_fewer_rows(std::move(kept), k_rows_a_kept_run)) {}

HeldOutRows::Level HeldOutRows::level_of(const std::string& name, const Fold& fold, const HeldOut& before,
                                         const HeldOut& after) const {
  Level level{name, {}};
  for (const std::size_t b : fold) {
    const Block block{static_cast<double>(evidence_.blocks[b].rows.size()), before.by_block[b], after.by_block[b]};
    if (std::isfinite(block.before) && std::isfinite(block.after)) level.blocks.push_back(block);
  }
  return level;
}

std::vector<HeldOutRows::Level> HeldOutRows::left_out(const std::vector<Fold>& folds, const Estimate& answer) const {
  const HeldOut before = hold_out(evidence_, declared_, folds), after = hold_out(evidence_, answer, folds);
  std::vector<Level> levels;
  for (const Fold& fold : folds) levels.push_back(level_of(names_of(evidence_, fold), fold, before, after));
  return levels;
}

/// Levels of the kept runs: each run has its load and speed.
std::vector<HeldOutRows::Level> HeldOutRows::kept_apart(const Estimate& answer) const {
  const joint::BenchLog log = measurement::bench_log(kept_);
  const joint::Readings before = joint::predict(*evidence_.declared, declared_.fit.at, log),
                        after = joint::predict(*evidence_.declared, answer.fit.at, log);
  std::vector<Level> levels;
  for (std::size_t r = 0; r < kept_.runs.size(); ++r) {
    const measurement::Run& run = kept_.runs[r];
    Level& level = levels.emplace_back(Level{run.name, {}});
    for (const measurement::Stroke& stroke : run.strokes) {
      Block block;
      if (stroke.partial) continue;
      block.before = mean_square(run, stroke, before[r], block.rows);
      block.after = mean_square(run, stroke, after[r], block.rows);
      if (block.rows > 0) level.blocks.push_back(block);
    }
  }
  return levels;
}

HeldOutRows::Block HeldOutRows::sum_of(const std::vector<Block>& blocks) {
  Block sum;
  for (const Block& block : blocks) {
    sum.rows += block.rows;
    sum.before += block.rows * block.before;
    sum.after += block.rows * block.after;
  }
  return sum;
}

/// Standard error of the mean change of the squares, by its scatter between blocks, rad².
double HeldOutRows::standard_error(const std::vector<Block>& blocks) {
  const Block sum = sum_of(blocks);
  const double more = (sum.after - sum.before) / sum.rows;
  const auto count = static_cast<double>(blocks.size());
  double squares = 0;
  for (const Block& block : blocks)
    squares += elementary::pow(block.rows * (block.after - block.before - more) / sum.rows, 2);
  return std::sqrt(squares * count / (count - 1.0));
}

/// True if the squares rise by more than is visible and by more than strokes scatter; a single stroke is compared with
/// the scatter of `all` levels.
bool HeldOutRows::gets_worse(const Level& level, const Level& all) const {
  const Block sum = sum_of(level.blocks);
  if (sum.rows == 0) return false;
  const double more = (sum.after - sum.before) / sum.rows;
  if (more <= elementary::pow(k_thresholds.least_residual * evidence_.floor, 2)) return false;
  if (all.blocks.size() < 2) return true;
  const double error = level.blocks.size() > 1
                           ? standard_error(level.blocks)
                           : standard_error(all.blocks) * std::sqrt(sum_of(all.blocks).rows / sum.rows);
  return more > k_errors_by_chance * error;
}

std::string HeldOutRows::worse_among(const std::vector<Level>& levels) const {
  Level all{"all rows", {}};
  for (const Level& level : levels) all.blocks.insert(all.blocks.end(), level.blocks.begin(), level.blocks.end());
  if (gets_worse(all, all)) return all.name;
  const auto worse =
      std::find_if(levels.begin(), levels.end(), [&](const Level& level) { return gets_worse(level, all); });
  return worse == levels.end() ? "" : worse->name;
}

std::string HeldOutRows::worse_at(const Estimate& answer) const {
  std::vector<std::vector<Level>> all = {left_out(evidence_.run_folds, answer),
                                         left_out(evidence_.factor_folds, answer)};
  if (!kept_.runs.empty()) all.push_back(kept_apart(answer));
  for (const std::vector<Level>& levels : all) {
    if (std::string where = worse_among(levels); !where.empty()) return where;
  }
  return "";
}

void drop_effect(FitterPool& pool, std::size_t place, const std::string& why, Selection& selection) {
  const fusee::Effect* gone = selection.best.effects[place];
  const EffectSet before = selection.best.effects;
  const std::vector<CredibleGroup> groups = std::move(selection.groups);
  selection.best = selection.without[place].usable ? selection.without[place] : selection.none;
  selection.groups.clear();
  for (const fusee::Effect* effect : selection.best.effects) {
    const auto own = static_cast<std::size_t>(std::find(before.begin(), before.end(), effect) - before.begin());
    selection.groups.push_back(groups[own]);
  }
  std::erase_if(selection.rivals,
                [&](const Rival& rival) { return !contains(selection.best.effects, *rival.accepted); });
  const Fit& best = selection.best;
  selection.without.assign(best.effects.size(), {});
  pool.each(best.effects.size(), [&](const Fitter& fitter, std::size_t i) {
    const fusee::Effect& effect = *best.effects[i];
    selection.without[i] = fitter.fit(without(best.effects, effect), without(best.at, effect));
  });
  for (Candidate& candidate : selection.tried) {
    if (contains(best.effects, *gone) || candidate.name != gone->name) continue;
    candidate.accepted = false;
    candidate.why = why;
  }
}

}  // namespace fusee::calibration
