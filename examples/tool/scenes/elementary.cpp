// SPDX-License-Identifier: MIT
#include "tool/scenes/elementary.h"

#include <cmath>

#include "tool/scenes/points.h"

// Only + - * /, square roots, rounding to integers and powers of two, all defined to the bit by IEEE 754. The series
// are Taylor's. Arguments are reduced with constants split into parts, so that k times the leading parts is exact (Cody
// and Waite 1980).
namespace tool {

namespace {

// pi/2 in two parts of 33 bits and a rest; ln 2 in one of 32 bits and a rest: Sun Microsystems' fdlibm 5.3, files
// e_rem_pio2.c and e_exp.c.
constexpr double half_pi[3] = {1.57079632673412561417e+00, 6.07710050630396597660e-11, 2.02226624879595063154e-21};
constexpr double ln2[2] = {6.93147180369123816490e-01, 1.90821492927058770002e-10};

// sum of (-1)^i r^(2 i + odd) / (2 i + odd)!, |r| <= pi/4: the first term left out is below 2^-60.
double alternating(double r, int odd) {
  double sum = 1;
  for (int n = 18 + odd; n > odd; n -= 2) sum = 1 - r * r / (n * (n - 1)) * sum;
  return odd == 1 ? r * sum : sum;
}

// The sine of a + quarters * pi/2.
double sine_from(double a, int quarters) {
  const double k = std::floor(a * (2 / pi) + 0.5);
  const double r = ((a - k * half_pi[0]) - k * half_pi[1]) - k * half_pi[2];
  const int turn = static_cast<int>(k - 4 * std::floor(k / 4)) + quarters;
  const double value = alternating(r, turn % 2 == 0 ? 1 : 0);
  return turn % 4 < 2 ? value : -value;
}

// |x| <= 1. Two halvings of the angle leave at most tan(pi/16) = .199; the first term left out is below 2^-60.
double arc_tangent_of(double x) {
  for (int i = 0; i < 2; ++i) x /= 1 + std::sqrt(1 + x * x);
  double sum = 0;
  for (int n = 25; n > 0; n -= 2) sum = 1.0 / n - x * x * sum;
  return 4 * x * sum;
}

}  // namespace

double sine(double a) { return sine_from(a, 0); }
double cosine(double a) { return sine_from(a, 1); }
double tangent(double a) { return sine(a) / cosine(a); }

double arc_tangent(double y, double x) {
  const double across = std::fabs(y), along = std::fabs(x);
  if (across == 0 && along == 0) return 0;
  double angle = across <= along ? arc_tangent_of(across / along) : pi / 2 - arc_tangent_of(along / across);
  if (x < 0) angle = pi - angle;
  return y < 0 ? -angle : angle;
}

double arc_cosine(double x) { return arc_tangent(std::sqrt((1 - x) * (1 + x)), x); }

double exponential(double x) {
  const double k = std::floor(x / (ln2[0] + ln2[1]) + 0.5), r = (x - k * ln2[0]) - k * ln2[1];
  double sum = 1;
  for (int n = 15; n > 0; --n) sum = 1 + r / n * sum;
  return std::ldexp(sum, static_cast<int>(k));
}

double logarithm(double x) {
  int k = 0;
  double m = std::frexp(x, &k);
  if (m < 0.70710678118654752440) {
    m *= 2;
    --k;
  }
  // 2 artanh(s): |s| <= .172, so that the first term left out is below 2^-60.
  const double s = (m - 1) / (m + 1);
  double sum = 0;
  for (int n = 23; n > 0; n -= 2) sum = 1.0 / n + s * s * sum;
  return k * ln2[0] + (k * ln2[1] + 2 * s * sum);
}

double cube_root(double x) { return exponential(logarithm(x) / 3); }

}  // namespace tool
