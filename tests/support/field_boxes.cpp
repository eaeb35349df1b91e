// SPDX-License-Identifier: MIT
// Field meshes of boxes, prisms and plates, with sides in one plane, or all but in one plane.
#include <algorithm>
#include <cmath>

#include "support/field_meshes.h"
#include "support/field_shapes.h"
#include "support/tangle_shapes.h"
#include "tool/scenes/elementary.h"

namespace support {

namespace {

// With one of the ways to cut its sides in two.
Mesh BoxOfTwelve(const Point& low, const Point& high, Random& random) {
  const Mesh unit = QuarterTurned(Box({-1, -1, -1}, {1, 1, 1}, 1), WholeIn(random, 0, 23));
  return Mapped(unit, [&](const Point& p) {
    return Point{p[0] < 0 ? low[0] : high[0], p[1] < 0 ? low[1] : high[1], p[2] < 0 ? low[2] : high[2]};
  });
}

struct Corners {
  Point low, high;
};

// Of whole numbers up to `grid`.
Corners WholeBox(int grid, int longest, Random& random) {
  Corners c;
  for (size_t i = 0; i < 3; ++i) {
    const int side = WholeIn(random, 1, longest);
    c.low[i] = WholeIn(random, 0, grid - side);
    c.high[i] = c.low[i] + side;
  }
  return c;
}

Mesh BoxesOnGrid(Random& random) {
  std::vector<Mesh> parts;
  const int grid = WholeIn(random, 3, 6);
  for (int n = WholeIn(random, 2, 12); n > 0; --n) {
    const Corners c = WholeBox(grid, 3, random);
    parts.push_back(BoxOfTwelve(c.low, c.high, random));
  }
  return Renumbered(Together(parts), random);
}

Mesh FineBoxesOnGrid(Random& random) {
  std::vector<Mesh> parts;
  const int grid = WholeIn(random, 3, 5);
  for (int n = WholeIn(random, 2, 8); n > 0; --n) {
    const Corners c = WholeBox(grid, 3, random);
    const int per_unit = WholeIn(random, 1, 4);
    std::array<int, 3> counts;
    for (size_t i = 0; i < 3; ++i) counts[i] = per_unit * static_cast<int>(c.high[i] - c.low[i]);
    parts.push_back(Block(c.low, c.high, counts));
  }
  return Renumbered(Together(parts), random);
}

// Some boxes are inside out, and take away what they overlap.
Mesh SignedBoxesOnGrid(Random& random) {
  std::vector<Mesh> parts = {BoxOfTwelve({0, 0, 0}, {4, 4, 4}, random)};
  for (int n = WholeIn(random, 1, 8); n > 0; --n) {
    const Corners c = WholeBox(6, 4, random);
    const Mesh box = BoxOfTwelve(c.low, c.high, random);
    parts.push_back(WholeIn(random, 0, 2) == 0 ? Reversed(box) : box);
  }
  return Renumbered(Together(parts), random);
}

// Columns of whole heights side by side.
Outline Stairs(Random& random) {
  Outline p = {{0, 0}};
  const int columns = WholeIn(random, 2, 5);
  p.push_back({1.0 * columns, 0});
  int last = 0;
  for (int i = columns; i > 0; --i) {
    const int height = WholeIn(random, 1, 4);
    if (height == last) {
      p.back()[0] -= 1;
      continue;
    }
    p.push_back({1.0 * i, 1.0 * height});
    p.push_back({1.0 * (i - 1), 1.0 * height});
    last = height;
  }
  return p;
}

// Drops corners between two collinear edges.
Outline WithoutFlatCorners(Outline p) {
  for (size_t i = 0; i < p.size() && p.size() > 3;) {
    const Flat &a = p[(i + p.size() - 1) % p.size()], &b = p[i], &c = p[(i + 1) % p.size()];
    if ((b[0] - a[0]) * (c[1] - b[1]) == (b[1] - a[1]) * (c[0] - b[0])) {
      p.erase(p.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    } else {
      ++i;
    }
  }
  return p;
}

// Corners of the grid in the order of their directions from a point that lies on no line of the grid.
Outline StarOfWholeNumbers(Random& random) {
  for (;;) {
    std::vector<std::pair<double, Flat>> corners;
    for (int n = WholeIn(random, 4, 9); n > 0; --n) {
      const double x = WholeIn(random, 0, 5), y = WholeIn(random, 0, 5);
      corners.push_back({tool::arc_tangent(y - 2.4142, x - 2.5773), {x, y}});
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    bool is_round = corners.size() >= 3;
    Outline p;
    for (size_t i = 0; i < corners.size(); ++i) {
      const double next = i + 1 < corners.size() ? corners[i + 1].first : corners[0].first + 2 * pi;
      is_round = is_round && next - corners[i].first > 1e-6 && next - corners[i].first < 3.1;
      p.push_back(corners[i].second);
    }
    if (!is_round) continue;
    p = WithoutFlatCorners(p);
    double area = 0;
    for (size_t i = 0; i < p.size(); ++i)
      area += p[i][0] * p[(i + 1) % p.size()][1] - p[i][1] * p[(i + 1) % p.size()][0];
    if (area > 0) return p;
  }
}

Mesh PrismsOnGrid(Random& random) {
  std::vector<Mesh> parts;
  for (int n = WholeIn(random, 2, 6); n > 0; --n) {
    const Outline outline = WithoutFlatCorners(Coin(random) ? Stairs(random) : StarOfWholeNumbers(random));
    const double height = WholeIn(random, 1, 3);
    const Mesh prism = QuarterTurned(Prism(outline, height), WholeIn(random, 0, 23));
    Point by;
    for (double& x : by) x = WholeIn(random, -3, 3);
    parts.push_back(Translated(prism, by));
  }
  return Renumbered(Together(parts), random);
}

// A box pushed along an axis, a copy at each step: four sides lie in four planes.
Mesh Swept(int cells, Random& random) {
  static constexpr double shares[] = {0.125, 0.25, 0.5, 0.3, 0.1, 0.75, 1};
  const double share = shares[WholeIn(random, 0, 6)];
  const Mesh box =
      cells == 1 ? BoxOfTwelve({0, 0, 0}, {1, 1, 1}, random) : Block({0, 0, 0}, {1, 1, 1}, {cells, cells, cells});
  std::vector<Mesh> parts;
  const int copies = WholeIn(random, 2, 10);
  const size_t axis = static_cast<size_t>(WholeIn(random, 0, 2));
  for (int i = 0; i < copies; ++i) {
    Point by{};
    by[axis] = share * i;
    parts.push_back(Translated(box, by));
  }
  return Renumbered(Together(parts), random);
}

Mesh SweptBox(Random& random) { return Swept(1, random); }
Mesh SweptFineBox(Random& random) { return Swept(WholeIn(random, 2, 8), random); }

// Boxes that differ by hundredths: slivers in between.
Mesh NearBoxes(Random& random) {
  std::vector<Mesh> parts;
  const int cells = WholeIn(random, 1, 3);
  const Point side{1, Uniform(random, 0.5, 1.5), Uniform(random, 0.5, 1.5)};
  for (int n = WholeIn(random, 2, 6); n > 0; --n) {
    Point low{}, high = side;
    for (size_t i = 0; i < 3; ++i) {
      const double by = 0.01 * WholeIn(random, -1, 1);
      low[i] += by;
      high[i] += Coin(random) ? by : 0;
    }
    parts.push_back(cells == 1 ? BoxOfTwelve(low, high, random) : Block(low, high, {cells, cells, cells}));
  }
  return Renumbered(Together(parts), random);
}

Mesh Plate(double thick, Random& random) {
  const Point half{Uniform(random, 0.5, 1), Uniform(random, 0.5, 1), thick / 2};
  const Point low = Scaled(-1, half);
  if (Coin(random)) return BoxOfTwelve(low, half, random);
  return Block(low, half, {WholeIn(random, 2, 10), WholeIn(random, 2, 10), WholeIn(random, 1, 2)});
}

Mesh CrossingPlates(Random& random) {
  std::vector<Mesh> parts;
  for (int n = WholeIn(random, 2, 7); n > 0; --n) {
    const Mesh plate = RandomlyTurned(Plate(Uniform(random, 0.02, 0.15), random), random);
    parts.push_back(Translated(plate, RandomPoint(random, -0.3, 0.3)));
  }
  return Renumbered(Together(parts), random);
}

// Each plate lies upon the one below, a few with a gap, shifted a bit.
Mesh StackedPlates(Random& random) {
  std::vector<Mesh> parts;
  double z = 0;
  const double grid = Coin(random) ? 0.25 : 0.0625;
  for (int n = WholeIn(random, 2, 8); n > 0; --n) {
    const double thick = 0.0625 * WholeIn(random, 1, 4);
    const Point low{grid * WholeIn(random, -2, 2), grid * WholeIn(random, -2, 2), z};
    const Point high{low[0] + 0.25 * WholeIn(random, 4, 8), low[1] + 0.25 * WholeIn(random, 4, 8), z + thick};
    parts.push_back(Coin(random) ? BoxOfTwelve(low, high, random)
                                 : Block(low, high, {WholeIn(random, 2, 8), WholeIn(random, 2, 8), 1}));
    z += thick + (WholeIn(random, 0, 5) == 0 ? 0.125 : 0);
  }
  return Renumbered(QuarterTurned(Together(parts), WholeIn(random, 0, 23)), random);
}

}  // namespace

std::vector<FieldFamily> BoxFamilies() {
  return {
      {"boxes-grid", BoxesOnGrid, 600, 72, true},         {"boxes-grid-fine", FineBoxesOnGrid, 300, 72, true},
      {"boxes-signed", SignedBoxesOnGrid, 300, 72, true}, {"prisms-grid", PrismsOnGrid, 400, 90, true},
      {"boxes-swept", SweptBox, 300, 72, true},           {"boxes-swept-fine", SweptFineBox, 200, 72, true},
      {"boxes-near", NearBoxes, 300, 72, false},          {"plates-crossing", CrossingPlates, 300, 120, false},
      {"plates-stacked", StackedPlates, 300, 120, true},
  };
}

}  // namespace support
