/// \file
/// The nearest change of each single number that makes the impossible possible, found by searching.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// The nearest value of one number of the file with which every condition would hold.
struct Change {
  std::string key;   ///< "pulley.r1_mm"
  double from = 0;   ///< in the file's unit
  double to = 0;
  std::string unit;
  std::string text;  ///< "r1 ≤ 18.9 mm"
};

/// For each number of the joint, guides, pulley and tendon that the law uses, and for `more_keys`: steps outwards from its
/// value, a little further each time, to the bounds of the field table, until `possible` holds; then halves its way back to the border and rounds to
/// three digits on the safe side. Numbers that cannot help are left out; the nearest (relative to their size) come first.
std::vector<Change> nearest_changes(const Mechanism& mechanism, const std::function<bool(const Mechanism&)>& possible,
                                    const std::vector<std::string>& more_keys = {});

/// "make r1 ≤ 18.9 mm, or EF ≥ 95 mm, or the range ±28°"; "" for none.
std::string advice_sentence(const std::vector<Change>& changes);

}  // namespace fusee
