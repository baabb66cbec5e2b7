/// \file
/// Internal: what an objective cannot fall below over a box of designs.
#pragma once

#include <array>
#include <vector>

#include "fusee/optimize/problem.h"
#include "transmission/interval.h"

namespace fusee {

struct Box {
  std::array<double, Jet::k_most> lower{};
  std::array<double, Jet::k_most> upper{};
  double bound = 0;  ///< no design of the box is better
  int cut = 0;       ///< the variable whose halving promises most
};

struct BoxBound {
  bool possible = true;  ///< false: no design of the box has a value
  double bound = 0;
  Design best_corner;                           ///< where the linear model of the box is lowest: a design worth trying
  std::array<double, Jet::k_most> influence{};  ///< |slope| × width of each variable: where a cut helps most
};

class Bounder {
 public:
  Bounder(const Problem& problem, Objective objective);

  /// Cuts off what no constraint allows. False when nothing is left.
  bool contract(Box& box) const;
  /// From the box's worst places of the stroke. Stops looking once the bound is above `enough`.
  BoxBound bound(const Box& box, double enough) const;
  /// The objective of one design, over the whole range, rounded up; infinite when it cannot be bounded.
  double rounded_up_value(const Design& design) const;

  long evaluations() const { return evaluations_; }

 private:
  std::vector<double> worst_places(const Box& box) const;
  void bound_at(const Box& box, double place, BoxBound& best, double enough) const;

  const Problem& problem_;
  Objective objective_;
  mutable long evaluations_ = 0;
};

}  // namespace fusee
