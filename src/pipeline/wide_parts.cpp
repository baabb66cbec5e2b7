#include "pipeline/wide_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/text.h"

namespace fusee::pipeline {

std::optional<Diagnostic> wide_part_warning(const formats::Product& product) {
  constexpr double k_wide = 2.0;  // ratio of radii from which a part is wide
  if (product.helix) return std::nullopt;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const transmission::TransmissionPoint& point : product.synthesis.stroke) {
    least = std::min({least, point.t1.p, point.t2.p});
    most = std::max({most, point.t1.p, point.t2.p});
  }
  const double diameter = solid::outer_size(product.pulley).diameter;
  const double required_radius = std::max(most, product.pulley.layout.hub_radius);
  if (diameter < 2.0 * k_wide * required_radius) return std::nullopt;
  return Diagnostic{
      Severity::warning, product.file.place_of("pulley.law"),
      fmt::format("the part is {} mm wide, and the tendons leave it at radii of {} to {} mm: its outline closes far "
                  "outside the range",
                  rounded(diameter, 4), rounded(least, 3), rounded(most, 3)),
      "narrow joint.range_deg, or write the space that you have as body.room_diameter_mm: advice then keeps to it"};
}

}  // namespace fusee::pipeline
