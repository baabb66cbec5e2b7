/// \file
/// What `fusee simulate` leaves behind, as bytes.
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
  Measurement log;                 ///< one run: what drove it
  std::vector<JointState> states;  ///< parallel to its rows
};

/// A column of the table: its name ends in its unit; NaN where there is no such number.
struct SimulationColumn {
  std::string name;
  std::vector<double> values;
};
/// In the order of the table, which ends with `status`. theta_deg is what the joint's sensor shows, joint_deg where the
/// joint stands; loose_deg how far from there it may stand, because nothing holds it. tension1_N and
/// tension2_N are between pulley and pin, tension1_joint_N and tension2_joint_N between pin and joint; the motor's
/// torque is positive towards +α. time_s, temperature_C and how the encoders were turned are there where they were
/// logged; of a joint declared by a ratio no tensions and no torque are known.
std::vector<SimulationColumn> simulation_columns(const Simulation& simulation);
/// "held", "loose" (both tendons are slack), "no_equilibrium" (no joint angle carries the load).
std::string_view word(EquilibriumStatus status);
/// The same as a table that `fusee calibrate` reads.
std::string simulation_csv(const Simulation& simulation);

}  // namespace fusee
