/// \file
/// What was identified, turned into a pulley that takes it out and into a table for what no pulley can.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/calibration/calibration.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// The joint as [identified] says it is, asked to follow the law that the file declares: identified geometry, tendon
/// and weight; a law that, given way under the mean load, is the declared θ(α); and shrinkage that a pulley scaled in
/// making comes out right from. The range is that of the unloaded joint. Of `identified` only what draw_for_making()
/// takes out stays: radius offset, wave of the profile and runout. The mechanism itself when nothing of this was
/// identified.
Mechanism as_it_is(const Mechanism& mechanism);
/// The joint that a measurement is held against: as it is, with the pulley that was made for it. Nothing is left in
/// `identified`.
Mechanism expected_joint(const Mechanism& declared);

/// Draws both curves further in and off the axis, so that they come out where they belong.
void draw_for_making(SynthesisResult& synthesis, const Mechanism& mechanism);
/// Seen the other way: a floor drawn off the axis, on it …
Polygon as_made(Polygon drawn, const Mechanism& mechanism);
/// … and the joint in which the tendon lies on a floor drawn further in as the real one lies on the made floor:
/// thicker, over thinner pins.
Mechanism with_inset(Mechanism mechanism);

/// Where the motor must stand when the tendons are tied, the unloaded joint at home, for the loaded joint to follow the
/// declared law, rad. No pulley can give this: tied at 0, the joint is off by as much at every α, and compensation.csv
/// says so.
double tied_at(const Mechanism& mechanism);

/// P1 may stay round when the best r1 on the joint as it is misses the law it needs by little.
struct RoundChoice {
  double r1 = 0;         ///< mm
  double max_error = 0;  ///< of θ, rad
  bool suffices = false;
};
/// For law = "compensate" alone.
RoundChoice round_choice(const Mechanism& mechanism);

/// Where the motor must stand for the joint to be at `theta`, on its way up (α grows) and on its way down. rad.
struct CompensationRow {
  double theta = 0;
  double alpha_up = 0;
  double alpha_down = 0;
};

struct Correction {
  Imperfections identified;  ///< of the file and of this calibration together
  bool has_pulley = false;   ///< something identified that another pulley takes out, and it can be made
  std::string infeasible;    ///< why it cannot; empty when it can or none is needed
  RoundChoice round;
  double tied_at = 0;  ///< of the corrected pulley, rad
  // By how much the joint as found misses the declared law over the measured strokes, rms, rad, by simulation …
  double error_now = 0;
  double error_with_pulley = 0;  ///< … with the corrected pulley, tendons tied at α = 0
  double error_with_table = 0;   ///< … and the motor where the table says
  double by_pulley = 0;          ///< what the pulley takes away: error_now² − error_with_pulley² is its square
  double by_table = 0;           ///< what the table takes away beyond that
  std::vector<CompensationRow> table;  ///< for the corrected pulley where there is one, within the range seen
};

/// `declared` as the file says, with the [identified] of earlier calibrations still apart.
Correction correct(const Mechanism& declared, const Measurement& measurement, const Calibration& calibration);

/// The declared file with the [identified] table, its comments kept; what was found stands above it in words.
std::string corrected_toml(std::string_view declared_text, const Mechanism& declared, const Calibration& calibration,
                           const Correction& correction);
std::string compensation_csv(const Correction& correction);

}  // namespace fusee
