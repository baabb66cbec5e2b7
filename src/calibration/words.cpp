#include "fusee/calibration/words.h"

namespace fusee {

std::string_view word(CalibrationVerdict verdict) {
  switch (verdict) {
    case CalibrationVerdict::not_testable:
      return "not_testable";
    case CalibrationVerdict::not_repeatable:
      return "not_repeatable";
    case CalibrationVerdict::unexplained:
      return "unexplained";
    case CalibrationVerdict::confounded:
      return "confounded";
    case CalibrationVerdict::explained:
      return "explained";
    case CalibrationVerdict::no_effect:
      return "no_effect";
  }
  return "";
}

std::string_view remedy_words(const FoundEffect& effect) {
  return effect.correctable_by == "pulley"  ? "A corrected pulley can take it out."
         : effect.correctable_by == "table" ? "The table can take it out."
                                            : "Neither a pulley nor a table can take it out.";
}

}  // namespace fusee
