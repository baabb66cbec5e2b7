#include "pipeline/thin_walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/text.h"

namespace fusee::pipeline {
namespace {

/// Measured walls of exactly one line may be thinner by this, mm.
constexpr double k_tolerance = 1e-3;

Diagnostic thinner_than_a_line(const formats::Product& product, const char* key, double value,
                               const std::string& what) {
  const double nozzle = product.joint.mechanism.print.nozzle;
  return {Severity::warning, product.file.place_of(key),
          fmt::format("{}: thinner than one line of a {} mm nozzle (print.nozzle_mm)", what, rounded(nozzle)),
          fmt::format("try {} = {} or more (now {}), or a finer nozzle", key, rounded(nozzle),
                      value > 0 ? rounded(value) : "automatic")};
}

/// The thinnest wall at a groove or between two of its turns, mm, as planned or as measured on the mesh by the checks.
double thinnest_measured(const formats::Product& product, double planned) {
  double thinnest = planned;
  for (const Check& check : product.checks) {
    if (check.name.starts_with("wall") || check.name.starts_with("rib")) thinnest = std::min(thinnest, check.value);
  }
  return thinnest;
}

}  // namespace

std::vector<Diagnostic> thin_wall_warnings(const formats::Product& product) {
  const solid::BodyLayout& layout = product.pulley.layout;
  const Body& body = product.joint.mechanism.body;
  const double line = product.joint.mechanism.print.nozzle - k_tolerance;
  std::vector<Diagnostic> warnings;
  if (layout.flange_thickness < line) {
    warnings.push_back(thinner_than_a_line(
        product, "body.flange_thickness_mm", body.flange_thickness,
        fmt::format("the flanges are {} mm thick at the groove edge", rounded(layout.flange_thickness))));
  }
  const double measured = thinnest_measured(product, layout.min_wall);
  if (measured < line) {
    warnings.push_back(thinner_than_a_line(product, "body.min_wall_mm", body.min_wall,
                                           fmt::format("walls are only {} mm thick", rounded(measured))));
  }
  return warnings;
}

}  // namespace fusee::pipeline
