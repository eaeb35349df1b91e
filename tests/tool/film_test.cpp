// SPDX-License-Identifier: MIT
// Bounds of what --html keeps of a run and of a volume, and the bytes of its streams.
#include "tool/view/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tool/io/base64.h"
#include "tool/scenes/sphere.h"
#include "tool/view/deflate.h"
#include "tool/view/packing.h"

#if TOOL_HAVE_ZLIB
#include <zlib.h>
#endif

namespace film_test {
namespace {

size_t TrianglesOf(const tool::Film& film) {
  size_t count = 0;
  for (const tool::FilmFrame& f : film.frames) count += f.mesh.triangles.size() / 3;
  return count;
}

TEST(Film, KeepsFewFramesOfManySteps) {
  const tool::TriangleMesh ball = tool::make_sphere({0, 0, 0}, 1, 2);
  tool::Film film;
  tool::EventCounts counts;
  for (int step = 1; step <= 10000; ++step) {
    if (step % 1000 == 0) {
      ++counts.merge;
      counts.places.push_back({1, 2, 3});
    }
    film.add(step, ball, counts);
    ASSERT_LE(film.frames.size(), tool::most_frames);
    ASSERT_LE(film.moments.size(), tool::most_moments);
  }
  film.end(10000, ball);
  EXPECT_GE(film.frames.size(), tool::most_frames / 2);
  EXPECT_EQ(film.frames.front().time, 1);
  EXPECT_EQ(film.frames.back().time, 10000);
  EXPECT_EQ(film.moments.back().time, 10000);
  EXPECT_TRUE(std::is_sorted(film.frames.begin(), film.frames.end(),
                             [](const auto& a, const auto& b) { return a.time < b.time; }));
  ASSERT_EQ(film.events.size(), 10u);
  for (const tool::FilmEvent& e : film.events) EXPECT_TRUE(e.merge == 1 && e.places.size() == 1);
}

TEST(Film, DrawsLargeMeshesCoarser) {
  const tool::TriangleMesh large = tool::make_sphere({5, 6, 7}, 3, 90), small = tool::make_sphere({5, 6, 7}, 3, 20);
  ASSERT_GT(large.triangles.size() / 3, tool::most_frame_triangles);
  tool::Film film;
  for (int step = 1; step <= 40; ++step) film.add(step, large, {});
  EXPECT_LE(TrianglesOf(film), tool::most_film_triangles);
  film.end(41, large);
  EXPECT_EQ(film.frames.back().mesh.triangles.size(), large.triangles.size()) << "the last one is whole";
  const tool::FilmFrame& coarse = film.frames.front();
  EXPECT_EQ(coarse.triangles, large.triangles.size() / 3);
  EXPECT_LE(coarse.mesh.triangles.size() / 3, tool::most_frame_triangles);
  EXPECT_GT(coarse.mesh.triangles.size() / 3, tool::most_frame_triangles / 4);
  for (size_t v = 0; v < coarse.mesh.positions.size(); v += 3) {
    const double* p = &coarse.mesh.positions[v];
    EXPECT_NEAR(std::hypot(p[0] - 5, p[1] - 6, p[2] - 7), 3, 0.1);
  }
  EXPECT_EQ(tool::coarse_drawing(small, small.triangles.size()).positions, small.positions);
}

TEST(Packing, AveragesLargeVolumes) {
  tool::Volume volume;
  volume.nx = 301, volume.ny = 200, volume.nz = 150;
  volume.to_world.axes[2] = {0, 0, 3};
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y)
      for (int x = 0; x < volume.nx; ++x) volume.values.push_back(static_cast<float>(2 * x - y + 3 * z));
  const tool::PackedVolume p = tool::pack_volume(volume);
  ASSERT_EQ(p.bytes.size(), size_t(p.size[0]) * size_t(p.size[1]) * size_t(p.size[2]));
  EXPECT_LE(p.bytes.size(), tool::most_page_voxels);
  EXPECT_EQ(p.steps[2], 1) << "the longest voxels stay";
  // A linear image keeps its values at the middles of blocks.
  int byte = 0;
  for (int x = 0; x < p.size[0] - 1; ++x) {
    byte = (byte + static_cast<unsigned char>(p.bytes[size_t(x)])) & 255;
    const tool::Point at = p.to_world({double(x), 0, 0});
    const double grey = std::clamp(2 * at[0] - at[1] + at[2], p.low, p.high);
    EXPECT_NEAR(p.low + byte * (p.high - p.low) / 255, grey, 0.51 * (p.high - p.low) / 255) << x;
  }
}

TEST(Deflate, WritesBase64) {
  // RFC 4648, section 10.
  const std::pair<const char*, const char*> known[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : known) EXPECT_EQ(tool::base64(bytes), text);
}

#if TOOL_HAVE_ZLIB
TEST(Deflate, InflatesToTheSameBytes) {
  for (const size_t size : {size_t{0}, size_t{1}, size_t{65535}, size_t{65536}, size_t{200000}}) {
    std::string bytes;
    for (size_t i = 0; i < size; ++i) bytes += static_cast<char>(i * i >> 3 & 255);
    for (const std::string& stream : {tool::zlib_stream(bytes), tool::stored_stream(bytes)}) {
      std::string out(size + 1, '\0');
      uLongf count = static_cast<uLongf>(out.size());
      ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(out.data()), &count, reinterpret_cast<const Bytef*>(stream.data()),
                           static_cast<uLong>(stream.size())),
                Z_OK);
      out.resize(count);
      EXPECT_EQ(out, bytes);
    }
  }
}
#endif

}  // namespace
}  // namespace film_test
