// SPDX-License-Identifier: MIT
// shapes: meshes to begin with. Only sums, products, quotients and square roots are used, so every browser makes the
// same bits.

/** Cosine and sine of a part of a full turn. */
export function turn(part) {
  // Taylor series within an eighth of a turn on either side of the nearest quarter.
  const quarter = Math.round(4 * part);
  const angle = (part - quarter / 4) * 6.283185307179586;
  let cosine = 0, sine = 0, term = 1;
  for (let i = 0; i < 20; ++i) {
    if (i % 2 === 0) cosine += term * (i % 4 === 0 ? 1 : -1);
    else sine += term * (i % 4 === 1 ? 1 : -1);
    term *= angle / (i + 1);
  }
  const turned = [[cosine, sine], [-sine, cosine], [-cosine, -sine], [sine, -cosine]];
  return turned[((quarter % 4) + 4) % 4];
}

/** Numbers in [0, 1) that look random: xorshift of 32 bits. */
export function random(seed) {
  let state = (seed * 2654435761 + 1) >>> 0;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    state >>>= 0;
    return state / 4294967296;
  };
}

/** The unit sphere: an icosahedron with `parts` edges for each of its own. 10 parts² + 2 vertices. */
export function sphere(parts) {
  const t = (1 + Math.sqrt(5)) / 2;
  const corners = [[-1, t, 0], [1, t, 0], [-1, -t, 0], [1, -t, 0], [0, -1, t], [0, 1, t], [0, -1, -t], [0, 1, -t],
    [t, 0, -1], [t, 0, 1], [-t, 0, -1], [-t, 0, 1]];
  const faces = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2],
    [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10],
    [8, 6, 7], [9, 8, 1]];
  const positions = [], triangles = [], known = new Map();
  // Faces share the points of their edges: named by the corners' weights.
  const vertex = (face, weights) => {
    const name = face.map((corner, i) => [corner, weights[i]]).filter(([, w]) => w > 0)
      .sort(([a], [b]) => a - b).join();
    if (!known.has(name)) {
      const p = [0, 1, 2].map((k) => face.reduce((sum, corner, i) => sum + corners[corner][k] * weights[i], 0));
      const length = Math.sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      known.set(name, positions.length / 3);
      positions.push(p[0] / length, p[1] / length, p[2] / length);
    }
    return known.get(name);
  };
  for (const face of faces) {
    const row = (i) => Array.from({ length: i + 1 }, (_, j) => vertex(face, [parts - i, i - j, j]));
    for (let i = 0; i < parts; ++i) {
      const upper = row(i), lower = row(i + 1);
      for (let j = 0; j <= i; ++j) {
        triangles.push(upper[j], lower[j], lower[j + 1]);
        if (j < i) triangles.push(upper[j], lower[j + 1], upper[j + 1]);
      }
    }
  }
  return { positions, triangles };
}

/** A closed tube: `around` rings, ring i with its centre and two unit vectors of its plane from frame(i / around). */
export function tube(around, sides, radius, frame) {
  const positions = [], triangles = [];
  for (let i = 0; i < around; ++i) {
    const { centre, u, v } = frame(i / around);
    for (let j = 0; j < sides; ++j) {
      const [c, s] = turn(j / sides);
      for (let k = 0; k < 3; ++k) positions.push(centre[k] + radius * (c * u[k] + s * v[k]));
    }
  }
  for (let i = 0; i < around; ++i) {
    for (let j = 0; j < sides; ++j) {
      const a = i * sides + j, b = i * sides + ((j + 1) % sides);
      const next = ((i + 1) % around) * sides;
      const c = next + j, d = next + ((j + 1) % sides);
      triangles.push(a, b, c, b, d, c);
    }
  }
  return outward({ positions, triangles });
}

/** A ring in the plane of two axes. */
export function torus(ring, radius, edge, axes = [0, 1, 2]) {
  const around = Math.round((6.2832 * ring) / edge), sides = Math.round((6.2832 * radius) / edge);
  return tube(around, sides, radius, (part) => {
    const [c, s] = turn(part);
    const at = [0, 0, 0], u = [0, 0, 0], v = [0, 0, 0];
    at[axes[0]] = ring * c;
    at[axes[1]] = ring * s;
    u[axes[0]] = c;
    u[axes[1]] = s;
    v[axes[2]] = 1;
    return { centre: at, u, v };
  });
}

/** Every point p becomes centre + scale * p; scale is a number or one for each axis. */
export function placed(mesh, centre, scale = 1) {
  const by = typeof scale === "number" ? [scale, scale, scale] : scale;
  return { ...mesh, positions: mesh.positions.map((x, i) => centre[i % 3] + by[i % 3] * x) };
}

export function joined(meshes) {
  const positions = [], triangles = [];
  for (const mesh of meshes) {
    const first = positions.length / 3;
    for (const x of mesh.positions) positions.push(x);
    for (const v of mesh.triangles) triangles.push(first + v);
  }
  return { positions, triangles };
}

/** Turns the triangles round where they enclose a negative volume. */
function outward(mesh) {
  const { positions: p, triangles: t } = mesh;
  let volume = 0;
  for (let h = 0; h < t.length; h += 3) {
    const a = 3 * t[h], b = 3 * t[h + 1], c = 3 * t[h + 2];
    volume += p[a] * (p[b + 1] * p[c + 2] - p[b + 2] * p[c + 1]) + p[a + 1] * (p[b + 2] * p[c] - p[b] * p[c + 2]) +
      p[a + 2] * (p[b] * p[c + 1] - p[b + 1] * p[c]);
  }
  if (volume < 0) for (let h = 0; h < t.length; h += 3) [t[h + 1], t[h + 2]] = [t[h + 2], t[h + 1]];
  return mesh;
}
