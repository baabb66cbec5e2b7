/// \file
/// Internal: reproducible random numbers, unlike the distributions of the standard library.
#pragma once

#include <cstdint>

#include "fusee/optimize.h"

namespace fusee::optimize {

/// splitmix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1).
  double fraction() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

 private:
  std::uint64_t state_;
};

/// A design with each variable uniform in its range.
inline Design random_design(const Problem& problem, Random& random) {
  Design design;
  for (const Variable& variable : problem.variables)
    design.push_back(variable.lower + random.fraction() * (variable.upper - variable.lower));
  return design;
}

}  // namespace fusee::optimize
