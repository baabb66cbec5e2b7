#pragma once

namespace fusee {

/// Of one fitted x, in its own steps.
struct ConfidenceInterval {
  double low = 0;  ///< 95 %
  double high = 0;
  double deviation = 0;  ///< standard
};

}  // namespace fusee
