/// \file
/// One tendon over its pin at given lengths: which tensions its two spans take, and whether material crosses the pin.
/// Closed formulas.
#pragma once

#include "fusee/joint/equilibrium.h"

namespace fusee {

/// Lengths of path and unstretched material. A span of length L that holds material n is at tension EA (L/n − 1), or
/// slack.
struct Spans {
  double upper_length = 0;
  double upper_material = 0;
  double lower_length = 0;  ///< with the part of the arc that is being wound at the tension that comes out
  double lower_material = 0;
  double capstan = 1;  ///< e^{μφ} ≥ 1
  double EA = 0;
};

struct TendonBalance {
  double upper = 0;  ///< tensions, N
  double lower = 0;
  double crossed = 0;  ///< material that crossed the pin upwards, mm
  PinContact contact = PinContact::stick;
  double per_length = 0;   ///< d upper / d upper_length as material crosses or sticks now
  double per_capstan = 0;  ///< d upper / d ln(capstan)
};

TendonBalance balance(const Spans& spans);

/// d upper / d upper_length with no material crossing (`upper_tension` > 0), and with pins that pass it at the present
/// ratio of tensions.
double stuck_rate(const Spans& spans, const TendonBalance& now);
double sliding_rate(const Spans& spans, const TendonBalance& now);

}  // namespace fusee
