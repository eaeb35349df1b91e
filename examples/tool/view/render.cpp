// SPDX-License-Identifier: MIT
#include "tool/view/render.h"

#include <algorithm>
#include <cmath>

namespace tool {

namespace {

constexpr double elevation = 0.42;
constexpr double crease = 0.7;  // radians, 40 degrees
constexpr Point surface_colour = {111, 168, 220}, inner_colour = {232, 184, 120}, mark_colour = {226, 62, 52};

Point turned(const Camera& c, const Point& p) { return {dot(c.rows[0], p), dot(c.rows[1], p), dot(c.rows[2], p)}; }

Point vertex(const TriangleMesh& mesh, uint32_t v) {
  const double* p = &mesh.positions[3 * size_t{v}];
  return {p[0], p[1], p[2]};
}

Point area_normal(const TriangleMesh& mesh, size_t f) {
  const uint32_t* v = &mesh.triangles[3 * f];
  const Point a = vertex(mesh, v[0]);
  return cross(vertex(mesh, v[1]) - a, vertex(mesh, v[2]) - a);
}

// The normal at each corner: the mean, by area, of the triangles round the vertex that are bent against the corner's
// own by less than a crease.
std::vector<Point> normals_of(const TriangleMesh& mesh) {
  const double smooth = std::cos(crease);
  const size_t triangles = mesh.triangles.size() / 3, vertices = mesh.positions.size() / 3;
  std::vector<Point> of_triangle(triangles), of_corner(3 * triangles);
  for (size_t f = 0; f < triangles; ++f) of_triangle[f] = area_normal(mesh, f);
  std::vector<uint32_t> first(vertices + 1), corners(3 * triangles);
  for (const uint32_t v : mesh.triangles) ++first[v + 1];
  for (size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
  std::vector<uint32_t> next(first.begin(), first.end() - 1);
  for (uint32_t c = 0; c < corners.size(); ++c) corners[next[mesh.triangles[c]]++] = c;
  for (size_t c = 0; c < of_corner.size(); ++c) {
    const Point& own = of_triangle[c / 3];
    const uint32_t v = mesh.triangles[c];
    for (uint32_t k = first[v]; k < first[v + 1]; ++k) {
      const Point& n = of_triangle[corners[k] / 3];
      if (dot(own, n) >= smooth * length(own) * length(n)) of_corner[c] = of_corner[c] + n;
    }
  }
  return of_corner;
}

uint8_t byte_of(double value) { return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))); }

// `n` in camera coordinates, towards the eye.
Colour lit(Point n, const Point& base) {
  const double size = length(n);
  n = size > 0 ? 1 / size * n : Point{0, 0, 1};
  const double key = std::max(0.0, dot(n, unit({-0.45, 0.6, 0.75}))),
               fill = std::max(0.0, dot(n, unit({0.7, -0.3, 0.5}))),
               gloss = 41 * std::pow(std::max(0.0, dot(n, unit({-0.25, 0.33, 0.96}))), 40);
  const double light = 0.34 + 0.62 * key + 0.2 * fill;
  return {byte_of(base[0] * light + gloss), byte_of(base[1] * light + gloss), byte_of(base[2] * light + gloss)};
}

// Corners in fine pixels, with depths towards the eye.
struct Projected {
  Point corner[3], normal[3];
  bool front, marked;
};

struct Painter {
  Canvas& canvas;
  int left, top, right, bottom;  // fine pixels
  std::vector<float> depth;

  float& depth_at(int x, int y) {
    return depth[static_cast<size_t>(y - top) * static_cast<size_t>(right - left) + static_cast<size_t>(x - left)];
  }

  // Calls pixel(x, y, weights) for each pixel with its middle in the triangle.
  template <class Pixel>
  void cover(const Projected& t, Pixel pixel) {
    const Point &a = t.corner[0], &b = t.corner[1], &c = t.corner[2];
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (area == 0) return;
    const auto least = [](double p, double q, double r) { return std::floor(std::min({p, q, r})); };
    const int x0 = std::max(left, static_cast<int>(least(a[0], b[0], c[0]))),
              y0 = std::max(top, static_cast<int>(least(a[1], b[1], c[1]))),
              x1 = std::min(right - 1, static_cast<int>(std::max({a[0], b[0], c[0]}))),
              y1 = std::min(bottom - 1, static_cast<int>(std::max({a[1], b[1], c[1]})));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double v = ((px - a[0]) * (c[1] - a[1]) - (py - a[1]) * (c[0] - a[0])) / area,
                     w = ((b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0])) / area;
        if (v >= 0 && w >= 0 && v + w <= 1) pixel(x, y, Point{1 - v - w, v, w});
      }
  }

  void paint(const Projected& t) {
    cover(t, [&](int x, int y, const Point& weight) {
      const auto z = static_cast<float>(dot(weight, {t.corner[0][2], t.corner[1][2], t.corner[2][2]}));
      if (z <= depth_at(x, y)) return;
      depth_at(x, y) = z;
      Point n = weight[0] * t.normal[0] + weight[1] * t.normal[1] + weight[2] * t.normal[2];
      if (!t.front) n = -1.0 * n;
      canvas.fine(x, y) = lit(n, t.marked ? mark_colour : t.front ? surface_colour : inner_colour);
    });
  }

  void tint(const Projected& t) {
    cover(t, [&](int x, int y, const Point&) {
      Colour& pixel = canvas.fine(x, y);
      // Once for each pixel, however many triangles lie behind each other.
      if (depth_at(x, y) == INFINITY) return;
      depth_at(x, y) = INFINITY;
      for (size_t i = 0; i < 3; ++i) pixel[i] = byte_of(0.6 * pixel[i] + 0.4 * mark_colour[i]);
    });
  }
};

}  // namespace

Camera fitting_camera(const std::vector<const TriangleMesh*>& meshes, double azimuth, double width, double height) {
  const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation), se = std::sin(elevation);
  Camera c{{{-sa, ca, 0}, {-se * ca, -se * sa, ce}, {ce * ca, ce * sa, se}}, {}, 1};
  Point low = {INFINITY, INFINITY, INFINITY}, high = -1.0 * low;
  for (const TriangleMesh* mesh : meshes)
    for (size_t v = 0; v < mesh->positions.size(); v += 3) {
      const Point p = turned(c, {mesh->positions[v], mesh->positions[v + 1], mesh->positions[v + 2]});
      for (size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
  if (low[0] > high[0]) return c;
  const Point centre = 0.5 * (low + high);
  c.middle = centre[0] * c.rows[0] + centre[1] * c.rows[1] + centre[2] * c.rows[2];
  c.scale = std::min(width / std::max(1e-300, high[0] - low[0]), height / std::max(1e-300, high[1] - low[1]));
  return c;
}

void render(Canvas& canvas, const Box2& box, const Camera& camera, const TriangleMesh& mesh,
            const std::vector<uint8_t>& marks) {
  const auto pixel = [](double at, int most) {
    return std::clamp(static_cast<int>(std::lround(Canvas::finer * at)), 0, most);
  };
  Painter painter{canvas,
                  pixel(box.x, canvas.fine_width()),
                  pixel(box.y, canvas.fine_height()),
                  pixel(box.x + box.width, canvas.fine_width()),
                  pixel(box.y + box.height, canvas.fine_height()),
                  {}};
  painter.depth.assign(
      static_cast<size_t>(painter.right - painter.left) * static_cast<size_t>(painter.bottom - painter.top), -INFINITY);
  const std::vector<Point> normals = normals_of(mesh);
  const double scale = camera.scale * Canvas::finer, x = Canvas::finer * (box.x + box.width / 2),
               y = Canvas::finer * (box.y + box.height / 2);
  std::vector<Projected> marked;
  for (size_t f = 0; f < mesh.triangles.size() / 3; ++f) {
    Projected t{};
    t.marked = !marks.empty() && marks[f] != 0;
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t v = mesh.triangles[3 * f + i];
      const Point p = scale * turned(camera, vertex(mesh, v) - camera.middle);
      t.corner[i] = {x + p[0], y - p[1], p[2]};
      t.normal[i] = turned(camera, normals[3 * f + i]);
    }
    t.front = cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0])[2] < 0;  // y runs down
    painter.paint(t);
    if (t.marked) marked.push_back(t);
  }
  for (const Projected& t : marked) painter.tint(t);
}

}  // namespace tool
