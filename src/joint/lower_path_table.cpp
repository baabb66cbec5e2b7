#include "joint/lower_path_table.h"

#include <algorithm>
#include <cmath>

namespace fusee {
namespace {

constexpr double k_step = 0.012;  // rad
constexpr std::size_t k_most_pieces = 4096;

template <typename Knot>
Knot slope_at(const std::vector<Knot>& values, std::size_t i) {
  Knot slope{};
  const std::size_t last = values.size() - 1;
  for (std::size_t k = 0; k < slope.size(); ++k) {
    const auto at = [&](std::size_t j) { return values[j][k]; };
    if (i >= 2 && i + 2 <= last) {
      slope[k] = (at(i - 2) - 8.0 * at(i - 1) + 8.0 * at(i + 1) - at(i + 2)) / 12.0;
    } else if (i < 2) {
      slope[k] = (-25.0 * at(i) + 48.0 * at(i + 1) - 36.0 * at(i + 2) + 16.0 * at(i + 3) - 3.0 * at(i + 4)) / 12.0;
    } else {
      slope[k] = (25.0 * at(i) - 48.0 * at(i - 1) + 36.0 * at(i - 2) - 16.0 * at(i - 3) + 3.0 * at(i - 4)) / 12.0;
    }
  }
  return slope;
}

}  // namespace

LowerPathTable::LowerPathTable(const JointModel& model, double least, double most)
    : least_(least), exact_(model.lower), exact_expected_(model.expected) {
  const auto pieces =
      static_cast<std::size_t>(std::clamp(std::ceil((most - least) / k_step), 8.0, static_cast<double>(k_most_pieces)));
  step_ = (most - least) / static_cast<double>(pieces);
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double alpha = least + step_ * static_cast<double>(i);
    const auto [left, right] = exact_(alpha);
    values_.push_back({left.p, left.normal, left.reach, left.wound, right.p, right.normal, right.reach, right.wound,
                       exact_expected_(alpha)});
  }
  for (std::size_t i = 0; i <= pieces; ++i) slopes_.push_back(slope_at(values_, i));
}

std::array<LowerPath, 2> LowerPathTable::paths(double alpha) const {
  const double place = (alpha - least_) / step_;
  if (!(place >= 0 && place < static_cast<double>(values_.size() - 1))) return exact_(alpha);
  const auto i = static_cast<std::size_t>(place);
  const double u = place - static_cast<double>(i);
  const double a = u * u * (2.0 * u - 3.0) + 1.0;
  const double b = u * (u - 1.0) * (u - 1.0);
  const double c = u * u * (3.0 - 2.0 * u);
  const double d = u * u * (u - 1.0);
  std::array<double, k_members> at{};
  for (std::size_t k = 0; k < k_members; ++k)
    at[k] = a * values_[i][k] + b * slopes_[i][k] + c * values_[i + 1][k] + d * slopes_[i + 1][k];
  // Next to where the law ends a cubic knows nothing.
  if (!std::isfinite(at[3]) || !std::isfinite(at[7])) return exact_(alpha);
  return {LowerPath{at[0], at[1], at[2], at[3]}, LowerPath{at[4], at[5], at[6], at[7]}};
}

double LowerPathTable::expected(double alpha) const {
  const double place = (alpha - least_) / step_;
  if (!(place >= 0 && place < static_cast<double>(values_.size() - 1))) return exact_expected_(alpha);
  const auto i = static_cast<std::size_t>(place);
  return values_[i].back() + (place - static_cast<double>(i)) * (values_[i + 1].back() - values_[i].back());
}

}  // namespace fusee
