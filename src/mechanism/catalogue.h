/// \file
/// Catalogue of parts and materials, as data with sources: profiles/catalogue/*.toml, compiled in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"

namespace fusee {

struct HornType {
  std::string name;
  std::string description;
  std::string source;
  Horn horn;
};

/// The shaft of a motor.
struct ShaftType {
  std::string name;
  std::string description;
  std::string source;
  Bore bore = Bore::round;
  double diameter = 0;  ///< mm
  double flat = 0;      ///< D shaft: from the flat to the far side, mm
};

struct TendonType {
  std::string name;
  std::string description;
  std::string source;
  double diameter = 0;           ///< mm
  double modulus = 0;            ///< over the full section of the diameter, MPa
  double breaking_strength = 0;  ///< N, without a knot
  double bend_ratio = 0;         ///< minimum bend diameter / tendon diameter
};

struct MaterialType {
  std::string name;
  std::string description;
  std::string source;
  double shrinkage_least = 0;  ///< percent
  double shrinkage_typical = 0;
  double shrinkage_most = 0;
};

/// A deep-groove ball bearing for the joint of a test rig. mm
struct BearingType {
  std::string name;
  std::string description;
  std::string source;
  double bore = 0;
  double outer = 0;
  double width = 0;
  double spacer = 0;  ///< outer diameter of a ring that touches the inner race only
};

/// A sensor board that reads a magnet's angle, with the chip in its middle. mm
struct BoardType {
  std::string name;
  std::string description;
  std::string source;
  Vec2 size{0, 0};
  double thickness = 0;
  Vec2 pitch{0, 0};   ///< spacing of its four holes
  double hole = 0;    ///< diameter of the holes
  double chip = 0;    ///< height of the chip above the board
  double magnet = 0;  ///< diameter of the diametrically magnetized disc
  double magnet_height = 0;
  double gap = 0;  ///< between magnet and chip
};

/// The motor of a test rig. Coordinates are relative to its shaft axis; height 0 is the face that lies against a plate
/// from below. mm
struct MotorType {
  std::string name;
  std::string description;
  std::string source;
  std::vector<std::string> fits;  ///< names of horns and shafts
  double shaft = 0;               ///< diameter; 0: it has a horn
  double shaft_length = 0;        ///< length of the shaft above the motor's face
  double face = 0;                ///< height of the horn's face above the motor's face
  double front = 0, back = 0;     ///< extent of the motor along its long side; front is the nearer end
  double side = 0;                ///< extent to each side
  double depth = 0;               ///< extent below the motor's face
  /// Diameter of the round boss on the face; 0: the motor's body passes through the plate.
  double pilot = 0;
  bool two_holes = false;  ///< screws at ±x only; otherwise at ±x, both at the front and at the back
  double hole_x = 0, hole_front = 0, hole_back = 0;  ///< distances of the screws' holes from the shaft axis
  double hole = 0;                                   ///< diameter of the holes
  double head = 0;                                   ///< height of the screws' heads
};

/// Stall torque per required torque that is advised for a motor that cannot hold its stall torque. An STS3215 held half
/// of it for an hour (TheRobotStudio/SO-ARM100, issue 134).
inline constexpr double k_advised_stall_margin = 2.0;

/// A motor by its maker's figures.
struct MotorModel {
  std::string name;
  std::string description;
  std::string source;
  std::vector<std::string> fits;  ///< names of horns and shafts
  double travel = 0;              ///< rad; 0: turns without end
  double stall_torque = 0;        ///< N·mm
  double speed = 0;               ///< without load, rad/s; 0: unknown
  bool holds = false;             ///< stall_torque is a continuous torque, given at full speed too

  /// Advised ratio of stall_torque and the torque that is required.
  double advised_margin() const { return holds ? 1.0 : k_advised_stall_margin; }
};

/// The entry of a mechanism file of profiles/ in the list of templates.
struct TemplateType {
  std::string name;
  std::string description;
  std::string group;
};

const std::vector<HornType>& horns();
const std::vector<ShaftType>& shafts();
const std::vector<TendonType>& tendon_types();
const std::vector<MaterialType>& material_types();
const std::vector<BearingType>& bearing_types();  ///< the largest first
const std::vector<BoardType>& board_types();
const std::vector<MotorType>& motor_types();
const std::vector<MotorModel>& motor_models();
const std::vector<TemplateType>& template_types();  ///< in the order of the list

/// Finds an entry by name; null when there is none.
const HornType* find_horn(std::string_view name);
const ShaftType* find_shaft(std::string_view name);
const MotorModel* find_motor_model(std::string_view name);
/// Breaking strength of a tendon of this kind with another diameter (mm), by its cross-section, N.
double strength_by_section(const TendonType& type, double diameter);
/// The model with the largest torque among those of the body's shaft or horn; null when there is none.
const MotorModel* strongest_motor_that_fits(const Body& body);

/// True if the body is made for a shaft or horn of this motor.
bool fits_bore(const MotorModel& model, const Body& body);
/// Limits of the mechanism's motor at the pulley, behind its gearbox: the numbers of [motor] and, where it has none,
/// those of its model. 0: unknown.
MotorModel motor_limits(const Motor& motor);
/// The model behind the gearbox of [motor], with its ratio in the name.
MotorModel behind_gearbox(MotorModel model, const Motor& motor);

/// The value of body.horn that selects Mechanism::horn.
inline constexpr std::string_view k_own_horn = "own";
/// The horn of the mechanism, for body.bore = "horn". Throws InputError for an unknown name.
const Horn& horn_of(const Mechanism& mechanism);

}  // namespace fusee
