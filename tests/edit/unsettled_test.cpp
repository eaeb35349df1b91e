// SPDX-License-Identifier: MIT
// The faces that a sweep tries after changes, against corners in common on the list of triangles.
#include "edit/unsettled.h"

#include <algorithm>
#include <set>

#include "support/library_mesh.h"
#include "support/share.h"
#include "support/support.h"

namespace unsettled_test {
namespace {

using namespace support;
using Faces = std::set<uint32_t>;

struct Workbench : LibraryMesh {
  explicit Workbench(const Mesh& mesh) : LibraryMesh(mesh), mesh_(mesh) {
    tpa::BitSet* const sets[] = {&u.vertices, &u.faces, &u.lengths, &u.flips, &vertices, &faces};
    for (size_t i = 0; i < 6; ++i) {
      words_[i].resize(tpa::bit_set_words(m.face_count));
      *sets[i] = tpa::open_bit_set(words_[i].data(), m.face_count);
    }
  }

  Faces At(const Faces& ends) const {
    Faces out;
    for (size_t h = 0; h < mesh_.triangles.size(); ++h)
      if (ends.count(mesh_.triangles[h]) != 0) out.insert(static_cast<uint32_t>(h / 3));
    return out;
  }
  // All faces with a corner in common with these.
  Faces Round(const Faces& inner) const {
    Faces ends;
    for (const uint32_t f : inner) ends.insert(&mesh_.triangles[3 * f], &mesh_.triangles[3 * f] + 3);
    return At(ends);
  }
  // What is unsettled, and is tried now.
  Faces Taken() {
    Faces lengths, flips;
    for (const uint32_t f : u.lengths) lengths.insert(f);
    for (const uint32_t f : u.flips) flips.insert(f);
    EXPECT_EQ(lengths, flips);
    u.lengths.cut_off(0);
    u.flips.cut_off(0);
    return lengths;
  }

  tpa::Unsettled u;
  tpa::BitSet vertices, faces;  // of a commit

 private:
  Mesh mesh_;
  std::vector<uint32_t> words_[6];
};

// One sweep after another: each tries the faces near changes since the last one, and no others.
TEST(Unsettled, FacesAreNearChangesSinceTheLastSweep) {
  Random random(1);
  Workbench b(Renumbered(Sphere({0, 0, 0}, 1, 12), random));
  std::vector<uint32_t> room(b.m.face_count);
  tpa::Stack<uint32_t> list{room.data(), b.m.face_count, 0};
  for (int sweep = 0; sweep < Share(40); ++sweep) {
    Faces changed_vertices, changed_faces;
    for (uint64_t i = 0; i < 3; ++i) {
      changed_vertices.insert(static_cast<uint32_t>(random() % b.m.vertex_count));
      changed_faces.insert(static_cast<uint32_t>(random() % b.m.face_count));
    }
    b.vertices.cut_off(0);
    b.faces.cut_off(0);
    for (const uint32_t v : changed_vertices) b.vertices.add(v);
    for (const uint32_t f : changed_faces) b.faces.add(f);
    tpa::note_changed(b.u, b.vertices, b.faces);
    tpa::spread(b.u, b.m, list);
    Faces expected = b.At(changed_vertices);
    expected.insert(changed_faces.begin(), changed_faces.end());
    EXPECT_EQ(b.Taken(), b.Round(expected)) << "sweep " << sweep;
    // Stars of vertices that move meanwhile.
    const std::vector<uint32_t> moved(changed_vertices.begin(), changed_vertices.end());
    tpa::unsettle_stars(b.u, b.m, {moved.data(), static_cast<uint32_t>(moved.size())});
    EXPECT_EQ(b.Taken(), b.Round(b.At(changed_vertices))) << "sweep " << sweep;
  }
}

// Nothing is left for the next sweep of changes before.
TEST(Unsettled, AllFacesAreTriedOnce) {
  Workbench b(Sphere({0, 0, 0}, 1, 4));
  b.vertices.add(3);
  b.faces.add(5);
  tpa::note_changed(b.u, b.vertices, b.faces);
  tpa::unsettle_all(b.u, b.m);
  EXPECT_EQ(b.Taken().size(), b.m.face_count);
  std::vector<uint32_t> room(b.m.face_count);
  tpa::Stack<uint32_t> list{room.data(), b.m.face_count, 0};
  tpa::spread(b.u, b.m, list);
  EXPECT_EQ(b.Taken(), Faces());
}

}  // namespace
}  // namespace unsettled_test
