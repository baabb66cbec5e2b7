/// \file
/// Parts and materials that people have, as data with sources: profiles/catalogue/*.toml, compiled in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism/mechanism.h"

namespace fusee {

struct HornType {
  std::string name;
  std::string description;
  std::string source;
  Horn horn;
};

/// A motor's shaft.
struct ShaftType {
  std::string name;
  std::string description;
  std::string source;
  Bore bore = Bore::round;
  double diameter = 0;  ///< mm
  double flat = 0;      ///< d: from the flat to the far side, mm
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

const std::vector<HornType>& horns();
const std::vector<ShaftType>& shafts();
const std::vector<TendonType>& tendon_types();
const std::vector<MaterialType>& material_types();

/// By name, or null.
const HornType* find_horn(std::string_view name);
const ShaftType* find_shaft(std::string_view name);

/// The body.horn that stands for Mechanism::horn.
inline constexpr std::string_view k_own_horn = "own";
/// The horn that the pulley is made for, where body.bore = "horn". InputError for a name that is not known.
const Horn& horn_of(const Mechanism& mechanism);

}  // namespace fusee
