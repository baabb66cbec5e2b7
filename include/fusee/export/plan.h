/// \file
/// The outputs of `fusee plan`, as bytes.
#pragma once

#include <string>
#include <vector>

#include "fusee/base/files.h"
#include "fusee/mechanism/file.h"
#include "fusee/plan/plan.h"

namespace fusee {

/// A plan and its inputs.
struct PlanProduct {
  MechanismFile file;
  double noise = 0;    ///< rad
  double minutes = 0;  ///< available minutes
  Plan plan;
};

/// "run_2.csv"; "" for a step that is no run.
std::string run_file_name(const Plan& plan, std::size_t step);
/// The rows to drive in the format of `fusee calibrate`, with θ empty and the instructions in comments.
std::string run_csv(const PlanProduct& product, std::size_t step);
std::string plan_json(const PlanProduct& product);
/// A page for the bench: A4, boxes to tick, no network.
std::string plan_html(const PlanProduct& product);
/// The page and run files of a calibration's next measurements. `measured`: the runs that it had.
std::string next_html(const PlanProduct& product, const std::vector<std::string>& measured);
/// The sections with instructions, for another page that has plan.css.
std::string plan_steps_html(const PlanProduct& product);
std::string plan_manifest_json(const PlanProduct& product, const std::vector<OutputFile>& outputs);

// ---- texts for page and terminal ----

/// "hang 1.02 kg on a cord …"; "" without load.
std::string hanging_words(const PlanProduct& product, const PlannedRun& run);
/// The expected false-positive rate in words, for simulated joints.
std::vector<std::string> false_positive_words(const Plan& plan);
/// The predicted gain of a step over the steps before it, such as "sees creep; tells … from …".
std::string gain_words(const PlanStep& step);
/// The predicted gain of the first minutes, such as "by minute 3: 3 cycles, slow …; tells …".
std::string minute_words(const PlanStep& step, const std::string& gain);
std::vector<std::string> minute_words(const std::vector<PlanStep>& steps);

}  // namespace fusee
