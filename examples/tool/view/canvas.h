// SPDX-License-Identifier: MIT
// canvas: a picture in memory, three bytes a pixel. Everything is drawn `finer` times as large and averaged at the end,
// so that lines and letters are smooth. Coordinates in pixels of the end, x to the right, y down.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tool/scenes/points.h"

namespace tool {

using Colour = std::array<uint8_t, 3>;

struct Box2 {
  double x = 0, y = 0, width = 0, height = 0;
};

struct Canvas {
  static constexpr int finer = 3;
  int width, height;  // of the end
  std::vector<Colour> pixels;

  Canvas(int w, int h, Colour ground);
  int fine_width() const { return width * finer; }
  int fine_height() const { return height * finer; }
  Colour& fine(int x, int y) {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(fine_width()) + static_cast<size_t>(x)];
  }

  void fill(const Box2& box, Colour colour);
  // A line with round ends, as far as it lies in the box.
  void line(const Box2& within, std::array<double, 4> ends, double breadth, Colour colour);
  // One line of text, `size` the height of capital letters, from the foot of its first letter. Letters without a shape
  // of their own are left blank.
  void text(double x, double y, double size, std::string_view letters, Colour colour);

  // The bytes of a .png.
  std::string png() const;
};

double width_of_text(std::string_view letters, double size);

}  // namespace tool
