/// \file
/// What `fusee calibrate` leaves behind, as bytes: CONTRACT §6.
#pragma once

#include <string>
#include <vector>

#include "fusee/base/files.h"
#include "fusee/calibration/correction.h"
#include "fusee/mechanism/file.h"

namespace fusee {

/// All that is known after a calibration.
struct CalibrationProduct {
  MechanismFile file;
  Measurement measurement;
  Calibration calibration;
  Correction correction;
};

std::string calibration_json(const CalibrationProduct& product);
std::string calibration_report_html(const CalibrationProduct& product);
/// Names the files beside it, so that the next run knows them as ours.
std::string calibration_manifest_json(const CalibrationProduct& product, const std::vector<OutputFile>& outputs);

}  // namespace fusee
