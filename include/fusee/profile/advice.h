/// \file
/// The nearest change of each single number that makes the impossible possible, found by searching.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fusee/mechanism/mechanism.h"

namespace fusee {

struct Condition;

/// The nearest value of one number of the file, or another word, with which every condition would hold.
struct Change {
  std::string key;  ///< "pulley.r1_mm"
  double from = 0;  ///< in the file's unit
  double to = 0;
  std::string unit;
  std::string text;            ///< "r1 ≤ 18.9 mm"
  std::string from_word = {};  ///< of a key that is no number: "M3"
  std::string to_word = {};
};

/// How a changed mechanism is judged while advice is searched for.
struct Judge {
  /// The conditions that do not hold; none: it can be made as far as a quick look tells. Asked hundreds of times, and
  /// where there is something to make, from two threads.
  std::function<std::vector<Condition>(const Mechanism&)> obstacles;
  /// The whole making, asked for what is about to be given, with the very numbers that will be read. Empty: obstacles
  /// are all there is.
  std::function<bool(const Mechanism&)> made = {};
  /// A look takes long: numbers that do not help are asked less often the further they are turned.
  bool is_dear = false;
  /// How many more makings what was looked at so far is worth; fewer than usual where each is large. Empty: as many
  /// as usual.
  std::function<int()> makings = {};
};

/// What would make a mechanism possible: changes each of which does alone, the nearest first; or two that do together.
struct Advice {
  std::vector<Change> alone;
  std::vector<Change> together;

  bool empty() const { return alone.empty() && together.empty(); }
};

/// For each number of the joint, guides, pulley and tendon that the law uses, and for `more_keys` (to which 0 is no
/// number): steps outwards from its value, all of them a little further each time, within the bounds of the field
/// table, until a few hold; then halves its way back to the border and rounds to three digits on the safe side. Where
/// no number does alone, those that help most are turned in pairs. Numbers of `more_keys` are the easier ones to
/// change: they are turned three times as far. So many changes as are `known` already are not looked for.
Advice find_advice(const Mechanism& mechanism, const Judge& judge, const std::vector<std::string>& more_keys = {},
                   std::size_t known = 0);

/// Of find_advice() what does alone, where all that is known of a mechanism is whether it is possible.
std::vector<Change> nearest_changes(const Mechanism& mechanism, const std::function<bool(const Mechanism&)>& possible,
                                    const std::vector<std::string>& more_keys = {});

/// "make r1 ≤ 18.9 mm, or EF ≥ 95 mm, or the range ±28°"; "" for none.
std::string advice_sentence(const std::vector<Change>& changes);

}  // namespace fusee
