/// \file
/// Helpers that build and damage drawings in tests.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "fusee/export.h"
#include "support/shapes.h"

namespace fusee::testing {

/// "0\nLINE\n8\ncut…" from pairs: what DXF is made of.
inline std::string tags(const std::vector<std::pair<int, std::string>>& pairs) {
  std::string text;
  for (const auto& [code, value] : pairs) text += std::to_string(code) + "\n" + value + "\n";
  return text;
}

/// A drawing in AC1015 with the given $INSUNITS, blocks and entities, and nothing else.
inline std::string dxf_of(const std::string& entities, int units = 4, const std::string& blocks = {}) {
  return tags({{0, "SECTION"},
               {2, "HEADER"},
               {9, "$ACADVER"},
               {1, "AC1015"},
               {9, "$INSUNITS"},
               {70, std::to_string(units)},
               {0, "ENDSEC"}}) +
         tags({{0, "SECTION"}, {2, "BLOCKS"}}) + blocks + tags({{0, "ENDSEC"}, {0, "SECTION"}, {2, "ENTITIES"}}) +
         entities + tags({{0, "ENDSEC"}, {0, "EOF"}});
}

inline std::vector<formats::DrawingPath> on_layer(const formats::Drawing& drawing, const std::string& layer) {
  std::vector<formats::DrawingPath> paths;
  for (const formats::DrawingPath& path : drawing.paths) {
    if (path.layer == layer) paths.push_back(path);
  }
  return paths;
}

inline const Check& check_named(const std::vector<Check>& checks, const std::string& name) {
  const auto found = std::find_if(checks.begin(), checks.end(), [&](const Check& check) { return check.name == name; });
  if (found == checks.end()) throw std::out_of_range("no check named " + name);
  return *found;
}

/// Input of drawings: pitch curves of known shape, on a shaft of 6 mm. They are cut with a kerf of 0.2 mm from plates of
/// 3 mm, with dowel holes of 3 mm, on sheets of 300 mm by 200 mm.
inline formats::Product product_of(const SupportShape& p1, const SupportShape& p2) {
  formats::Product product;
  Mechanism& mechanism = product.joint.mechanism;
  mechanism = plain_mechanism();
  mechanism.body.bore_diameter = 6;
  mechanism.cut = {0.2, 3, 300, 200, 3};
  product.synthesis = pulley_of(p1, p2);
  return product;
}

/// P1 is a circle, P2 an egg.
inline formats::Product egg() { return product_of(circle(16), {18, {{1, 0.5, 1}, {2, 1, 0.3}}}); }

/// The names of the failed checks.
inline std::vector<std::string> failed(const std::vector<Check>& checks) {
  std::vector<std::string> names;
  for (const Check& check : checks) {
    if (!check.ok) names.push_back(check.name);
  }
  return names;
}

}  // namespace fusee::testing
