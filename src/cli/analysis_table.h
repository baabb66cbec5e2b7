/// \file
/// The stroke of `analyze` as columns for a terminal, CSV and JSON.
#pragma once

#include <string>
#include <vector>

#include "cli/reply.h"
#include "fusee/analysis.h"

namespace fusee::cli {

/// Tables of geometry, forces and compliance within 80 columns, with all rows or 13 of them.
std::string stroke_tables(const std::vector<analysis::AnalysisRow>& rows, bool all);
/// CSV, one line per row; a cell is empty without equilibrium. Columns:
/// - of the target motion: alpha_deg, theta_deg, r1_mm, r2_mm, gamma1_deg and gamma2_deg (angles at C), phi1_deg and
///   phi2_deg (wraps on the pins);
/// - paper_…: by equations [6]-[11] of the paper;
/// - rising_… and falling_…: by the full model while alpha grows and falls:
///   - status: held, loose or no_equilibrium; theta_deg; theta_error_deg = declared − theta_deg;
///   - T1_N, T2_N above the pins, T1_below_N, T2_below_N below them; slack and elongation of each tendon; phi1_deg and
///     phi2_deg;
///   - motor_torque_Nmm, positive towards +alpha;
///   - stiffness_Nmm_per_deg with sliding pins, stiffness_stuck_… with sticking pins;
///   - pin1, pin2: stick, slip_up (towards the joint), slip_down or slack.
std::string stroke_csv(const std::vector<analysis::AnalysisRow>& rows);
/// The columns of stroke_csv() as a list of objects; null without equilibrium.
Json stroke_json(const std::vector<analysis::AnalysisRow>& rows);

}  // namespace fusee::cli
