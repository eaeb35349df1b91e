// SPDX-License-Identifier: MIT
// elementary: sine and other elementary functions with the same bits on every machine. Functions of the C library
// differ in the last bit from processor to processor. Scenes that start a bit apart may meet a bit later, and end
// otherwise.
#pragma once

namespace tool {

// Within 4 units in the last place of the largest value taken near by (sine, cosine: 1), for |a| < 2^20.
double sine(double a);
double cosine(double a);
double tangent(double a);
// The angle of (x, y), in [-pi, pi].
double arc_tangent(double y, double x);
// Precondition: -1 <= x <= 1.
double arc_cosine(double x);
// Relative error below 2^-50. |x| < 700.
double exponential(double x);
// Error below 2^-50 of the larger of 1 and the value. 0 < x.
double logarithm(double x);
// Relative error below 2^-46: the logarithm's, magnified. 0 < x.
double cube_root(double x);

}  // namespace tool
