/// \file
/// Where both tendons run between pin and pulley, looked up: a fit asks for the same geometry at thousands of places.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fusee/joint/joint_model.h"

namespace fusee {

/// By cubics over pulley angles half a degree or so apart: to 1e-7 mm of JointModel::lower. The function itself answers
/// outside and where a tendon has no path.
class LowerPathTable {
 public:
  /// Over pulley angles from `least` to `most`, rad.
  LowerPathTable(const JointModel& model, double least, double most);

  std::array<LowerPath, 2> paths(double alpha) const;
  /// JointModel::expected: a start for root finders, straight between places.
  double expected(double alpha) const;

 private:
  /// p, normal, reach and wound of the left tendon, of the right one, and the expected θ.
  static constexpr std::size_t k_members = 9;
  using Knot = std::array<double, k_members>;

  double least_;
  double step_;
  std::vector<Knot> values_;
  std::vector<Knot> slopes_;  ///< per step
  std::function<std::array<LowerPath, 2>(double)> exact_;
  std::function<double(double)> exact_expected_;
};

}  // namespace fusee
