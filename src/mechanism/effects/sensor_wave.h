/// \file
/// Internal: common parts of the harmonics of both sensors, wave_sin · sin nφ + wave_cos · (cos nφ − 1) at the angle φ.
/// The errors of a tilted magnet, of unequal gains of two channels and of an elliptic ring repeat twice a turn, those
/// of motor poles near the magnet four times. n is searched, not fitted.
#pragma once

#include <vector>

#include "mechanism/effect.h"

namespace fusee {

inline EffectParameter wave_part(std::string_view name, double& (*number)(Imperfections&), const IdentifiedKey& key) {
  return {.name = std::string(name),
          .number = number,
          .least = -0.2,
          .most = 0.2,
          .step = 1e-3,
          .prior = radians(0.3),  // 1 % between the gains of sine and cosine: 0.3 degrees
          .shown = shown::in_degrees,
          .key = key};
}

inline EffectParameter wave_order(double& (*number)(Imperfections&), std::string_view key) {
  constexpr auto as_written = [](double order) { return order; };
  return {.name = "harmonic",
          .number = number,
          .least = 2,
          .most = 4,
          .step = 1,
          .shown = shown::as_is,
          .key = {key, "", "order n of the harmonic", 1, 100, as_written, as_written, "2"},
          .searched = true};
}

inline std::vector<std::vector<double>> wave_starts() { return {{0, 0, 2}, {0, 0, 3}, {0, 0, 4}}; }

}  // namespace fusee
