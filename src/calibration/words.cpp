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
  switch (effect.correctable_by) {
    case CorrectableBy::pulley:
      return "A corrected pulley can take it out.";
    case CorrectableBy::table:
      return "The table can take it out.";
    case CorrectableBy::nothing:
      return "Neither a pulley nor a table can take it out.";
  }
  return "";
}

}  // namespace fusee
