/// \file
/// Internal: interface of an evolutionary algorithm (selection, crossover, mutation), in plain values. Its
/// implementation (pagmo) can be a module that is loaded on demand.
#pragma once

#include <map>
#include <memory>
#include <vector>

namespace fusee::optimize {

enum class EvolutionKind {
  genetic,  ///< one cost: tournament, simulated binary crossover, polynomial mutation, elitism
  nsga2,    ///< two or three costs
};

/// Algorithm, bounds of the variables, number of costs, and seed.
struct EvolutionSettings {
  EvolutionKind kind = EvolutionKind::genetic;
  std::vector<double> lower, upper;
  unsigned costs = 1;
  unsigned seed = 1;
};

/// Costs by design.
using CostsOfDesigns = std::map<std::vector<double>, std::vector<double>>;

/// A sequence of generations, reproducible on every machine. The designs that a generation evaluates depend only on the
/// generation before, so that their costs can be computed in parallel beforehand.
class Evolution {
 public:
  virtual ~Evolution() = default;
  /// Sets the first generation, of which `known` has the costs.
  virtual void begin(const std::vector<std::vector<double>>& designs, const CostsOfDesigns& known) = 0;
  /// The designs that the next generation evaluates.
  virtual std::vector<std::vector<double>> next_designs() = 0;
  /// Requires the costs of all of next_designs().
  virtual void advance(const CostsOfDesigns& known) = 0;
  /// The present generation, and its costs in the same order.
  virtual std::vector<std::vector<double>> designs() const = 0;
  virtual std::vector<std::vector<double>> costs() const = 0;
  /// For one cost: the best design so far.
  virtual std::vector<double> best() const = 0;
  /// Indices in designs() of the non-dominated ones.
  virtual std::vector<std::size_t> front() const = 0;
};

/// Export of the module `fusee-evolution`; weak, so that a program may link it instead.
struct EvolutionMaker {
  std::unique_ptr<Evolution> (*make)(const EvolutionSettings& settings);
};
inline constexpr const char* k_evolution_maker = "fusee_evolution_maker_1";

}  // namespace fusee::optimize

extern "C" __attribute__((visibility("default"), weak)) const fusee::optimize::EvolutionMaker fusee_evolution_maker_1;
