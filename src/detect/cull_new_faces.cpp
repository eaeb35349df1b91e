#include "detect/cull_new_faces.h"

#include "mesh/projection.h"

namespace tpa {

namespace {

// The slab may reach beyond the trial faces by their width and depth together. Neighbours as large as the trial faces
// then stay within on slopes of one in one, and nearly on the steepest slope in a view along an axis, tan 54.7 degrees.
constexpr f64 margin_by_width = 1;

// A view along the axis that shows the most area of the trial faces.
View view_of(const Mesh& m, const Trial* trials, u32 n) {
  Vec3 sum;
  for (u32 i = 0; i < n; ++i) sum = sum + normal_of(m, trials[i]);
  return view_along(sum);
}

Range heights_of(const View& w, const Mesh& m, const u32* corner) {
  return range_of({m.position[corner[0]][w.z], m.position[corner[1]][w.z], m.position[corner[2]][w.z]});
}

// Faces over the rectangle: their heights, and whether a face may fail to face up, or may cover the point.
constexpr u32 most_over = 64;
struct FacesOver {
  u32 count = 0;
  Range height[most_over];
  bool covers[most_over];
};

// Extends the slab until no face reaches out of it; false if a face in it breaks the proof.
bool grow_slab(FacesOver& over, Range& slab) {
  for (u32 i = 0; i < over.count;) {
    if (is_apart(over.height[i], slab)) {
      ++i;
      continue;
    }
    if (over.covers[i]) return false;
    const Range grown = united(slab, over.height[i]);
    const bool grows = grown.low < slab.low || grown.high > slab.high;
    slab = grown;
    over.height[i] = over.height[--over.count], over.covers[i] = over.covers[over.count];
    if (grows) i = 0;
  }
  return true;
}

}  // namespace

Vec3 normal_of(const Mesh& m, const Trial& t) {
  return area_normal(m.position[t.v[0]], m.position[t.v[1]], m.position[t.v[2]]);
}

bool covers_once(const Mesh& m, const NearFaces& g, const u8* going, const Trial* trials, u32 n) {
  const View w = view_of(m, trials, n);
  const Seen first = seen(w, m, trials[0].v);
  const Point p = middle_of(first);
  Range x = first.in_x, y = first.in_y, z = heights_of(w, m, trials[0].v);
  if (!faces_up(w, first)) return false;
  for (u32 i = 1; i < n; ++i) {
    const Seen s = seen(w, m, trials[i].v);
    if (!faces_up(w, s) || !is_off(w, s, p)) return false;
    x = united(x, s.in_x), y = united(y, s.in_y), z = united(z, heights_of(w, m, trials[i].v));
  }
  if (!(x.low < p.x && p.x < x.high && y.low < p.y && p.y < y.high)) return false;
  // The slab begins at the heights of the trial faces, and grows while faces reach out of it.
  const f64 margin = margin_by_width * ((x.high - x.low) + (y.high - y.low));
  const Range reach = {z.low - margin, z.high + margin};
  FacesOver over;
  const auto survey = [&](u32 f) {
    const u32* corner = m.corner + 3 * static_cast<size_t>(f);
    const Seen s = seen(w, m, corner);
    if (is_apart(s.in_x, x) || is_apart(s.in_y, y)) return false;
    if (over.count == most_over) return true;
    over.height[over.count] = heights_of(w, m, corner);
    over.covers[over.count++] = !faces_up(w, s) || !is_off(w, s, p);
    return false;
  };
  Vec3 low, high;
  low[w.x] = x.low, low[w.y] = y.low, low[w.z] = reach.low;
  high[w.x] = x.high, high[w.y] = y.high, high[w.z] = reach.high;
  if (find_near(
          g, box_of(low, high, high), [&](u32 f) { return going[f] == 0; }, survey) != none)
    return false;
  return grow_slab(over, z) && reach.low <= z.low && z.high <= reach.high;
}

}  // namespace tpa
