/// \file
/// A physical way in which a joint can differ from its mechanism file: where it sits, what it does, what its numbers
/// are called.
///
/// To add an effect: one file here with a function that returns it, one line in catalogue.cpp, and what it does to the
/// joint as a member of Imperfections.
#pragma once

#include <string>
#include <vector>

#include "fusee/base/units.h"
#include "fusee/measurement/measurement.h"
#include "fusee/mechanism/imperfections.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

struct EffectParameter {
  std::string name;  ///< as reported, the unit stands in it: "EA_N"
  double Imperfections::*member = nullptr;
  double least = 0;  ///< bounds of the member
  double most = 0;
  double step = 0;  ///< a change of the member that a sensor may just see: the scale of the fit
  /// From the member to the number reported; may fall where the member grows.
  double (*shown)(double value, const Mechanism& declared) = nullptr;
  bool searched = false;  ///< not fitted: only the values in Effect::starts are tried
};

struct Effect {
  std::string name;
  std::string place;  ///< in the chain: "motor sensor", "shaft", "pulley", "tendon", "pins", "joint", "joint sensor"
  std::string signature;       ///< how data show it
  std::string correctable_by;  ///< "pulley", "table" or ""
  std::string separating_run;  ///< the measurement that tells it from its rivals
  std::vector<EffectParameter> parameters;
  std::vector<std::vector<double>> starts;  ///< of the fit, beside zero; one value a parameter
  bool starts_in_time = false;  ///< and wherever the residual steps: size and time are the first two parameters
  /// Whether the joint has what it needs and the data can show it at all.
  bool (*applies)(const Mechanism& declared, const Measurement& measurement) = nullptr;
};

/// Every effect that the joint can have and the data can show, in the order of the chain.
std::vector<Effect> catalogue(const Mechanism& declared, const Measurement& measurement);

namespace shown {
inline double as_is(double value, const Mechanism&) { return value; }
inline double in_degrees(double value, const Mechanism&) { return degrees(value); }
inline double in_percent(double value, const Mechanism&) { return 100.0 * value; }
inline double in_ms(double value, const Mechanism&) { return 1000.0 * value; }
}  // namespace shown

namespace applies {
inline bool always(const Mechanism&, const Measurement&) { return true; }
/// To the mechanism with guides and pulley.
inline bool to_tendons(const Mechanism& declared, const Measurement&) { return !declared.transmission; }
bool with_time(const Mechanism& declared, const Measurement& measurement);
bool with_time_and_load(const Mechanism& declared, const Measurement& measurement);
bool with_load(const Mechanism& declared, const Measurement& measurement);
bool with_temperature(const Mechanism& declared, const Measurement& measurement);
/// Delays are seen in motion only.
inline bool with_speeds(const Mechanism& declared, const Measurement& measurement) {
  return with_time(declared, measurement);
}
bool to_tendons_or_load(const Mechanism& declared, const Measurement& measurement);
/// What comes back once per turn of the motor is seen only when it turns far enough.
bool to_full_turn(const Mechanism& declared, const Measurement& measurement);
}  // namespace applies

}  // namespace fusee
