// SPDX-License-Identifier: MIT
#pragma once

// Elementary functions with the same bits on every machine.
//
// libm's sin, cos, exp, log, pow and their inverses differ in the last digits by version and by the CPU it
// dispatches to, and so would the images. These use only IEEE additions, multiplications, divisions and square
// roots in double precision (the build forbids contraction), and round once to float at the end: the result is
// within 0.501 units in the last place of the true value, unless an argument range below says otherwise.

namespace plumb {

struct SinCos {
    float sin;
    float cos;
};

SinCos sin_cos(float x); // |x| <= 1e5
float sin(float x);
float cos(float x);
float tan(float x);
float acos(float x);                   // argument clamped to [-1, 1]; result in [0, pi]
float atan2(float y, float x);         // result in (-pi, pi]; atan2(0, 0) is 0
float exp(float x);                    // 0 below -104, infinity above 89
float log(float x);                    // -infinity at 0, NaN below
float pow(float base, float exponent); // base >= 0; pow(0, 0) is 1

// The same functions before the rounding, with relative errors below 1e-14.
double exp(double x);
double log(double x);
double atan2(double y, double x);
struct SinCosD {
    double sin;
    double cos;
};
SinCosD sin_cos(double x);
double erf(double x); // absolute error below 1e-12

} // namespace plumb
