/// \file
/// What was identified, turned into a pulley that takes it out and into a table for what no pulley can.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/calibration/calibration.h"
#include "fusee/joint/as_it_is.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// Where the motor must stand for the joint to be at `theta`, on its way up (α grows) and on its way down. rad.
struct CompensationRow {
  double theta = 0;
  double alpha_up = 0;
  double alpha_down = 0;
  double curve_up = 0;  ///< part of alpha_up that comes from the empirical curve of what has no name
  double curve_down = 0;
};

struct Correction {
  Imperfections identified;  ///< of the file and of this calibration together
  bool has_pulley = false;   ///< something identified that another pulley takes out, and it can be made
  std::string infeasible;    ///< why it cannot; empty when it can or none is needed
  RoundChoice round;
  double tied_at = 0;  ///< of the corrected pulley, rad
  // By how much the joint as found misses the declared law over the measured strokes, rms, rad, by simulation; of a
  // joint declared by a ratio its zero, which is found, is no part of it …
  double error_now = 0;
  double error_with_pulley = 0;  ///< … with the corrected pulley, tendons tied at α = 0
  double error_with_table = 0;   ///< … and the motor where the table says
  // By how much less rows that were left out miss the declared law, rms, rad: the difference of the squares is the
  // square of what is taken away. 0: they do not get better, and the file is not to be used.
  double by_pulley = 0;  ///< by what the corrected pulley changes of the joint …
  double by_table = 0;   ///< … and by the table beyond that, the empirical curve in it included …
  double by_curve = 0;   ///< … which alone takes away so much of data that it was not made from; 0: not in it
  std::string why_no_pulley_file;      ///< why corrected.toml is not to be used; "" where it is
  std::string why_no_table;            ///< the same of compensation.csv
  std::vector<CompensationRow> table;  ///< for the corrected pulley where there is one, within the range seen
};

/// `declared` as the file says, with the [identified] of earlier calibrations still apart.
Correction correct(const DeclaredMechanism& declared, const Measurement& measurement, const Calibration& calibration);

/// The declared file with the [identified] table, its comments kept; what was found stands above it in words.
std::string corrected_toml(std::string_view declared_text, const DeclaredMechanism& declared,
                           const Calibration& calibration, const Correction& correction);
/// Columns theta_deg, alpha_up_deg, alpha_down_deg. With an empirical curve two more, empirical_up_deg and
/// empirical_down_deg, have the curve's part of both angles.
std::string compensation_csv(const Correction& correction);

}  // namespace fusee
