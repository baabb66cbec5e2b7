/// \file
/// What creeps remembers: how long, and under what, it was held before.
#pragma once

#include <array>

namespace fusee {

/// Kelvin elements in a row, one a decade of time, driven by a tension, strain or load. From rest, under a driver that
/// stays, they give way by driver · log10(1 + t/s) for an hour, within 0.15 of a decade (0.1 after ten seconds), and
/// come back in the same way.
class CreepMemory {
 public:
  /// `driver` acts for `time` s.
  void hold(double driver, double time);
  /// By how much it has given way, in the driver's unit: a driver of 1 for every decade of time.
  double crept() const;

 private:
  /// An element of τ stands for its decade from τ/√10 on; elements without gaps from τ0 on give way by log10(1.78
  /// t/τ0): 10^(k + 3/4) s is log10(1 + t/s) in the long run.
  static constexpr std::array<double, 4> k_times{5.62, 56.2, 562, 5620};
  std::array<double, k_times.size()> elements_{};
};

}  // namespace fusee
