/// \file
/// Internal: lower bounds of an objective over a box of designs.
#pragma once

#include <optional>
#include <vector>

#include "fusee/optimize.h"
#include "optimize/objective_at.h"
#include "optimize/relaxation.h"

namespace fusee::optimize {

/// Result of BoundCalculator::bound().
struct BoxBound {
  bool possible = true;  ///< false: no possible design of the box has a value of at most `limit`
  double bound = 0;
  Design lowest;                               ///< estimated minimizer in the box, worth evaluating; empty: unknown
  std::array<double, k_max_variables> loss{};  ///< contribution of each variable's width to the error of the bound
  long evaluations = 0;                        ///< interval evaluations of the formulas at one angle
};

/// Computes bounds. Calls are deterministic and thread-safe.
class BoundCalculator {
 public:
  /// Designs satisfy the problem's constraints, its cap and, if Problem::feasible, the conditions of conditions_at.h.
  BoundCalculator(const Problem& problem, Objective objective);

  /// Bounds the designs of the box with an objective of at most `limit`, and cuts off parts of the box without such
  /// designs.
  BoxBound bound(Box& box, double limit) const;
  /// Estimated minimizer near a design, by linearization: every variable moves by at most the share `size` of its
  /// range. Empty if there is none.
  Design lowest_around(const Design& design, double size) const;
  /// The objective of one design over the whole range, rounded up; infinite if it cannot be bounded.
  double rounded_up_value(const Design& design) const;

 private:
  /// A number of the file that a design changes.
  struct Number {
    std::size_t slot;  ///< index in k_slots
    const MovingKey* moving;
  };
  struct Query;
  using Lines = std::vector<LineBelow>;
  template <typename S>
  DesignNumbers<S> numbers_of(const std::vector<S>& variables) const;
  DesignNumbers<transmission::Jet> numbers_over(const Box& box) const;
  transmission::Jet value_of(const Query& query, const DesignNumbers<transmission::Jet>& numbers,
                             transmission::Domain& domain) const;
  transmission::Jet value_at(const Query& query, const Box& box, transmission::Domain& domain) const;
  transmission::Jet slopes_at(const Query& query, const Box& box, transmission::Domain& domain) const;

  PinAngles least_angles(const Box& box, double place) const;

  Lines lines_of_constraints(const Box& box, double slack) const;
  std::vector<Query> queries_around(const std::vector<double>& middle) const;
  double excess_of(const Query& query, const std::vector<double>& design) const;
  void add_worst_places(Objective objective, bool of_cap, const DesignNumbers<double>& middle,
                        std::vector<Query>& queries) const;
  std::size_t condition_query_count() const;
  void add_tightest_places(const DesignNumbers<double>& middle, std::vector<Query>& queries) const;
  void add_lines(const Box& box, Query query, Lines& lines, BoxBound& result, double limit) const;
  void add_lines_of(const Box& box, const Query& query, Lines& lines, BoxBound& result, double limit) const;
  LineBelow line_from(const Box& box, const Query& query, const transmission::Jet& over, bool from_highest,
                      bool& exists) const;
  double quotient_bound(const Box& box, double place, const Lines& constraints) const;
  transmission::Interval value_over_piece(const Design& design, double low, double high) const;

  const Problem& problem_;
  Objective objective_;
  FileNumbers<double> base_;
  WideKind wide_kind_;
  WideFileNumbers<double> wide_base_;
  std::vector<Number> numbers_;  ///< numbers that a design changes
};

}  // namespace fusee::optimize
