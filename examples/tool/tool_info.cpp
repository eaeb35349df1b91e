// SPDX-License-Identifier: MIT
#include "tool/tool_info.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tool/io/output_file.h"
#include "tool/segment/info.h"
#include "tool/view/packing.h"
#include "tool/view/slice_picture.h"

namespace tool {

namespace {

using Corner = std::array<Point, 2>;

// Outer faces of the voxels, in the world.
Corner world_box(const Volume& v) {
  Corner box = {Point{INFINITY, INFINITY, INFINITY}, Point{-INFINITY, -INFINITY, -INFINITY}};
  for (int corner = 0; corner < 8; ++corner) {
    const Point at =
        v.to_world({(corner & 1 ? v.nx : 0) - 0.5, (corner & 2 ? v.ny : 0) - 0.5, (corner & 4 ? v.nz : 0) - 0.5});
    for (size_t k = 0; k < 3; ++k) box[0][k] = std::min(box[0][k], at[k]), box[1][k] = std::max(box[1][k], at[k]);
  }
  return box;
}

Point point_of(const Index& v) { return {double(v.i), double(v.j), double(v.k)}; }
std::string text_of_point(const Point& p) { return text_of(p[0], ",", p[1], ",", p[2]); }
const char* name_of(const SideInfo& side) { return side.threshold.bright ? "bright" : "dark"; }
std::string name_of_volume(const SegmentRequest& r) { return r.phantom.empty() ? r.volume : r.phantom; }

// In a shell, a name of more than letters, digits and the like is quoted.
std::string quoted(const std::string& word) {
  const auto is_plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           std::string_view("/._-+,:=@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string command_of(const SegmentRequest& r, const SideInfo& side) {
  return text_of("topoadapt segment ", quoted(r.volume), r.reading.time ? text_of(" --time ", *r.reading.time) : "",
                 r.sigma > 0 ? text_of(" --sigma ", r.sigma) : "", " --seed ", text_of_point(point_of(side.seed)),
                 " --threshold ", side.threshold.value, side.threshold.bright ? " --bright" : "");
}

void print_histogram(const VolumeInfo& info) {
  constexpr size_t rows = 16, longest = 50;
  std::vector<uint64_t> sums(rows);
  for (size_t b = 0; b < info.histogram.size(); ++b) sums[b * rows / info.histogram.size()] += info.histogram[b];
  const uint64_t most = std::max<uint64_t>(1, *std::max_element(sums.begin(), sums.end()));
  const double width = (info.high - info.low) / rows;
  for (size_t row = 0; row < rows; ++row) {
    const double from = info.low + width * static_cast<double>(row);
    const bool holds = info.threshold >= from && info.threshold < from + width;
    std::printf("  %12.6g %10llu %s%s\n", from, static_cast<unsigned long long>(sums[row]),
                std::string(static_cast<size_t>(sums[row] * longest / most), '#').c_str(),
                holds ? "  <- threshold" : "");
  }
}

void print_side(const SegmentRequest& r, const Volume& volume, const SideInfo& side) {
  const Point seed = point_of(side.seed);
  std::printf("%s: %s, %.1f %% of all, in %s; the largest has %llu\n  seed %s (%s mm), %s from its border\n",
              name_of(side), counted(side.voxels, "voxel").c_str(),
              100 * static_cast<double>(side.voxels) / static_cast<double>(volume.voxels()),
              counted(side.parts, "part").c_str(), static_cast<unsigned long long>(side.largest),
              text_of_point(seed).c_str(), text_of_point(volume.to_world(seed)).c_str(),
              counted(static_cast<uint64_t>(side.depth), "voxel").c_str());
  if (r.phantom.empty()) std::printf("  %s\n", command_of(r, side).c_str());
}

void print(const SegmentRequest& r, const Volume& v, const VolumeInfo& info) {
  const Corner box = world_box(v);
  std::printf("%s: %d x %d x %d voxels of %.6g x %.6g x %.6g mm, world %s\n", name_of_volume(r).c_str(), v.nx, v.ny,
              v.nz, v.to_world.spacing(0), v.to_world.spacing(1), v.to_world.spacing(2), tool::name_of(v.space));
  std::printf("box (%s) to (%s) mm\n", text_of_point(box[0]).c_str(), text_of_point(box[1]).c_str());
  std::printf("values %.6g to %.6g, mean %.6g%s\n", info.least, info.most, info.mean,
              info.nan > 0 ? (", " + counted(info.nan, "voxel") + " without a number").c_str() : "");
  print_histogram(info);
  std::printf("threshold %.6g%s\n", info.threshold, info.is_given ? "" : ", between two classes (Otsu 1979)");
  for (const SideInfo& side : info.sides) print_side(r, v, side);
  for (const LabelInfo& label : info.labels)
    std::printf("label %d: %s\n", label.label, counted(label.voxels, "voxel").c_str());
}

void member(JsonWriter& json, std::string_view name, const Point& p) {
  json.key(name).begin_array().value(p[0]).value(p[1]).value(p[2]).end_array();
}

void describe(JsonWriter& json, const SegmentRequest& r, const Volume& v, const VolumeInfo& info) {
  begin_report(json);
  json.member("volume", name_of_volume(r)).key("size").begin_array().value(v.nx).value(v.ny).value(v.nz).end_array();
  member(json, "spacing_mm", {v.to_world.spacing(0), v.to_world.spacing(1), v.to_world.spacing(2)});
  const Corner box = world_box(v);
  json.member("space", tool::name_of(v.space)).key("box_mm").begin_array();
  for (const Point& p : box) json.begin_array().value(p[0]).value(p[1]).value(p[2]).end_array();
  json.end_array().member("least", info.least).member("most", info.most).member("mean", info.mean);
  json.member("not_a_number", info.nan);
  json.key("histogram").begin_object().member("low", info.low).member("high", info.high).key("counts").begin_array();
  for (const uint64_t count : info.histogram) json.value(count);
  json.end_array().end_object().member("threshold", info.threshold).member("threshold_is_given", info.is_given);
  for (const SideInfo& side : info.sides) {
    json.key(name_of(side)).begin_object().member("voxels", side.voxels).member("parts", side.parts);
    json.member("largest", side.largest).member("depth", side.depth);
    json.key("seed").begin_array().value(side.seed.i).value(side.seed.j).value(side.seed.k).end_array();
    member(json, "seed_mm", v.to_world(point_of(side.seed)));
    json.end_object();
  }
  json.key("labels").begin_array();
  for (const LabelInfo& label : info.labels)
    json.begin_object().member("label", label.label).member("voxels", label.voxels).end_object();
  json.end_array().end_object();
}

// Three slices through the first seed, or through the middle, with the threshold's contour and the seeds near them.
std::string picture(const SegmentRequest& r, const Volume& v, const VolumeInfo& info) {
  constexpr double margin = 12, title_height = 44;
  constexpr int width = 1000;
  constexpr Colour white = {255, 255, 255}, ink = {34, 40, 48};
  const double side = (width - 3 * margin) / 2;
  Canvas canvas(width, static_cast<int>(title_height + 2 * (side + margin)), white);
  canvas.text(margin, 29, 13, std::filesystem::path(name_of_volume(r)).filename().string(), ink);
  Point through = {0.5 * (v.nx - 1), 0.5 * (v.ny - 1), 0.5 * (v.nz - 1)};
  if (!r.world_seeds.empty()) through = inverse(v.to_world)(from_named_space(r, v)(r.world_seeds.front()));
  if (!r.voxel_seeds.empty()) through = r.voxel_seeds.front();
  const auto [low, high] = grey_range(v);
  const std::array<SliceLayout, 3> layouts = slice_layouts(v.to_world, v.space);
  for (size_t i = 0; i < 3; ++i) {
    const SliceLayout& l = layouts[i];
    Slice s = slice_of(v, v.to_world, l, static_cast<int>(std::lround(through[l.axis])), {});
    s.contour = level_contour(s, info.threshold);
    std::vector<SliceMark> marks;
    for (const SideInfo& at : info.sides)
      if (std::fabs(point_of(at.seed)[l.axis] - s.at) <= at.depth) marks.push_back({point_of(at.seed), name_of(at)});
    const double column = i == 1 ? 1 : 0, row = i == 2 ? 1 : 0;
    draw_chart(canvas, {margin + column * (side + margin), title_height + row * (side + margin), side, side}, s, low,
               high, marks);
  }
  const double x = 2 * margin + side, y = title_height + side + 2 * margin;
  std::vector<std::string> lines = {text_of("threshold ", info.threshold, ", the contour")};
  for (const SideInfo& at : info.sides)
    lines.push_back(text_of(name_of(at), ": --seed ", text_of_point(point_of(at.seed)), ", ", at.depth, " deep"));
  lines.push_back(text_of("values ", info.least, " to ", info.most));
  for (size_t i = 0; i < lines.size(); ++i) canvas.text(x, y + 20 * static_cast<double>(i + 1), 9.5, lines[i], ink);
  return canvas.png();
}

}  // namespace

int run_info(const SegmentRequest& r, Volume& volume) {
  if (Status s = smooth_gaussian(volume, r.sigma, Workers(static_cast<int>(r.threads))); !s) return refuse(s);
  const VolumeInfo info = info_of(volume, r.selection.threshold);
  if (r.outputs.summary_wanted()) print(r, volume, info);
  JsonWriter json;
  describe(json, r, volume, info);
  if (!r.view.png.empty())
    if (Status s = write_file(r.view.png, picture(r, volume, info)); !s) return refuse(s);
  if (Status s = write_json(r.outputs.json, json); !s) return refuse(s);
  return 0;
}

}  // namespace tool
