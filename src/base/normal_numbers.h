/// \file
/// Internal: reproducible normal random numbers.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "fusee/base.h"

namespace fusee {

/// Standard normal numbers by the Box-Muller transform. They are equal on every machine, unlike those of
/// std::normal_distribution.
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : bits_(seed) {}

  double next() {
    const double radius = std::sqrt(-2.0 * elementary::log(uniform()));
    return radius * elementary::cos(k_two_pi * uniform());
  }

 private:
  /// Uniform in (0, 1), from the upper 53 bits. The half keeps 0 out, for the logarithm.
  double uniform() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1p-53; }

  std::mt19937_64 bits_;
};

}  // namespace fusee
