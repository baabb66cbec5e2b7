#include <algorithm>

#include "fusee/base.h"

namespace fusee {
namespace {

Check verdict(bool ok, std::string name, double value, double limit, std::string unit, std::string where) {
  return {std::move(name), value, limit, std::move(unit), ok, ok ? std::string() : std::move(where)};
}

}  // namespace

Check at_most(std::string name, double value, double limit, std::string unit, std::string where) {
  return verdict(value <= limit, std::move(name), value, limit, std::move(unit), std::move(where));
}

Check at_least(std::string name, double value, double limit, std::string unit, std::string where) {
  return verdict(value >= limit, std::move(name), value, limit, std::move(unit), std::move(where));
}

Check exactly(std::string name, double value, double limit, std::string unit, std::string where) {
  return verdict(value == limit, std::move(name), value, limit, std::move(unit), std::move(where));
}

bool all_ok(const std::vector<Check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.ok; });
}

}  // namespace fusee
