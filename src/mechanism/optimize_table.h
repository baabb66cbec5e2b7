/// \file
/// Internal: checks [optimize] against the field table; errors have columns.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"

namespace fusee {

/// `is_good(key)`: the key was read without an error. `item_place(key, i)`: place of item i of its list; its line is 0
/// for --set.
void check_optimize_table(const Optimization& table, const std::function<bool(const std::string& key)>& is_good,
                          const std::function<Place(const std::string& key, std::size_t item)>& item_place,
                          std::vector<Diagnostic>& errors);

}  // namespace fusee
