/// \file
/// The global optimum, proven: branch and bound with outward-rounded intervals over the variables and the stroke.
/// Constraints are kept to 1e-12 of their largest term, in the bound and in the designs.
#pragma once

#include "fusee/optimize/problem.h"

namespace fusee {

struct CertifiedOptions {
  double gap = 1e-6;          ///< relative, between the best design's value and the proven bound
  double tie = 1e-3;          ///< relative: designs this near to the best tie with it
  long most_boxes = 1000000;  ///< an end to memory (150 MB) and time
  long most_tie_boxes = 3000;
  std::vector<Design> first_tries;  ///< designs known to be good
  KeepGoing keep_going;
  unsigned threads = 0;  ///< 0: as many as there are; the result is the same on any number
};

struct DesignBox {
  Design lower;
  Design upper;
};

/// Where all designs lie that are within `tie` of the optimum: none lies outside of `boxes`.
struct TieSet {
  std::vector<DesignBox> boxes;
  DesignBox hull;    ///< around all boxes
  DesignBox known;   ///< around designs that were evaluated and do tie: the set reaches at least this far
  double share = 0;  ///< volume of the boxes in that of the whole box
  /// Some variable can move by more than a twentieth of its range within the set.
  bool wide = false;
};

struct CertifiedResult {
  bool found = false;   ///< false: no design keeps all conditions (proven when `proven`)
  bool proven = false;  ///< the gap was reached
  Design best;
  double value = 0;        ///< of the best design, rounded up over the whole range
  double theta = 0;        ///< where in the range, rad
  double lower_bound = 0;  ///< no design is better than this, rounded down
  double relative_gap = 0;
  TieSet ties;
  long boxes = 0;        ///< examined
  long evaluations = 0;  ///< of formulas at one angle, over intervals
  std::string reason;    ///< when nothing was found: the commonest cause
};

/// Why no optimum of this can be certified; empty when one can.
std::string cannot_certify(const Problem& problem, Objective objective);

/// Needs an objective that is certifiable, law compensate or linear, a joint as declared: else InputError, naming what
/// can be certified. `feasible`: no design whose pulley can be drawn is below the bound. Of the conditions of
/// profile/feasibility.cpp two have no part in the bound, which can only make it lower: one turn is enough, and an arc
/// closes the curve. The best design keeps all of them.
CertifiedResult certified_optimum(const Problem& problem, Objective objective, const CertifiedOptions& options = {});

}  // namespace fusee
