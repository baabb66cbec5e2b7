/// \file
/// Evolution by pagmo. The only file that uses pagmo, in a module and in a library (CMakeLists.txt).
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/utils/multi_objective.hpp>
#include <stdexcept>
#include <utility>

#include "optimize/evolution.h"

namespace fusee::optimize {
namespace {

/// Costs for pagmo: known values, or, with `known` null, a record of the designs that pagmo requests.
struct CostRecorder {
  EvolutionSettings settings;
  const CostsOfDesigns* known = nullptr;
  std::vector<std::vector<double>> requested;

  pagmo::vector_double fitness(const pagmo::vector_double& design) {
    if (known == nullptr) {
      requested.push_back(design);
      return pagmo::vector_double(settings.costs, 0.0);
    }
    const auto found = known->find(design);
    if (found == known->end()) throw std::logic_error("a design is asked for that was not foreseen");
    return found->second;
  }
};

/// The problem that pagmo copies; the costs are shared.
struct PagmoProblem {
  CostRecorder* recorder = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& design) const { return recorder->fitness(design); }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {recorder->settings.lower, recorder->settings.upper};
  }
  pagmo::vector_double::size_type get_nobj() const { return recorder->settings.costs; }
};

/// One generation per call, so that each can be inspected.
pagmo::algorithm algorithm_of(const EvolutionSettings& settings) {
  constexpr unsigned k_generations = 1, k_tournament_size = 2;
  if (settings.kind == EvolutionKind::nsga2) {
    constexpr double k_crossover = 0.95, k_crossover_index = 10.0, k_mutation = 0.02, k_mutation_index = 50.0;
    return pagmo::algorithm(
        pagmo::nsga2(k_generations, k_crossover, k_crossover_index, k_mutation, k_mutation_index, settings.seed));
  }
  constexpr double k_crossover = 0.9, k_crossover_index = 1.0, k_mutation = 0.1, k_mutation_index = 1.0;
  return pagmo::algorithm(pagmo::sga(k_generations, k_crossover, k_crossover_index, k_mutation, k_mutation_index,
                                     k_tournament_size, "sbx", "polynomial", "tournament", settings.seed));
}

class PagmoEvolution final : public Evolution {
 public:
  explicit PagmoEvolution(const EvolutionSettings& settings)
      : recorder_{settings, nullptr, {}},
        algorithm_(algorithm_of(settings)),
        population_(pagmo::problem(PagmoProblem{&recorder_}), 0u, settings.seed) {}
  PagmoEvolution(const PagmoEvolution&) = delete;
  PagmoEvolution& operator=(const PagmoEvolution&) = delete;

  void begin(const std::vector<std::vector<double>>& designs, const CostsOfDesigns& known) override {
    recorder_.known = &known;
    for (const auto& design : designs) population_.push_back(design);
    recorder_.known = nullptr;
  }
  /// Runs a generation on a copy to record its designs; advance() repeats it with their costs.
  std::vector<std::vector<double>> next_designs() override {
    recorder_.requested.clear();
    (void)pagmo::algorithm(algorithm_).evolve(population_);
    return std::move(recorder_.requested);
  }
  void advance(const CostsOfDesigns& known) override {
    recorder_.known = &known;
    population_ = algorithm_.evolve(population_);
    recorder_.known = nullptr;
  }
  std::vector<std::vector<double>> designs() const override { return population_.get_x(); }
  std::vector<std::vector<double>> costs() const override { return population_.get_f(); }
  std::vector<double> best() const override { return population_.champion_x(); }
  std::vector<std::size_t> front() const override {
    const auto fronts = std::get<0>(pagmo::fast_non_dominated_sorting(population_.get_f()));
    return {fronts.front().begin(), fronts.front().end()};
  }

 private:
  CostRecorder recorder_;
  pagmo::algorithm algorithm_;
  pagmo::population population_;
};

std::unique_ptr<Evolution> make(const EvolutionSettings& settings) {
  return std::make_unique<PagmoEvolution>(settings);
}

}  // namespace
}  // namespace fusee::optimize

const fusee::optimize::EvolutionMaker fusee_evolution_maker_1{fusee::optimize::make};
