// SPDX-License-Identifier: MIT
#include "detect/cull_new_faces.h"

#include "mesh/projection.h"

namespace tpa {

namespace {

// The slab may reach beyond the trial faces by their width and depth together. Neighbours as large as the trial faces
// then stay within on slopes of one in one, and nearly on slopes of tan 54.7 degrees, the steepest in a view along an
// axis.
constexpr f64 margin_by_width = 1;

// A view along the axis that shows the most area of the trial faces.
View view_of(const Mesh& m, const FaceCorners* trials, u32 n) {
  Vec3 sum;
  for (u32 i = 0; i < n; ++i) sum = sum + normal_of(m, trials[i]);
  return view_along(sum);
}

Range heights_of(const View& w, const Mesh& m, const u32* corner) {
  return range_of({m.position[corner[0]][w.z], m.position[corner[1]][w.z], m.position[corner[2]][w.z]});
}

// Trial faces as seen along an axis: the rectangle R and the heights that bound them, and a point inside the first.
struct SeenTrials {
  View view;
  Point point;
  Range x, y, z;
};

// False if a trial face may not face up, or if the point may be outside R or covered by more than the first face.
bool see_trials(const Mesh& m, const FaceCorners* trials, u32 n, SeenTrials& s) {
  s.view = view_of(m, trials, n);
  const Seen first = seen(s.view, m, trials[0].v);
  s.point = middle_of(first);
  s.x = first.in_x, s.y = first.in_y, s.z = heights_of(s.view, m, trials[0].v);
  if (!faces_up(s.view, first)) return false;
  for (u32 i = 1; i < n; ++i) {
    const Seen other = seen(s.view, m, trials[i].v);
    if (!faces_up(s.view, other) || !is_off(s.view, other, s.point)) return false;
    s.x = united(s.x, other.in_x), s.y = united(s.y, other.in_y);
    s.z = united(s.z, heights_of(s.view, m, trials[i].v));
  }
  return s.x.low < s.point.x && s.point.x < s.x.high && s.y.low < s.point.y && s.point.y < s.y.high;
}

// Faces over R: their heights, and whether a face breaks the proof, since it may lean or cover the point.
constexpr u32 most_over = 64;
struct FacesOver {
  u32 count;
  Range height[most_over];
  bool breaks[most_over];
};

static_assert(sizeof(FacesOver) <= trial_room_bytes);

// Collects the faces over R within a range of heights, except going faces; false if there are too many.
bool collect_faces(const Mesh& m, const NearFaces& g, const u8* going, const SeenTrials& s, const Range& reach,
                   FacesOver& over) {
  const View& view = s.view;
  const auto is_too_many = [&](u32 f) {
    const u32* corner = m.corner + 3 * static_cast<size_t>(f);
    const Seen face = seen(view, m, corner);
    if (is_apart(face.in_x, s.x) || is_apart(face.in_y, s.y)) return false;
    if (over.count == most_over) return true;
    over.height[over.count] = heights_of(view, m, corner);
    over.breaks[over.count++] = !faces_up(view, face) || !is_off(view, face, s.point);
    return false;
  };
  Vec3 low, high;
  low[view.x] = s.x.low, low[view.y] = s.y.low, low[view.z] = reach.low;
  high[view.x] = s.x.high, high[view.y] = s.y.high, high[view.z] = reach.high;
  const auto stays = [&](u32 f) { return going[f] == 0; };
  return find_near(g, box_of(low, high, high), stays, is_too_many) == none;
}

// Extends the slab until no face reaches out of it; false if a face in the slab breaks the proof.
bool grow_slab(FacesOver& over, Range& slab) {
  for (u32 i = 0; i < over.count;) {
    if (is_apart(over.height[i], slab)) {
      ++i;
      continue;
    }
    if (over.breaks[i]) return false;
    const Range grown = united(slab, over.height[i]);
    const bool grows = grown.low < slab.low || grown.high > slab.high;
    slab = grown;
    over.height[i] = over.height[--over.count], over.breaks[i] = over.breaks[over.count];
    if (grows) i = 0;
  }
  return true;
}

}  // namespace

Vec3 normal_of(const Mesh& m, const FaceCorners& t) {
  return area_normal(m.position[t.v[0]], m.position[t.v[1]], m.position[t.v[2]]);
}

bool covers_once(const Mesh& m, const NearFaces& g, const u8* going, const FaceCorners* trials, u32 n) {
  SeenTrials s;
  if (!see_trials(m, trials, n, s)) return false;
  const f64 margin = margin_by_width * ((s.x.high - s.x.low) + (s.y.high - s.y.low));
  const Range reach = {s.z.low - margin, s.z.high + margin};
  FacesOver& over = *reinterpret_cast<FacesOver*>(g.tree->trial_room);
  over.count = 0;
  if (!collect_faces(m, g, going, s, reach, over)) return false;
  // The slab begins at the heights of the trial faces, and grows while faces reach out of it.
  Range slab = s.z;
  return grow_slab(over, slab) && reach.low <= slab.low && slab.high <= reach.high;
}

}  // namespace tpa
