// SPDX-License-Identifier: MIT
// exact: signs of determinants of doubles, by a filter and then integers of any size.
#pragma once

#include <cstddef>

#include "support/point.h"

namespace support {

// Sign of det(b - a, c - a, d - a): exact.
int Side(const Point& a, const Point& b, const Point& c, const Point& d);
// Sign of the area of a, b, c as axes x and y show it: exact.
int Turn(const Point& a, const Point& b, const Point& c, size_t x, size_t y);

}  // namespace support
