// SPDX-License-Identifier: MIT
#include "tool/view/canvas.h"

#include <algorithm>
#include <cmath>

#include "tool/view/deflate.h"
#include "tool/view/lettering.h"

namespace tool {

namespace {

// Units of lettering.h: height of capitals, space beside a letter, width of a blank.
constexpr double capital = 6, gap = 1.7, blank = 2.2, foot = 2;

double width_of_letter(char letter) {
  double width = 0;
  const std::string_view strokes = strokes_of(letter);
  if (strokes.empty()) return blank;
  size_t digit = 0;
  for (const char c : strokes) {
    if (c == ' ') continue;
    if (digit++ % 2 == 0) width = std::max(width, static_cast<double>(c - '0'));
  }
  return width;
}

double distance_to_segment(double x, double y, const std::array<double, 4>& s) {
  const double dx = s[2] - s[0], dy = s[3] - s[1], size = dx * dx + dy * dy;
  const double t = size > 0 ? std::clamp(((x - s[0]) * dx + (y - s[1]) * dy) / size, 0.0, 1.0) : 0;
  return std::hypot(x - s[0] - t * dx, y - s[1] - t * dy);
}

void append_big_endian(std::string& bytes, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
}

uint32_t crc32_of(std::string_view bytes) {
  uint32_t crc = 0xffffffff;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

void append_chunk(std::string& png, std::string_view kind, std::string_view body) {
  append_big_endian(png, static_cast<uint32_t>(body.size()));
  const size_t from = png.size();
  png += kind;
  png += body;
  append_big_endian(png, crc32_of(std::string_view(png).substr(from)));
}

}  // namespace

Canvas::Canvas(int w, int h, Colour ground)
    : width(w), height(h), pixels(static_cast<size_t>(w * finer) * static_cast<size_t>(h * finer), ground) {}

void Canvas::fill(const Box2& b, Colour colour) {
  const auto edge = [](double at, int most) { return std::clamp(static_cast<int>(std::lround(finer * at)), 0, most); };
  for (int y = edge(b.y, fine_height()); y < edge(b.y + b.height, fine_height()); ++y)
    for (int x = edge(b.x, fine_width()); x < edge(b.x + b.width, fine_width()); ++x) fine(x, y) = colour;
}

void Canvas::line(const Box2& within, std::array<double, 4> ends, double breadth, Colour colour) {
  const double half = breadth / 2;
  const auto pixel = [](double at, int most) { return std::clamp(static_cast<int>(std::floor(finer * at)), 0, most); };
  const double left = std::max(within.x, std::min(ends[0], ends[2]) - half),
               right = std::min(within.x + within.width, std::max(ends[0], ends[2]) + half),
               top = std::max(within.y, std::min(ends[1], ends[3]) - half),
               bottom = std::min(within.y + within.height, std::max(ends[1], ends[3]) + half);
  if (left > right || top > bottom) return;
  for (int y = pixel(top, fine_height() - 1); y <= pixel(bottom, fine_height() - 1); ++y)
    for (int x = pixel(left, fine_width() - 1); x <= pixel(right, fine_width() - 1); ++x)
      if (distance_to_segment((x + 0.5) / finer, (y + 0.5) / finer, ends) <= half) fine(x, y) = colour;
}

double width_of_text(std::string_view letters, double size) {
  double width = 0;
  for (const char c : letters) width += width_of_letter(c) + gap;
  return std::max(0.0, width - gap) * size / capital;
}

void Canvas::text(double x, double y, double size, std::string_view letters, Colour colour) {
  const double unit = size / capital;
  const Box2 all = {0, 0, static_cast<double>(width), static_cast<double>(height)};
  for (const char c : letters) {
    std::array<double, 2> last{};
    bool begins = true;
    const std::string_view strokes = strokes_of(c);
    for (size_t i = 0; i + 1 < strokes.size(); i += 2) {
      if (strokes[i] == ' ') {
        begins = true;
        ++i;
      }
      const std::array<double, 2> at = {x + unit * (strokes[i] - '0'), y - unit * (strokes[i + 1] - '0' - foot)};
      const std::array<double, 2>& from = begins ? at : last;
      line(all, {from[0], from[1], at[0], at[1]}, 0.16 * size, colour);
      last = at;
      begins = false;
    }
    x += unit * (width_of_letter(c) + gap);
  }
}

std::string Canvas::png() const {
  std::string rows;
  for (int y = 0; y < height; ++y) {
    rows += '\0';  // no filter
    for (int x = 0; x < width; ++x)
      for (size_t channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int k = 0; k < finer * finer; ++k) {
          const int fy = y * finer + k / finer, fx = x * finer + k % finer;
          sum += pixels[static_cast<size_t>(fy) * static_cast<size_t>(fine_width()) + static_cast<size_t>(fx)][channel];
        }
        rows += static_cast<char>((sum + finer * finer / 2) / (finer * finer));
      }
  }
  std::string header, png("\x89PNG\r\n\x1a\n", 8);
  append_big_endian(header, static_cast<uint32_t>(width));
  append_big_endian(header, static_cast<uint32_t>(height));
  header += std::string("\x08\x02\0\0\0", 5);
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", zlib_stream(rows));
  append_chunk(png, "IEND", "");
  return png;
}

}  // namespace tool
