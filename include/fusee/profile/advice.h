/// \file
/// Search for the smallest change of a number that makes an infeasible mechanism feasible.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fusee/mechanism/mechanism.h"

namespace fusee {

struct Condition;

/// The nearest value of one key, a number or a word, with which every condition holds.
struct Change {
  std::string key;  ///< "pulley.r1_mm"
  double from = 0;  ///< in the file's unit
  double to = 0;
  std::string unit;
  std::string text;            ///< "r1 ≤ 18.9 mm"
  std::string from_word = {};  ///< for a key that is not a number: "M3"
  std::string to_word = {};
};

/// Feasibility test of changed mechanisms during the search for advice.
struct FeasibilityOracle {
  /// Fast test: returns the failed conditions; none if the mechanism is feasible as far as a fast test tells. Called
  /// hundreds of times, and from two threads if `made` is set.
  std::function<std::vector<Condition>(const Mechanism&)> obstacles;
  /// Full build of a change before it is reported, with the very numbers that the user will read. Empty: the fast test
  /// suffices.
  std::function<bool(const Mechanism&)> made = {};
  /// The fast test is slow: numbers that do not help are tested less often the further they are changed.
  bool is_expensive = false;
  /// Number of full builds that the evaluations so far still justify; fewer than usual for large parts. Empty: the
  /// usual number.
  std::function<int()> builds_left = {};
};

/// Changes that make a mechanism feasible: single changes, nearest first, or two combined changes.
struct Advice {
  std::vector<Change> alone;
  std::vector<Change> together;

  bool empty() const { return alone.empty() && together.empty(); }
};

/// Searches each number of joint, guides, pulley and tendon that the law uses, and `more_keys` (for which 0 is not a
/// number). All numbers move outwards together in growing steps within the bounds of the field table, until a few are
/// feasible. Bisection then finds the border, rounded to three digits on the safe side. If no single number suffices,
/// the most helpful ones are changed in pairs. `more_keys` are easier to change and move three times as far. `known`:
/// number of changes that are known already and need not be found.
Advice find_advice(const Mechanism& mechanism, const FeasibilityOracle& judge,
                   const std::vector<std::string>& more_keys = {}, std::size_t known = 0);

/// The single changes of find_advice() for a yes/no feasibility test.
std::vector<Change> nearest_changes(const Mechanism& mechanism, const std::function<bool(const Mechanism&)>& possible,
                                    const std::vector<std::string>& more_keys = {});

/// "make r1 ≤ 18.9 mm, or EF ≥ 95 mm, or the range ±28°"; "" for none.
std::string advice_sentence(const std::vector<Change>& changes);

}  // namespace fusee
