// SPDX-License-Identifier: MIT
// Volumes of parts after edits, against integers of any size.
#include "mesh/part_volumes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "mesh/component_volumes.h"
#include "oracle/volume_oracle.h"
#include "support/library_mesh.h"
#include "support/share.h"

namespace part_volumes_test {
namespace {

using namespace support;
using tpa::u32;

// A mesh edited at random: vertices come and go, also in slots of others; bodies are joined; vertices move.
class Edited {
 public:
  Edited(const Mesh& mesh, double reach, Random& random) : mesh_(mesh, 200), reach_(reach), random_(random) {}

  tpa::Edit& e() { return mesh_.e; }
  const tpa::Mesh& m() const { return mesh_.e.mesh; }
  void EditOnce() {
    const uint64_t kind = random_() % 10;
    if (kind < 3)
      RemoveVertex();
    else if (kind < 5)
      SplitFace();
    else if (kind < 6)
      JoinFaces();
    else
      MoveVertex();
  }

 private:
  u32 LivingFace() {
    for (;;)
      if (const u32 f = Below(m().face_count); tpa::face_lives(m(), f)) return f;
  }
  u32 LivingVertex() {
    for (;;)
      if (const u32 v = Below(m().vertex_count); tpa::vertex_lives(m(), v)) return v;
  }
  u32 Below(u32 n) { return static_cast<u32>(random_() % n); }
  tpa::Vec3 Near(u32 v) {
    const Point by = RandomPoint(random_, -reach_, reach_);
    return m().position[v] + tpa::Vec3{by[0], by[1], by[2]};
  }
  void MoveVertex() {
    const u32 v = LivingVertex();
    tpa::set_position(e(), v, Near(v));
  }
  void SplitFace() {
    const u32 f = LivingFace();
    const u32 c[3] = {m().corner[3 * f], m().corner[3 * f + 1], m().corner[3 * f + 2]};
    const tpa::Vec3 at = Near(c[0]);
    const tpa::VertexOrigin origin = tpa::blend_origins(m(), c[0], c[1], 0.4);
    tpa::delete_face(e(), f);
    const u32 v = tpa::new_vertex(e(), at, origin);
    for (u32 i = 0; i < 3; ++i) tpa::new_face(e(), v, c[i], c[(i + 1) % 3], tpa::none);
    Relink();
  }
  // A fan fills the hole, unless an edge would become double.
  void RemoveVertex() {
    const u32 v = LivingVertex();
    std::vector<u32> link, faces;
    tpa::for_each_outgoing(m(), v, [&](u32 h) {
      link.push_back(tpa::head(m(), h));
      faces.push_back(tpa::face_of(h));
    });
    if (link.size() < 4) return;
    for (size_t i = 2; i + 1 < link.size(); ++i)
      if (tpa::find_edge(m(), link[0], link[i]) != tpa::none) return;
    tpa::delete_vertex(e(), v);
    for (const u32 f : faces) tpa::delete_face(e(), f);
    for (size_t i = 1; i + 1 < link.size(); ++i) tpa::new_face(e(), link[0], link[i], link[i + 1], tpa::none);
    Relink();
  }
  // By a prism, unless corners are equal or neighbours.
  void JoinFaces() {
    const u32 f = LivingFace(), g = LivingFace();
    const u32 a[3] = {m().corner[3 * f], m().corner[3 * f + 1], m().corner[3 * f + 2]};
    const u32 b[3] = {m().corner[3 * g], m().corner[3 * g + 2], m().corner[3 * g + 1]};
    for (const u32 x : a)
      for (const u32 y : b)
        if (x == y || tpa::find_edge(m(), x, y) != tpa::none) return;
    tpa::delete_face(e(), f);
    tpa::delete_face(e(), g);
    for (u32 i = 0; i < 3; ++i) {
      const u32 j = (i + 1) % 3;
      tpa::new_face(e(), a[i], a[j], b[i], tpa::none);
      tpa::new_face(e(), a[j], b[j], b[i], tpa::none);
    }
    Relink();
  }
  void Relink() {
    tpa::Mesh& m = e().mesh;
    std::map<std::pair<u32, u32>, u32> half_edge;
    for (u32 h = 0; h < 3 * m.face_count; ++h) {
      if (!tpa::face_lives(m, tpa::face_of(h))) continue;
      const u32 v = tpa::tail(m, h), was = m.vertex_edge[v];
      half_edge[{v, tpa::head(m, h)}] = h;
      if (was == tpa::none || !tpa::face_lives(m, tpa::face_of(was)) || m.corner[was] != v)
        tpa::set_vertex_edge(e(), v, h);
    }
    for (const auto& [ends, h] : half_edge) m.opposite[h] = half_edge.at({ends.second, ends.first});
  }

  EditedMesh mesh_;
  double reach_;
  Random& random_;
};

// Memory of find_parts() and measure_parts() for n vertices.
struct Room {
  explicit Room(size_t n)
      : label(n),
        node(2 * n),
        queue(n + 1),
        part(n, tpa::none),
        following(n),
        open(64),
        place(64),
        touched(64),
        change(64),
        components(64),
        parts(n),
        families(64) {
    c.label = label.data(), c.node = node.data(), c.list = {components.data(), 64, 0};
    p.part = part.data(), p.following = following.data(), p.change = change.data(), p.open = open.data(),
    p.place = place.data();
    p.list = {parts.data(), static_cast<u32>(n), 0}, p.families = {families.data(), 64, 0};
    p.touched = {touched.data(), 64, 0};
  }
  std::vector<u32> label, node, queue, part, following, open, place, touched;
  std::vector<int32_t> change;
  std::vector<tpa::Component> components;
  std::vector<tpa::Part> parts;
  std::vector<tpa::Family> families;
  tpa::Components c;
  tpa::Parts p;
};

// Per vertex: the smallest vertex of the body.
std::vector<u32> BodiesOf(const tpa::Mesh& m) {
  std::vector<u32> of(m.vertex_capacity);
  std::iota(of.begin(), of.end(), 0u);
  const auto find = [&](u32 v) {
    while (of[v] != v) v = of[v] = of[of[v]];
    return v;
  };
  for (u32 h = 0; h < 3 * m.face_count; ++h) {
    if (!tpa::face_lives(m, tpa::face_of(h))) continue;
    const u32 a = find(tpa::tail(m, h)), b = find(tpa::head(m, h));
    of[std::max(a, b)] = std::min(a, b);
  }
  for (u32 v = 0; v < of.size(); ++v) of[v] = find(v);
  return of;
}

TEST(PartVolumes, AreWithinTheirDoubt) {
  size_t known = 0, open = 0, taken_over = 0;
  for (uint64_t seed = 1; seed <= Share(400u); ++seed) {
    Random random(seed);
    const double far = std::pow(10, Uniform(random, -1, 5));
    std::vector<Mesh> bodies(2 + random() % 3);
    for (Mesh& body : bodies)
      body = Translated(Sphere({0, 0, 0}, 1, 2 + static_cast<int>(random() % 2)), RandomPoint(random, -far, far));
    Edited edited(Together(bodies), std::pow(10, Uniform(random, -6, 0.5)), random);
    const tpa::Mesh& m = edited.m();
    Room room(m.vertex_capacity);
    tpa::find_components(m, room.c, room.queue.data());
    tpa::measure_volumes(edited.e(), room.c);
    for (uint64_t i = 1 + random() % 30; i > 0; --i) edited.EditOnce();
    for (const u32 v : edited.e().journal.vertices)
      taken_over += v < edited.e().journal.vertex_count && tpa::vertex_lives(m, v) && !tpa::is_old(m, v) ? 1u : 0u;
    tpa::find_parts(edited.e(), edited.e().journal.faces, room.c, room.p);
    tpa::measure_parts(edited.e(), room.c, room.p);
    const std::vector<u32> body = BodiesOf(m);
    for (const tpa::Part& part : room.p.list) {
      if (!tpa::is_root(room.p, part) || part.volume.doubt == tpa::unknown_volume) continue;
      const u32 own = body[part.found.first != tpa::none ? part.found.first : part.done.first];
      const big_int::BigInt exact =
          volume_oracle::SixVolumes(m, [&](u32 f) { return tpa::face_lives(m, f) && body[m.corner[3 * f]] == own; });
      EXPECT_TRUE(volume_oracle::IsWithinDoubt(part.volume.sum, part.volume.doubt, exact)) << "seed " << seed;
      ++known;
      open += part.is_whole ? 0u : 1u;
    }
  }
  EXPECT_GT(known, Least(500u));
  EXPECT_GT(open, Least(200u));
  EXPECT_GT(taken_over, Least(200u));
}

}  // namespace
}  // namespace part_volumes_test
