#include "calibration/catalogue.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "joint/joint_effects.h"
#include "measurement/value_range.h"

namespace fusee::calibration {
namespace {

/// Temperature range below which all data are at one temperature.
constexpr double k_least_warming = 1.0;  // K

bool all(const measurement::Measurement& measurement, bool measurement::Run::*has) {
  return std::all_of(measurement.runs.begin(), measurement.runs.end(),
                     [&](const measurement::Run& run) { return run.*has; });
}

bool has_load(const Mechanism& declared, const measurement::Measurement& measurement) {
  if (declared.load.tip_force != 0 || declared.load.torque != 0 || declared.load.mass_kg > 0 ||
      declared.spring != Spring{})
    return true;
  return std::any_of(measurement.runs.begin(), measurement.runs.end(), [](const measurement::Run& run) {
    return run.has_load && std::any_of(run.samples.begin(), run.samples.end(),
                                       [](const measurement::Sample& sample) { return std::abs(sample.load) > 0; });
  });
}

bool has_warming(const measurement::Measurement& measurement) {
  return all(measurement, &measurement::Run::has_temperature) &&
         measurement::value_range(measurement, &measurement::Sample::temperature_C).size() > k_least_warming;
}

bool can_be_seen(const Needs& needs, const Mechanism& declared, const measurement::Measurement& measurement) {
  return !(needs.time && !all(measurement, &measurement::Run::has_time)) &&
         !(needs.load && !has_load(declared, measurement)) && !(needs.temperature && !has_warming(measurement)) &&
         joint::has_part(declared, needs);
}

}  // namespace

std::vector<const fusee::Effect*> catalogue(const Mechanism& declared, const measurement::Measurement& measurement,
                                            std::span<const fusee::Effect* const> more,
                                            std::span<const std::string> without) {
  std::vector<const fusee::Effect*> all(more.begin(), more.end());
  for (const fusee::Effect& effect : effects(kind_of(declared))) {
    const auto is_replaced = [&](const fusee::Effect* other) { return other->name == effect.name; };
    if (std::none_of(more.begin(), more.end(), is_replaced)) all.push_back(&effect);
  }
  std::erase_if(all, [&](const fusee::Effect* effect) {
    return !effect->is_tested || !can_be_seen(effect->needs, declared, measurement) ||
           std::find(without.begin(), without.end(), effect->name) != without.end();
  });
  std::stable_sort(all.begin(), all.end(), [](const fusee::Effect* a, const fusee::Effect* b) {
    return std::tie(a->place, a->rank) < std::tie(b->place, b->rank);
  });
  return all;
}

}  // namespace fusee::calibration
