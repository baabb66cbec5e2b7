#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/module.h"
#include "base/thread_pool.h"
#include "fusee/base.h"
#include "fusee/optimize.h"
#include "optimize/evolution.h"
#include "optimize/random.h"
#include "optimize/search_progress.h"

namespace fusee::optimize {
namespace {

/// Cost of a design that violates a constraint: above any possible one, and increasing with the violation.
constexpr double k_penalty = 1e12;
/// Magnitude of the best value before any design was possible.
constexpr double k_no_value = 1e300;

/// Costs of a design, and the reason why it is not possible.
struct Costs {
  std::vector<double> costs;
  std::string reason;
};

/// A reason without its numbers, so that there are few kinds.
std::string without_numbers(std::string reason) {
  reason.erase(std::remove_if(reason.begin(), reason.end(), [](char c) { return (c >= '0' && c <= '9') || c == '.'; }),
               reason.end());
  return reason;
}

/// Counts why designs are not possible.
class ReasonCounter {
 public:
  void add(const std::string& reason) {
    if (reason.empty()) return;
    Kind& kind = kinds_[without_numbers(reason)];
    if (kind.count++ == 0) kind.example = reason;
  }
  std::string commonest() const {
    const auto most = std::max_element(kinds_.begin(), kinds_.end(),
                                       [](const auto& a, const auto& b) { return a.second.count < b.second.count; });
    return most == kinds_.end() ? "no design satisfies the constraints" : most->second.example;
  }

 private:
  struct Kind {
    long count = 0;
    std::string example;
  };
  std::map<std::string, Kind> kinds_;
};

/// Thrown to stop a search, and caught in this file.
struct SearchStopped {};

/// Evaluates the designs of a generation in parallel.
struct GenerationEvaluator {
  const Problem& problem;
  std::vector<Objective> objectives;
  unsigned threads;
  const RunContext& context;
  double done = 0;             ///< share of the generations
  std::optional<double> best;  ///< value of the best design so far; null for a front
  long evaluations = 0;
  CostsOfDesigns known;  ///< of the designs evaluated last
  ReasonCounter reasons;

  GenerationEvaluator(const Problem& evaluated, std::vector<Objective> by, const GeneticOptions& options,
                      const RunContext& run)
      : problem(evaluated), objectives(std::move(by)), threads(options.threads), context(run) {}

  Costs costs_of(const Design& design) const {
    Costs result;
    const double violation = constraint_violation(problem, design);
    for (const Objective objective : objectives) {
      if (violation > 0) {
        result.costs.push_back(k_penalty * (1.0 + violation));
        continue;
      }
      const Evaluation evaluation = evaluate_design(problem, objective, design);
      if (!evaluation.possible) result.reason = evaluation.reason.substr(0, evaluation.reason.find(" at θ"));
      result.costs.push_back(evaluation.possible ? evaluation.cost(objective) : k_penalty);
    }
    return result;
  }

  /// Evaluates a few at a time and checks in between for a stop.
  void evaluate(const std::vector<Design>& designs) {
    constexpr std::size_t k_at_once = 16;
    known.clear();
    for (std::size_t begin = 0; begin < designs.size(); begin += k_at_once) {
      if (!may_continue(context, done, best)) throw SearchStopped();
      std::vector<Costs> costs(std::min(k_at_once, designs.size() - begin));
      ThreadPool::shared().each(
          costs.size(), [&](std::size_t i, std::size_t) { costs[i] = costs_of(designs[begin + i]); }, threads);
      for (std::size_t i = 0; i < costs.size(); ++i) {
        reasons.add(costs[i].reason);
        known[designs[begin + i]] = std::move(costs[i].costs);
      }
      evaluations += static_cast<long>(costs.size());
    }
  }
};

/// Linked into this program, or loaded from a module.
const EvolutionMaker& evolution_maker() {
  if (&fusee_evolution_maker_1 != nullptr) return fusee_evolution_maker_1;
  static const LoadedModule module = load_module("fusee-evolution", k_evolution_maker);
  if (module.found == nullptr)
    throw InputError("", "evolutionary search is unavailable: " + module.why_not,
                     "install it; of the searches, only fusee optimize --method certified does not need it");
  return *static_cast<const EvolutionMaker*>(module.found);
}

std::unique_ptr<Evolution> evolution_of(const GenerationEvaluator& evaluator, EvolutionKind kind, unsigned seed) {
  EvolutionSettings settings{kind, {}, {}, static_cast<unsigned>(evaluator.objectives.size()), seed};
  for (const Variable& variable : evaluator.problem.variables) {
    settings.lower.push_back(variable.lower);
    settings.upper.push_back(variable.upper);
  }
  return evolution_maker().make(settings);
}

/// Proceeds by one generation.
void advance(Evolution& evolution, GenerationEvaluator& evaluator) {
  evaluator.evaluate(evolution.next_designs());
  evolution.advance(evaluator.known);
}

/// Random designs; those that violate a constraint are drawn again, so that a thin feasible set is found at the start.
void begin(Evolution& evolution, GenerationEvaluator& evaluator, const GeneticOptions& options) {
  constexpr int k_most_draws = 200;
  Random random(options.seed);
  std::vector<Design> designs;
  for (unsigned i = 0; i < options.population; ++i) {
    Design design = random_design(evaluator.problem, random);
    for (int draw = 0; draw < k_most_draws && constraint_violation(evaluator.problem, design) > 0; ++draw)
      design = random_design(evaluator.problem, random);
    designs.push_back(std::move(design));
  }
  evaluator.evaluate(designs);
  evolution.begin(designs, evaluator.known);
}

Generation describe_generation(unsigned number, const Evolution& evolution, Objective objective, double best_before) {
  Generation generation;
  generation.number = number;
  const double sign = info(objective).is_maximized ? -1.0 : 1.0;
  double sum = 0, best = sign * best_before;
  long possible = 0;
  for (const auto& costs : evolution.costs()) {
    if (!(costs[0] < k_penalty)) continue;
    sum += costs[0];
    ++possible;
    best = std::min(best, costs[0]);
  }
  generation.best = sign * best;
  generation.mean = possible > 0 ? sign * sum / static_cast<double>(possible) : generation.best;
  return generation;
}

std::optional<double> known_value(double best) {
  return std::abs(best) < k_no_value ? std::optional(best) : std::nullopt;
}

}  // namespace

GeneticResult genetic_optimum(const Problem& problem, Objective objective, const GeneticOptions& options,
                              const RunContext& context) {
  GenerationEvaluator evaluator(problem, {objective}, options, context);
  const auto evolution = evolution_of(evaluator, EvolutionKind::genetic, options.seed);
  GeneticResult result;
  double best = info(objective).is_maximized ? -k_no_value : k_no_value;
  try {
    begin(*evolution, evaluator, options);
    for (unsigned number = 0; number <= options.generations; ++number) {
      evaluator.done = static_cast<double>(number) / options.generations;
      if (number > 0) advance(*evolution, evaluator);
      result.generations.push_back(describe_generation(number, *evolution, objective, best));
      best = result.generations.back().best;
      evaluator.best = known_value(best);
      result.best = evolution->best();
    }
  } catch (const SearchStopped&) {
    result.stopped = true;
  }
  result.evaluations = evaluator.evaluations;
  if (!result.best.empty()) {
    const Evaluation evaluation = evaluate_design(problem, objective, result.best);
    result.found = evaluation.possible;
    result.value = evaluation.value;
    result.theta = evaluation.theta;
  }
  if (!result.found) result.reason = evaluator.reasons.commonest();
  return result;
}

ParetoResult pareto_front(const Problem& problem, const GeneticOptions& options, const RunContext& context) {
  if (problem.objectives.size() < 2) {
    throw InputError("", "a front needs two or three objectives",
                     "for example optimize.objective = [\"max_tension\", \"footprint\"]");
  }
  GenerationEvaluator evaluator(problem, problem.objectives, options, context);
  const auto evolution = evolution_of(evaluator, EvolutionKind::nsga2, options.seed);
  ParetoResult result;
  bool has_begun = false;
  try {
    begin(*evolution, evaluator, options);
    has_begun = true;
    for (; result.generations < options.generations; ++result.generations) {
      evaluator.done = static_cast<double>(result.generations) / options.generations;
      advance(*evolution, evaluator);
    }
  } catch (const SearchStopped&) {
    result.stopped = true;
  }
  result.evaluations = evaluator.evaluations;
  result.reason = evaluator.reasons.commonest();
  if (!has_begun) return result;
  const auto designs = evolution->designs(), costs = evolution->costs();
  for (const std::size_t i : evolution->front()) {
    if (!(costs[i][0] < k_penalty)) continue;
    FrontPoint point{designs[i], {}};
    for (std::size_t k = 0; k < costs[i].size(); ++k)
      point.values.push_back(info(problem.objectives[k]).is_maximized ? -costs[i][k] : costs[i][k]);
    result.front.push_back(std::move(point));
  }
  std::sort(result.front.begin(), result.front.end(), [](const FrontPoint& a, const FrontPoint& b) {
    return std::tie(a.values, a.design) < std::tie(b.values, b.design);
  });
  const auto same = [](const FrontPoint& a, const FrontPoint& b) { return a.values == b.values; };
  result.front.erase(std::unique(result.front.begin(), result.front.end(), same), result.front.end());
  if (!result.front.empty()) result.reason.clear();
  return result;
}

}  // namespace fusee::optimize
