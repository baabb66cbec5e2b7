/// \file
/// Internal: designs from designs, by selection, crossing and mutation. Plain values, so that what does it (pagmo) can
/// be a module of its own, loaded where a search asks for it.
#pragma once

#include <map>
#include <memory>
#include <vector>

namespace fusee {

enum class EvolutionKind {
  genetic,  ///< one cost: tournament, simulated binary crossover, polynomial mutation; the best is kept
  nsga2,    ///< two or three
};

struct EvolutionSettings {
  EvolutionKind kind = EvolutionKind::genetic;
  std::vector<double> lower, upper;
  unsigned costs = 1;
  unsigned seed = 1;
};

using CostsOfDesigns = std::map<std::vector<double>, std::vector<double>>;

/// Generations, one after the other; the same on every machine. What one asks the costs of depends on the one before
/// alone: it is asked first, so that they can be found side by side.
class Evolution {
 public:
  virtual ~Evolution() = default;
  virtual void begin(const std::vector<std::vector<double>>& designs, const CostsOfDesigns& known) = 0;
  virtual std::vector<std::vector<double>> next_designs() = 0;
  /// Needs the costs of all of next_designs().
  virtual void advance(const CostsOfDesigns& known) = 0;
  virtual std::vector<std::vector<double>> designs() const = 0;
  virtual std::vector<std::vector<double>> costs() const = 0;
  /// Of one cost: the least so far.
  virtual std::vector<double> best() const = 0;
  /// Places in designs() of those that no other is better than in everything.
  virtual std::vector<std::size_t> front() const = 0;
};

/// What the module `fusee-evolution` exports under this name; weak: a program that links it needs no module.
struct EvolutionMaker {
  std::unique_ptr<Evolution> (*make)(const EvolutionSettings& settings);
};
inline constexpr const char* k_evolution_maker = "fusee_evolution_maker_1";

}  // namespace fusee

extern "C" __attribute__((visibility("default"), weak)) const fusee::EvolutionMaker fusee_evolution_maker_1;
