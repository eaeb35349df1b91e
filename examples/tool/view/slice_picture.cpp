// SPDX-License-Identifier: MIT
#include "tool/view/slice_picture.h"

#include <algorithm>
#include <cmath>

namespace tool {

namespace {

constexpr Colour black = {0, 0, 0}, pale = {214, 221, 229}, orange = {255, 160, 40}, green = {70, 220, 120};

double bilinear(const Slice& s, double x, double y) {
  const AxisPosition px = position_on_axis(x, s.width), py = position_on_axis(y, s.height);
  const auto row = [&](int at) {
    const float* g = &s.grey[static_cast<size_t>(at) * static_cast<size_t>(s.width)];
    const auto a = static_cast<double>(g[px.lower]), b = static_cast<double>(g[px.upper]);
    return a + px.weight * (b - a);
  };
  const double a = row(py.lower), b = row(py.upper);
  return a + py.weight * (b - a);
}

// Where the slice lies: pixels for each voxel, and the outer corner of the first voxel.
struct Placement {
  double sx, sy, left, top;
};

Placement place(const Slice& s, const Box2& box) {
  const double scale = std::min(box.width / (s.width * s.step_right), box.height / (s.height * s.step_down));
  const double sx = scale * s.step_right, sy = scale * s.step_down;
  return {sx, sy, box.x + (box.width - sx * s.width) / 2, box.y + (box.height - sy * s.height) / 2};
}

void draw_grey(Canvas& canvas, const Box2& box, const Slice& s, const Placement& p, double low, double high) {
  const int finer = Canvas::finer;
  const auto first = [&](double at) { return std::max(0, static_cast<int>(std::ceil(finer * at - 0.5))); };
  const int right = std::min(canvas.fine_width(), first(std::min(p.left + p.sx * s.width, box.x + box.width)));
  const int bottom = std::min(canvas.fine_height(), first(std::min(p.top + p.sy * s.height, box.y + box.height)));
  for (int y = first(p.top); y < bottom; ++y)
    for (int x = first(p.left); x < right; ++x) {
      const double u = ((x + 0.5) / finer - p.left) / p.sx - 0.5, v = ((y + 0.5) / finer - p.top) / p.sy - 0.5;
      const double grey = std::clamp((bilinear(s, u, v) - low) / (high - low), 0.0, 1.0);
      const auto byte = static_cast<uint8_t>(std::isfinite(grey) ? std::lround(255 * grey) : 0);
      canvas.fine(x, y) = {byte, byte, byte};
    }
}

// Pale letters with a dark rim, for grounds of any grey.
void rimmed_text(Canvas& canvas, double x, double y, double size, std::string_view letters) {
  constexpr double rim = 1.3;
  for (const double dx : {-rim, 0.0, rim})
    for (const double dy : {-rim, 0.0, rim}) canvas.text(x + dx, y + dy, size, letters, black);
  canvas.text(x, y, size, letters, pale);
}

void draw_letters(Canvas& canvas, const Box2& box, const Slice& s) {
  const auto letter = [&](double x, double y, char c) {
    if (c == 0) return;
    rimmed_text(canvas, x - width_of_text({&c, 1}, 10) / 2, y, 10, {&c, 1});
  };
  const double x = box.x + box.width / 2, y = box.y + box.height / 2 + 5;
  letter(box.x + 12, y, s.layout.sides[0]);
  letter(box.x + box.width - 12, y, s.layout.sides[1]);
  letter(x, box.y + 18, s.layout.poles[0]);
  letter(x, box.y + box.height - 9, s.layout.poles[1]);
}

// A step of about a fifth of the voxels: 1, 2 or 5 times a power of ten.
int step_of_ruler(int voxels) {
  int step = 1;
  for (int i = 0; step * 6 < voxels; ++i) step = i % 3 == 1 ? step / 2 * 5 : step * 2;
  return step;
}

// Numbers of voxels along the upper and the left side, the first of each with the name of its axis.
void draw_rulers(Canvas& canvas, const Box2& box, const Slice& s, const Placement& p) {
  const auto index = [](int at, int size, bool flipped) { return flipped ? size - 1 - at : at; };
  const int right = step_of_ruler(s.width), down = step_of_ruler(s.height);
  for (int at = right; at < s.width; at += right) {
    const double x = p.left + p.sx * (index(at, s.width, s.layout.flip_right) + 0.5), y = std::max(p.top, box.y);
    canvas.line(box, {x, y, x, y + 6}, 1.2, pale);
    const std::string number = (at == right ? text_of("ijk"[s.layout.right], " ") : "") + std::to_string(at);
    rimmed_text(canvas, x - width_of_text(number, 7) / 2, y + 17, 7, number);
  }
  for (int at = down; at < s.height; at += down) {
    const double y = p.top + p.sy * (index(at, s.height, s.layout.flip_down) + 0.5), x = std::max(p.left, box.x);
    canvas.line(box, {x, y, x + 6, y}, 1.2, pale);
    rimmed_text(canvas, x + 9, y + 3.5, 7, (at == down ? text_of("ijk"[s.layout.down], " ") : "") + std::to_string(at));
  }
}

}  // namespace

void draw_slice(Canvas& canvas, const Box2& box, const Slice& s, double low, double high) {
  canvas.fill(box, black);
  const Placement p = place(s, box);
  draw_grey(canvas, box, s, p, low, high);
  for (const auto& line : s.contour)
    canvas.line(box,
                {p.left + p.sx * (line[0] + 0.5), p.top + p.sy * (line[1] + 0.5), p.left + p.sx * (line[2] + 0.5),
                 p.top + p.sy * (line[3] + 0.5)},
                1.6, orange);
  draw_letters(canvas, box, s);
  rimmed_text(canvas, box.x + 10, box.y + box.height - 9, 9,
              text_of(std::string(1, "ijk"[s.layout.axis]), " = ", s.at));
}

void draw_chart(Canvas& canvas, const Box2& box, const Slice& s, double low, double high,
                const std::vector<SliceMark>& marks) {
  draw_slice(canvas, box, s, low, high);
  const Placement p = place(s, box);
  draw_rulers(canvas, box, s, p);
  for (const SliceMark& mark : marks) {
    const SliceLayout& l = s.layout;
    const double u = l.flip_right ? s.width - 1 - mark.voxel[l.right] : mark.voxel[l.right],
                 v = l.flip_down ? s.height - 1 - mark.voxel[l.down] : mark.voxel[l.down];
    const double x = p.left + p.sx * (u + 0.5), y = p.top + p.sy * (v + 0.5);
    canvas.line(box, {x - 7, y, x + 7, y}, 2, green);
    canvas.line(box, {x, y - 7, x, y + 7}, 2, green);
    rimmed_text(canvas, x + 8, y - 5, 8, mark.name);
  }
}

std::vector<std::array<double, 4>> level_contour(const Slice& s, double level) {
  std::vector<std::array<double, 4>> contour;
  const auto grey = [&](int x, int y) {
    return static_cast<double>(s.grey[static_cast<size_t>(y) * static_cast<size_t>(s.width) + static_cast<size_t>(x)]);
  };
  // Two triangles for each four voxels, so that no square is in doubt.
  const auto cut = [&](const std::array<std::array<int, 2>, 3>& t) {
    std::array<double, 4> segment{};
    size_t ends = 0;
    for (size_t i = 0; i < 3; ++i) {
      const auto &p = t[i], &q = t[(i + 1) % 3];
      const double a = grey(p[0], p[1]), b = grey(q[0], q[1]);
      if (!std::isfinite(a) || !std::isfinite(b) || (a > level) == (b > level)) continue;
      const double along = (level - a) / (b - a);
      segment[2 * ends] = p[0] + along * (q[0] - p[0]);
      segment[2 * ends + 1] = p[1] + along * (q[1] - p[1]);
      ++ends;
    }
    if (ends == 2) contour.push_back(segment);
  };
  for (int y = 0; y + 1 < s.height; ++y)
    for (int x = 0; x + 1 < s.width; ++x) {
      cut({{{x, y}, {x + 1, y}, {x, y + 1}}});
      cut({{{x + 1, y}, {x + 1, y + 1}, {x, y + 1}}});
    }
  return contour;
}

}  // namespace tool
