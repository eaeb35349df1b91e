// SPDX-License-Identifier: MIT
#include "tool/view/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tool/view/packing.h"
#include "tool/view/render.h"
#include "tool/view/slice_picture.h"

namespace tool {

namespace {

constexpr Colour white = {255, 255, 255}, panel = {240, 243, 246}, ink = {34, 40, 48}, quiet = {96, 106, 118};
constexpr double margin = 12, title_height = 44, caption_height = 26;
constexpr int picture_width = 1000;

std::string text_of_number(double number, const char* format = "%.6g") {
  char digits[32];
  std::snprintf(digits, sizeof digits, format, number);
  return digits;
}

std::string text_of_moment(const FilmMoment& m, const std::string& unit) {
  return text_of("genus ", m.genus, ", ", m.components, m.components == 1 ? " component" : " components", ", volume ",
                 text_of_number(m.volume), unit.empty() ? "" : " " + unit + "3");
}

double azimuth_of(const PageContent& c) { return c.space == Space::ras ? 1.05 : -1.05; }

Canvas titled_canvas(const PageContent& c, double height) {
  Canvas canvas(picture_width, static_cast<int>(height), white);
  canvas.text(margin, 29, 13, c.title, ink);
  if (c.film->moments.empty()) return canvas;
  const FilmMoment& m = c.film->moments.back();
  const std::string facts = text_of(text_of_moment(m, c.unit), ", ", m.vertices, " vertices");
  canvas.text(picture_width - margin - width_of_text(facts, 9.5), 29, 9.5, facts, quiet);
  return canvas;
}

void draw_mesh(Canvas& canvas, const Box2& box, const PageContent& c, const FilmFrame& frame,
               const std::vector<const TriangleMesh*>& shown) {
  canvas.fill(box, panel);
  render(canvas, box, fitting_camera(shown, azimuth_of(c), 0.9 * box.width, 0.9 * box.height), frame.mesh, frame.marks);
}

// Three slices through the middle of the last mesh, and the mesh.
std::string picture_of_slices(const PageContent& c) {
  const FilmFrame& last = c.film->frames.back();
  const double side = (picture_width - 3 * margin) / 2, height = 0.8 * side;
  Canvas canvas = titled_canvas(c, title_height + 2 * (height + margin));
  Affine map;  // from voxels to the film's world
  map.origin = c.film->map(c.volume->to_world.origin);
  for (size_t k = 0; k < 3; ++k)
    map.axes[k] = c.film->map(c.volume->to_world.origin + c.volume->to_world.axes[k]) - map.origin;
  const auto box = [&](int i) {
    return Box2{margin + (i % 2) * (side + margin), title_height + (i / 2) * (height + margin), side, height};
  };
  draw_mesh(canvas, box(0), c, last, {&last.mesh});
  const PackedMesh packed = pack_mesh(last.mesh, {});
  const Point middle = inverse(map)(
      {(packed.box[0] + packed.box[3]) / 2, (packed.box[1] + packed.box[4]) / 2, (packed.box[2] + packed.box[5]) / 2});
  std::array<SliceLayout, 3> layouts = slice_layouts(map, c.space);
  std::sort(layouts.begin(), layouts.end(),
            [](const SliceLayout& a, const SliceLayout& b) { return a.world > b.world; });
  const auto [low, high] = grey_range(*c.volume);
  for (int i = 0; i < 3; ++i) {
    const SliceLayout& l = layouts[static_cast<size_t>(i)];
    const int at = static_cast<int>(std::lround(std::clamp(middle[l.axis], -1.0, 1e9)));
    draw_slice(canvas, box(i + 1), slice_of(*c.volume, map, l, at, last.mesh), low, high);
  }
  return canvas.png();
}

const FilmMoment& moment_at(const Film& film, double time) {
  const FilmMoment* found = &film.moments.front();
  for (const FilmMoment& m : film.moments)
    if (m.time <= time) found = &m;
  return *found;
}

// Frames at even distances, the first and the last among them, each with what the run said then.
std::string picture_of_frames(const PageContent& c) {
  const Film& film = *c.film;
  const size_t count = std::min<size_t>(6, film.frames.size()), columns = count <= 2 ? count : 3;
  const size_t rows = (count + columns - 1) / columns;
  const double side = (picture_width - margin * static_cast<double>(columns + 1)) / static_cast<double>(columns);
  const double height = 0.85 * side;
  Canvas canvas = titled_canvas(c, title_height + static_cast<double>(rows) * (height + caption_height + margin));
  std::vector<const TriangleMesh*> all;
  for (const FilmFrame& f : film.frames) all.push_back(&f.mesh);
  for (size_t i = 0; i < count; ++i) {
    const FilmFrame& frame = film.frames[count < 2 ? 0 : i * (film.frames.size() - 1) / (count - 1)];
    const Box2 box = {margin + static_cast<double>(i % columns) * (side + margin),
                      title_height + static_cast<double>(i / columns) * (height + caption_height + margin), side,
                      height};
    draw_mesh(canvas, box, c, frame, all);
    const FilmMoment& m = moment_at(film, frame.time);
    const std::string caption = !frame.name.empty()
                                    ? frame.name
                                    : text_of(c.time_name, " ", text_of_number(frame.time, "%.3g"), ": genus ", m.genus,
                                              ", ", m.components, m.components == 1 ? " component" : " components");
    canvas.text(box.x + (side - width_of_text(caption, 9.5)) / 2, box.y + height + 19, 9.5, caption, ink);
  }
  return canvas.png();
}

}  // namespace

std::string picture_of(const PageContent& c) { return c.volume ? picture_of_slices(c) : picture_of_frames(c); }

}  // namespace tool
