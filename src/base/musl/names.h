/* Names that meet no other C library: read before each file of musl. */
#ifndef FUSEE_MUSL_NAMES_H
#define FUSEE_MUSL_NAMES_H

#include <math.h> /* before the names below, which its macros would replace */

double fusee_atan(double);
double fusee_scalbn(double, int);

#define sin fusee_sin
#define cos fusee_cos
#define tan fusee_tan
#define asin fusee_asin
#define acos fusee_acos
#define atan fusee_atan
#define atan2 fusee_atan2
#define exp fusee_exp
#define log fusee_log
#define log1p fusee_log1p
#define log10 fusee_log10
#define pow fusee_pow
#define hypot fusee_hypot
#define scalbn fusee_scalbn
#define __sin fusee_musl_sin
#define __cos fusee_musl_cos
#define __tan fusee_musl_tan
#define __sinl fusee_musl_sinl
#define __cosl fusee_musl_cosl
#define __tanl fusee_musl_tanl
#define __rem_pio2 fusee_musl_rem_pio2
#define __rem_pio2_large fusee_musl_rem_pio2_large
#define __exp_data fusee_musl_exp_data
#define __log_data fusee_musl_log_data
#define __pow_log_data fusee_musl_pow_log_data
#define __math_divzero fusee_musl_divzero
#define __math_invalid fusee_musl_invalid
#define __math_oflow fusee_musl_oflow
#define __math_uflow fusee_musl_uflow
#define __math_xflow fusee_musl_xflow

/* An FMA would give other digits. */
#undef __FP_FAST_FMA

#endif
