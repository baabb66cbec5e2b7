/// \file
/// Balance of one tendon over its pin and through its sheath for given lengths: the tensions of its spans, where each
/// bend of the sheath has its own friction.
///
/// Friction in a sheath is distributed. When the motor reverses, the adjacent tendon slides first, and further places
/// follow as their tension is reached; the joint rests until all of it slides. Concentrated friction would release half
/// of the sheath at once: equal in the end, but with an error of up to 1/8 of the sheath's stretch on the way. With n
/// places the error is 1/n² of that.
#pragma once

#include <array>
#include <cstddef>

#include "fusee/joint.h"

namespace fusee::joint {

/// Spans from the joint to the pulley, with lengths and material as in Spans. `holds[j]`: ln of the tension ratio that
/// friction sustains at bend j, between the spans j and j + 1. The first includes the pin.
struct ThreadedSpans {
  static constexpr std::size_t k_bends = 6;
  std::array<double, k_bends + 1> length{};
  std::array<double, k_bends + 1> material{};
  std::array<double, k_bends> holds{};
  double EA = 0;  ///< axial stiffness, N
};

/// Tensions of all spans, and the material that passes each bend.
struct ThreadedBalance {
  std::array<double, ThreadedSpans::k_bends + 1> tension{};
  std::array<double, ThreadedSpans::k_bends> crossed{};  ///< material that passed each bend towards the joint, mm
  std::array<int, ThreadedSpans::k_bends> slides{};      ///< 1: towards the joint, −1: to the pulley, 0: holds
  PinContact contact = PinContact::stick;                ///< slip: at every bend, in one direction
  double per_length = 0;                                 ///< d upper tension / d upper length
  double per_hold = 0;                                   ///< d upper tension / d holds[0]
  double lower_per_upper = 0;                            ///< d lower tension / d upper tension; 0 where a bend holds
};

/// `likely`: an initial guess of the sliding bends; it does not affect the result.
ThreadedBalance balance(const ThreadedSpans& spans, const std::array<int, ThreadedSpans::k_bends>& likely);

/// d upper / d its length with all bends sliding at the present tension ratios.
double sliding_rate(const ThreadedSpans& spans, const ThreadedBalance& now);

}  // namespace fusee::joint
