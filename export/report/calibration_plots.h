/// \file
/// Pictures of a calibration. Residuals before and after have the same axis, except in residual_html().
#pragma once

#include <string>

#include "fusee/export.h"

namespace fusee::formats {

/// All runs at a glance: a row for each run and direction, a column for each bin of α, the mean residual as colour.
std::string residual_map_html(const CalibrationProduct& product);
/// Residuals of each run over α, before beside after.
std::string residual_runs_html(const CalibrationProduct& product);
/// Mean residual of each run and direction over load and over speed, where these vary.
std::string residual_levels_html(const CalibrationProduct& product);
/// The mean residual of all runs after the calibration, over α, on an axis of its own, with the noise floor.
std::string residual_html(const CalibrationProduct& product);
/// A component of the discrepancy over α.
std::string discrepancy_html(const calibration::DiscrepancyComponent& part);
/// The empirical curve over α, in both directions; "" if compensation.csv has none.
std::string curve_html(const CalibrationProduct& product);
/// The required motor angle minus that of the target motion, over θ. For a joint of [transmission] the mean is
/// subtracted, because its zero is arbitrary.
std::string compensation_html(const CalibrationProduct& product);
/// θ over α as it was logged: for data that cannot be judged.
std::string logged_html(const measurement::Measurement& measurement);

/// "run_2.csv, load 6 N, 12 °/s"
std::string run_words(const measurement::Run& run, const std::string& load_unit);

}  // namespace fusee::formats
