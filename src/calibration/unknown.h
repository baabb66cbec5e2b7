/// \file
/// What stays without a name beside a set of effects: on what it depends, how large it is, where such a thing can sit.
#pragma once

#include <vector>

#include "calibration/fit.h"
#include "fusee/calibration/calibration.h"

namespace fusee {

struct Unnamed {
  double evidence = 0;  ///< nats by which the data are likelier with it than with noise and the model's own error alone
  double rms = 0;       ///< of all of it, rad
  std::vector<Unknown> parts;  ///< the largest first
  Explained explained;         ///< by the factors that are described, each with its amplitude
};

/// Whether nothing but where the motor is and which way it came matters.
bool is_of_place(Factor factor);

/// Parts that the data hardly need are not among them.
Unnamed unnamed_beside(const Evidence& evidence, const Fit& fit);

/// Whether what is left is more than noise and the model's own error.
bool is_unexplained(const Unnamed& unnamed, double floor);

}  // namespace fusee
