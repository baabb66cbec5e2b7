/// \file
/// Parts and materials that people have, as data with sources: profiles/catalogue/*.toml, compiled in.
#pragma once

#include <string>
#include <vector>

namespace fusee {

/// A servo horn that the pulley is screwed onto. mm.
struct Horn {
  std::string name;
  std::string description;
  std::string source;
  double hub_diameter = 0;     ///< of the horn's round hub, which sinks into the recess
  double recess_depth = 0;     ///< how far the hub stands above the face that the pulley lies on; 0: the horn is flat
  double centre_hole = 0;      ///< for the screw that holds the horn on the servo, and its head
  int hole_count = 0;          ///< screw holes, evenly spaced on hole_circle, the first on +x
  double hole_circle = 0;      ///< diameter of the circle through the holes' centres
  double hole_diameter = 0;    ///< clearance of the screws
};

struct TendonType {
  std::string name;
  std::string description;
  std::string source;
  double diameter = 0;           ///< mm
  double modulus = 0;            ///< over the full section of the diameter, MPa
  double breaking_strength = 0;  ///< N, without a knot
  double bend_ratio = 0;         ///< smallest bend diameter per diameter
};

struct MaterialType {
  std::string name;
  std::string description;
  std::string source;
  double shrinkage_least = 0;  ///< percent
  double shrinkage_typical = 0;
  double shrinkage_most = 0;
};

const std::vector<Horn>& horns();
const std::vector<TendonType>& tendon_types();
const std::vector<MaterialType>& material_types();

/// By name, or null.
const Horn* find_horn(const std::string& name);

}  // namespace fusee
