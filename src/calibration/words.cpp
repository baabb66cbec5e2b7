#include "calibration/words.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace fusee::calibration {

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

std::string odds(double log_odds) {
  const bool against = log_odds < 0;
  const double decades = std::min(6.0, std::abs(log_odds) / elementary::log(10.0));
  const double unit = elementary::pow(10.0, std::floor(decades));
  const std::string times = fixed(std::max(1.0, unit * std::round(elementary::pow(10.0, decades) / unit)), 0) +
                            (decades < 6.0 ? "" : " or more");
  return against ? "1 : " + times : times + " : 1";
}

std::string_view remedy_words(const FoundEffect& effect) {
  switch (effect.correctable_by) {
    case CorrectableBy::pulley:
      return "A corrected pulley can correct it.";
    case CorrectableBy::table:
      return "The table can correct it.";
    case CorrectableBy::nothing:
      if (effect.place == ChainPlace::joint_sensor)
        return "It is an error of the joint sensor: correct the sensor. Pulley and table would move a joint that is "
               "right.";
      return "Neither a pulley nor a table can correct it.";
  }
  return "";
}

}  // namespace fusee::calibration
