/// \file
/// A joint moved through logged motor angles: what its sensor would have shown.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "fusee/joint/bench_log.h"
#include "fusee/joint/equilibrium.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// θ as the joint sensor shows it, rad, run by run, parallel to the rows.
using Readings = std::vector<std::vector<double>>;

/// The state that a joint was in while the first runs of a log were made.
struct EarlierState {
  Imperfections joint;
  std::size_t runs = 0;  ///< made in it; the others were made later
};

/// What the sensor would have logged of the joint `declared` with these imperfections. NaN where the joint has no
/// equilibrium.
Readings predict(const Mechanism& declared, const Imperfections& imperfections, const BenchLog& log);

/// With runs of an earlier state, if there is one: `imperfections` were added to it, and act in the later runs alone.
Readings predict(const Mechanism& declared, const Imperfections& imperfections, const BenchLog& log,
                 const std::optional<EarlierState>& earlier);

/// The joint as a row of a log finds it. What is not known is NaN: of a joint declared by a ratio all but its angles.
struct JointState {
  EquilibriumStatus status = EquilibriumStatus::held;
  double theta = std::numeric_limits<double>::quiet_NaN();  ///< where the joint stands, rad; NaN without an equilibrium
  double shown = std::numeric_limits<double>::quiet_NaN();  ///< by the joint's sensor, rad: what predict() says
  double loose = 0;              ///< how far from there it may stand, because nothing holds it, rad
  TendonState t1 = {}, t2 = {};  ///< left, right; N, mm
  double motor_torque = std::numeric_limits<double>::quiet_NaN();  ///< towards +α, N·mm
};

/// The joint `declared` with these imperfections, run by run, parallel to the rows: what predict() only shows.
std::vector<std::vector<JointState>> simulate(const Mechanism& declared, const Imperfections& imperfections,
                                              const BenchLog& log);

}  // namespace fusee
