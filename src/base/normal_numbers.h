/// \file
/// Internal: noise for those who draw joints, tolerances or readings.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "fusee/base/units.h"

namespace fusee {

/// Normal numbers, the same on every machine: the standard's own distribution is not.
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : bits_(seed) {}

  double next() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(k_two_pi * uniform());
  }

 private:
  /// In (0, 1).
  double uniform() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1p-53; }

  std::mt19937_64 bits_;
};

}  // namespace fusee
