// SPDX-License-Identifier: MIT
#include "support/candidates_support.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tool/scenes/elementary.h"

namespace candidates_support {

size_t Mu(const Loops& loops) {
  size_t mu = 0;
  for (const auto& loop : loops) mu += loop.size();
  return mu;
}

double Length(const Loops& loops, const Faces& faces) {
  std::vector<Vec3> points;
  for (const auto& loop : loops) points.insert(points.end(), loop.begin(), loop.end());
  double sum = 0;
  for (const auto& f : faces)
    for (int c = 0; c < 3; ++c) {
      const Vec3 e = points[f.v[c]] - points[f.v[(c + 1) % 3]];
      sum += 0.5 * std::sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
    }
  return sum;
}

std::string WhyNotConsistent(const Loops& loops, const Faces& faces) {
  const size_t mu = Mu(loops), k = loops.size();
  if (faces.size() != (k == 1 ? mu - 2 : mu + 2 * k - 4)) return "number of faces";
  std::vector<size_t> next, of;
  for (size_t l = 0, first = 0; l < k; first += loops[l++].size())
    for (size_t v = 0; v < loops[l].size(); ++v) next.push_back(first + (v + 1) % loops[l].size()), of.push_back(l);
  std::vector<std::map<size_t, size_t>> star(mu);  // star[a][b] = c for the face a b c
  for (const auto& f : faces)
    for (int c = 0; c < 3; ++c) {
      const size_t a = f.v[c], b = f.v[(c + 1) % 3], d = f.v[(c + 2) % 3];
      if (a >= mu || a == b) return "a corner";
      if (!star[a].emplace(b, d).second) return "an edge twice in one direction";
    }
  size_t inner = 0;
  for (size_t a = 0; a < mu; ++a) {
    if (!star[a].count(next[a])) return "a loop's edge is missing";
    for (const auto& [b, unused] : star[a]) {
      if (next[a] == b) continue;
      if (next[b] == a) return "a loop's edge is traversed backwards";
      if (!star[b].count(a)) return "an inner edge has one face";
      if (k > 1 && of[a] == of[b]) return "an edge inside a loop";
      ++inner;
    }
    size_t at = next[a], steps = 0;
    for (auto it = star[a].find(at); it != star[a].end() && steps <= star[a].size(); it = star[a].find(at))
      at = it->second, ++steps;
    if (steps != star[a].size() || next[at] != a) return "a star that is not one fan";
  }
  std::vector<char> seen(mu);
  std::vector<size_t> stack{0};
  seen[0] = 1;
  size_t reached = 0;
  while (!stack.empty()) {
    const size_t v = stack.back();
    stack.pop_back();
    ++reached;
    for (const auto& [b, c] : star[v])
      for (size_t w : {b, c})
        if (!seen[w]) seen[w] = 1, stack.push_back(w);
  }
  if (reached != mu) return "several components";
  // Caps add k vertices, mu edges and mu faces.
  if (mu + k + faces.size() + mu != 2 + (mu + inner / 2 + mu)) return "Euler number";
  return "";
}

double LoopEdges(const Loops& loops) {
  double sum = 0;
  for (const auto& loop : loops)
    for (size_t v = 0; v < loop.size(); ++v) sum += 0.5 * tpa::length(loop[v] - loop[(v + 1) % loop.size()]);
  return sum;
}

Search::Search(Loops p, tpa::CandidateOptions options) : points(std::move(p)) {
  for (const auto& loop : points) loops.push_back({loop.data(), static_cast<tpa::u32>(loop.size())});
  const tpa::u64 bytes = tpa::candidate_scratch_bytes(Mu(points), points.size());
  scratch.resize(bytes / 8 + 1);
  EXPECT_TRUE(tpa::begin(search, {loops.data(), static_cast<tpa::u32>(loops.size())},
                         {reinterpret_cast<tpa::u8*>(scratch.data()), static_cast<tpa::u32>(bytes)}, options));
}

bool Search::Next(Faces& faces) {
  faces.resize(tpa::candidate_face_count(search.loops));
  tpa::u32 count = 0;
  const bool more = tpa::next(search, {faces.data(), static_cast<tpa::u32>(faces.size())}, count);
  EXPECT_TRUE(!more || count == faces.size());
  return more;
}

Loops Maker::Make(const std::vector<int>& sides, Positions positions) {
  Loops loops;
  const double k = static_cast<double>(sides.size());
  for (size_t l = 0; l < sides.size(); ++l) {
    std::vector<Vec3> loop;
    const double at = 6.283185307179586 * static_cast<double>(l) / k;
    for (int v = 0; v < sides[l]; ++v) {
      const double t = 6.283185307179586 * v / sides[l];
      Vec3 p{3 * tool::cosine(at) + tool::cosine(t), 3 * tool::sine(at) - tool::sine(t), 0};
      if (positions == Positions::random) p = p + Vec3{Unit(), Unit(), Unit()};
      if (positions == Positions::tied) p = {std::round(p.x + Unit()), std::round(p.y + Unit()), std::round(Unit())};
      if (positions == Positions::symmetric && sides.size() == 2)
        p = {tool::cosine(t), l == 0 ? tool::sine(t) : -tool::sine(t), l == 0 ? 0.0 : 1.0};
      loop.push_back(p);
    }
    loops.push_back(loop);
  }
  return loops;
}

bool IsFree(void*, const tpa::FaceCorners& f) {
  const unsigned sum = (f.v[0] + 1) * (f.v[1] + 1) * (f.v[2] + 1) + f.v[0] + f.v[1] + f.v[2];
  return (sum * 2654435761u >> 16) % 5 != 0;
}
bool AreFree(const Faces& faces) {
  return std::all_of(faces.begin(), faces.end(), [](const tpa::FaceCorners& f) { return IsFree(nullptr, f); });
}

bool IsFreeOf(const Hindrance& h, size_t a, size_t b, size_t c) {
  const uint64_t sum = (a + 1) * (b + 1) * (c + 1) * 31 + a + b + c;
  return (sum * 0x9e3779b97f4a7c15u >> 33) % 100 >= h.percent;
}
bool AskHindrance(void* caller, const tpa::FaceCorners& f) {
  Hindrance& h = *static_cast<Hindrance*>(caller);
  ++h.asked;
  return IsFreeOf(h, f.v[0], f.v[1], f.v[2]);
}

}  // namespace candidates_support
