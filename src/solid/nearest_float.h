/// \file
#pragma once

namespace fusee {

/// What rounding to float moves a coordinate by, and a section of such a mesh a little more. mm.
inline constexpr double k_float_grain = 1e-5;

/// The float nearest to `value`, as a double: every mesh format holds floats.
///
/// volatile: g++ 12's vectoriser drops a narrowing and widening of two neighbouring doubles altogether (-O2, x86-64).
inline double nearest_float(double value) {
  const volatile float narrow = static_cast<float>(value);
  return static_cast<double>(narrow);
}

}  // namespace fusee
