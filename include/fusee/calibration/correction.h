/// \file
/// What was identified, turned into a pulley that takes it out and into a table for what no pulley can.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/calibration/calibration.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// The joint as [identified] says it is, asked to follow the law that the file declares: identified geometry and tendon, the declared
/// θ(α), and a drawing that a pulley offset or scaled in making comes out right from. Of `identified` only the runout stays, which
/// pulley_shift() takes out. The mechanism itself when nothing of this was identified.
Mechanism as_it_is(const Mechanism& mechanism);
/// The joint that a measurement is held against: as it is, with the pulley that was made for it. Nothing is left in `identified`.
Mechanism expected_joint(const Mechanism& declared);
/// By how much the curves are drawn off the axis, mm, so that they come out on it.
Vec2 pulley_shift(const Mechanism& mechanism);

/// P1 may stay round when the best r1 on the joint as it is misses the declared law by little.
struct RoundChoice {
  double r1 = 0;          ///< mm
  double max_error = 0;   ///< of θ, rad
  bool suffices = false;
};
/// For law = "compensate" alone.
RoundChoice round_choice(const Mechanism& mechanism);

/// Where the motor must stand for the joint to be at `theta`, coming from below and from above. rad.
struct CompensationRow {
  double theta = 0;
  double alpha_up = 0;
  double alpha_down = 0;
};

struct Correction {
  Imperfections identified;            ///< of the file and of this calibration together
  double by_pulley = 0;                ///< rms of what the corrected pulley takes away, rad, by simulation
  double by_table = 0;                 ///< rms of what the table takes away beyond that
  bool has_pulley = false;             ///< something identified that a pulley takes out
  RoundChoice round;
  std::vector<CompensationRow> table;  ///< for the corrected pulley where there is one, within the range seen
};

/// `declared` as the file says, with the [identified] of earlier calibrations still apart.
Correction correct(const Mechanism& declared, const Measurement& measurement, const Calibration& calibration);

/// The declared file with the [identified] table, its comments kept; what was found stands above it in words.
std::string corrected_toml(std::string_view declared_text, const Mechanism& declared, const Calibration& calibration, const Correction& correction);
std::string compensation_csv(const Correction& correction);

}  // namespace fusee
