/// \file
/// What `fusee plan` leaves behind, as bytes.
#pragma once

#include <string>
#include <vector>

#include "fusee/base/files.h"
#include "fusee/mechanism/file.h"
#include "fusee/plan/plan.h"

namespace fusee {

/// A plan, and what it was made from.
struct PlanProduct {
  MechanismFile file;
  double noise = 0;    ///< rad
  double minutes = 0;  ///< given
  Plan plan;
};

/// "run_2.csv"; "" for a step that is no run.
std::string run_file_name(const Plan& plan, std::size_t step);
/// The rows to drive, as `fusee calibrate` reads them, θ empty; what the person has to do stands in comments.
std::string run_csv(const PlanProduct& product, std::size_t step);
std::string plan_json(const PlanProduct& product);
/// A page that a person follows at the bench: A4, boxes to tick, no network.
std::string plan_html(const PlanProduct& product);
/// The page and run files of a calibration's next measurements: `measured` are the runs that it had.
std::string next_html(const PlanProduct& product, const std::vector<std::string>& measured);
/// Its sections of what to do, for another page that has plan.css.
std::string plan_steps_html(const PlanProduct& product);
std::string plan_manifest_json(const PlanProduct& product, const std::vector<OutputFile>& outputs);

// ---- in words, for the page and for a terminal alike ----

/// "hang 1.02 kg on a cord …"; "" without load.
std::string hanging_words(const PlanProduct& product, const PlannedRun& run);
/// "in 250 simulated joints as declared these runs would have named something in 1".
std::vector<std::string> blame_words(const Plan& plan);
/// "sees creep; tells backlash from sensor_lag": what a step shows that those before it do not.
std::string gain_words(const PlanStep& step);
/// "by minute 3: 3 cycles, slow …; tells …", what the first minutes, or more of them, would buy.
std::string minute_words(const PlanStep& step, const std::string& gain);
std::vector<std::string> minute_words(const std::vector<PlanStep>& steps);

}  // namespace fusee
