/// \file
/// Proven global optimum: branch and bound with outward-rounded intervals over the variables and the stroke.
/// Constraints are satisfied to 1e-12 of their largest term, in the bound and in the designs.
#pragma once

#include "fusee/base/run_context.h"
#include "fusee/optimize/problem.h"

namespace fusee {

struct CertifiedOptions {
  double gap = 1e-6;          ///< relative, between the best design's value and the proven bound
  double tie = 1e-3;          ///< relative: designs this close to the best one tie with it
  long most_boxes = 1000000;  ///< limit of memory (150 MB) and time
  long most_tie_boxes = 3000;
  std::vector<Design> first_tries;  ///< designs known to be good
  /// The search ends at a design with a smaller value.
  std::optional<double> sufficient = std::nullopt;
  unsigned threads = 0;  ///< 0: as many as available; the result does not depend on the number
};

struct DesignBox {
  Design lower;
  Design upper;
};

/// Enclosure of all designs within `tie` of the optimum: none lies outside of `boxes`.
struct TieSet {
  std::vector<DesignBox> boxes;
  DesignBox hull;    ///< encloses all boxes
  DesignBox known;   ///< encloses evaluated designs that tie: the set is at least this large
  double share = 0;  ///< volume of the boxes relative to the whole box
  /// True if a variable can change by more than a twentieth of its range within the set.
  bool wide = false;
};

struct CertifiedResult {
  bool found = false;    ///< false: no design satisfies all conditions (proven if `proven`)
  bool proven = false;   ///< the gap was reached
  bool stopped = false;  ///< by RunContext::stop, or by `sufficient`: the best design so far
  Design best;
  double value = 0;        ///< value of the best design, rounded up over the whole range
  double theta = 0;        ///< joint angle of that value, rad
  double lower_bound = 0;  ///< lower bound on all designs, rounded down
  double relative_gap = 0;
  TieSet ties;
  long boxes = 0;        ///< number of examined boxes
  long evaluations = 0;  ///< interval evaluations of the formulas at one angle
  std::string reason;    ///< if nothing was found: the most frequent cause
};

/// Reason why this optimum cannot be certified; empty if it can.
std::string cannot_certify(const Problem& problem, Objective objective);

/// Requires a certifiable objective, law compensate or linear, and a joint as declared; otherwise throws InputError
/// with the certifiable objectives. `feasible`: no design with a drawable pulley is below the bound. Two conditions of
/// profile/feasibility.cpp are omitted from the bound, which can only lower it: one turn suffices, and an arc closes
/// the curve. The best design satisfies all of them. Progress: "best 2.367", or "" before the first design.
CertifiedResult certified_optimum(const Problem& problem, Objective objective, const CertifiedOptions& options = {},
                                  const RunContext& context = {});

}  // namespace fusee
