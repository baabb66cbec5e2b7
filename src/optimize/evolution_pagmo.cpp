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
  std::vector<std::vector<double>> asked;

  pagmo::vector_double fitness(const pagmo::vector_double& design) {
    if (known == nullptr) {
      asked.push_back(design);
      return pagmo::vector_double(settings.costs, 0.0);
    }
    const auto found = known->find(design);
    if (found == known->end()) throw std::logic_error("a design is asked for that was not foreseen");
    return found->second;
  }
};

/// The problem that pagmo copies; the costs are shared.
struct PagmoProblem {
  CostRecorder* costing = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& design) const { return costing->fitness(design); }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {costing->settings.lower, costing->settings.upper};
  }
  pagmo::vector_double::size_type get_nobj() const { return costing->settings.costs; }
};

/// One generation per call, so that each can be inspected.
pagmo::algorithm algorithm_of(const EvolutionSettings& settings) {
  if (settings.kind == EvolutionKind::nsga2)
    return pagmo::algorithm(pagmo::nsga2(1u, 0.95, 10.0, 0.02, 50.0, settings.seed));
  return pagmo::algorithm(pagmo::sga(1u, 0.9, 1.0, 0.1, 1.0, 2u, "sbx", "polynomial", "tournament", settings.seed));
}

class PagmoEvolution final : public Evolution {
 public:
  explicit PagmoEvolution(const EvolutionSettings& settings)
      : costing_{settings, nullptr, {}},
        algorithm_(algorithm_of(settings)),
        population_(pagmo::problem(PagmoProblem{&costing_}), 0u, settings.seed) {}
  PagmoEvolution(const PagmoEvolution&) = delete;
  PagmoEvolution& operator=(const PagmoEvolution&) = delete;

  void begin(const std::vector<std::vector<double>>& designs, const CostsOfDesigns& known) override {
    costing_.known = &known;
    for (const auto& design : designs) population_.push_back(design);
    costing_.known = nullptr;
  }
  /// Runs a generation on a copy to record its designs; advance() repeats it with their costs.
  std::vector<std::vector<double>> next_designs() override {
    costing_.asked.clear();
    (void)pagmo::algorithm(algorithm_).evolve(population_);
    return std::move(costing_.asked);
  }
  void advance(const CostsOfDesigns& known) override {
    costing_.known = &known;
    population_ = algorithm_.evolve(population_);
    costing_.known = nullptr;
  }
  std::vector<std::vector<double>> designs() const override { return population_.get_x(); }
  std::vector<std::vector<double>> costs() const override { return population_.get_f(); }
  std::vector<double> best() const override { return population_.champion_x(); }
  std::vector<std::size_t> front() const override {
    const auto fronts = std::get<0>(pagmo::fast_non_dominated_sorting(population_.get_f()));
    return {fronts.front().begin(), fronts.front().end()};
  }

 private:
  CostRecorder costing_;
  pagmo::algorithm algorithm_;
  pagmo::population population_;
};

std::unique_ptr<Evolution> make(const EvolutionSettings& settings) {
  return std::make_unique<PagmoEvolution>(settings);
}

}  // namespace
}  // namespace fusee::optimize

const fusee::optimize::EvolutionMaker fusee_evolution_maker_1{fusee::optimize::make};
