/// \file
/// Internal: a list of conditions with their limits.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fusee/profile.h"

namespace fusee::solid {

/// Collects conditions. Values and limits are in mm.
class ConditionList {
 public:
  void add(std::string name, double value, double limit, bool ok, std::string message) {
    profile::Condition condition;
    condition.name = std::move(name);
    condition.ok = ok;
    condition.value = value;
    condition.limit = limit;
    condition.unit = "mm";
    condition.message = std::move(message);
    add(std::move(condition));
  }
  void add_least(std::string name, double value, double least, std::string message) {
    add(std::move(name), value, least, value >= least - k_grain, std::move(message));
  }
  void add_most(std::string name, double value, double most, std::string message) {
    add(std::move(name), value, most, value <= most + k_grain, std::move(message));
  }
  void add(profile::Condition condition) { conditions_.push_back(std::move(condition)); }

  /// All conditions. The list is empty afterwards.
  std::vector<profile::Condition> release() { return std::move(conditions_); }

 private:
  // Tolerance for numbers that a person rounded.
  static constexpr double k_grain = 1e-9;

  std::vector<profile::Condition> conditions_;
};

/// Text for the wall between two holes, or for their overlap.
std::string wall_words(double wall);

}  // namespace fusee::solid
