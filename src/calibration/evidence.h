/// \file
/// Data of a calibration: thinned runs, their blocks, and the folds that are held out together.
#pragma once

#include <Eigen/Dense>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fusee/measurement.h"
#include "joint/forward.h"
#include "mechanism/effect.h"

namespace fusee::calibration {

/// Dwells within this share of the range of α are at one place.
inline constexpr double k_dwell_tolerance = 0.02;

/// Rows that are held out together: a stroke, one level of load in it, a dwell of the motor, or several short dwells
/// from one side under one load.
struct Block {
  std::size_t run = 0;
  std::size_t stroke = 0;         ///< stroke of the first row; joined dwells are of strokes of one direction
  std::vector<std::size_t> rows;  ///< indices into the rows of all runs, one after another, without outliers
  std::size_t alike = 0;          ///< blocks of one run and direction that repeat one another share this number
  double load = 0;                ///< mean over its rows; 0 without a load
};

/// Blocks that are held out together.
using Fold = std::vector<std::size_t>;

/// Caliper reading of a number of the joint: [prior] of the file.
struct HandReading {
  const EffectParameter* parameter = nullptr;
  double value = 0;
  double uncertainty = 0;  ///< standard uncertainty
};

class EvidenceModel;

struct Evidence {
  const DeclaredMechanism* declared = nullptr;
  std::optional<joint::EarlierState> earlier;  ///< state in the first runs; effects are changes from it
  measurement::Measurement measurement;        ///< thinned
  joint::BenchLog log;                         ///< motion and load of the measurement
  Eigen::VectorXd theta;                       ///< joint angle of all runs, one after another
  std::vector<Block> blocks;
  std::vector<Fold> run_folds;       ///< whole runs; the blocks of a single run
  std::vector<Fold> factor_folds;    ///< whole levels of load and speed if the data vary them, otherwise as run_folds
  std::vector<std::string> factors;  ///< factors of which whole levels are held out
  std::vector<HandReading> readings;
  double largest_load = 0;                              ///< largest size of a logged load
  double floor = 0;                                     ///< rms noise, rad
  double floor_freedom = 1e9;                           ///< degrees of freedom of the floor
  std::shared_ptr<const EvidenceModel> evidence_model;  ///< evidence model, filled by weigh()
  std::map<const EffectParameter*, double> sizes;       ///< prior sizes of numbers that these data narrow, in steps

  /// Indices of the rows in use, block by block.
  std::vector<Eigen::Index> rows() const;
  std::size_t rows_used() const;
  /// Names of the runs of the blocks of `fold`, each once, in their order.
  std::vector<std::string> run_names(const Fold& fold) const;
};

Evidence gather(const DeclaredMechanism& declared, const measurement::Measurement& measurement, double floor,
                const std::optional<joint::EarlierState>& earlier = {});

/// Fills `evidence_model` from all other members.
void weigh(Evidence& evidence);

/// Thins each run to a number of rows, evenly over its strokes.
measurement::Measurement with_fewer_rows(measurement::Measurement measurement, std::size_t most_a_run);

/// Indices of samples, run by run, ascending.
using RowsOfRuns = std::vector<std::vector<std::size_t>>;

/// Rows far from their neighbours: a fit leaves such rows out, and so must every figure. `about_declared`: residuals of
/// the declared joint, run by run.
RowsOfRuns outliers_of(const measurement::Measurement& measurement, double floor,
                       const std::vector<std::vector<double>>& about_declared);
/// Replaces the residuals of these rows by NaN. Returns the number that were finite.
std::size_t exclude_rows(const RowsOfRuns& rows, std::vector<std::vector<double>>& residuals);

/// Joint angles of all runs, one after another.
Eigen::VectorXd flat(const joint::Readings& readings);

}  // namespace fusee::calibration
