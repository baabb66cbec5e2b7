#include <algorithm>
#include <cmath>

#include "fusee/base/text.h"
#include "fusee/calibration/measurement.h"
#include "fusee/transmission/transmission.h"

namespace fusee {
namespace {

/// Straight lines through all samples: what was measured and what was declared, over the same α.
struct Slopes {
  double measured = 0;     ///< dθ/dα
  double declared = 0;     ///< the same of the declared law, over its own range
  double alpha_span = 0;   ///< rad, of the samples
  double alpha_range = 0;  ///< rad, declared; 0 for a ratio, which has no range
};

double slope_of_samples(const Measurement& measurement) {
  double slope_up = 0, slope_down = 0;
  for (const Run& run : measurement.runs) {
    double alpha = 0, theta = 0;
    const double n = static_cast<double>(run.samples.size());
    for (const Sample& sample : run.samples) {
      alpha += sample.alpha / n;
      theta += sample.theta / n;
    }
    for (const Sample& sample : run.samples) {
      slope_up += (sample.alpha - alpha) * (sample.theta - theta);
      slope_down += (sample.alpha - alpha) * (sample.alpha - alpha);
    }
  }
  return slope_down > 0 ? slope_up / slope_down : 0;
}

double span_of_samples(const Measurement& measurement) {
  double span = 0;
  for (const Run& run : measurement.runs) {
    if (run.samples.empty()) continue;
    const auto [low, high] = std::minmax_element(run.samples.begin(), run.samples.end(), [](const Sample& a, const Sample& b) { return a.alpha < b.alpha; });
    span = std::max(span, high->alpha - low->alpha);
  }
  return span;
}

Slopes slopes_of(const Mechanism& declared, const Measurement& measurement) {
  Slopes slopes;
  slopes.measured = slope_of_samples(measurement);
  slopes.alpha_span = span_of_samples(measurement);
  if (declared.transmission) {
    slopes.declared = 1.0 / declared.transmission->ratio;
    return slopes;
  }
  const Transmission transmission(declared);
  if (transmission.dead_centre()) return slopes;
  slopes.alpha_range = transmission.alpha_max() - transmission.alpha_min();
  slopes.declared = (declared.joint.theta_max - declared.joint.theta_min) / slopes.alpha_range;
  return slopes;
}

/// Within a third of `expected`: a mistake of a kind is far larger than any error of a joint.
bool is_about(double value, double expected) { return value / expected > 0.67 && value / expected < 1.5; }

std::string slope_text(const Slopes& slopes) {
  return "theta changes by " + rounded(slopes.measured, 3) + " deg a degree of alpha, and " + rounded(slopes.declared, 3) + " is declared: ";
}

std::string fault(const Slopes& slopes) {
  const double ratio = slopes.measured / slopes.declared;
  const double exchanged = 1.0 / (slopes.declared * slopes.declared);
  const double turn = degrees(1.0);
  if (slopes.alpha_range > 0 && is_about(ratio, 1.0) && slopes.alpha_span < 0.06 * slopes.alpha_range && slopes.alpha_span * turn > 0.25 * slopes.alpha_range) {
    return "alpha moves over " + rounded(degrees(slopes.alpha_span), 3) + " deg of the declared " + rounded(degrees(slopes.alpha_range), 4) +
           ": both angles look like radians; give them in degrees (times 57.29578)";
  }
  if (ratio > 0.4 && ratio < 2.5) return {};
  if (is_about(ratio, turn)) return slope_text(slopes) + "alpha looks like radians; give it in degrees (times 57.29578)";
  if (is_about(ratio, 1.0 / turn)) return slope_text(slopes) + "theta looks like radians; give it in degrees (times 57.29578)";
  if (is_about(std::abs(ratio), exchanged) && !is_about(exchanged, 1.0)) {
    return slope_text(slopes) + "alpha and theta look exchanged" + (ratio < 0 ? ", with one sign turned" : "") + "; --column alpha=theta_deg --column theta=alpha_deg exchanges them";
  }
  if (ratio < -0.4 && ratio > -2.5) {
    return slope_text(slopes) + "one of the two has the opposite sign; alpha > 0 turns the pulley clockwise and lets theta grow: turn the sign of one column";
  }
  return slope_text(slopes) + "this is not the declared joint, or a column has another unit";
}

}  // namespace

void compare_with_declared(const Mechanism& declared, Measurement& measurement) {
  if (!measurement.not_testable.empty()) return;
  const Slopes slopes = slopes_of(declared, measurement);
  if (slopes.declared == 0 || !std::isfinite(slopes.declared)) return;
  const std::string found = fault(slopes);
  if (!found.empty()) measurement.not_testable.push_back(found);
}

}  // namespace fusee
