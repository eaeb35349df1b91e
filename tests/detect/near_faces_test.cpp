// SPDX-License-Identifier: MIT
// NearFaces: the faces near a box, while faces come, go and change. The judge keeps a list of entered faces, and tries
// each with each query.
#include "detect/near_faces.h"

#include <algorithm>
#include <map>

#include "support/library_mesh.h"
#include "support/share.h"
#include "support/support.h"

namespace near_faces_test {
namespace {

using namespace support;

// A mesh edited at random, without regard to adjacency: NearFaces takes each face by itself.
class Editor : public NearFacesWithMemory {
 public:
  // `spare`: room for more faces, the gaps of the tree.
  explicit Editor(const Mesh& mesh, uint32_t spare, uint64_t seed)
      : NearFacesWithMemory(VertexCount(mesh), TriangleCount(mesh) + spare),
        random_(seed),
        vertices_(VertexCount(mesh)),
        capacity_(TriangleCount(mesh) + spare),
        corners_(mesh.triangles),
        opposite_(LibraryMesh(mesh).opposite),
        given_("given", mesh) {
    for (size_t v = 0; v < vertices_; ++v)
      positions_.push_back({mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
    corners_.resize(3 * size_t{capacity_}, tpa::none);
    m.position = positions_.data();
    m.corner = corners_.data();
    m.opposite = opposite_.data();
    m.vertex_count = vertices_;
    m.face_count = TriangleCount(mesh);
    m.face_capacity = capacity_;
  }

  void EnterAll() {
    Arrange(m);
    for (uint32_t f = 0; f < m.face_count; ++f)
      if (tpa::face_lives(m, f)) entered_[f] = tpa::face_box(m, f);
  }
  void Enter(uint32_t f) {
    tpa::insert(g, m, f);
    entered_[f] = tpa::face_box(m, f);
  }
  void Leave(uint32_t f) {
    tpa::remove(g, f);
    entered_.erase(f);
  }
  // Did at most a tenth of the faces asked about not meet the query?
  bool AskedFewInVain() const { return 10 * in_vain_ < asked_; }
  bool Holds(uint32_t f) const { return entered_.contains(f); }

  uint32_t AnyFace() {
    uint32_t f;
    do f = static_cast<uint32_t>(random_() % m.face_count);
    while (!tpa::face_lives(m, f));
    return f;
  }
  // Takes a face out; mostly puts it back, often with a vertex moved.
  void EditFace(double reach) {
    const uint32_t f = AnyFace();
    if (!Holds(f)) return Enter(f);
    Leave(f);
    if (random_() % 4 == 0) return;
    const tpa::Vec3 p = tpa::corner_position(m, 3 * f);
    if (random_() % 2 == 0) MoveTogether(m.corner[3 * f], p, reach);
    Enter(f);
  }
  void NewFace(uint32_t like) {
    if (m.face_count == capacity_) return;
    const uint32_t f = m.face_count++;
    for (uint32_t i = 0; i < 3; ++i) m.corner[3 * f + i] = m.corner[3 * like + (2 - i)];
    Enter(f);
  }

  void DeleteFace() {
    const uint32_t f = AnyFace();
    m.corner[3 * f] = tpa::none;
    m.corner[3 * f + 1] = m.free_face;
    m.free_face = f;
  }
  void FillHole() {
    const uint32_t like = AnyFace(), f = m.free_face;
    if (f == tpa::none) return;
    m.free_face = m.corner[3 * f + 1];
    for (uint32_t i = 0; i < 3; ++i) m.corner[3 * f + i] = m.corner[3 * like + (2 - i)];
    Enter(f);
  }

  void ExpectAsJudged() {
    const tpa::Vec3 low = {Uniform(random_, -1.6, 1.4), Uniform(random_, -1.6, 1.4), Uniform(random_, -1.6, 1.4)};
    const double size = random_() % 5 == 0 ? 3 : .2;
    const tpa::Vec3 high = low + Uniform(random_, 0, size) * tpa::Vec3{1, Uniform(random_, 0, 1), 1};
    const tpa::Box query = tpa::box_of(low, high, high);
    std::map<uint32_t, int> asked;
    tpa::for_each_near(g, query, [&](uint32_t f) { ++asked[f]; });
    ExpectNear(asked, query);
    // A search ends with the first answer.
    const uint32_t wanted = AnyFace();
    const uint32_t found = tpa::find_near(
        g, query, [&](uint32_t f) { return f != wanted; }, [&](uint32_t f) { return f % 3 == wanted % 3; });
    bool any = false;
    for (const auto& [f, box] : asked) any = any || (f != wanted && f % 3 == wanted % 3);
    EXPECT_EQ(found != tpa::none, any);
    EXPECT_TRUE(found == tpa::none || (asked.contains(found) && found != wanted && found % 3 == wanted % 3));
  }

  tpa::Mesh m;

 private:
  // Expects each face once, and all faces with boxes that meet the query.
  void ExpectNear(const std::map<uint32_t, int>& asked, const tpa::Box& query) {
    for (const auto& [f, times] : asked) {
      EXPECT_EQ(times, 1) << f;
      EXPECT_TRUE(Holds(f)) << f;
      ++asked_;
      in_vain_ += boxes_meet(entered_[f], query) ? 0u : 1u;
    }
    for (const auto& [f, box] : entered_) EXPECT_TRUE(asked.contains(f) || !boxes_meet(box, query)) << f;
  }

  // All faces of the moved vertex enter anew; some leave before.
  void MoveTogether(uint32_t v, tpa::Vec3 p, double reach) {
    std::vector<uint32_t> back;
    for (uint32_t f = 0; f < m.face_count; ++f)
      if (Holds(f) && (m.corner[3 * f] == v || m.corner[3 * f + 1] == v || m.corner[3 * f + 2] == v)) {
        if (random_() % 2 == 0) Leave(f);
        back.push_back(f);
      }
    m.position[v] = p + reach * tpa::Vec3{Uniform(random_, -1, 1), Uniform(random_, -1, 1), Uniform(random_, -1, 1)};
    for (uint32_t f : back) Enter(f);
  }

  Random random_;
  size_t asked_ = 0, in_vain_ = 0;
  uint32_t vertices_, capacity_;
  std::vector<tpa::Vec3> positions_;
  std::vector<uint32_t> corners_, opposite_;
  MeshOnFailure given_;
  std::map<uint32_t, tpa::Box> entered_;
};

// New faces all over the mesh find gaps of the tree nearby; new faces in one place soon find none. Without spare room,
// a face that moves far takes the place left by another face.
TEST(NearFaces, AsksForWhatIsNearAfterAnyEdits) {
  for (bool crowded : {false, true})
    for (uint32_t spare : {0u, 500u})
      for (uint64_t seed = 1; seed <= Share(6u); ++seed) {
        Editor editor(Together({Sphere({0, 0, 0}, 1, 12), Torus({0, 0, 0}, 1.2, .05, 40, 8)}), spare, seed);
        editor.EnterAll();
        for (int i = 0; i < 600 && !HasFailure(); ++i) {
          editor.EditFace(i % 7 == 0 ? .5 : .02);
          if (crowded)
            editor.NewFace(0);
          else if (i % 10 == 0)
            editor.NewFace(editor.AnyFace());
          editor.ExpectAsJudged();
        }
        EXPECT_EQ(editor.g.tree->strays > 0, crowded && spare > 0);
        EXPECT_TRUE(editor.AskedFewInVain());
        ASSERT_FALSE(HasFailure()) << crowded << ", " << spare << " to spare, seed " << seed;
      }
}

// The leaves whose boxes meet the box of a face, in the mean over all faces.
double LeavesPerFace(const Editor& editor) {
  uint64_t leaves = 0;
  for (uint32_t f = 0; f < editor.m.face_count; ++f) {
    const tpa::Frame& frame = editor.g.tree->frame;
    const tpa::Vec3 &a = tpa::corner_position(editor.m, 3 * f), &b = tpa::corner_position(editor.m, 3 * f + 1),
                    &c = tpa::corner_position(editor.m, 3 * f + 2);
    tpa::Vec3 low, high;
    for (int k = 0; k < 3; ++k) low[k] = std::min({a[k], b[k], c[k]}), high[k] = std::max({a[k], b[k], c[k]});
    tpa::for_each_leaf_near(*editor.g.tree, tpa::flat_box(frame, low, high), 0, [&](uint32_t) { return ++leaves > 0; });
  }
  return double(leaves) / editor.m.face_count;
}

// New faces go to leaves near by. So a search goes through hardly more leaves than before, however many faces have
// come: boxes of leaves that grow far lie in the way of all searches between. Spheres of many sizes make nodes of many
// sizes.
TEST(NearFaces, NewFacesLeaveLeavesSmall) {
  std::vector<Mesh> spheres;
  for (int i = 0; i < 64; ++i)
    spheres.push_back(Sphere({3. * (i % 4), 3. * (i / 4 % 4), 3. * (i / 16)}, .5 + .25 * (i * 7 % 5), 12 + i * 5 % 11));
  const Mesh mesh = Together(spheres);
  Editor editor(mesh, TriangleCount(mesh), 1);
  editor.EnterAll();
  const double before = LeavesPerFace(editor);
  for (uint32_t f = 0; f < TriangleCount(mesh); f += 3) editor.NewFace(f);
  EXPECT_LT(LeavesPerFace(editor), 1.5 * before);
}

// A face that moves far goes to the best leaf if a gap is left there, and stays otherwise.
TEST(NearFaces, MovesFacesWhereThereAreGaps) {
  for (uint32_t spare : {0u, 2000u}) {
    const Mesh sphere = Sphere({0, 0, 0}, 1, 16);
    Editor editor(sphere, spare, 1);
    editor.EnterAll();
    editor.Enter(0);  // makes gaps
    const tpa::FaceTree& tree = *editor.g.tree;
    ASSERT_GT(tree.count, 8u);
    const uint32_t place = tree.place[0];
    // To the other side.
    for (uint32_t i = 0; i < 3; ++i) {
      tpa::Vec3& p = editor.m.position[editor.m.corner[i]];
      p = -1.0 * p;
    }
    editor.Enter(0);
    for (int i = 0; i < 100; ++i) editor.ExpectAsJudged();
    EXPECT_EQ(tree.place[0] == place, spare == 0);
    EXPECT_EQ(tree.strays, spare == 0 ? 1u : 0u);
  }
}

// Even with fewer gaps than leaves.
TEST(NearFaces, HasGapsEverywhere) {
  for (uint32_t spare : {0u, 1u, 5u, 20u, 75u, 400u, 5000u}) {
    Editor editor(Torus({0, 0, 0}, 1, .4, 60, 30), spare, 1);
    editor.EnterAll();
    editor.Enter(0);
    const tpa::FaceTree& tree = *editor.g.tree;
    uint32_t gaps = 0;
    for (uint32_t c = 0; c < tree.count; ++c) {
      gaps += tree.first[c + 1] - tree.end[c];
      // An even share so far, rounded down.
      EXPECT_EQ(gaps, uint64_t{spare} * (c + 1) / tree.count) << spare << " to spare, leaf " << c;
      for (uint32_t i = tree.first[c]; i < tree.end[c]; ++i) EXPECT_EQ(tree.place[tree.face[i]], i);
    }
    EXPECT_EQ(gaps, spare);
  }
}

// Holes in the numbering, and new faces in holes, far from the faces before.
TEST(NearFaces, ArrangesWhatLives) {
  for (uint64_t seed = 1; seed <= Share(4u); ++seed) {
    Editor editor(Sphere({0, 0, 0}, 1, 8), 500, seed);
    for (int i = 0; i < 300; ++i) editor.DeleteFace();
    editor.EnterAll();
    for (int i = 0; i < 300 && !HasFailure(); ++i) {
      if (i % 3 == 0) editor.FillHole();
      editor.EditFace(.1);
      editor.ExpectAsJudged();
    }
    EXPECT_TRUE(editor.AskedFewInVain());
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST(NearFaces, BeginsAnewWithTheMeshAsItIs) {
  Editor editor(Sphere({0, 0, 0}, 1, 10), 500, 1);
  for (int round = 0; round < 4; ++round) {
    editor.EnterAll();
    for (int i = 0; i < 100; ++i) editor.EditFace(.1);
    for (uint32_t f = 0; f < editor.m.face_count; ++f)
      if (!editor.Holds(f)) editor.Enter(f);
    for (int i = 0; i < 100; ++i) editor.ExpectAsJudged();
  }
}

// Faces go, come and change as in edits of the library; the tree follows a rollback of the mesh.
TEST(NearFaces, FollowsARollback) {
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    const auto upto = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
    ArrangedMesh w(Torus({}, 1, .4, 24, 12), 60);
    const tpa::Mesh& m = w.e.mesh;
    const std::vector<uint32_t> corners = w.corners;
    for (int round = 0; round < 6; ++round) {
      for (int i = 0; i < 40; ++i) {
        const uint32_t f = upto(m.face_count), v = upto(m.vertex_count);
        if (!tpa::face_lives(m, f)) continue;
        switch (i % 5) {
          case 0:
            tpa::remove(w.g, f);
            tpa::delete_face(w.e, f);
            break;
          case 1:
          case 2:
            if (const uint32_t made = tpa::new_face(w.e, v, upto(m.vertex_count), upto(m.vertex_count), tpa::none);
                made != tpa::none)
              tpa::insert(w.g, m, made);
            break;
          case 3:
            tpa::set_corner(w.e, 3 * f + upto(3), v);
            tpa::insert(w.g, m, f);
            break;
          default:
            tpa::set_position(w.e, v, 3.0 * m.position[upto(m.vertex_count)]);
            for (uint32_t g = 0; g < m.face_count; ++g)
              if (tpa::face_lives(m, g)) tpa::insert(w.g, m, g);
        }
      }
      tpa::rollback(w.e, w.g);
      ASSERT_EQ(m.face_count, w.faces);
      ASSERT_TRUE(std::equal(corners.begin(), corners.begin() + 3 * w.faces, w.corners.begin()));
      ExpectArranged(w.g, m);
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ", round " << round;
      tpa::begin(w.e);
    }
  }
}

}  // namespace
}  // namespace near_faces_test
