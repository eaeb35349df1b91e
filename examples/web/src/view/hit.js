// SPDX-License-Identifier: MIT

/** Where a ray first meets a mesh from outside, or null. */
export function hit(mesh, { origin: o, direction: d }) {
  const p = mesh.positions, t = mesh.triangles;
  let nearest = Infinity;
  for (let h = 0; h < t.length; h += 3) {
    const a = 3 * t[h], b = 3 * t[h + 1], c = 3 * t[h + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    const px = d[1] * vz - d[2] * vy, py = d[2] * vx - d[0] * vz, pz = d[0] * vy - d[1] * vx;
    const det = ux * px + uy * py + uz * pz;
    if (det <= 0) continue;
    const sx = o[0] - p[a], sy = o[1] - p[a + 1], sz = o[2] - p[a + 2];
    const u = sx * px + sy * py + sz * pz;
    if (u < 0 || u > det) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
    const v = d[0] * qx + d[1] * qy + d[2] * qz;
    if (v < 0 || u + v > det) continue;
    const along = (vx * qx + vy * qy + vz * qz) / det;
    if (along > 0 && along < nearest) nearest = along;
  }
  return nearest === Infinity ? null : o.map((x, k) => x + nearest * d[k]);
}
