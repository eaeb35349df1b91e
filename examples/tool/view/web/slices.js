// SPDX-License-Identifier: MIT
// slices: the volume along its three axes, with the contour of the mesh.

// Places as voxel indices: the inverse of the volume's map, a row for each index.
function indexMap({ axes: [a, b, c], origin }) {
  const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
  const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  const size = dot(a, cross(b, c));
  return [cross(b, c), cross(c, a), cross(a, b)].map((row) => {
    const r = row.map((x) => x / size);
    return [...r, -dot(r, origin)];
  });
}

// How slices lie on the screen, as radiologists look: from the feet, from the front, from the patient's left. For each axis of the volume: the axes to the right and down, and whether each runs the other way.
function layoutOf(volume) {
  const names = { ras: ["LR", "PA", "IS"], lps: ["RL", "AP", "IS"] }[data.space];
  // Each axis of the volume takes the nearest axis of the world.
  const world = [], free = new Set([0, 1, 2]);
  const pairs = [0, 1, 2].flatMap((i) => [0, 1, 2].map((w) => [Math.abs(volume.axes[i][w]) / Math.hypot(...volume.axes[i]), i, w]));
  for (const [, i, w] of pairs.sort((p, q) => q[0] - p[0]))
    if (world[i] === undefined && free.delete(w)) world[i] = w;
  // To the right and down, the world runs to the left of the patient, to the back, and to the feet.
  const side = data.space === "ras" ? -1 : 1, wanted = [side, side, -1];
  const axes = [0, 1, 2].map((i) => {
    const grows = volume.axes[i][world[i]] > 0, flip = grows !== wanted[world[i]] > 0;
    const letters = names ? names[world[i]] : "  ";
    return { flip, ends: grows === !flip ? letters : letters[1] + letters[0] };
  });
  return [0, 1, 2].map((axis) => {
    const [p, q] = [0, 1, 2].filter((i) => i !== axis);
    const down = world[p] > world[q] ? p : q, right = down === p ? q : p;
    const title = names ? ["sagittal", "coronal", "axial"][world[axis]] : "";
    const [r, d] = [axes[right], axes[down]];
    return { axis, world: world[axis], right, down, flipRight: r.flip, flipDown: d.flip, title, sides: r.ends, poles: d.ends };
  });
}

class SliceView {
  constructor(volume, bytes, layout, at) {
    Object.assign(this, { volume, bytes, layout, at });
    this.width = volume.size[layout.right];
    this.height = volume.size[layout.down];
    this.count = volume.size[layout.axis];
    this.strides = [1, volume.size[0], volume.size[0] * volume.size[1]];
    this.grey = new Uint8Array(this.width * this.height);
    this.picture = document.createElement("canvas");
    this.picture.width = this.width;
    this.picture.height = this.height;
    this.build();
  }

  build() {
    const { layout, count } = this;
    this.element = document.createElement("figure");
    this.element.className = "card slice";
    this.element.innerHTML = `<canvas role="img"></canvas><figcaption><span></span><input type="range" min="0" step="1"><output></output></figcaption>`;
    this.canvas = this.element.querySelector("canvas");
    const name = `slice across ${"ijk"[layout.axis]} ${layout.title}`.trim();
    this.canvas.setAttribute("aria-label", name);
    this.slider = this.element.querySelector("input");
    this.slider.max = count - 1;
    this.slider.value = this.at;
    this.slider.setAttribute("aria-label", name);
    this.element.querySelector("span").textContent = layout.title;
    this.output = this.element.querySelector("output");
    new ResizeObserver(() => this.paint()).observe(this.canvas);
  }

  extract() {
    const { layout, strides, width, height, grey, bytes } = this;
    const base = this.at * strides[layout.axis];
    for (let y = 0; y < height; ++y) {
      const row = base + (layout.flipDown ? height - 1 - y : y) * strides[layout.down];
      for (let x = 0; x < width; ++x)
        grey[y * width + x] = bytes[row + (layout.flipRight ? width - 1 - x : x) * strides[layout.right]];
    }
  }

  colour([low, span]) {
    const pixels = new Uint8ClampedArray(4 * this.grey.length);
    for (let i = 0; i < this.grey.length; ++i) {
      pixels[4 * i] = pixels[4 * i + 1] = pixels[4 * i + 2] = 255 * (this.grey[i] - low) / span;
      pixels[4 * i + 3] = 255;
    }
    this.picture.getContext("2d").putImageData(new ImageData(pixels, this.width, this.height), 0, 0);
  }

  // Where the mesh crosses the slice: segments in voxels right and down.
  cross(indices, triangles) {
    const { layout, at } = this, segments = [], { axis, right, down } = layout;
    for (let f = 0; f < triangles.length; f += 3) {
      const corners = [3 * triangles[f], 3 * triangles[f + 1], 3 * triangles[f + 2]];
      const above = corners.map((c) => indices[c + axis] > at);
      if (above[0] === above[1] && above[1] === above[2]) continue;
      for (let i = 0; i < 3; ++i) {
        const j = (i + 1) % 3;
        if (above[i] === above[j]) continue;
        const p = corners[i], q = corners[j], t = (at - indices[p + axis]) / (indices[q + axis] - indices[p + axis]);
        segments.push(indices[p + right] + t * (indices[q + right] - indices[p + right]), indices[p + down] + t * (indices[q + down] - indices[p + down]));
      }
    }
    this.segments = segments;
  }

  // Pixels for each voxel, and the place of the corner of the first voxel.
  placement() {
    const spacing = this.volume.axes.map((a) => Math.hypot(...a)), { layout, canvas } = this;
    const across = this.width * spacing[layout.right], along = this.height * spacing[layout.down];
    const scale = 0.94 * Math.min(canvas.width / across, canvas.height / along);
    const sx = scale * spacing[layout.right], sy = scale * spacing[layout.down];
    return { sx, sy, left: (canvas.width - sx * this.width) / 2, top: (canvas.height - sy * this.height) / 2 };
  }

  paint() {
    const { canvas, layout } = this, ratio = Math.min(window.devicePixelRatio || 1, 2);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    const pen = canvas.getContext("2d"), { sx, sy, left, top } = this.placement();
    pen.drawImage(this.picture, left, top, sx * this.width, sy * this.height);
    pen.strokeStyle = "#ffb454";
    pen.lineWidth = 1.4 * ratio;
    pen.lineCap = "round";
    pen.beginPath();
    const x = (u) => left + sx * ((layout.flipRight ? this.width - 1 - u : u) + 0.5);
    const y = (u) => top + sy * ((layout.flipDown ? this.height - 1 - u : u) + 0.5);
    const s = this.segments || [];
    for (let i = 0; i + 3 < s.length; i += 4) {
      pen.moveTo(x(s[i]), y(s[i + 1]));
      pen.lineTo(x(s[i + 2]), y(s[i + 3]));
    }
    pen.stroke();
    this.letter(pen, ratio);
  }

  letter(pen, ratio) {
    const { canvas, layout } = this, inset = 12 * ratio;
    pen.font = `600 ${12 * ratio}px system-ui, "DejaVu Sans", sans-serif`;
    pen.fillStyle = "#c8d0d9";
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.shadowColor = "#000";
    pen.shadowBlur = 3 * ratio;
    pen.fillText(layout.sides[0], inset, canvas.height / 2);
    pen.fillText(layout.sides[1], canvas.width - inset, canvas.height / 2);
    pen.fillText(layout.poles[0], canvas.width / 2, inset);
    pen.fillText(layout.poles[1], canvas.width / 2, canvas.height - inset);
    pen.shadowBlur = 0;
  }

  // Corners of the voxels' outer faces in the order of the picture's corners.
  corners() {
    const { volume, layout } = this, place = [0, 0, 0];
    place[layout.axis] = this.at;
    const ends = (size, flipped) => (flipped ? [size - 0.5, -0.5] : [-0.5, size - 0.5]);
    const [l, r] = ends(this.width, layout.flipRight), [t, b] = ends(this.height, layout.flipDown);
    return [[l, t], [r, t], [l, b], [r, b]].map(([u, v]) => {
      place[layout.right] = u;
      place[layout.down] = v;
      return volume.origin.map((o, i) => o + place.reduce((sum, p, k) => sum + p * volume.axes[k][i], 0));
    });
  }
}

// The three slices, their sliders, and window and level.
class Slices {
  constructor(section, bytes, meshView) {
    const volume = (this.volume = data.volume);
    this.meshView = meshView;
    this.rows = indexMap(volume);
    const { low, high } = volume, last = data.frames[data.frames.length - 1].box;
    const middle = [0, 1, 2].map((i) => (last[i] + last[i + 3]) / 2);
    const start = this.rows.map((r) => r[0] * middle[0] + r[1] * middle[1] + r[2] * middle[2] + r[3]);
    const clamp = (x, most) => Math.max(0, Math.min(most, Math.round(x)));
    this.views = layoutOf(volume).map((layout) => new SliceView(volume, bytes, layout, clamp(start[layout.axis], volume.size[layout.axis] - 1)));
    // The axial slice first.
    for (const view of [...this.views].sort((a, b) => b.layout.world - a.layout.world)) section.append(view.element);
    section.append(this.greyPanel(low, high));
    for (const view of this.views) this.listen(view);
    this.regrey();
    for (const view of this.views) this.move(view, view.at);
  }

  greyPanel(low, high) {
    const panel = document.createElement("div"), step = (high - low) / 255, { threshold } = this.volume;
    panel.id = "grey";
    panel.className = "card";
    panel.innerHTML = `<label for="level">Level</label><input type="range" id="level"><output id="level_is"></output>
      <label for="window">Window</label><input type="range" id="window"><output id="window_is"></output>
      <p>Orange: the mesh. Threshold ${text(threshold)}. Drag in a slice for level and window, wheel to leaf through.</p>
      <button type="button" id="regrey">Whole range</button>`;
    [this.level, this.window] = panel.querySelectorAll("input");
    const whole = () => {
      this.level.value = (low + high) / 2;
      this.window.value = high - low;
      this.regrey();
    };
    Object.assign(this.level, { min: low, max: high, step, value: (low + high) / 2 });
    Object.assign(this.window, { min: step, max: high - low, step, value: high - low });
    for (const input of [this.level, this.window]) input.addEventListener("input", () => this.regrey());
    panel.querySelector("button").addEventListener("click", whole);
    this.panel = panel;
    return panel;
  }

  regrey() {
    const { low, high } = this.volume, unit = (high - low) / 255, level = +this.level.value, window = +this.window.value;
    this.panel.querySelector("#level_is").value = text(level, 4);
    this.panel.querySelector("#window_is").value = text(window, 4);
    this.span = [(level - window / 2 - low) / unit, Math.max(window / unit, 1e-3)];
    this.meshView.window = this.span;
    for (const view of this.views) {
      view.colour(this.span);
      view.paint();
    }
    this.meshView.draw();
  }

  move(view, at) {
    view.at = Math.max(0, Math.min(view.count - 1, at));
    view.slider.value = view.at;
    const step = this.volume.steps[view.layout.axis];
    view.output.value = `${"ijk"[view.layout.axis]} = ${view.at * step + (step - 1) / 2}`;
    view.extract();
    view.colour(this.span);
    if (this.indices) view.cross(this.indices, this.mesh.triangles);
    view.paint();
    this.meshView.showPlane(view.layout.axis, view.corners(), view.grey, view.width, view.height);
  }

  show(mesh) {
    const { rows } = this, { positions } = mesh, indices = new Float32Array(positions.length);
    for (let v = 0; v < positions.length; v += 3)
      for (let i = 0; i < 3; ++i)
        indices[v + i] = rows[i][0] * positions[v] + rows[i][1] * positions[v + 1] + rows[i][2] * positions[v + 2] + rows[i][3];
    Object.assign(this, { mesh, indices });
    for (const view of this.views) {
      view.cross(indices, mesh.triangles);
      view.paint();
    }
  }

  listen(view) {
    view.slider.addEventListener("input", () => this.move(view, +view.slider.value));
    view.canvas.addEventListener("wheel", (e) => {
      e.preventDefault();
      this.move(view, view.at + Math.sign(e.deltaY));
    }, { passive: false });
    view.canvas.addEventListener("pointerdown", (e) => view.canvas.setPointerCapture(e.pointerId));
    view.canvas.addEventListener("pointermove", (e) => {
      if (!e.buttons) return;
      const { low, high } = this.volume;
      this.level.value = +this.level.value - e.movementY * (high - low) / 500;
      this.window.value = +this.window.value + e.movementX * (high - low) / 500;
      this.regrey();
    });
  }
}
