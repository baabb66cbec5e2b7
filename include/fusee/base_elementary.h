/// \file
/// Elementary functions with bit-identical results on every machine. Those of the C library differ in the last digit
/// between systems, and between processors with and without FMA.
#pragma once

extern "C" {
double fusee_sin(double x) noexcept;
double fusee_cos(double x) noexcept;
double fusee_tan(double x) noexcept;
double fusee_asin(double x) noexcept;
double fusee_acos(double x) noexcept;
double fusee_atan(double x) noexcept;
double fusee_atan2(double y, double x) noexcept;
double fusee_exp(double x) noexcept;
double fusee_log(double x) noexcept;
double fusee_log1p(double x) noexcept;
double fusee_log10(double x) noexcept;
double fusee_pow(double x, double y) noexcept;
double fusee_hypot(double x, double y) noexcept;
}

/// Arguments, results and special values as in cmath; angles in rad. The error is below 1.25 units in the last place,
/// and below 2 in directed rounding. They are musl's (src/base/musl), compiled without FMA.
namespace fusee::elementary {

inline double sin(double x) noexcept { return fusee_sin(x); }
inline double cos(double x) noexcept { return fusee_cos(x); }
inline double tan(double x) noexcept { return fusee_tan(x); }
inline double asin(double x) noexcept { return fusee_asin(x); }
inline double acos(double x) noexcept { return fusee_acos(x); }
inline double atan(double x) noexcept { return fusee_atan(x); }
inline double atan2(double y, double x) noexcept { return fusee_atan2(y, x); }
inline double exp(double x) noexcept { return fusee_exp(x); }
inline double log(double x) noexcept { return fusee_log(x); }
inline double log1p(double x) noexcept { return fusee_log1p(x); }
inline double log10(double x) noexcept { return fusee_log10(x); }
inline double pow(double x, double y) noexcept { return fusee_pow(x, y); }
inline double hypot(double x, double y) noexcept { return fusee_hypot(x, y); }

}  // namespace fusee::elementary
