/// \file
/// Simulation of a joint along logged motor angles, including its sensor.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "fusee/joint/bench_log.h"
#include "fusee/joint/equilibrium.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// Readings of the joint sensor, rad, per run and row.
using Readings = std::vector<std::vector<double>>;

/// State of the joint during the first runs of a log.
struct EarlierState {
  Imperfections joint;
  std::size_t runs = 0;  ///< number of runs in this state; the others were made later
};

/// Predicted readings of the joint `declared` with these imperfections. NaN where the joint has no equilibrium.
Readings predict(const Mechanism& declared, const Imperfections& imperfections, const BenchLog& log);

/// Predicted readings with runs of an earlier state, if any: `imperfections` are added to it and act only in the later
/// runs.
Readings predict(const Mechanism& declared, const Imperfections& imperfections, const BenchLog& log,
                 const std::optional<EarlierState>& earlier);

/// State of the joint at a row of a log. Unknown values are NaN; for a joint declared by a ratio all but its angles.
struct JointState {
  EquilibriumStatus status = EquilibriumStatus::held;
  double theta = std::numeric_limits<double>::quiet_NaN();  ///< true joint angle, rad; NaN without an equilibrium
  /// Reading of the joint's sensor, rad, as predict() returns it.
  double shown = std::numeric_limits<double>::quiet_NaN();
  double loose = 0;              ///< possible deviation from there within the play, rad
  TendonState t1 = {}, t2 = {};  ///< left, right; N, mm
  double motor_torque = std::numeric_limits<double>::quiet_NaN();  ///< towards +α, N·mm
};

/// The states of the joint `declared` with these imperfections, per run and row.
std::vector<std::vector<JointState>> simulate(const Mechanism& declared, const Imperfections& imperfections,
                                              const BenchLog& log);

}  // namespace fusee
