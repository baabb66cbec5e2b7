/// \file
/// Internal: what an objective cannot fall below over a box of designs.
#pragma once

#include <optional>
#include <vector>

#include "fusee/optimize/problem.h"
#include "optimize/objective_at.h"
#include "optimize/relaxation.h"

namespace fusee {

struct BoxBound {
  bool possible = true;  ///< false: no design of the box has a value of `limit` or less
  double bound = 0;
  Design lowest;  ///< where what is known of the box is lowest: a design worth trying; empty: nothing is known
  std::array<double, k_most_variables> loss{};  ///< how much of the bound's error goes with the width of each variable
  long evaluations = 0;                         ///< of formulas at one angle, over intervals
};

/// Every call says the same of the same box: it may be asked from several threads at once.
class Bounder {
 public:
  /// Designs keep the problem's constraints, its cap and, where `feasible`, the conditions of conditions_at.h.
  Bounder(const Problem& problem, Objective objective);

  /// What designs of the box with an objective of at most `limit` are worth; cuts off the box what holds none of them.
  BoxBound bound(Box& box, double limit) const;
  /// Where the objective would be least within `size` of every variable's range around a design, were everything as
  /// linear as it is there: a guess. Empty where there is none.
  Design lowest_around(const Design& design, double size) const;
  /// The objective of one design, over the whole range, rounded up; infinite when it cannot be bounded.
  double rounded_up_value(const Design& design) const;

 private:
  /// Of the file, and changed by a design.
  struct Number {
    std::size_t slot;
    const MovingKey* moving;
  };
  struct Asked;
  using Lines = std::vector<LineBelow>;
  template <typename S>
  DesignNumbers<S> numbers_of(const std::vector<S>& variables) const;
  DesignNumbers<Jet> numbers_over(const Box& box) const;
  Jet value_of(const Asked& asked, const DesignNumbers<Jet>& numbers, Domain& domain) const;
  Jet value_at(const Asked& asked, const Box& box, Domain& domain) const;
  Jet slopes_at(const Asked& asked, const Box& box, Domain& domain) const;

  PinAngles least_angles(const Box& box, double place) const;

  Lines lines_of_constraints(const Box& box, double slack) const;
  std::vector<Asked> asked_around(const std::vector<double>& middle) const;
  double excess_of(const Asked& asked, const std::vector<double>& design) const;
  void ask_worst_places(Objective objective, bool of_cap, const DesignNumbers<double>& middle,
                        std::vector<Asked>& asked) const;
  std::size_t asked_conditions() const;
  void ask_tightest_places(const DesignNumbers<double>& middle, std::vector<Asked>& asked) const;
  void add_lines(const Box& box, Asked asked, Lines& lines, BoxBound& result, double limit) const;
  void add_lines_of(const Box& box, const Asked& asked, Lines& lines, BoxBound& result, double limit) const;
  LineBelow line_from(const Box& box, const Asked& asked, const Jet& over, bool from_highest, bool& exists) const;
  double quotient_bound(const Box& box, double place, const Lines& constraints) const;
  Interval value_over_piece(const Design& design, double low, double high) const;

  const Problem& problem_;
  Objective objective_;
  FileNumbers<double> base_;
  WideKind wide_kind_;
  WideFileNumbers<double> wide_base_;
  std::vector<Number> numbers_;  ///< that move
};

}  // namespace fusee
