/// \file
/// Answers that a person types: lengths, ranges, loads, motors and tendons, with the units and names of a workshop.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "fusee/mechanism.h"

namespace fusee::cli {

/// Why an answer cannot be used, and what to type.
struct Refusal {
  std::string reason;
};

template <class Value>
using Answer = std::variant<Value, Refusal>;

/// "45", "45 mm", "4.5 cm", "4,5 cm", "1.8 in", "1 3/4\"", "2 ft 3 in", "⌀30". In mm; must be positive. A plain number
/// is in `plain`.
Answer<double> read_length(std::string_view text, LengthUnit plain = LengthUnit::mm);
/// True for a length that is typed in inches or feet.
bool is_in_inches(std::string_view text);

struct AngleRange {
  double low = 0, high = 0;  ///< deg
};
/// "-30 30", "±30", "+-30°", "-30..30", "0 to 80", "0-80", "[-15, 45]", "-15,5 30". Home lies within.
Answer<AngleRange> read_range(std::string_view text);

/// A force across the link at C, or a torque about the joint.
struct TypedLoad {
  double force = 0;   ///< N
  double torque = 0;  ///< N·mm
};
/// "10", "10 N", "0.5 kg", "500 g", "2 lbf" at C; "0.8 Nm", "5 kg cm" about the joint.
Answer<TypedLoad> read_load(std::string_view text);

struct TypedMotor {
  std::string shaft;        ///< a name of the catalogue, or empty
  std::string horn;         ///< a name of the catalogue, or empty
  double bore = 0;          ///< diameter of any other shaft, mm
  bool flat = false;        ///< that shaft is a D shaft
  std::string model;        ///< a motor of the catalogue by its maker's name, or empty
  double travel = 0;        ///< rotation of the pulley that the motor allows, behind a gearbox, rad; 0: unlimited
  double typed_travel = 0;  ///< rotation of the motor that was typed beside its name, before a gearbox, rad
  double gear_ratio = 1;    ///< of a gearbox that was typed beside its name
  std::string words;        ///< for the summary
  std::string choice;       ///< name of the shaft that was chosen from a family, and the others; empty without a choice
};
/// A name of the catalogue or part of it ("n20-d3", "MG996R horn", "nema 17 round"), a model ("XL430-W250"), or a shaft
/// ("5 mm", "1/4 in D"). "180 deg" beside it is the travel of the motor itself. "5:1" beside a model is a gearbox, whose
/// own shaft may follow ("NEMA17-48mm 5:1, 8 mm D"). A plain number is in `plain`.
Answer<TypedMotor> read_motor(std::string_view text, LengthUnit plain = LengthUnit::mm);

struct TypedTendon {
  double diameter = 0;    ///< mm
  double modulus = 0;     ///< MPa
  double bend_ratio = 0;  ///< minimum bend diameter / tendon diameter
  double strength = 0;    ///< by the section of the nearest tendon of the catalogue, N; 0: the catalogue's own
  std::string words;      ///< for the summary
};
/// A diameter, a name of the catalogue, or both: "0.6", "hmpe-0.56", "Dyneema 0.6 mm", "steel 1/16 in", "nylon".
Answer<TypedTendon> read_tendon(std::string_view text, LengthUnit plain = LengthUnit::mm);

}  // namespace fusee::cli
