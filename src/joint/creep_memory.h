/// \file
/// Memory of a creeping material.
#pragma once

#include <array>

namespace fusee::joint {

/// A chain of Kelvin elements, one per decade of time, driven by a tension, strain or load. From rest, a constant
/// driver causes creep of driver · log10(1 + 1.78 t/s) for some hours, within 0.15 of a decade (0.05 after ten
/// seconds). Recovery is the same.
class CreepMemory {
 public:
  /// Applies `driver` for `time` s.
  void hold(double driver, double time);
  /// The accumulated creep. A constant driver adds its own value for each decade of time.
  double crept() const;

 private:
  /// Time constants in the middle of their decades, from 1 s. A gapless spectrum from there on would creep by
  /// log10(1.78 t/s); faster creep is part of the stiffness.
  static constexpr std::array<double, 5> k_times{3.16, 31.6, 316, 3160, 31600};
  std::array<double, k_times.size()> elements_{};
};

}  // namespace fusee::joint
