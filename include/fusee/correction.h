/// \file
/// Corrections from identified effects, and their influence by simulation.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/analysis.h"
#include "fusee/calibration.h"
#include "fusee/joint.h"
#include "fusee/mechanism.h"
#include "fusee/profile.h"

namespace fusee::correction {

// ---- Correction -----------------------------------------------------------------------------------------------------
// Corrections from the identified effects: a pulley, and a motor table for the errors that no pulley corrects.

/// Motor angles, rad, at which the joint is at `theta`: alpha_up while α grows, alpha_down while it falls.
struct CompensationRow {
  double theta = 0;
  double alpha_up = 0;
  double alpha_down = 0;
  double curve_up = 0;  ///< part of alpha_up from the empirical curve of the unmodelled error
  double curve_down = 0;
};

/// Result of correct(): the corrected pulley and table, each with its validated gain.
struct Correction {
  Imperfections identified;  ///< the file's and this calibration's imperfections, combined
  bool has_pulley = false;   ///< an identified effect is corrected by another pulley, and that pulley is feasible
  std::string infeasible;    ///< why it is infeasible; empty if it is feasible or not needed
  joint::RoundChoice round;
  double assembly_angle = 0;  ///< motor angle at which the corrected pulley's tendons are tied, rad
  // Rms error of the identified joint from its target motion over the measured strokes, rad, by simulation. The zero of
  // a joint declared by a ratio is arbitrary: the identified zero is no part of its error.
  double error_now = 0;
  double error_with_pulley = 0;  ///< with the corrected pulley, assembled at α = 0
  double error_with_table = 0;   ///< with the corrected pulley and the table
  // Reduction of the rms error on held-out rows, rad: the square root of the difference of mean squares. 0: no
  // reduction, and the file is not written.
  double by_pulley = 0;                ///< by the corrected pulley
  double by_table = 0;                 ///< by the table beyond the pulley, including the empirical curve
  double by_curve = 0;                 ///< by the empirical curve alone, on held-out data; 0: not included
  std::string why_no_pulley_file;      ///< why corrected.toml is not written; "" if it is
  std::string why_no_table;            ///< why compensation.csv is not written; "" if it is
  std::vector<CompensationRow> table;  ///< for the corrected pulley if there is one, within the measured range
};

/// Computes both corrections. `declared`: the file, with [identified] of earlier calibrations kept apart.
Correction correct(const DeclaredMechanism& declared, const measurement::Measurement& measurement,
                   const calibration::Calibration& calibration);

/// The declared file with comments, plus the table [identified] and the effects in words.
std::string corrected_toml(std::string_view declared_text, const DeclaredMechanism& declared,
                           const calibration::Calibration& calibration, const Correction& correction);
/// Columns theta_deg, alpha_up_deg, alpha_down_deg. With an empirical curve also empirical_up_deg and
/// empirical_down_deg, the curve's part of both angles.
std::string compensation_csv(const Correction& correction);

// ---- Influence of each effect ---------------------------------------------------------------------------------------
// Simulated influence of each identified effect on the joint, by size of the effect and load: data of the sliders in
// the report.

/// Stroke of the expected joint under one load.
struct LoadedStroke {
  double load = 0;                            ///< tip force, N, positive against +θ
  std::vector<analysis::StrokePoint> points;  ///< along the stroke
};

/// Sizes of an effect, as multiples of the identified size.
inline constexpr std::array k_rehearsed_shares{0.0, 0.5, 1.0, 1.5, 2.0};

/// Change of the sensed joint angle by the effect alone at one share of its size, rad.
struct RehearsedShare {
  std::vector<calibration::FittedParameter> parameters;  ///< the effect's parameters at that share
  std::vector<std::vector<double>> rising, falling;      ///< by load and point of the stroke; α rises, falls
};

/// Simulated influence of one effect.
struct RehearsedEffect {
  std::string name;
  std::vector<RehearsedShare> shares;  ///< one for each of k_rehearsed_shares
};

/// Result of rehearse().
struct Rehearsal {
  Mechanism mechanism;                 ///< the expected joint
  profile::SynthesisResult synthesis;  ///< of the mounted pulley
  std::vector<LoadedStroke> strokes;
  std::vector<RehearsedEffect> effects;  ///< effects with an influence on a slow stroke there and back
};

/// Simulates all effects. Empty for a joint declared by a ratio, or without a feasible pulley. `expected`: from
/// expected_joint().
Rehearsal rehearse(const DeclaredMechanism& expected, const measurement::Measurement& measurement,
                   const calibration::Calibration& calibration);

}  // namespace fusee::correction
