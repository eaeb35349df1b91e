// SPDX-License-Identifier: MIT
// Embree's rtcCollide on one thread, with the library's own exact test of pairs, which is quicker than CGAL's: what is
// compared is the search.
#include <embree3/rtcore.h>

#include <cmath>

#include "detect/face_pair.h"
#include "detectors.h"

namespace bench {

namespace {

struct Scene {
  tpa::Mesh mesh;
  Pairs pairs;
};

float Below(double x) { return std::nextafter(static_cast<float>(x), -INFINITY); }
float Above(double x) { return std::nextafter(static_cast<float>(x), INFINITY); }

void Bounds(const RTCBoundsFunctionArguments* args) {
  const tpa::Mesh& m = static_cast<Scene*>(args->geometryUserPtr)->mesh;
  tpa::Vec3 low = tpa::corner_position(m, 3 * args->primID), high = low;
  for (uint32_t i = 1; i < 3; ++i) {
    const tpa::Vec3& p = tpa::corner_position(m, 3 * args->primID + i);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  *args->bounds_o = {Below(low.x), Below(low.y), Below(low.z), 0, Above(high.x), Above(high.y), Above(high.z), 0};
}

void Collide(void* user, RTCCollision* collisions, unsigned count) {
  Scene& s = *static_cast<Scene*>(user);
  for (unsigned i = 0; i < count; ++i) {
    const uint32_t f = collisions[i].primID0, g = collisions[i].primID1;
    if (f < g && tpa::faces_meet(s.mesh, f, g)) s.pairs.emplace_back(f, g);
  }
}

void Find(RTCDevice device, uint32_t faces, Scene& s) {
  const RTCScene scene = rtcNewScene(device);
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, faces);
  rtcSetGeometryUserData(geometry, &s);
  rtcSetGeometryBoundsFunction(geometry, Bounds, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  rtcCollide(scene, scene, Collide, &s);
  rtcReleaseScene(scene);
  std::sort(s.pairs.begin(), s.pairs.end());
  s.pairs.erase(std::unique(s.pairs.begin(), s.pairs.end()), s.pairs.end());
}

}  // namespace

Measured DetectWithEmbree(const Mesh& mesh, int repeats) {
  const RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  std::vector<tpa::Vec3> positions;
  for (size_t i = 0; i < mesh.positions.size(); i += 3)
    positions.push_back({mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]});
  std::vector<uint32_t> corners = mesh.triangles;
  Scene scene;
  scene.mesh.position = positions.data();
  scene.mesh.corner = corners.data();
  Measured out;
  out.seconds = BestTime(
      repeats, [&] { scene.pairs.clear(); }, [&] { Find(device, TriangleCount(mesh), scene); });
  out.pairs = scene.pairs;
  rtcReleaseDevice(device);
  return out;
}

}  // namespace bench
