#include "calibration/changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace fusee::calibration {
namespace {

bool has_size(const fusee::Effect& effect, const Imperfections& joint) {
  return std::any_of(effect.parameters.begin(), effect.parameters.end(),
                     [&](const EffectParameter& p) { return !p.searched && value_of(joint, p) != 0; });
}

/// A joint has one order of each wave: an existing wave may change in size and phase only.
void keep_order(const Imperfections& before, fusee::Effect& effect) {
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const EffectParameter& parameter = effect.parameters[k];
    if (!parameter.searched) continue;
    const double order = value_of(before, parameter);
    std::erase_if(effect.starts,
                  [&](const std::vector<double>& start) { return start.size() > k && start[k] != order; });
  }
}

/// Adds starts of the opposite sign for numbers that may shrink.
void add_opposite_starts(fusee::Effect& effect) {
  const std::vector<std::vector<double>> starts = effect.starts;
  for (std::vector<double> start : starts) {
    bool fits = false;
    for (std::size_t k = 0; k < start.size(); ++k) {
      const EffectParameter& parameter = effect.parameters[k];
      if (parameter.searched || start[k] == 0) continue;
      start[k] = -start[k];
      fits = start[k] > parameter.least;
      if (!fits) break;
    }
    if (fits && std::find(effect.starts.begin(), effect.starts.end(), start) == effect.starts.end())
      effect.starts.push_back(start);
  }
}

fusee::Effect change_of(const Imperfections& before, fusee::Effect effect) {
  if (has_size(effect, before)) keep_order(before, effect);
  for (EffectParameter& parameter : effect.parameters) {
    if (parameter.searched) continue;
    const double value = value_of(before, parameter);
    parameter.least -= value;
    parameter.most -= value;
    parameter.value_if_absent = -value;
  }
  add_opposite_starts(effect);
  return effect;
}

}  // namespace

std::vector<fusee::Effect> changes_from(const Imperfections& before, JointKind kind) {
  std::vector<fusee::Effect> all;
  for (const fusee::Effect& effect : effects(kind)) {
    // The model of a slip has one time, so an existing slip excludes a second one.
    if (effect.starts_in_time && has_size(effect, before)) continue;
    all.push_back(change_of(before, effect));
  }
  if (kind == JointKind::ratio) all.push_back(change_of(before, *find_effect("zero_offset", JointKind::tendons)));
  if (kind == JointKind::ratio) all.back().needs = {};
  return all;
}

namespace {

/// Discrepancy beside `fit` at the rows in use, without the families of single runs and strokes.
Eigen::VectorXd shared_discrepancy(const Evidence& evidence, const Fit& fit) {
  return sum_of_families(evidence.evidence_model->discrepancy(), fit.posterior.coefficients, [](Factor factor) {
    return factor != Factor::run && factor != Factor::drift && factor != Factor::stroke;
  });
}

/// Variance of the size of a change, from one state: Σ (gᵣ·eᵣ)² / (Σ gᵣ·gᵣ)² over its clusters, corrected for their
/// number.
class ClusteredVariance {
 public:
  void take(std::size_t cluster, double contribution, double residual) {
    products_[cluster] += contribution * residual;
    squares_ += contribution * contribution;
  }
  double value() const {
    const double count = static_cast<double>(products_.size());
    double sum = 0;
    for (const auto& [cluster, product] : products_) sum += product * product;
    return squares_ > 0 && count > 1 ? count / (count - 1) * sum / (squares_ * squares_) : 0.0;
  }

 private:
  std::map<std::size_t, double> products_;
  double squares_ = 0;
};

/// `contribution`: of the change to all rows of both states; `residual`: of the fit beside the shared discrepancy, at
/// the rows in use.
double size_by_scatter(const Evidence& evidence, const Eigen::VectorXd& contribution, const Eigen::VectorXd& residual) {
  const std::size_t first = evidence.earlier->runs, runs = evidence.measurement.runs.size();
  std::array<ClusteredVariance, 2> states;
  Eigen::Index at = 0;
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b) {
    const Block& block = evidence.blocks[b];
    const bool is_later = block.run >= first;
    const bool is_alone = (is_later ? runs - first : first) < 2;
    for (const std::size_t row : block.rows)
      states[is_later ? 1 : 0].take(is_alone ? b : block.run, contribution[static_cast<Eigen::Index>(row)],
                                    residual[at++]);
  }
  const double variance = states[0].value() + states[1].value();
  return variance > 0 ? 1.0 / std::sqrt(variance) : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<double> sizes_by_scatter(const Evidence& evidence, const Fit& fit) {
  const JointKind kind = kind_of(*evidence.declared);
  const Imperfections& before = evidence.earlier->joint;
  joint::Forward forward(*evidence.declared, evidence.log);
  const Eigen::VectorXd residual = fit.residual(evidence.rows()) - shared_discrepancy(evidence, fit);
  const Eigen::VectorXd whole = flat(forward(changed(before, fit.at, kind)));
  std::vector<double> all;
  for (const fusee::Effect* effect : fit.effects)
    all.push_back(
        size_by_scatter(evidence, whole - flat(forward(changed(before, without(fit.at, *effect), kind))), residual));
  return all;
}

StateDifference state_difference(const Evidence& evidence, const Fit& none, const Fit& changed) {
  const Eigen::VectorXd shared = shared_discrepancy(evidence, changed);
  double before = 0, after = 0, rows = 0;
  Eigen::Index at = 0;
  for (const Block& block : evidence.blocks) {
    for (const std::size_t row : block.rows) {
      const double discrepancy = shared[at++];
      if (block.run < evidence.earlier->runs) continue;
      const double unchanged = none.residual[static_cast<Eigen::Index>(row)] - discrepancy;
      before += unchanged * unchanged;
      after += elementary::pow(changed.residual[static_cast<Eigen::Index>(row)] - discrepancy, 2);
      rows += 1;
    }
  }
  if (rows == 0) return {};
  return {std::sqrt(before / rows), std::sqrt(after / rows)};
}

}  // namespace fusee::calibration
