// SPDX-License-Identifier: MIT
#include "detect/cull_leaves.h"

namespace tpa {

namespace {

// Bounds on errors of rounding: relative to a length, and of a coordinate in tree units.
constexpr f32 relative = 0x1p-18f, absolute = 0x1p-21f;

// Directions tried for a leaf. Beside a sharp edge of the body, the second direction sees both sides of the edge. On
// rough surfaces further directions cost more than the proofs save.
constexpr u32 most_views = 2;

// A vector in single precision, or four in lanes.
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

// A direction d, and the disc D across d.
struct DiscView {
  Arrow middle, normal;
  f32 radius;
};

// Is the ball round `middle` certainly not over D?
template <class T>
inline auto is_off(const DiscView& v, const ArrowOf<T>& middle, const T& radius) {
  const ArrowOf<T> away = middle - v.middle;
  const T along = dot(v.normal, away), square = dot(away, away);
  const T both = (v.radius + radius) * (1 + relative) + absolute;
  return square * (1 - relative) - along * along > both * both;
}

F4 point_of(const FaceTree& tree, u32 vertex) { return load4(tree.point + 3 * static_cast<size_t>(vertex)); }

// Do all faces of a leaf certainly turn up, seen along `along`? `normal`, slope and doubt are of the leaf's Outline. A
// face's normal is `normal` and a vector across of length `slope` at most. The first counts with the cosine of the
// angle between `along` and `normal`, the second at most with the sine.
template <class T>
auto all_turn_up(const ArrowOf<T>& along, const ArrowOf<T>& normal, const T& slope, const T& doubt) {
  const T cosine = dot(along, normal);
  return cosine > slope * (size_of(along - cosine * normal) + relative) + doubt + relative;
}
bool all_turn_up(const DiscView& v, const Outline& o) {
  return all_turn_up(v.normal, arrow_of(o.normal), o.slope, o.doubt);
}

// Four faces in lanes.
struct FourTriangles {
  ArrowOf<F4> a, b, c;
};
FourTriangles triangles_at(const FaceTree& tree, const Mesh& m, u32 at, u32 last) {
  F4 p[3][3];
  corners_of_four(tree, m, at, last, p);
  return {{p[0][0], p[0][1], p[0][2]}, {p[1][0], p[1][1], p[1][2]}, {p[2][0], p[2][1], p[2][2]}};
}

I4 are_off(const DiscView& v, const FourTriangles& t) {
  const ArrowOf<F4> middle = (1.0f / 3) * (t.a + t.b + t.c);
  const ArrowOf<F4> a = t.a - middle, b = t.b - middle, c = t.c - middle;
  return is_off(v, middle, square_root(max4(dot(a, a), max4(dot(b, b), dot(c, c)))));
}

// `normal` becomes the normals of the faces.
I4 turn_up(const DiscView& v, const FourTriangles& t, ArrowOf<F4>& normal) {
  const ArrowOf<F4> ab = t.b - t.a, ac = t.c - t.a;
  normal = cross(ab, ac);
  return dot(v.normal, normal) > certain_volume * max4(reach_of(ab), reach_of(ac));
}

// Of the faces over D: there are none; all turn up; a face leans, and may not turn up.
enum class OverDisc { none, up, leaning };

// How the faces of a leaf lie over D. If one leans, `leaning` becomes the normal of the first such face.
OverDisc faces_over_disc(const FaceTree& tree, const Mesh& m, const DiscView& v, u32 leaf, Arrow& leaning) {
  bool any = false;
  for (u32 at = tree.first[leaf], last = tree.first[leaf + 1]; at < last; at += 4) {
    const FourTriangles t = triangles_at(tree, m, at, last);
    const I4 over = ~are_off(v, t);
    if (bits_of(over) == 0) continue;
    any = true;
    ArrowOf<F4> normal;
    if (const u32 lean = bits_of(over & ~turn_up(v, t, normal)); lean != 0) {
      const u32 i = static_cast<u32>(__builtin_ctz(lean));
      leaning = {normal.x[i], normal.y[i], normal.z[i]};
      return OverDisc::leaning;
    }
  }
  return any ? OverDisc::up : OverDisc::none;
}

// S as it grows, a point in a face of P, and the leaves of S that may lie over the point.
struct NeighbourhoodSearch {
  const FaceTree& tree;
  const Mesh& m;
  Neighbourhood& found;
  DiscView v{};
  Arrow point;
  u32 judged = 0;  // the first leaves of found.known, judged already
  u32 passed = 0;
  u32 over_point[Neighbourhood::most + 1];  // `passed` leaves

  // The point is in the first face of `leaf`, a leaf of P.
  NeighbourhoodSearch(const FaceTree& of_tree, const Mesh& mesh, u32 leaf, Neighbourhood& neighbourhood)
      : tree(of_tree), m(mesh), found(neighbourhood), point(arrow_of(of_tree.outline[leaf].point)) {}

  void take(u32 at, u32 leaf, u32 is_in, u32 passes) {
    found.take(at, leaf, is_in);
    fetch(tree.adjacent + leaf);
    over_point[passed] = leaf;
    passed += is_in & passes;
  }
};

// Begins with P as S.
void begin(NeighbourhoodSearch& s, Span<const u32> several) {
  s.found.clear();
  s.passed = 0;
  for (u32 i : several) s.found.note(i);
  for (u32 i = 0; i < s.found.known.count; ++i) s.take(i, s.found.known.leaf[i], 1, 1);
  s.judged = s.found.known.count;
}

// Judges the next four known leaves: a leaf over D joins S. False if a face leans, with its normal in `leaning`.
// Without `by_faces`, leaves are judged as wholes only, and `leaning` stays as it is.
bool judge_four(NeighbourhoodSearch& s, bool by_faces, Arrow& leaning) {
  const auto& known = s.found.known;
  const u32 first = s.judged;
  const Four four = four_of(known.leaf, first, known.count);
  s.judged = min_of(first + 4, known.count);
  const FourOutlines o = outlines_of(s.tree, four.at);
  const ArrowOf<F4> middle{o.middle[0], o.middle[1], o.middle[2]}, normal{o.normal[0], o.normal[1], o.normal[2]};
  const u32 over = first_bits_of(~is_off(s.v, middle, o.radius), known.count - first);
  if (over == 0) return true;
  F4 slope, doubt;
  for (u32 i = 0; i < 4; ++i) slope[i] = s.tree.outline[four.at[i]].slope, doubt[i] = s.tree.outline[four.at[i]].doubt;
  const u32 up = bits_of(all_turn_up(broad(s.v.normal), normal, slope, doubt));
  if (!by_faces && (over & ~up) != 0) return false;
  const u32 passing = ~bits_of(is_off({s.point, s.v.normal, 0}, middle, o.radius));
  u32 in = over;
  for (u32 rest = over & ~up; rest != 0; rest &= rest - 1) {
    const u32 i = static_cast<u32>(__builtin_ctz(rest));
    const OverDisc kind = faces_over_disc(s.tree, s.m, s.v, four.at[i], leaning);
    if (kind == OverDisc::leaning) return false;
    if (kind == OverDisc::none) in &= ~(1u << i);
  }
  for (u32 i = 0; i < 4; ++i) s.take(first + i, four.at[i], in >> i & 1, passing >> i & 1);
  return true;
}

// Completes S; false if S grows too large, or if a face leans.
bool collect(NeighbourhoodSearch& s, bool by_faces, Arrow& leaning) {
  Neighbourhood& found = s.found;
  for (u32 i = 0;;) {
    for (; i < found.count; ++i) {
      const AdjacentLeaves& n = s.tree.adjacent[found.member[i]];
      if (n.count > AdjacentLeaves::capacity) return false;
      for (u32 k = 0; k < n.count; ++k)
        if (!found.note(n.leaf[k])) return false;
      while (found.known.count - s.judged >= 4)
        if (!judge_four(s, by_faces, leaning)) return false;
    }
    if (s.judged == found.known.count) return true;
    if (!judge_four(s, by_faces, leaning)) return false;
  }
}

// Does a face certainly not cover the point p, seen along d? Pre: the face turns up. Lanes: the three edges, and the
// first edge again.
bool is_beside(const FaceTree& tree, const DiscView& v, const u32* face, const Arrow& p) {
  F4 x = point_of(tree, face[0]), y = point_of(tree, face[1]), z = point_of(tree, face[2]), rest = x;
  transpose(x, y, z, rest);
  const auto turned = [](const F4& a) { return shuffled<1, 2, 0, 1>(a, a); };
  const ArrowOf<F4> corner{x, y, z}, next{turned(x), turned(y), turned(z)};
  const ArrowOf<F4> edge = next - corner, away = broad(p) - corner;
  const F4 doubt = certain_volume * max4(reach_of(edge), reach_of(away));
  return bits_of(dot(v.normal, cross(edge, away)) < -doubt) != 0;
}

// Bounds the part of the line through p along d where a leaf may reach over p; false if the leaf certainly does not.
bool bound_passage(const DiscView& v, const Outline& o, const Arrow& p, Box& box) {
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

// Condition (2) for the point: is the point certainly inside D, with no face of S over it or close to it but `face`?
// The point is in the middle of `face`. Buds grow from their first faces, so the point is near the middle of the leaf,
// too.
bool is_covered_once(const NeighbourhoodSearch& s, u32 face) {
  const FaceTree& tree = s.tree;
  const DiscView& v = s.v;
  if (!(size_of(s.point - v.middle) * (1 + relative) + absolute < v.radius)) return false;
  Box passage{};
  for (u32 i = 0; i < s.passed; ++i) {
    const u32 leaf = s.over_point[i], last = tree.first[leaf + 1];
    if (!bound_passage(v, tree.outline[leaf], s.point, passage) || !boxes_meet(node_box(tree, leaf), passage)) continue;
    const QuantizedBox box = byte_box(tree.byte_frame[leaf], passage);
    const auto is_clear = [&](u32 place) {
      const u32 f = face_at(tree, place);
      return f == face || is_beside(tree, v, s.m.corner + 3 * static_cast<size_t>(f), s.point);
    };
    if (!for_each_meeting(tree.box, tree.first[leaf], last, box, is_clear)) return false;
  }
  return true;
}

// Looks along the normal of the leaf; if a face leans, then along the mean of this normal and the normal of the face.
bool find_view(NeighbourhoodSearch& s, u32 leaf) {
  const Outline& o = s.tree.outline[leaf];
  s.v = {arrow_of(o.middle), arrow_of(o.normal), o.radius};
  for (u32 round = 0; round < most_views; ++round) {
    Arrow leaning{};
    begin(s, {&leaf, 1});
    if ((all_turn_up(s.v, o) || faces_over_disc(s.tree, s.m, s.v, leaf, leaning) == OverDisc::up) &&
        collect(s, true, leaning))
      return true;
    const f32 size = size_of(leaning);
    if (!(size > 0)) return false;
    const Arrow between = s.v.normal + (1 / size) * leaning;
    if (!(size_of(between) > 0x1p-4f)) return false;
    s.v.normal = (1 / size_of(between)) * between;
  }
  return false;
}

// Looks along the mean normal of several leaves at a disc round the mean of their middles; false if a face may lean.
bool view_all(const FaceTree& tree, Span<const u32> several, DiscView& v) {
  Arrow sum{}, normal{};
  for (u32 i : several) {
    sum = sum + arrow_of(tree.outline[i].middle);
    normal = normal + arrow_of(tree.outline[i].normal);
  }
  const f32 size = size_of(normal);
  if (!(size > 0.5f)) return false;
  v = {(1 / static_cast<f32>(several.size)) * sum, (1 / size) * normal, 0};
  for (u32 i : several) {
    const Outline& o = tree.outline[i];
    if (!all_turn_up(v, o)) return false;
    v.radius = max_of(v.radius, (size_of(arrow_of(o.middle) - v.middle) + o.radius) * (1 + relative) + absolute);
  }
  return true;
}

}  // namespace

bool find_neighbourhood(const FaceTree& tree, const Mesh& m, u32 leaf, Neighbourhood& found) {
  NeighbourhoodSearch s(tree, m, leaf, found);
  return find_view(s, leaf) && is_covered_once(s, face_at(tree, tree.first[leaf]));
}

bool find_common_neighbourhood(const FaceTree& tree, const Mesh& m, Span<const u32> several, Neighbourhood& found) {
  NeighbourhoodSearch s(tree, m, several[0], found);
  Arrow leaning;
  if (!view_all(tree, several, s.v)) return false;
  begin(s, several);
  return collect(s, false, leaning) && is_covered_once(s, face_at(tree, tree.first[several[0]]));
}

}  // namespace tpa
