/// \file
/// Lookup table of both tendon paths between pin and pulley, since a fit evaluates one geometry at thousands of angles.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fusee/joint.h"

namespace fusee::joint {

/// Quintic interpolation over six pulley angles about 1.4° apart, accurate to 1e-7 mm. Outside the table, and where a
/// tendon has no path, JointModel::lower is called.
class LowerPathTable {
 public:
  /// Covers pulley angles from `least` to `most`, rad.
  LowerPathTable(const JointModel& model, double least, double most);

  std::array<LowerPath, 2> paths(double alpha) const;
  /// JointModel::expected: a start for root finders.
  double expected(double alpha) const;

 private:
  /// p, normal, reach and wound of the left tendon, of the right one, and the expected θ.
  static constexpr std::size_t k_members = 9;
  using Node = std::array<double, k_members>;

  /// Six neighbouring nodes: index of the first, and the interpolation weights at `alpha`.
  struct Interpolation {
    std::size_t first = 0;
    std::array<double, 6> weights{};
  };
  bool covers(double alpha) const;
  Interpolation interpolation_at(double alpha) const;

  double least_;  ///< lower end of the table, rad
  double step_;   ///< distance of its nodes, rad
  std::vector<Node> values_;
  std::function<std::array<LowerPath, 2>(double)> exact_;
  std::function<double(double)> exact_expected_;
};

}  // namespace fusee::joint
