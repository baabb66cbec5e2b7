/// \file
/// What creeps remembers: how long, and under what, it was held before.
#pragma once

#include <array>

namespace fusee {

/// Kelvin elements in a row, one a decade of time, driven by a tension, strain or load. From rest, under a driver that
/// stays, they give way by driver · log10(1 + 1.78 t/s) for some hours, within 0.15 of a decade (0.05 after ten
/// seconds), and come back in the same way.
class CreepMemory {
 public:
  /// `driver` acts for `time` s.
  void hold(double driver, double time);
  /// By how much it has given way, in the driver's unit: a driver of 1 for every decade of time.
  double crept() const;

 private:
  /// In the middle of their decades, the first from 1 s: elements without gaps from there on would give way by
  /// log10(1.78 t/s). What is quicker is part of the stiffness.
  static constexpr std::array<double, 5> k_times{3.16, 31.6, 316, 3160, 31600};
  std::array<double, k_times.size()> elements_{};
};

}  // namespace fusee
