#include "solid/size.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/text.h"
#include "fusee/base.h"

namespace fusee::solid {
namespace {

profile::Condition exceeding(std::string name, double value, double limit, std::string message) {
  profile::Condition condition;
  condition.name = std::move(name);
  condition.ok = false;
  condition.value = value;
  condition.limit = limit;
  condition.unit = "mm";
  condition.message = std::move(message);
  return condition;
}

}  // namespace

std::optional<profile::Condition> too_tall(const BodyLayout& layout) {
  const bool apart = layout.parts == Parts::two;
  const double height = apart ? std::max(layout.z_mate, layout.z_hub - layout.z_mate) : layout.z_hub;
  if (height <= k_tallest) return std::nullopt;
  std::string message = fmt::format("{} would be {} mm tall, at most {} mm is supported",
                                    apart ? "a part" : "the pulley", rounded(height, 3), k_tallest);
  if (layout.ceiling_slope > 0)
    message += fmt::format(": its cones rise at {:.0f}° (print.overhang_deg)", degrees(layout.ceiling_slope));
  return exceeding(k_height_condition, height, k_tallest, std::move(message));
}

std::optional<profile::Condition> too_far_out(transmission::Side side, double reach, double active_reach) {
  if (reach <= k_furthest) return std::nullopt;
  const std::string name(transmission::pulley_name(side));
  std::string message =
      active_reach > k_furthest
          ? fmt::format("{} would reach {} m from the axis", name, rounded(1e-3 * reach, 3))
          : fmt::format(
                "the arc that closes {} would reach {} m from the axis (its ends are almost opposite each "
                "other)",
                name, rounded(1e-3 * reach, 3));
  message += fmt::format(": at most {} m is supported", 1e-3 * k_furthest);
  return exceeding("furthest_" + name, reach, k_furthest, std::move(message));
}

}  // namespace fusee::solid
