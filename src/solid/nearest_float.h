/// \file
#pragma once

namespace fusee {

/// The float nearest to `value`, as a double: every mesh format holds floats.
///
/// volatile: g++ 12's vectoriser drops a narrowing and widening of two neighbouring doubles altogether (-O2, x86-64).
inline double nearest_float(double value) {
  const volatile float narrow = static_cast<float>(value);
  return static_cast<double>(narrow);
}

}  // namespace fusee
