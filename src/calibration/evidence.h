/// \file
/// What a calibration is held against: thinned runs, how they are cut into blocks, and which blocks are held out
/// together.
#pragma once

#include <Eigen/Dense>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fusee/measurement/measurement.h"
#include "fusee/mechanism/effect.h"
#include "joint/forward.h"

namespace fusee {

/// Held angles within this part of what α spans are one.
inline constexpr double k_one_stand = 0.02;

/// Rows that stand or fall together: a stroke, one level of load on it, a held motor angle, or so many short stands
/// from one side under one load that there are enough rows.
struct Block {
  std::size_t run = 0;
  std::size_t stroke = 0;         ///< of short stands the first one's; they are of strokes of one direction
  std::vector<std::size_t> rows;  ///< into the rows of all runs, one after another; without outliers
  std::size_t alike = 0;          ///< blocks of one run and direction that repeat one another share this number
  double load = 0;                ///< mean over its rows; 0 without a load
};

/// Blocks that are held out together.
using Fold = std::vector<std::size_t>;

/// What a caliper says of a number of the joint: [prior] of the file.
struct HandReading {
  const EffectParameter* parameter = nullptr;
  double value = 0;
  double uncertainty = 0;  ///< standard
};

class Marginal;

struct Evidence {
  const DeclaredMechanism* declared = nullptr;
  std::optional<EarlierState> earlier;  ///< of the first runs; effects are then what was added to it
  Measurement measurement;              ///< thinned
  BenchLog log;                         ///< what drove the joint in it
  Eigen::VectorXd theta;                ///< all runs, one after another
  std::vector<Block> blocks;
  std::vector<Fold> run_folds;       ///< whole runs; blocks of a lone run
  std::vector<Fold> factor_folds;    ///< whole levels of load and speed where the data vary them, or as run_folds
  std::vector<std::string> factors;  ///< by which whole levels are held out
  std::vector<HandReading> readings;
  double floor = 0;                                ///< rms noise, rad
  double floor_freedom = 1e9;                      ///< degrees of freedom that it is known by
  std::shared_ptr<const Marginal> marginal;        ///< by which sets of effects are weighed: weigh()
  std::map<const EffectParameter*, double> sizes;  ///< of numbers that in practice are larger than these data bear

  /// Rows in use, block by block.
  std::vector<Eigen::Index> rows() const;
  std::size_t rows_used() const;
  /// Names of the runs that the blocks of `fold` are parts of, each once, in their order.
  std::vector<std::string> run_names(const Fold& fold) const;
};

Evidence gather(const DeclaredMechanism& declared, const Measurement& measurement, double floor,
                const std::optional<EarlierState>& earlier = {});

/// Fills `marginal` from all that stands before it.
void weigh(Evidence& evidence);

/// Of runs longer than that, so many rows evenly over their strokes: what many looks at the same data can bear.
Measurement with_fewer_rows(Measurement measurement, std::size_t most_a_run);

/// All runs, one after another.
Eigen::VectorXd flat(const Readings& readings);

}  // namespace fusee
