/// \file
/// When no effect explains a measurement, perhaps the file or a column was written wrongly: the likeliest slips, each
/// undone and held against the same data.
#pragma once

#include <string>
#include <vector>

#include "fusee/calibration/calibration.h"

namespace fusee {

/// A slip with which undone the data are explained.
struct UndoneSlip {
  /// "guides.OE_mm"; "guides.EB_mm, guides.ED_mm" where two are exchanged; "theta", "alpha" or both of the data.
  std::string key;
  std::vector<double> declared;          ///< in the file's unit; of data 1
  std::vector<double> would_be;          ///< of data what the logged angle is to be multiplied with
  std::string question;                  ///< for a person: "is the sign right?"
  bool pulley_as_declared = false;       ///< the pulley was made from the file as it stands, the joint is otherwise
  std::vector<std::string> beside = {};  ///< names of effects that are there too
  double rms = 0;                        ///< what is then left of data that were not fitted to, rad
};

/// The best first; those that do as well follow. Empty where `found` is an explanation and where no slip is one.
/// `as_read`: the runs before they were compared with a joint.
std::vector<UndoneSlip> slips_that_explain(const DeclaredMechanism& declared, const Measurement& as_read,
                                           const Calibration& found);

/// Whether a slip undone, with nothing fitted, leaves noise alone or at most a fault beside it, of data that the file
/// as it stands is far from: what effects could be made to fit there describes nothing, and is not worth the search.
bool is_plainly_a_slip(const DeclaredMechanism& declared, const Measurement& as_read);

/// "guides.OE_mm = -40 in place of 40 would explain the data to 0.03°: is the sign right?"
std::string slip_words(const UndoneSlip& slip);

}  // namespace fusee
