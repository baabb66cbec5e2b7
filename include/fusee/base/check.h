/// \file
/// A measured value and its limit. A failed check is a value, not an exception.
#pragma once

#include <string>
#include <vector>

namespace fusee {

struct Check {
  std::string name;  ///< snake_case, stable: stands in manifest.json
  double value = 0;  ///< the measured value
  double limit = 0;  ///< the limit that the value is compared with
  std::string unit;  ///< "mm", "deg", "1" (a count or a plain number) …
  bool ok = false;
  std::string where;  ///< location of the fault, for a person ("facet 812 at (3.1, 4.2, 0.0) mm"); empty when ok
};

/// A check that holds when value <= limit (false for NaN).
Check at_most(std::string name, double value, double limit, std::string unit, std::string where = {});
/// A check that holds when value >= limit (false for NaN).
Check at_least(std::string name, double value, double limit, std::string unit, std::string where = {});
/// A check that holds when value == limit exactly (counts, Euler numbers).
Check exactly(std::string name, double value, double limit, std::string unit, std::string where = {});

bool all_ok(const std::vector<Check>& checks);

}  // namespace fusee
