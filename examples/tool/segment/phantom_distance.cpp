// SPDX-License-Identifier: MIT
// phantom_distance: distance to the exact surface of a phantom. The surface consists of the parts of primitive surfaces
// outside the other primitives, bounded by the seams of two primitives. A point's nearest surface point is therefore
// its projection on a primitive, if that part of the primitive belongs to the surface, or else a point of a seam.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tool/segment/phantom_shapes.h"

namespace tool {

namespace {

using Point = std::array<double, 3>;

double length(double a, double b) { return std::sqrt(a * a + b * b); }
double length(const Point& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]); }
double distance(const Point& p, const Point& q) { return length({p[0] - q[0], p[1] - q[1], p[2] - q[2]}); }

// For a point without a unique projection (an axis, a centre) a point this near serves; distances are continuous.
constexpr double tiny = 1e-9;

double distance_to_segment(const Point& p, const double* a, const double* b) {
  double along = 0, squared = 0;
  for (size_t i = 0; i < 3; ++i) {
    along += (p[i] - a[i]) * (b[i] - a[i]);
    squared += (b[i] - a[i]) * (b[i] - a[i]);
  }
  const double t = squared > 0 ? std::clamp(along / squared, 0.0, 1.0) : 0.0;
  return distance(p, {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
}

double distance_to_seam(const Phantom& phantom, const Point& p) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t line = 0; line + 1 < phantom.seam_starts.size(); ++line) {
    for (size_t i = phantom.seam_starts[line]; i + 1 < phantom.seam_starts[line + 1]; ++i) {
      least = std::min(least, distance_to_segment(p, &phantom.seam[3 * i], &phantom.seam[3 * i + 3]));
    }
  }
  return least;
}

// Cube minus ball. The seams are the circles in which the ball meets the six faces.
double distance_to_cube_cavity(const Point& p) {
  const double circle = std::sqrt(cavity_radius * cavity_radius - cube_half * cube_half);
  double least = std::numeric_limits<double>::infinity();
  for (size_t axis = 0; axis < 3; ++axis) {
    const double u = p[(axis + 1) % 3], v = p[(axis + 2) % 3], in_plane = length(u, v);
    const double off_plane = std::fabs(p[axis]) - cube_half;  // by symmetry the nearer of two opposite faces
    if (in_plane <= circle) {
      least = std::min(least, length(off_plane, circle - in_plane));
    } else {
      const double beyond_u = std::max(std::fabs(u) - cube_half, 0.0);
      const double beyond_v = std::max(std::fabs(v) - cube_half, 0.0);
      least = std::min(least, length({off_plane, beyond_u, beyond_v}));
      least = std::min(least, length(off_plane, in_plane - circle));
    }
  }
  const double r = length(p);
  const Point direction = r > tiny ? Point{p[0] / r, p[1] / r, p[2] / r} : Point{0.6, 0.6, 0.529150262212918};
  const double on_ball = cavity_radius;
  if (cube_level(on_ball * direction[0], on_ball * direction[1], on_ball * direction[2], cube_half) <= 0) {
    least = std::min(least, std::fabs(r - cavity_radius));
  }
  return least;
}

// The nearest point of a torus round the coordinate axis `axis`.
Point project_on_torus(const Point& p, size_t axis, double ring, double tube) {
  const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  double radial = length(p[u], p[v]);
  const double cosine = radial > tiny ? p[u] / radial : 1.0, sine = radial > tiny ? p[v] / radial : 0.0;
  double off_ring = radial - ring, height = p[axis];
  double to_ring = length(off_ring, height);
  if (to_ring < tiny) {
    off_ring = to_ring = tiny;
    height = 0;
  }
  radial = ring + tube * off_ring / to_ring;
  Point q;
  q[u] = radial * cosine;
  q[v] = radial * sine;
  q[axis] = tube * height / to_ring;
  return q;
}

double torus_level_at(const Point& p, size_t axis, double ring, double tube) {
  const double u = p[(axis + 1) % 3], v = p[(axis + 2) % 3];
  return torus_level(u * u + v * v, p[axis], ring, tube);
}

double distance_to_tori(const Phantom& phantom, const Point& p) {
  double least = distance_to_seam(phantom, p);
  for (size_t axis = 0; axis < 2; ++axis) {
    Point moved = p;  // off the axis and the ring, where a circle of points is nearest and some may be covered
    if (length(p[(axis + 1) % 3], p[(axis + 2) % 3]) < tiny) moved[1 - axis] = 1e-6;
    const Point q = project_on_torus(moved, axis, tori_ring, tori_tube);
    if (torus_level_at(q, 1 - axis, tori_ring, tori_tube) >= 0) least = std::min(least, distance(p, q));
  }
  return least;
}

// The balls lie within the tube, clear of its surface.
double distance_to_nested(const Point& p) {
  double least = distance(p, project_on_torus(p, 2, nested_ring, nested_tube));
  const double u = std::fabs(p[0]), v = std::fabs(p[1]);
  least = std::min(least, std::fabs(length({u - nested_ring, v, p[2]}) - nested_ball));
  return std::min(least, std::fabs(length({u, v - nested_ring, p[2]}) - nested_ball));
}

// Nearest point of an axis-parallel ellipsoid about the origin (Eberly, "Distance from a Point to an Ellipse, an
// Ellipsoid, or a Hyperellipsoid"): x_i = a_i^2 p_i / (t + a_i^2), where t solves sum (x_i / a_i)^2 = 1. The unknown
// here is s = t + least a_i^2 > 0, whose digits survive near 0.
Point project_on_ellipsoid(const Point& p, const double (&axes)[3]) {
  const double least_axis = std::min({axes[0], axes[1], axes[2]});
  Point q;
  const auto excess_at = [&](double s) {
    double sum = -1;
    for (size_t i = 0; i < 3; ++i) {
      const double a = axes[i];
      q[i] = a * a * std::max(std::fabs(p[i]), tiny) / (s + (a - least_axis) * (a + least_axis));
      sum += (q[i] / a) * (q[i] / a);
    }
    return sum;
  };
  double low = 0, high = least_axis * least_axis;
  while (excess_at(high) > 0) high *= 2;
  for (int halving = 0; halving < 200 && low < high; ++halving) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (excess_at(middle) > 0 ? low : high) = middle;
  }
  excess_at(high);
  for (size_t i = 0; i < 3; ++i) q[i] = std::copysign(q[i], p[i]);
  return q;
}

// Ellipsoid minus rod. A point whose nearest ellipsoid point is in the hole is nearest to the rod's wall or
// to a seam.
double distance_to_cyst(const Phantom& phantom, const Point& p) {
  double least = distance_to_seam(phantom, p);
  const Point q = project_on_ellipsoid(p, cyst_axes);
  if (ball_level(q[0], 0, q[2], rod_radius) >= 0) least = std::min(least, distance(p, q));
  const double radial = length(p[0], p[2]);
  const double cosine = radial > tiny ? p[0] / radial : 1.0, sine = radial > tiny ? p[2] / radial : 0.0;
  if (ellipsoid_level(rod_radius * cosine, p[1], rod_radius * sine, cyst_axes) <= 0) {
    least = std::min(least, std::fabs(radial - rod_radius));
  }
  return least;
}

constexpr int seam_segments = 512;

void end_polyline(Phantom& phantom) { phantom.seam_starts.push_back(phantom.seam.size() / 3); }

// Two tori with the same measures meet where their distances to the axes are equal: in the planes x = y and x
// = -y. With x = tube sin(a) there, the first torus gives z^2 = (ring + tube cos(a))^2 - x^2. One closed
// curve for each pole and plane.
void trace_tori(Phantom& phantom) {
  for (const double pole : {1.0, -1.0}) {
    for (const double plane : {1.0, -1.0}) {
      for (int i = 0; i <= seam_segments; ++i) {
        const double a = 2 * std::numbers::pi * i / seam_segments;
        const double x = tori_tube * std::sin(a), rho = tori_ring + tori_tube * std::cos(a);
        phantom.seam.insert(phantom.seam.end(), {x, plane * x, pole * std::sqrt(rho * rho - x * x)});
      }
      end_polyline(phantom);
    }
  }
}

void trace_rod_ends(Phantom& phantom) {
  for (const double end : {1.0, -1.0}) {
    for (int i = 0; i <= seam_segments; ++i) {
      const double a = 2 * std::numbers::pi * i / seam_segments;
      const double x = rod_radius * std::cos(a), z = rod_radius * std::sin(a);
      const double rest = -ellipsoid_level(x, 0, z, cyst_axes);
      phantom.seam.insert(phantom.seam.end(), {x, end * cyst_axes[1] * std::sqrt(rest), z});
    }
    end_polyline(phantom);
  }
}

}  // namespace

void trace_seam(Phantom& phantom) {
  phantom.seam.clear();
  phantom.seam_starts = {0};
  if (phantom.shape == PhantomShape::genus_3) trace_tori(phantom);
  if (phantom.shape == PhantomShape::cyst) trace_rod_ends(phantom);
}

double distance_to_surface(const Phantom& phantom, double x, double y, double z) {
  switch (phantom.shape) {
    case PhantomShape::cube_cavity: return distance_to_cube_cavity({x - cube_centre, y - cube_centre, z - cube_centre});
    case PhantomShape::genus_3: return distance_to_tori(phantom, {x - tori_centre, y - tori_centre, z - tori_centre});
    case PhantomShape::torus_nested:
      return distance_to_nested({x - nested_centre, y - nested_centre, z - nested_centre});
    case PhantomShape::cyst:
      return distance_to_cyst(phantom, {x - cyst_centre[0], y - cyst_centre[1], z - cyst_centre[2]});
  }
  return 0;
}

}  // namespace tool
