// SPDX-License-Identifier: MIT
// faulty_meshes: boxes as files, to put faults in, and what the tool makes of a file. For tests with
// TOPOADAPT_TOOL_PATH.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "support/tool_support.h"
#include "tool/topology.h"

namespace support {

struct Polygons {
  std::vector<Point> points;
  std::vector<std::vector<int>> faces;

  void Add(const Polygons& other) {
    const int first = static_cast<int>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (auto face : other.faces) {
      for (int& v : face) v += first;
      faces.push_back(face);
    }
  }
  // Triangles with corners of their own.
  Polygons Soup() const {
    Polygons soup;
    for (const auto& face : faces) {
      soup.faces.emplace_back();
      for (const int v : face) {
        soup.faces.back().push_back(static_cast<int>(soup.points.size()));
        soup.points.push_back(points[static_cast<size_t>(v)]);
      }
    }
    return soup;
  }
};

// Triangles wind outward, or inward.
inline Polygons Box(const Point& low, double size, bool inward = false) {
  Polygons box;
  for (int k = 0; k < 8; ++k)
    box.points.push_back({low[0] + (k & 1 ? size : 0), low[1] + (k & 2 ? size : 0), low[2] + (k & 4 ? size : 0)});
  constexpr int squares[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& s : squares)
    for (const auto& t : {std::array{s[0], s[1], s[2]}, std::array{s[0], s[2], s[3]}}) {
      box.faces.push_back({t[0], t[1], t[2]});
      if (inward) std::reverse(box.faces.back().begin(), box.faces.back().end());
    }
  return box;
}

inline std::string Off(const Polygons& p) {
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n" << p.points.size() << " " << p.faces.size() << " 0\n";
  for (const Point& q : p.points) text << q[0] << " " << q[1] << " " << q[2] << "\n";
  for (const auto& face : p.faces) {
    text << face.size();
    for (const int v : face) text << " " << v;
    text << "\n";
  }
  return text.str();
}

inline std::string Stl(const Polygons& p) {
  std::ostringstream text;
  text.precision(17);
  text << "solid s\n";
  for (const auto& face : p.faces) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const int v : face) {
      const Point& q = p.points[static_cast<size_t>(v)];
      text << "vertex " << q[0] << " " << q[1] << " " << q[2] << "\n";
    }
    text << "endloop\nendfacet\n";
  }
  return text.str() + "endsolid s\n";
}

inline std::string Obj(const Polygons& p) {
  std::ostringstream text;
  text.precision(17);
  for (const Point& q : p.points) text << "v " << q[0] << " " << q[1] << " " << q[2] << "\n";
  for (const auto& face : p.faces) {
    text << "f";
    for (const int v : face) text << " " << v + 1;
    text << "\n";
  }
  return text.str();
}

class Mend : public Tool {
 protected:
  // Resolves the mesh, and expects bodies of these volumes, sound, and a note with all the words.
  void Resolves(const std::string& file, const std::string& options, std::vector<double> volumes,
                const std::vector<std::string>& words) const {
    std::filesystem::remove(At("out.off"));
    const Ended run = Call("resolve " + file + " --out " + At("out.off") + " --json " + At("out.json") + options);
    EXPECT_EQ(run.exit_code, 0) << file << options << ": " << run.err;
    for (const std::string& word : words) EXPECT_NE(run.err.find(word), std::string::npos) << word << ": " << run.err;
    if (words.empty()) {
      EXPECT_EQ(run.err, "") << file;
    }
    Mesh m;
    ASSERT_TRUE(tool::read_mesh(At("out.off"), m).ok) << file << options << run.err;
    EXPECT_TRUE(IsSound(m, file));
    std::vector<double> found;
    for (const tool::Part& p : tool::parts_of(m)) found.push_back(p.volume);
    std::sort(found.begin(), found.end());
    std::sort(volumes.begin(), volumes.end());
    ASSERT_EQ(found.size(), volumes.size()) << file;
    for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], volumes[i], 1e-3 * std::fabs(volumes[i])) << file;
  }
  std::string Report() const { return Contents(At("out.json")); }
  void ExpectInReport(const std::string& words) const {
    EXPECT_NE(Report().find(words), std::string::npos) << words << ": " << Report();
  }
  // Exit 1, nothing written, and all the words on standard error.
  void Names(const std::string& file, const std::vector<std::string>& words) const {
    std::filesystem::remove(At("never.off"));
    const Ended run = Call("resolve " + file + " --out " + At("never.off") + " --json " + At("out.json"));
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(At("never.off")));
    for (const std::string command : {"detect ", "validate "}) {
      const Ended other = Call(command + file);
      for (const std::string& word : words)
        EXPECT_NE(other.err.find(word), std::string::npos) << command << word << ": " << other.err;
    }
    for (const std::string& word : words) EXPECT_NE(run.err.find(word), std::string::npos) << word << ": " << run.err;
  }
};

}  // namespace support
