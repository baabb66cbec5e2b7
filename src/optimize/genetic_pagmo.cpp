#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/utils/multi_objective.hpp>

#include "fusee/base/diagnostics.h"
#include "fusee/optimize/genetic.h"
#include "optimize/random.h"

namespace fusee {
namespace {

/// What a design that breaks a constraint costs: more than any possible one, and more the further off it is.
constexpr double k_penalty = 1e12;
/// The best so far where nothing was possible so far.
constexpr double k_none = 1e300;

/// What pagmo copies about; the counts are shared.
struct PagmoProblem {
  const Problem* problem = nullptr;
  std::vector<Objective> objectives;
  std::shared_ptr<std::map<std::string, long>> reasons = std::make_shared<std::map<std::string, long>>();

  pagmo::vector_double fitness(const pagmo::vector_double& design) const {
    const double violation = constraint_violation(*problem, design);
    pagmo::vector_double costs;
    for (const Objective objective : objectives) {
      if (violation > 0) {
        costs.push_back(k_penalty * (1.0 + violation));
        continue;
      }
      const Evaluation evaluation = evaluate_design(*problem, objective, design);
      if (!evaluation.possible) ++(*reasons)[evaluation.reason.substr(0, evaluation.reason.find(" at θ"))];
      costs.push_back(evaluation.possible ? evaluation.cost(objective) : k_penalty);
    }
    return costs;
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    std::pair<pagmo::vector_double, pagmo::vector_double> bounds;
    for (const Variable& variable : problem->variables) {
      bounds.first.push_back(variable.lower);
      bounds.second.push_back(variable.upper);
    }
    return bounds;
  }
  pagmo::vector_double::size_type get_nobj() const { return objectives.size(); }
};

std::string commonest(const std::map<std::string, long>& reasons) {
  const auto most = std::max_element(reasons.begin(), reasons.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == reasons.end() ? "no design keeps the constraints" : most->first;
}

/// Random designs, those outside of a constraint drawn again: a thin set of possible designs must not be missed at the
/// start.
pagmo::population first_population(const PagmoProblem& pagmo_problem, const GeneticOptions& options) {
  constexpr int k_most_draws = 200;
  pagmo::population population(pagmo::problem(pagmo_problem), 0u, options.seed);
  Random random(options.seed);
  for (unsigned i = 0; i < options.population; ++i) {
    Design design = random_design(*pagmo_problem.problem, random);
    for (int draw = 0; draw < k_most_draws && constraint_violation(*pagmo_problem.problem, design) > 0; ++draw) {
      design = random_design(*pagmo_problem.problem, random);
    }
    population.push_back(design);
  }
  return population;
}

Generation described(unsigned number, const pagmo::population& population, Objective objective, double best_before) {
  Generation generation;
  generation.number = number;
  const double sign = info(objective).largest ? -1.0 : 1.0;
  double sum = 0, best = sign * best_before;
  long possible = 0;
  for (const auto& costs : population.get_f()) {
    if (!(costs[0] < k_penalty)) continue;
    sum += costs[0];
    ++possible;
    best = std::min(best, costs[0]);
  }
  generation.best = sign * best;
  generation.mean = possible > 0 ? sign * sum / static_cast<double>(possible) : generation.best;
  return generation;
}

bool goes_on(const GeneticOptions& options, unsigned generation, std::optional<double> best, long evaluations) {
  if (!options.keep_going) return true;
  SearchProgress progress;
  progress.done = static_cast<double>(generation) / options.generations;
  progress.best = best;
  progress.evaluations = evaluations;
  return options.keep_going(progress);
}

}  // namespace

GeneticResult genetic_optimum(const Problem& problem, Objective objective, const GeneticOptions& options) {
  const PagmoProblem pagmo_problem{&problem, {objective}};
  pagmo::population population = first_population(pagmo_problem, options);
  // One generation a call, so that each can be looked at.
  pagmo::algorithm algorithm{pagmo::sga(1u, 0.9, 1.0, 0.1, 1.0, 2u, "sbx", "polynomial", "tournament", options.seed)};
  GeneticResult result;
  double best = info(objective).largest ? -k_none : k_none;
  for (unsigned number = 0; number <= options.generations && !result.stopped; ++number) {
    if (number > 0) population = algorithm.evolve(population);
    result.generations.push_back(described(number, population, objective, best));
    best = result.generations.back().best;
    result.stopped = !goes_on(options, number, std::abs(best) < k_none ? std::optional(best) : std::nullopt,
                              static_cast<long>(population.get_problem().get_fevals()));
  }
  result.evaluations = static_cast<long>(population.get_problem().get_fevals());
  result.best = population.champion_x();
  const Evaluation evaluation = evaluate_design(problem, objective, result.best);
  result.found = evaluation.possible;
  result.value = evaluation.value;
  result.theta = evaluation.theta;
  if (!result.found) result.reason = commonest(*pagmo_problem.reasons);
  return result;
}

ParetoResult pareto_front(const Problem& problem, const GeneticOptions& options) {
  if (problem.objectives.size() < 2) {
    throw InputError("", "a front needs two or three objectives",
                     "for example optimize.objective = [\"max_tension\", \"footprint\"]");
  }
  const PagmoProblem pagmo_problem{&problem, problem.objectives};
  pagmo::population population = first_population(pagmo_problem, options);
  pagmo::algorithm algorithm{pagmo::nsga2(1u, 0.95, 10.0, 0.02, 50.0, options.seed)};
  ParetoResult result;
  for (unsigned number = 1; number <= options.generations && !result.stopped; ++number) {
    population = algorithm.evolve(population);
    result.stopped = !goes_on(options, number, std::nullopt, static_cast<long>(population.get_problem().get_fevals()));
  }
  result.evaluations = static_cast<long>(population.get_problem().get_fevals());
  const auto costs = population.get_f();
  const auto fronts = std::get<0>(pagmo::fast_non_dominated_sorting(costs));
  for (const auto i : fronts.front()) {
    if (!(costs[i][0] < k_penalty)) continue;
    FrontPoint point{population.get_x()[i], {}};
    for (std::size_t k = 0; k < costs[i].size(); ++k)
      point.values.push_back(info(problem.objectives[k]).largest ? -costs[i][k] : costs[i][k]);
    result.front.push_back(std::move(point));
  }
  std::sort(result.front.begin(), result.front.end(), [](const FrontPoint& a, const FrontPoint& b) {
    return std::tie(a.values, a.design) < std::tie(b.values, b.design);
  });
  const auto same = [](const FrontPoint& a, const FrontPoint& b) { return a.values == b.values; };
  result.front.erase(std::unique(result.front.begin(), result.front.end(), same), result.front.end());
  if (result.front.empty()) result.reason = commonest(*pagmo_problem.reasons);
  return result;
}

}  // namespace fusee
