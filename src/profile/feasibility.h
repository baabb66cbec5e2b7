/// \file
/// Feasibility of both pitch curves: all conditions on the law, the tendon paths and the curves, each with its tightest
/// place.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fusee/profile.h"
#include "profile/closing_arc.h"
#include "profile/take_off.h"

namespace fusee::profile {

/// One side of an attempted synthesis. Index 0 of pairs is tendon 1, P1, pin B; index 1 is tendon 2, P2, pin D.
struct SideAttempt {
  TakeOffs take_offs;
  std::vector<TakeOff> samples;       ///< by increasing joint angle of the image
  std::optional<ClosingArc> closing;  ///< method = "exact"
  std::vector<double> straight = {};  ///< ψ at which the active arc is straight because a tendon leaves its drum
};

/// Outcome of attempt().
struct Attempt {
  std::vector<Condition> conditions;
  std::array<std::optional<SideAttempt>, 2> sides;  ///< absent when the law itself fails

  bool feasible() const;
};

/// Limit of turns on a pulley. many: the curves do not close and may have any length.
enum class Turns { one, many };

/// Tests all conditions, except those that an earlier failure makes meaningless. The result refers to `transmission`.
Attempt attempt(const Mechanism& mechanism, const transmission::Transmission& transmission, Turns turns = Turns::one);

/// The first failed condition; null when all hold. Order of tests: the law, a few points of both curves, all points,
/// the closing arcs.
std::optional<Condition> first_failure(const Mechanism& mechanism, const transmission::Transmission& transmission);

/// Warnings that do not prevent making: bends tighter than the tendon permits.
std::vector<std::string> bend_warnings(const Mechanism& mechanism, const Attempt& attempt);

/// "α = −88°".
std::string at_alpha_text(double alpha);

}  // namespace fusee::profile
