/// \file
/// Parts and materials that people have, as data with sources: profiles/catalogue/*.toml, compiled in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/plane.h"
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

/// A deep-groove ball bearing for a test model's joint. mm
struct BearingType {
  std::string name;
  std::string description;
  std::string source;
  double bore = 0;
  double outer = 0;
  double width = 0;
  double spacer = 0;  ///< outer diameter of a ring that touches its inner ring only
};

/// A board that reads a magnet's angle, the chip in its middle. mm
struct BoardType {
  std::string name;
  std::string description;
  std::string source;
  Vec2 size{0, 0};
  double thickness = 0;
  Vec2 pitch{0, 0};  ///< between its four holes
  double hole = 0;
  double chip = 0;    ///< how far the chip stands above the board
  double magnet = 0;  ///< diameter of the disc, magnetised across
  double magnet_height = 0;
  double gap = 0;  ///< between magnet and chip
};

/// What turns a test model's pulley, about its shaft's axis, the face that lies against a plate from below at height 0.
/// mm
struct MotorType {
  std::string name;
  std::string description;
  std::string source;
  std::vector<std::string> fits;  ///< names of horns and shafts
  double shaft = 0;               ///< diameter; 0: it has a horn
  double shaft_length = 0;        ///< above that face
  double face = 0;                ///< of the horn above it
  double front = 0, back = 0;     ///< how far the body reaches along its long side; front is the nearer end
  double side = 0;                ///< to each side of it
  double depth = 0;               ///< below that face
  double pilot = 0;               ///< diameter of the round boss on it; 0: the body itself comes up through the plate
  bool two_holes = false;         ///< its screws stand at ±x; else at ±x, to the front and to the back
  double hole_x = 0, hole_front = 0, hole_back = 0;
  double hole = 0;  ///< diameter
  double head = 0;  ///< height of the screws' heads
};

const std::vector<HornType>& horns();
const std::vector<ShaftType>& shafts();
const std::vector<TendonType>& tendon_types();
const std::vector<MaterialType>& material_types();
const std::vector<BearingType>& bearing_types();  ///< the largest first
const std::vector<BoardType>& board_types();
const std::vector<MotorType>& motor_types();

/// By name, or null.
const HornType* find_horn(std::string_view name);
const ShaftType* find_shaft(std::string_view name);

/// The body.horn that stands for Mechanism::horn.
inline constexpr std::string_view k_own_horn = "own";
/// The horn that the pulley is made for, where body.bore = "horn". InputError for a name that is not known.
const Horn& horn_of(const Mechanism& mechanism);

}  // namespace fusee
