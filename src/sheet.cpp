#include "sheet.h"

namespace tpa {

namespace {

// What roundings leave open of lengths relative to them, and of coordinates.
constexpr f32 relative = 0x1p-18f, absolute = 0x1p-21f;

// Directions that are tried: beside an edge the second one looks at both sides of it. More cost more, where the surface
// is rough, than the pairs that they save.
constexpr u32 most_views = 2;

struct Arrow {
  f32 x, y, z;
};
Arrow operator*(f32 s, Arrow a) { return {s * a.x, s * a.y, s * a.z}; }
Arrow operator+(Arrow a, Arrow b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Arrow operator-(Arrow a, Arrow b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
f32 dot(Arrow a, Arrow b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Arrow cross(Arrow a, Arrow b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Arrow arrow_of(const f32* p) { return {p[0], p[1], p[2]}; }
f32 size_of(Arrow a) { return root_of(dot(a, a)); }
f32 reach_of(Arrow a) { return max_of(magnitude(a.x), max_of(magnitude(a.y), magnitude(a.z))); }

struct View {
  Arrow middle, normal;
  f32 radius;
};

// May something within a radius round `middle` reach over D?
inline bool may_reach_over(const View& v, Arrow middle, f32 radius) {
  const Arrow away = middle - v.middle;
  const f32 along = dot(away, v.normal), square = dot(away, away);
  const f32 both = (v.radius + radius) * (1 + relative) + absolute;
  return !(square * (1 - relative) - along * along > both * both);
}

Arrow point_of(const Clusters& c, u32 vertex) { return arrow_of(c.point + 4 * static_cast<size_t>(vertex)); }

struct Triangle {
  Arrow a, b, c;
};
Triangle triangle_at(const Clusters& c, const Mesh& m, u32 face) {
  const u32* corner = m.corner + 3 * static_cast<size_t>(face);
  return {point_of(c, corner[0]), point_of(c, corner[1]), point_of(c, corner[2])};
}
Arrow middle_of(const Triangle& t) { return (1.0f / 3) * (t.a + t.b + t.c); }

// Do all faces of the cluster certainly turn up? The part of a face's normal along the cluster's counts with the
// cosine, what is across with the sine.
bool all_turn_up(const View& v, const Outline& o) {
  const Arrow normal = arrow_of(o.normal);
  const f32 cosine = dot(v.normal, normal);
  return cosine > o.slope * (size_of(v.normal - cosine * normal) + relative) + o.doubt + relative;
}

// `normal`: what it was told by.
bool turns_up(const View& v, const Triangle& t, Arrow& normal) {
  const Arrow ab = t.b - t.a, ac = t.c - t.a;
  normal = cross(ab, ac);
  return dot(v.normal, normal) > certain_volume * max_of(reach_of(ab), reach_of(ac));
}

bool may_reach_over(const View& v, const Triangle& t) {
  const Arrow middle = middle_of(t);
  const Arrow a = t.a - middle, b = t.b - middle, c = t.c - middle;
  return may_reach_over(v, middle, root_of(max_of(dot(a, a), max_of(dot(b, b), dot(c, c)))));
}

enum class Over { none, up, leaning };

// How faces of a cluster lie over D. Where one leans, `leaning` becomes its normal.
Over faces_over_disc(const Clusters& c, const Mesh& m, const View& v, u32 cluster, Arrow& leaning) {
  if (all_turn_up(v, c.outline[cluster])) return Over::up;
  bool any = false;
  for (u32 i = c.first[cluster]; i < c.first[cluster + 1]; ++i) {
    const Triangle t = triangle_at(c, m, face_at(c, i));
    if (!may_reach_over(v, t)) continue;
    if (!turns_up(v, t, leaning)) return Over::leaning;
    any = true;
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
      if (may_reach_over(v, arrow_of(o.middle), o.radius))
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
  if (!may_reach_over({p, v.normal, 0}, arrow_of(o.middle), o.radius)) return false;
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
