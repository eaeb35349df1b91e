// SPDX-License-Identifier: MIT
// stars: the surroundings of every vertex, summed in one walk over the triangles.

export class Stars {
  #room = 0;

  /** Normals of length twice the area, sums of the neighbours' positions, their numbers, and the shortest edges, squared. */
  measure(positions, triangles) {
    const count = positions.length / 3;
    if (count > this.#room) {
      this.#room = count + (count >> 1);
      this.normals = new Float64Array(3 * this.#room);
      this.sums = new Float64Array(3 * this.#room);
      this.degrees = new Uint32Array(this.#room);
      this.shortest = new Float64Array(this.#room);
    }
    const { normals, sums, degrees, shortest } = this;
    normals.fill(0, 0, 3 * count);
    sums.fill(0, 0, 3 * count);
    degrees.fill(0, 0, count);
    shortest.fill(Infinity, 0, count);
    let volume = 0, area = 0;
    for (let h = 0; h < triangles.length; h += 3) {
      const i = triangles[h], j = triangles[h + 1], k = triangles[h + 2];
      const a = 3 * i, b = 3 * j, c = 3 * k;
      const ax = positions[a], ay = positions[a + 1], az = positions[a + 2];
      const bx = positions[b], by = positions[b + 1], bz = positions[b + 2];
      const cx = positions[c], cy = positions[c + 1], cz = positions[c + 2];
      const ux = bx - ax, uy = by - ay, uz = bz - az, vx = cx - ax, vy = cy - ay, vz = cz - az;
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      area += Math.sqrt(nx * nx + ny * ny + nz * nz);
      volume += ax * nx + ay * ny + az * nz;
      normals[a] += nx; normals[a + 1] += ny; normals[a + 2] += nz;
      normals[b] += nx; normals[b + 1] += ny; normals[b + 2] += nz;
      normals[c] += nx; normals[c + 1] += ny; normals[c + 2] += nz;
      // Each neighbour of a vertex follows the vertex in exactly one triangle.
      sums[a] += bx; sums[a + 1] += by; sums[a + 2] += bz;
      sums[b] += cx; sums[b + 1] += cy; sums[b + 2] += cz;
      sums[c] += ax; sums[c + 1] += ay; sums[c + 2] += az;
      ++degrees[i]; ++degrees[j]; ++degrees[k];
      // An edge is in two triangles, and counts for one end in each.
      const wx = cx - bx, wy = cy - by, wz = cz - bz;
      const u = ux * ux + uy * uy + uz * uz, v = vx * vx + vy * vy + vz * vz, w = wx * wx + wy * wy + wz * wz;
      if (u < shortest[i]) shortest[i] = u;
      if (w < shortest[j]) shortest[j] = w;
      if (v < shortest[k]) shortest[k] = v;
    }
    this.volume = volume / 6;
    this.area = area / 2;
  }

  /** Takes every value of a vertex to the mean of its neighbours, `rounds` times. After measure of this mesh. */
  average(values, triangles, rounds) {
    const { degrees } = this, sums = this.shortest;
    for (let round = 0; round < rounds; ++round) {
      sums.fill(0, 0, values.length);
      for (let h = 0; h < triangles.length; h += 3) {
        const i = triangles[h], j = triangles[h + 1], k = triangles[h + 2];
        sums[i] += values[j]; sums[j] += values[k]; sums[k] += values[i];
      }
      for (let v = 0; v < values.length; ++v) values[v] = sums[v] / degrees[v];
    }
  }

  /** Takes every point a part of the way to the mean of its neighbours, `rounds` times. After measure of this mesh. */
  relax(positions, triangles, part, rounds) {
    const { sums, degrees } = this;
    for (let round = 0; round < rounds; ++round) {
      sums.fill(0, 0, positions.length);
      for (let h = 0; h < triangles.length; h += 3) {
        const a = 3 * triangles[h], b = 3 * triangles[h + 1], c = 3 * triangles[h + 2];
        sums[a] += positions[b]; sums[a + 1] += positions[b + 1]; sums[a + 2] += positions[b + 2];
        sums[b] += positions[c]; sums[b + 1] += positions[c + 1]; sums[b + 2] += positions[c + 2];
        sums[c] += positions[a]; sums[c + 1] += positions[a + 1]; sums[c + 2] += positions[a + 2];
      }
      for (let v = 0, at = 0; at < positions.length; ++v, at += 3) {
        const share = part / degrees[v];
        positions[at] += share * sums[at] - part * positions[at];
        positions[at + 1] += share * sums[at + 1] - part * positions[at + 1];
        positions[at + 2] += share * sums[at + 2] - part * positions[at + 2];
      }
    }
  }
}
