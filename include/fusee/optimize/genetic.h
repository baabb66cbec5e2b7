/// \file
/// Evolutionary search (pagmo): the paper's genetic algorithm, and NSGA-II for two or three objectives. Seeded: every
/// run gives the same bytes.
#pragma once

#include "fusee/base/run_context.h"
#include "fusee/optimize/problem.h"

namespace fusee {

struct GeneticOptions {
  unsigned population = 48;  ///< a multiple of 4
  unsigned generations = 100;
  unsigned seed = 1;
  unsigned threads = 0;  ///< 0: as many as available; the result does not depend on the number
};

/// One generation of the single-objective algorithm, as in the paper's Fig. 7.
struct Generation {
  unsigned number = 0;
  double best = 0;  ///< best value so far
  double mean = 0;  ///< mean over the possible designs of this generation
};

struct GeneticResult {
  bool found = false;
  bool stopped = false;  ///< by RunContext::stop
  Design best;
  double value = 0;
  double theta = 0;
  std::vector<Generation> generations;
  long evaluations = 0;
  std::string reason;  ///< cause if nothing was found
};

/// A stopped search returns its best design. Progress: "best 2.367", or "" before the first design.
GeneticResult genetic_optimum(const Problem& problem, Objective objective, const GeneticOptions& options = {},
                              const RunContext& context = {});

struct FrontPoint {
  Design design;
  std::vector<double> values;  ///< values of the problem's objectives, in their units
};

struct ParetoResult {
  bool stopped = false;           ///< by RunContext::stop
  unsigned generations = 0;       ///< completed generations
  std::vector<FrontPoint> front;  ///< non-dominated designs, sorted by the first objective
  long evaluations = 0;
  std::string reason;  ///< cause if the front is empty
};

/// Requires two or three objectives; otherwise throws InputError.
ParetoResult pareto_front(const Problem& problem, const GeneticOptions& options = {}, const RunContext& context = {});

}  // namespace fusee
