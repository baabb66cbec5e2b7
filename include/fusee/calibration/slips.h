/// \file
/// Likely errors of the file or the logged columns (a wrong sign, unit or exchange), for data that no effect explains.
/// Each hypothesis is corrected and compared with the same data.
#pragma once

#include <string>
#include <vector>

#include "fusee/calibration/calibration.h"

namespace fusee {

/// Likely input error: the data are explained once it is corrected.
struct LikelyInputError {
  /// "guides.OE_mm"; "guides.EB_mm, guides.ED_mm" where two are exchanged; "theta", "alpha" or both of the data.
  std::string key;
  std::vector<double> declared;  ///< values in the file, in its unit; 1 for a column of data
  std::vector<double> would_be;  ///< corrected values; for a column of data the factor on the logged angle
  std::string question;          ///< question to the user: "is the sign right?"
  /// true if the pulley was made from the file as it is, and the joint is as corrected
  bool pulley_as_declared = false;
  std::vector<std::string> beside = {};  ///< names of effects found beside it
  double rms = 0;                        ///< held-out rms after the correction, rad
};

/// Input errors whose correction explains the data, best first, equally likely ones after it. Empty if `found` is an
/// explanation or no hypothesis is one. `as_read`: runs before the comparison with a joint.
std::vector<LikelyInputError> find_input_errors(const DeclaredMechanism& declared, const Measurement& as_read,
                                                const Calibration& found);

/// True if the file as it is leaves far more than noise, and one corrected input error, with nothing fitted, leaves
/// noise or at most a fault beside it. Effects fitted to such a file describe nothing, so the search is omitted.
bool is_input_error_obvious(const DeclaredMechanism& declared, const Measurement& as_read);

/// "guides.OE_mm = -40 in place of 40 would explain the data to 0.03°: is the sign right?"
std::string input_error_words(const LikelyInputError& slip);

}  // namespace fusee
