/// \file
/// Internal: rounding of coordinates to float, as mesh formats store them.
#pragma once

namespace fusee::solid {

/// Largest change of a coordinate of up to 256 mm by rounding to float (2⁻¹⁷ mm = 7.6e-6 mm), slightly increased for
/// sections of such a mesh. mm.
inline constexpr double k_float_grain = 1e-5;

/// The float nearest to `value`, as a double, as every mesh format stores it.
///
/// `volatile` prevents g++ 12's vectoriser from dropping the narrowing and widening of two neighbouring doubles (-O2,
/// x86-64).
inline double nearest_float(double value) {
  const volatile float narrow = static_cast<float>(value);
  return static_cast<double>(narrow);
}

}  // namespace fusee::solid
