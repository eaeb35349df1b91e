#include "detect/cull_clusters.h"

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
template <class S, class T>
ArrowOf<T> operator*(S s, const ArrowOf<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
ArrowOf<T> operator+(const ArrowOf<T>& a, const ArrowOf<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T, class U>
ArrowOf<T> operator-(const ArrowOf<T>& a, const ArrowOf<U>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T, class U>
U dot(const ArrowOf<T>& a, const ArrowOf<U>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
ArrowOf<T> cross(const ArrowOf<T>& a, const ArrowOf<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Arrow arrow_of(const f32* p) { return {p[0], p[1], p[2]}; }
ArrowOf<F4> broad(const Arrow& a) { return {all4(a.x), all4(a.y), all4(a.z)}; }
f32 size_of(const Arrow& a) { return square_root(dot(a, a)); }
F4 size_of(const ArrowOf<F4>& a) { return square_root(dot(a, a)); }
F4 reach_of(const ArrowOf<F4>& a) { return max4(abs_of(a.x), max4(abs_of(a.y), abs_of(a.z))); }

struct View {
  Arrow middle, normal;
  f32 radius;
};

// Does what is within a radius round `middle` certainly not reach over D?
template <class T>
inline auto is_off(const View& v, const ArrowOf<T>& middle, const T& radius) {
  const ArrowOf<T> away = middle - v.middle;
  const T along = dot(v.normal, away), square = dot(away, away);
  const T both = (v.radius + radius) * (1 + relative) + absolute;
  return square * (1 - relative) - along * along > both * both;
}

F4 point_of(const FaceTree& c, u32 vertex) { return load4(c.point + 3 * static_cast<size_t>(vertex)); }

// Do all faces of a cluster certainly turn up? The part of a face's normal along the cluster's counts with the cosine,
// what is across with the sine.
template <class T>
auto all_turn_up(const ArrowOf<T>& along, const ArrowOf<T>& normal, const T& slope, const T& doubt) {
  const T cosine = dot(along, normal);
  return cosine > slope * (size_of(along - cosine * normal) + relative) + doubt + relative;
}
bool all_turn_up(const View& v, const Outline& o) {
  return all_turn_up(v.normal, arrow_of(o.normal), o.slope, o.doubt);
}

// Four faces in lanes.
struct FourTriangles {
  ArrowOf<F4> a, b, c;
};
FourTriangles triangles_at(const FaceTree& c, const Mesh& m, u32 at, u32 last) {
  F4 p[3][3];
  corners_of_four(c, m, at, last, p);
  return {{p[0][0], p[0][1], p[0][2]}, {p[1][0], p[1][1], p[1][2]}, {p[2][0], p[2][1], p[2][2]}};
}

I4 are_off(const View& v, const FourTriangles& t) {
  const ArrowOf<F4> middle = (1.0f / 3) * (t.a + t.b + t.c);
  const ArrowOf<F4> a = t.a - middle, b = t.b - middle, c = t.c - middle;
  return is_off(v, middle, square_root(max4(dot(a, a), max4(dot(b, b), dot(c, c)))));
}

// `normal`: what it was told by.
I4 turn_up(const View& v, const FourTriangles& t, ArrowOf<F4>& normal) {
  const ArrowOf<F4> ab = t.b - t.a, ac = t.c - t.a;
  normal = cross(ab, ac);
  return dot(v.normal, normal) > certain_volume * max4(reach_of(ab), reach_of(ac));
}

enum class Over { none, up, leaning };

// How faces of a cluster lie over D. Where one leans, `leaning` becomes its normal.
Over faces_over_disc(const FaceTree& c, const Mesh& m, const View& v, u32 cluster, Arrow& leaning) {
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

// S while it grows, a point that P covers, and those clusters of S that may be over the point.
struct Growth {
  const FaceTree& c;
  const Mesh& m;
  Sheet& s;
  View v{};
  Arrow point;
  u32 judged = 0;  // of those known
  u32 passed = 0;
  u32 over_point[Sheet::most + 1];

  // The point is in the first face of the cluster.
  Growth(const FaceTree& c_, const Mesh& m_, u32 cluster, Sheet& s_)
      : c(c_), m(m_), s(s_), point(arrow_of(c_.outline[cluster].point)) {}

  void take(u32 at, u32 cluster, u32 is_in, u32 passes) {
    s.take(at, cluster, is_in);
    fetch(c.neighbours + cluster);
    over_point[passed] = cluster;
    passed += is_in & passes;
  }
};

// S is P at first.
void begin(Growth& g, Span<const u32> several) {
  g.s.clear();
  g.passed = 0;
  for (u32 i : several) g.s.note(i);
  for (u32 i = 0; i < g.s.known.count; ++i) g.take(i, g.s.known.cluster[i], 1, 1);
  g.judged = g.s.known.count;
}

// Judges the next four clusters that are known; false where a face leans, whose normal `leaning` becomes. Without
// `by_faces` clusters are judged as a whole.
bool judge_four(Growth& g, bool by_faces, Arrow& leaning) {
  const auto& known = g.s.known;
  const u32 first = g.judged;
  const Four four = four_of(known.cluster, first, known.count);
  g.judged = min_of(first + 4, known.count);
  const FourOutlines o = outlines_of(g.c, four.at);
  const ArrowOf<F4> middle{o.middle[0], o.middle[1], o.middle[2]}, normal{o.normal[0], o.normal[1], o.normal[2]};
  const u32 over = first_bits_of(~is_off(g.v, middle, o.radius), known.count - first);
  if (over == 0) return true;
  F4 slope, doubt;
  for (u32 i = 0; i < 4; ++i) slope[i] = g.c.outline[four.at[i]].slope, doubt[i] = g.c.outline[four.at[i]].doubt;
  const u32 up = bits_of(all_turn_up(broad(g.v.normal), normal, slope, doubt));
  if (!by_faces && (over & ~up) != 0) return false;
  const u32 passing = ~bits_of(is_off({g.point, g.v.normal, 0}, middle, o.radius));
  u32 in = over;
  for (u32 rest = over & ~up; rest != 0; rest &= rest - 1) {
    const u32 i = static_cast<u32>(__builtin_ctz(rest));
    const Over kind = faces_over_disc(g.c, g.m, g.v, four.at[i], leaning);
    if (kind == Over::leaning) return false;
    if (kind == Over::none) in &= ~(1u << i);
  }
  for (u32 i = 0; i < 4; ++i) g.take(first + i, four.at[i], in >> i & 1, passing >> i & 1);
  return true;
}

// Completes S; false where it grows too large, or where a face leans.
bool collect(Growth& g, bool by_faces, Arrow& leaning) {
  Sheet& s = g.s;
  for (u32 i = 0;;) {
    for (; i < s.count; ++i) {
      const Neighbours& n = g.c.neighbours[s.member[i]];
      if (n.count > Neighbours::capacity) return false;
      for (u32 k = 0; k < n.count; ++k)
        if (!s.note(n.cluster[k])) return false;
      while (s.known.count - g.judged >= 4)
        if (!judge_four(g, by_faces, leaning)) return false;
    }
    if (g.judged == s.known.count) return true;
    if (!judge_four(g, by_faces, leaning)) return false;
  }
}

// Is a face that turns up certainly not over the line through p along the normal? Its edges in lanes, the first one
// twice.
bool is_beside(const FaceTree& c, const View& v, const u32* face, const Arrow& p) {
  F4 x = point_of(c, face[0]), y = point_of(c, face[1]), z = point_of(c, face[2]), rest = x;
  transpose(x, y, z, rest);
  const auto turned = [](const F4& a) { return shuffled<1, 2, 0, 1>(a, a); };
  const ArrowOf<F4> corner{x, y, z}, next{turned(x), turned(y), turned(z)};
  const ArrowOf<F4> edge = next - corner, away = broad(p) - corner;
  const F4 doubt = certain_volume * max4(reach_of(edge), reach_of(away));
  return bits_of(dot(v.normal, cross(edge, away)) < -doubt) != 0;
}

// A box round the part of the line through p where the cluster may reach over it; empty where it does not.
bool bound_passage(const View& v, const Outline& o, const Arrow& p, Box& box) {
  if (is_off({p, v.normal, 0}, arrow_of(o.middle), o.radius)) return false;
  const Arrow normal = arrow_of(o.normal);
  const f32 cosine = dot(v.normal, normal), along = dot(v.normal, arrow_of(o.middle) - p) + cosine * o.level;
  const f32 half = (o.thickness * abs_of(cosine) + o.radius * size_of(v.normal - cosine * normal)) * (1 + relative) +
                   (abs_of(along) + o.radius) * relative + absolute;
  const Arrow from = p - (half - along) * v.normal, to = p - (-half - along) * v.normal;
  const f32 a[3] = {from.x, from.y, from.z}, b[3] = {to.x, to.y, to.z};
  for (u32 k = 0; k < 3; ++k) box.low[k] = min_of(a[k], b[k]) - absolute, box.high[k] = max_of(a[k], b[k]) + absolute;
  return true;
}

// The point is amid a face of P, where the search for a patch began, and so amid others. Is it inside D, and no other
// face of S over what is close to it?
bool is_covered_once(const Growth& g, u32 face) {
  const FaceTree& c = g.c;
  const View& v = g.v;
  if (!(size_of(g.point - v.middle) * (1 + relative) + absolute < v.radius)) return false;
  Box passage{};
  for (u32 i = 0; i < g.passed; ++i) {
    const u32 cluster = g.over_point[i], last = c.first[cluster + 1];
    if (!bound_passage(v, c.outline[cluster], g.point, passage) || !boxes_meet(node_box(c, cluster), passage)) continue;
    const ByteBox box = byte_box(c.byte_frame[cluster], passage);
    const auto is_clear = [&](u32 place) {
      const u32 f = face_at(c, place);
      return f == face || is_beside(c, v, g.m.corner + 3 * static_cast<size_t>(f), g.point);
    };
    if (!for_each_meeting(c.box, c.first[cluster], last, box, is_clear)) return false;
  }
  return true;
}

// Looks along the normal of the cluster; where a face is in the way that leans too far, along one between its and that.
bool find_view(Growth& g, u32 cluster) {
  const Outline& o = g.c.outline[cluster];
  g.v = {arrow_of(o.middle), arrow_of(o.normal), o.radius};
  for (u32 round = 0; round < most_views; ++round) {
    Arrow leaning{};
    begin(g, {&cluster, 1});
    if ((all_turn_up(g.v, o) || faces_over_disc(g.c, g.m, g.v, cluster, leaning) == Over::up) &&
        collect(g, true, leaning))
      return true;
    const f32 size = size_of(leaning);
    if (!(size > 0)) return false;
    const Arrow between = g.v.normal + (1 / size) * leaning;
    if (!(size_of(between) > 0x1p-4f)) return false;
    g.v.normal = (1 / size_of(between)) * between;
  }
  return false;
}

// Along the mean of the clusters' normals, at the ball round the middle of theirs.
bool view_all(const FaceTree& c, Span<const u32> several, View& v) {
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

bool find_sheet(const FaceTree& c, const Mesh& m, u32 cluster, Sheet& s) {
  Growth g(c, m, cluster, s);
  return find_view(g, cluster) && is_covered_once(g, face_at(c, c.first[cluster]));
}

bool find_common_sheet(const FaceTree& c, const Mesh& m, Span<const u32> several, Sheet& s) {
  Growth g(c, m, several[0], s);
  Arrow leaning;
  if (!view_all(c, several, g.v)) return false;
  begin(g, several);
  return collect(g, false, leaning) && is_covered_once(g, face_at(c, c.first[several[0]]));
}

}  // namespace tpa
