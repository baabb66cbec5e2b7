/// \file
/// Random numbers, the same on every machine: splitmix64 (Steele, Lea, Flood 2014) and Box-Muller.
#pragma once

#include <cmath>
#include <cstdint>

#include "fusee/base.h"

namespace fusee::rig {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  /// Within (0, 1).
  double share() { return (static_cast<double>(bits() >> 11) + 0.5) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * share(); }
  double sign() { return share() < 0.5 ? -1.0 : 1.0; }
  /// Mean 0, standard deviation 1.
  double normal() {
    const double distance = std::sqrt(-2.0 * std::log(share()));
    return distance * std::cos(k_two_pi * share());
  }

 private:
  std::uint64_t state_;
};

/// An independent generator for each pair of `number` and `stream`.
inline Random numbered(double number, std::uint64_t stream) {
  return Random(static_cast<std::uint64_t>(number) * 1000003ULL + stream);
}

}  // namespace fusee::rig
