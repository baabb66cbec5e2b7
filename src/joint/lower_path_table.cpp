#include "joint/lower_path_table.h"

#include <algorithm>
#include <cmath>

namespace fusee::joint {
namespace {

constexpr double k_step = 0.024;  // rad
constexpr std::size_t k_most_intervals = 4096;

/// Lagrange weights of the points 0 … 5 at `u`.
std::array<double, 6> weights_at(double u) {
  constexpr std::size_t count = 6;
  constexpr std::array<double, count> k_denominators{-120, 24, -12, 12, -24, 120};  // ∏ (k − j) over the other points j
  std::array<double, count> before{}, weights{};
  double product = 1;
  for (std::size_t k = 0; k < count; ++k) {
    before[k] = product;
    product *= u - static_cast<double>(k);
  }
  product = 1;
  for (std::size_t k = count; k-- > 0;) {
    weights[k] = before[k] * product / k_denominators[k];
    product *= u - static_cast<double>(k);
  }
  return weights;
}

}  // namespace

LowerPathTable::LowerPathTable(const JointModel& model, double least, double most)
    : least_(least), exact_(model.lower), exact_expected_(model.expected) {
  const auto intervals = static_cast<std::size_t>(
      std::clamp(std::ceil((most - least) / k_step), 8.0, static_cast<double>(k_most_intervals)));
  step_ = (most - least) / static_cast<double>(intervals);
  for (std::size_t i = 0; i <= intervals; ++i) {
    const double alpha = least + step_ * static_cast<double>(i);
    const auto [left, right] = exact_(alpha);
    values_.push_back({left.p, left.normal, left.reach, left.wound, right.p, right.normal, right.reach, right.wound,
                       exact_expected_(alpha)});
  }
}

bool LowerPathTable::covers(double alpha) const {
  return alpha >= least_ && alpha < least_ + step_ * static_cast<double>(values_.size() - 1);
}

LowerPathTable::Interpolation LowerPathTable::interpolation_at(double alpha) const {
  const double position = (alpha - least_) / step_;
  // `alpha` lies between the third and the fourth node, except at the ends.
  const auto before = static_cast<std::size_t>(position);
  const std::size_t first = std::min(before - std::min<std::size_t>(before, 2), values_.size() - 6);
  return {first, weights_at(position - static_cast<double>(first))};
}

std::array<LowerPath, 2> LowerPathTable::paths(double alpha) const {
  if (!covers(alpha)) return exact_(alpha);
  const Interpolation near = interpolation_at(alpha);
  Node at{};
  for (std::size_t i = 0; i < near.weights.size(); ++i) {
    for (std::size_t k = 0; k < k_members; ++k) at[k] += near.weights[i] * values_[near.first + i][k];
  }
  const LowerPath left{at[0], at[1], at[2], at[3]}, right{at[4], at[5], at[6], at[7]};
  // Next to the end of the law a node has no path, and the interpolation is invalid.
  if (!std::isfinite(left.wound) || !std::isfinite(right.wound)) return exact_(alpha);
  return {left, right};
}

double LowerPathTable::expected(double alpha) const {
  if (!covers(alpha)) return exact_expected_(alpha);
  const Interpolation near = interpolation_at(alpha);
  double expected = 0;
  for (std::size_t i = 0; i < near.weights.size(); ++i) expected += near.weights[i] * values_[near.first + i].back();
  return expected;
}

}  // namespace fusee::joint
