/// \file
/// Where both tendons run between pin and pulley, looked up: a fit asks for the same geometry at thousands of places.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fusee/joint/joint_model.h"

namespace fusee {

/// By quintics through six pulley angles a degree and a half or so apart: to 1e-7 mm of JointModel::lower. The function
/// itself answers outside and where a tendon has no path.
class LowerPathTable {
 public:
  /// Over pulley angles from `least` to `most`, rad.
  LowerPathTable(const JointModel& model, double least, double most);

  std::array<LowerPath, 2> paths(double alpha) const;
  /// JointModel::expected: a start for root finders.
  double expected(double alpha) const;

 private:
  /// p, normal, reach and wound of the left tendon, of the right one, and the expected θ.
  static constexpr std::size_t k_members = 9;
  using Knot = std::array<double, k_members>;

  /// Of six neighbouring places: the first one, and what each weighs in the value at `alpha`.
  struct Near {
    std::size_t first = 0;
    std::array<double, 6> weights{};
  };
  bool covers(double alpha) const;
  Near near(double alpha) const;

  double least_;
  double step_;
  std::vector<Knot> values_;
  std::function<std::array<LowerPath, 2>(double)> exact_;
  std::function<double(double)> exact_expected_;
};

}  // namespace fusee
