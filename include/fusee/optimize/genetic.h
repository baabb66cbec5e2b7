/// \file
/// Optima by evolution (pagmo): the paper's genetic algorithm, and NSGA-II for two or three objectives. Seeded: the
/// same bytes every run.
#pragma once

#include "fusee/optimize/problem.h"

namespace fusee {

struct GeneticOptions {
  unsigned population = 48;  ///< a multiple of 4
  unsigned generations = 100;
  unsigned seed = 1;
  KeepGoing keep_going;
  unsigned threads = 0;  ///< 0: as many as there are; the result is the same on any number
};

/// One generation of the single-objective algorithm: its Fig. 7.
struct Generation {
  unsigned number = 0;
  double best = 0;  ///< so far
  double mean = 0;  ///< of the designs of this generation that are possible
};

struct GeneticResult {
  bool found = false;
  bool stopped = false;  ///< by keep_going
  Design best;
  double value = 0;
  double theta = 0;
  std::vector<Generation> generations;
  long evaluations = 0;
  std::string reason;  ///< when nothing was found
};

GeneticResult genetic_optimum(const Problem& problem, Objective objective, const GeneticOptions& options = {});

struct FrontPoint {
  Design design;
  std::vector<double> values;  ///< of the problem's objectives, in their units
};

struct ParetoResult {
  bool stopped = false;
  unsigned generations = 0;       ///< that were finished
  std::vector<FrontPoint> front;  ///< none is better than another in everything; by the first objective
  long evaluations = 0;
  std::string reason;  ///< when the front is empty
};

/// Needs two or three objectives: else InputError.
ParetoResult pareto_front(const Problem& problem, const GeneticOptions& options = {});

}  // namespace fusee
