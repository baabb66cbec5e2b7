/// \file
/// The outputs of `fusee simulate`, as bytes.
#pragma once

#include <string>
#include <vector>

#include "fusee/joint/simulate.h"
#include "fusee/measurement/measurement.h"
#include "fusee/mechanism/file.h"

namespace fusee {

/// A joint moved through a log.
struct Simulation {
  MechanismFile file;
  Measurement log;                 ///< one run that drove the joint
  std::vector<JointState> states;  ///< parallel to its rows
};

/// A column of the table, whose name ends with its unit; NaN for missing numbers.
struct SimulationColumn {
  std::string name;
  std::vector<double> values;
};
/// In the order of the table, which ends with `status`. theta_deg: reading of the joint's sensor. joint_deg: true joint
/// angle. loose_deg: range about it without a restoring torque. tension1_N and tension2_N: between pulley and pin;
/// tension1_joint_N and tension2_joint_N: between pin and joint. The motor's torque is positive towards +α. time_s,
/// temperature_C and the encoder offsets appear if they were logged. A joint declared by a ratio has no tensions and no
/// torque.
std::vector<SimulationColumn> simulation_columns(const Simulation& simulation);
/// "held", "loose" (both tendons are slack), "no_equilibrium" (no joint angle carries the load).
std::string_view word(EquilibriumStatus status);
/// A table that `fusee calibrate` reads.
std::string simulation_csv(const Simulation& simulation);

}  // namespace fusee
