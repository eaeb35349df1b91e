#include "sheet.h"

namespace tpa {

namespace {

// What roundings leave open of lengths relative to them, and of coordinates.
constexpr f32 relative = 0x1p-18f, absolute = 0x1p-21f;

// Directions that are tried: beside an edge the second one looks at both sides of it. More cost more, where the surface
// is rough, than the pairs that they save.
constexpr u32 most_views = 2;

// One, or four in lanes.
template <class T>
struct ArrowOf {
  T x, y, z;
};
using Arrow = ArrowOf<f32>;
template <class T>
ArrowOf<T> operator*(T s, ArrowOf<T> a) { return {s * a.x, s * a.y, s * a.z}; }
template <class T>
ArrowOf<T> operator+(ArrowOf<T> a, ArrowOf<T> b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class T, class U>
ArrowOf<T> operator-(ArrowOf<T> a, ArrowOf<U> b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class T, class U>
U dot(ArrowOf<T> a, ArrowOf<U> b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T>
ArrowOf<T> cross(ArrowOf<T> a, ArrowOf<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Arrow arrow_of(const f32* p) { return {p[0], p[1], p[2]}; }
f32 size_of(Arrow a) { return root_of(dot(a, a)); }
f32 reach_of(Arrow a) { return max_of(magnitude(a.x), max_of(magnitude(a.y), magnitude(a.z))); }
F4 reach_of(ArrowOf<F4> a) { return max4(abs4(a.x), max4(abs4(a.y), abs4(a.z))); }

struct View {
  Arrow middle, normal;
  f32 radius;
};

// Does what is within a radius round `middle` certainly not reach over D?
template <class T>
inline auto is_off(const View& v, ArrowOf<T> middle, T radius) {
  const ArrowOf<T> away = middle - v.middle;
  const T along = dot(v.normal, away), square = dot(away, away);
  const T both = (v.radius + radius) * (1 + relative) + absolute;
  return square * (1 - relative) - along * along > both * both;
}

Arrow point_of(const Clusters& c, u32 vertex) { return arrow_of(c.point + 4 * static_cast<size_t>(vertex)); }

struct Triangle {
  Arrow a, b, c;
};
Triangle triangle_at(const Clusters& c, const Mesh& m, u32 face) {
  const u32* corner = m.corner + 3 * static_cast<size_t>(face);
  return {point_of(c, corner[0]), point_of(c, corner[1]), point_of(c, corner[2])};
}

// Do all faces of the cluster certainly turn up? The part of a face's normal along the cluster's counts with the
// cosine, what is across with the sine.
bool all_turn_up(const View& v, const Outline& o) {
  const Arrow normal = arrow_of(o.normal);
  const f32 cosine = dot(v.normal, normal);
  return cosine > o.slope * (size_of(v.normal - cosine * normal) + relative) + o.doubt + relative;
}

// Four faces in lanes.
struct FourTriangles {
  ArrowOf<F4> a, b, c;
};
FourTriangles triangles_at(const Clusters& c, const Mesh& m, u32 at, u32 last) {
  F4 p[3][3];
  corners_of_four(c, m, at, last, p);
  return {{p[0][0], p[0][1], p[0][2]}, {p[1][0], p[1][1], p[1][2]}, {p[2][0], p[2][1], p[2][2]}};
}

I4 are_off(const View& v, const FourTriangles& t) {
  const ArrowOf<F4> middle = all4(1.0f / 3) * (t.a + t.b + t.c);
  const ArrowOf<F4> a = t.a - middle, b = t.b - middle, c = t.c - middle;
  return reinterpret_cast<I4>(is_off(v, middle, root4(max4(dot(a, a), max4(dot(b, b), dot(c, c))))));
}

// `normal`: what it was told by.
I4 turn_up(const View& v, const FourTriangles& t, ArrowOf<F4>& normal) {
  const ArrowOf<F4> ab = t.b - t.a, ac = t.c - t.a;
  normal = cross(ab, ac);
  return reinterpret_cast<I4>(dot(v.normal, normal) > certain_volume * max4(reach_of(ab), reach_of(ac)));
}

enum class Over { none, up, leaning };

// How faces of a cluster lie over D. Where one leans, `leaning` becomes its normal.
Over faces_over_disc(const Clusters& c, const Mesh& m, const View& v, u32 cluster, Arrow& leaning) {
  if (all_turn_up(v, c.outline[cluster])) return Over::up;
  bool any = false;
  for (u32 at = c.first[cluster], last = c.first[cluster + 1]; at < last; at += 4) {
    const FourTriangles t = triangles_at(c, m, at, last);
    const I4 over = ~are_off(v, t);
    if (bits_of(over) == 0) continue;
    any = true;
    ArrowOf<F4> normal;
    if (const u32 lean = bits_of(over & ~turn_up(v, t, normal)); lean != 0) {
      const u32 i = static_cast<u32>(__builtin_ctz(lean));
      leaning = {normal.x[i], normal.y[i], normal.z[i]};
      return Over::leaning;
    }
  }
  return any ? Over::up : Over::none;
}

// Completes S, which has P; false where it grows too large, or where a face leans, whose normal `leaning` becomes.
// Without `by_faces` clusters are judged as a whole.
bool collect(const Clusters& c, const Mesh& m, const View& v, bool by_faces, Sheet& s, Arrow& leaning) {
  for (u32 i = 0; i < s.count; ++i) {
    const Neighbours& n = c.neighbours[s.cluster[i]];
    if (n.count > Neighbours::capacity) return false;
    for (u32 k = 0; k < n.count; ++k) {
      const u32 other = n.cluster[k];
      const u32 slot = s.slot_of(other);
      if (s.knows(slot)) continue;
      const Outline& o = c.outline[other];
      Over over = Over::none;
      if (!is_off(v, arrow_of(o.middle), o.radius))
        over = by_faces ? faces_over_disc(c, m, v, other, leaning) : all_turn_up(v, o) ? Over::up : Over::leaning;
      if (over == Over::leaning) return false;
      if (!(over == Over::up ? s.put(slot, other) : s.put_beside(slot, other))) return false;
    }
  }
  return true;
}

// Is a face that turns up certainly not over the line through p along the normal?
bool is_beside(const View& v, const Triangle& t, Arrow p) {
  const Arrow corner[] = {t.a, t.b, t.c, t.a};
  for (u32 i = 0; i < 3; ++i) {
    const Arrow edge = corner[i + 1] - corner[i], away = p - corner[i];
    if (dot(v.normal, cross(edge, away)) < -certain_volume * max_of(reach_of(edge), reach_of(away))) return true;
  }
  return false;
}

// A box round the part of the line through p where the cluster may reach over it; empty where it does not.
bool bound_passage(const View& v, const Outline& o, Arrow p, FlatBox& box) {
  if (is_off({p, v.normal, 0}, arrow_of(o.middle), o.radius)) return false;
  const Arrow normal = arrow_of(o.normal);
  const f32 cosine = dot(v.normal, normal), along = dot(v.normal, arrow_of(o.middle) - p);
  const f32 half = (o.thickness * magnitude(cosine) + o.radius * size_of(v.normal - cosine * normal)) * (1 + relative) +
                   (magnitude(along) + o.radius) * relative + absolute;
  const Arrow from = p - (half - along) * v.normal, to = p - (-half - along) * v.normal;
  const f32 a[3] = {from.x, from.y, from.z}, b[3] = {to.x, to.y, to.z};
  for (u32 k = 0; k < 3; ++k) box.low[k] = min_of(a[k], b[k]) - absolute, box.high[k] = max_of(a[k], b[k]) + absolute;
  return true;
}

// The point is amid the first face of this cluster of P, where the search for its patch began, and so amid the others.
// Is it inside D, and no other face of S over what is close to it?
bool is_covered_once(const Clusters& c, const Mesh& m, const View& v, const Sheet& s, u32 from) {
  const u32 face = face_at(c, c.first[from]);
  const Arrow p = arrow_of(c.outline[from].point);
  if (!(size_of(p - v.middle) * (1 + relative) + absolute < v.radius)) return false;
  const ConstBoxLanes boxes = lanes_of(c.box);
  FlatBox passage;
  for (u32 i = 0; i < s.count; ++i) {
    const u32 cluster = s.cluster[i], last = c.first[cluster + 1];
    if (!bound_passage(v, c.outline[cluster], p, passage) || !boxes_meet(node_box(c, cluster), passage)) continue;
    const BroadBox wide = broad(passage);
    for (u32 at = c.first[cluster]; at < last; at += 4)
      for (u32 rest = bits_of(lanes_meeting(boxes, at, wide) & first_lanes(last - at)); rest != 0; rest &= rest - 1) {
        const u32 f = face_at(c, at + static_cast<u32>(__builtin_ctz(rest)));
        if (f != face && !is_beside(v, triangle_at(c, m, f), p)) return false;
      }
  }
  return true;
}

// Looks along the normal of the cluster; where a face is in the way that leans too far, along one between its and that.
bool find_view(const Clusters& c, const Mesh& m, u32 cluster, View& v, Sheet& s) {
  const Outline& o = c.outline[cluster];
  v = {arrow_of(o.middle), arrow_of(o.normal), o.radius};
  for (u32 round = 0; round < most_views; ++round) {
    Arrow leaning{};
    s.clear();
    s.add(cluster);
    if (faces_over_disc(c, m, v, cluster, leaning) == Over::up && collect(c, m, v, true, s, leaning)) return true;
    const f32 size = size_of(leaning);
    if (!(size > 0)) return false;
    const Arrow between = v.normal + (1 / size) * leaning;
    if (!(size_of(between) > 0x1p-4f)) return false;
    v.normal = (1 / size_of(between)) * between;
  }
  return false;
}

// Along the mean of the clusters' normals, at the ball round the middle of theirs.
bool view_all(const Clusters& c, Span<const u32> several, View& v) {
  Arrow sum{}, normal{};
  for (u32 i : several) {
    sum = sum + arrow_of(c.outline[i].middle);
    normal = normal + arrow_of(c.outline[i].normal);
  }
  const f32 size = size_of(normal);
  if (!(size > 0.5f)) return false;
  v = {(1 / static_cast<f32>(several.size)) * sum, (1 / size) * normal, 0};
  for (u32 i : several) {
    const Outline& o = c.outline[i];
    if (!all_turn_up(v, o)) return false;
    v.radius = max_of(v.radius, (size_of(arrow_of(o.middle) - v.middle) + o.radius) * (1 + relative) + absolute);
  }
  return true;
}

}  // namespace

bool find_sheet(const Clusters& c, const Mesh& m, u32 cluster, Sheet& s) {
  View v;
  return find_view(c, m, cluster, v, s) && is_covered_once(c, m, v, s, cluster);
}

bool find_common_sheet(const Clusters& c, const Mesh& m, Span<const u32> several, Sheet& s) {
  View v;
  Arrow leaning;
  if (!view_all(c, several, v)) return false;
  s.clear();
  for (u32 i : several) s.add(i);
  return collect(c, m, v, false, s, leaning) && is_covered_once(c, m, v, s, several[0]);
}

}  // namespace tpa
