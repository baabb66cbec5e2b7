/// \file
/// One tendon over its pin and through its sheath, at given lengths: which tensions its spans take where each bend of
/// the sheath holds by a friction of its own.
///
/// Friction in a sheath is spread over it. Where the motor turns back, what lies next to it slides first, and the rest
/// follows as its tension is reached; the joint stands still until the last of it does. Friction at one place lets the
/// half of the sheath before it give all at once: by then the same, on the way there by up to 1/8 of what the sheath
/// stretches under the whole change. With n places it is 1/n² of that.
#pragma once

#include <array>
#include <cstddef>

#include "fusee/joint/equilibrium.h"

namespace fusee {

/// From the joint to the pulley. Material and lengths are Spans'; `holds[j]`: ln of the ratio of the tensions on both
/// sides of bend j that its friction holds, between the spans j and j + 1. The pin's is in the first.
struct ThreadedSpans {
  static constexpr std::size_t k_bends = 6;
  std::array<double, k_bends + 1> length{};
  std::array<double, k_bends + 1> material{};
  std::array<double, k_bends> holds{};
  double EA = 0;
};

struct ThreadedBalance {
  std::array<double, ThreadedSpans::k_bends + 1> tension{};
  std::array<double, ThreadedSpans::k_bends> crossed{};  ///< material that went past each bend, towards the joint, mm
  std::array<int, ThreadedSpans::k_bends> slides{};      ///< 1: towards the joint, −1: to the pulley, 0: holds
  PinContact contact = PinContact::stick;                ///< slides: at every bend, the same way
  double per_length = 0;                                 ///< of the upper tension, by the upper length
  double per_hold = 0;                                   ///< and by holds[0]
  double lower_per_upper = 0;                            ///< how the lower tension follows it; 0 where a bend holds
};

/// `likely`: which bends slide, probably; it says where to begin and not what comes out.
ThreadedBalance balance(const ThreadedSpans& spans, const std::array<int, ThreadedSpans::k_bends>& likely);

/// d upper / d its length with all bends passing it at the present ratios of tensions.
double sliding_rate(const ThreadedSpans& spans, const ThreadedBalance& now);

}  // namespace fusee
