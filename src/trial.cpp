#include "trial.h"

namespace tpa {

namespace {

constexpr f64 least_normal_cosine = 0.5;

Box united(const Box& a, const Box& b) {
  Box out;
  for (int i = 0; i < 3; ++i) {
    out.low[i] = min_of(a.low[i], b.low[i]);
    out.high[i] = max_of(a.high[i], b.high[i]);
  }
  return out;
}

}  // namespace

Vec3 normal_of(const Mesh& m, const Trial& t) {
  return area_normal(m.position[t.v[0]], m.position[t.v[1]], m.position[t.v[2]]);
}

bool turns_little(Vec3 before, Vec3 after) {
  const f64 d = dot(before, after);
  return d > 0 && d * d > least_normal_cosine * least_normal_cosine * squared_length(before) * squared_length(after);
}

bool trials_are_free(const Mesh& m, const Grid& g, const u8* going, const Trial* trials, u32 n) {
  for (u32 i = 0; i < n; ++i)
    for (u32 k = i + 1; k < n; ++k)
      if (corners_meet(m, trials[i].v, trials[k].v)) return false;
  Box boxes[largest_star];
  Box all;
  for (u32 i = 0; i < n; ++i) {
    const u32* v = trials[i].v;
    boxes[i] = box_of(m.position[v[0]], m.position[v[1]], m.position[v[2]]);
    all = i == 0 ? boxes[0] : united(all, boxes[i]);
  }
  const auto meets_a_trial = [&](u32 f) {
    const Box box = face_box(m, f);
    for (u32 i = 0; i < n; ++i)
      if (boxes_meet(box, boxes[i]) && corners_meet(m, trials[i].v, m.corner + 3 * f)) return true;
    return false;
  };
  return n == 0 || find_near(g, all, [&](u32 f) { return going[f] == 0; }, meets_a_trial) == none;
}

}  // namespace tpa
