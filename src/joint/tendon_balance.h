/// \file
/// Closed-form balance of one tendon over its pin: the tensions of its two spans for given lengths, and the material
/// that crosses the pin.
#pragma once

#include "fusee/joint.h"

namespace fusee::joint {

/// Both spans of a tendon: path lengths and unstretched material, mm. A span of length L with material n has the
/// tension EA (L/n − 1), or is slack.
struct Spans {
  double upper_length = 0;
  double upper_material = 0;
  double lower_length = 0;  ///< includes the part of the arc that is being wound at the resulting tension
  double lower_material = 0;
  double capstan = 1;  ///< e^{μφ} ≥ 1
  double EA = 0;       ///< axial stiffness, N
};

/// Tension of a span; 0 if it is slack. N
inline double tension_of(double EA, double length, double material) {
  return length > material ? EA * (length / material - 1.0) : 0.0;
}

/// Tensions of both spans, and the material that crosses the pin.
struct TendonBalance {
  double upper = 0;    ///< tension of the upper span, N
  double lower = 0;    ///< tension of the lower span, N
  double crossed = 0;  ///< material that crossed the pin upwards, mm
  PinContact contact = PinContact::stick;
  double per_length = 0;   ///< d upper / d upper_length while sticking or sliding as now, N/mm
  double per_capstan = 0;  ///< d upper / d ln(capstan), N
};

TendonBalance balance(const Spans& spans);

/// d upper / d upper_length without crossing material; TendonBalance::upper > 0.
double stuck_rate(const Spans& spans, const TendonBalance& now);
/// d upper / d upper_length with pins that slide at the present tension ratio.
double sliding_rate(const Spans& spans, const TendonBalance& now);

}  // namespace fusee::joint
