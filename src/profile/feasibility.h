/// \file
/// Can the two pitch curves exist? Every condition on the law, the tendons' paths and the curves, tightest place
/// included.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fusee/profile/synthesis.h"
#include "profile/closing_arc.h"
#include "profile/take_off.h"

namespace fusee {

/// One side of an attempt at a pulley. Index 0 of pairs is tendon 1, P1, pin B; index 1 tendon 2, P2, pin D.
struct SideAttempt {
  TakeOffs take_offs;
  std::vector<TakeOff> samples;       ///< by increasing joint angle of the image
  std::optional<ClosingArc> closing;  ///< method = "exact"
  std::vector<double> straight = {};  ///< ψ at which the active arc runs straight: a tendon leaves its drum there
};

struct Attempt {
  std::vector<Condition> conditions;
  std::array<std::optional<SideAttempt>, 2> sides;  ///< absent when the law itself fails

  bool feasible() const;
};

/// many: the curves do not close, and may be as long as they like.
enum class Turns { one, many };

/// Looks at everything. Conditions that an earlier failure makes meaningless are left out. The attempt refers to
/// `transmission`.
Attempt attempt(const Mechanism& mechanism, const Transmission& transmission, Turns turns = Turns::one);

/// The first condition found that does not hold; null where all do. What costs least to see is looked at first: the
/// law, then a few places of both curves, all of them only then, and the closing arcs last.
std::optional<Condition> first_failure(const Mechanism& mechanism, const Transmission& transmission);

/// What no condition forbids but a person should know: bends tighter than the tendon likes.
std::vector<std::string> bend_warnings(const Mechanism& mechanism, const Attempt& attempt);

/// "α = −88°".
std::string at_alpha_text(double alpha);

}  // namespace fusee
