/// \file
/// A joint moved through logged motor angles: what its sensor would have shown.
#pragma once

#include <vector>

#include "fusee/joint/bench_log.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// θ as the joint sensor shows it, rad, run by run, parallel to the rows.
using Readings = std::vector<std::vector<double>>;

/// What the sensor would have logged of the joint `declared` with these imperfections. NaN where the joint has no
/// equilibrium.
Readings predict(const Mechanism& declared, const Imperfections& imperfections, const BenchLog& log);

}  // namespace fusee
