// SPDX-License-Identifier: MIT
// mesh: the mesh, slices and places of events in WebGL 2.

const meshVertex = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;
uniform mat4 camera;
uniform mat3 turn;
uniform float size;
out vec3 at, facing, base, seen;
void main() {
  gl_Position = camera * vec4(position, 1.0);
  gl_PointSize = size;
  at = position;
  seen = turn * position;
  facing = turn * normal;
  base = colour.rgb;
}`;

const meshFragment = `#version 300 es
precision highp float;
in vec3 at, facing, base, seen;
uniform vec4 cut;
uniform vec4 paint;
uniform bool flatly, own, dots;
out vec4 shade;
void main() {
  if (dot(at, cut.xyz) > cut.w) discard;
  if (dots) {
    float r = length(gl_PointCoord - 0.5);
    if (r > 0.5) discard;
    shade = vec4(r > 0.34 ? vec3(0.06) : paint.rgb, 1.0);
    return;
  }
  if (paint.a < 0.0) { shade = vec4(paint.rgb, -paint.a); return; }
  vec3 n = flatly ? cross(dFdx(seen), dFdy(seen)) : facing;
  n = length(n) > 0.0 ? normalize(n) : vec3(0.0, 0.0, 1.0);
  if (flatly) { if (n.z < 0.0) n = -n; } else if (!gl_FrontFacing) n = -n;
  vec3 ground = own ? base : paint.rgb;
  if (!gl_FrontFacing) ground = vec3(0.91, 0.72, 0.47);
  float key = max(dot(n, normalize(vec3(-0.45, 0.6, 0.75))), 0.0);
  float fill = max(dot(n, normalize(vec3(0.7, -0.3, 0.5))), 0.0);
  float gloss = pow(max(dot(n, normalize(vec3(-0.25, 0.33, 0.96))), 0.0), 40.0);
  shade = vec4(ground * (0.26 + 0.66 * key + 0.22 * fill) + 0.16 * gloss, 1.0);
}`;

const planeVertex = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 texel;
uniform mat4 camera;
out vec2 place;
void main() { gl_Position = camera * vec4(position, 1.0); place = texel; }`;

const planeFragment = `#version 300 es
precision highp float;
in vec2 place;
uniform sampler2D image;
uniform vec2 window;
out vec4 shade;
void main() {
  float grey = clamp((texture(image, place).r * 255.0 - window.x) / window.y, 0.0, 1.0);
  shade = vec4(vec3(grey), 1.0);
}`;

function compiled(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const at = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
    const { name } = gl.getActiveUniform(program, i);
    at[name] = gl.getUniformLocation(program, name);
  }
  return { program, at };
}

// The box of all frames.
function boxOfFrames() {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const { box, vertices } of data.frames)
    for (let i = 0; i < 3 && vertices > 0; ++i) {
      low[i] = Math.min(low[i], box[i]);
      high[i] = Math.max(high[i], box[i + 3]);
    }
  return low[0] <= high[0] ? { low, high } : { low: [-1, -1, -1], high: [1, 1, 1] };
}

class MeshView {
  constructor(canvas) {
    this.canvas = canvas;
    const gl = (this.gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true }));
    if (!gl) throw new Error("this browser has no WebGL 2");
    this.surface = compiled(gl, meshVertex, meshFragment);
    this.plane = compiled(gl, planeVertex, planeFragment);
    const { low, high } = (this.box = boxOfFrames());
    this.middle = low.map((x, i) => (x + high[i]) / 2);
    this.radius = Math.hypot(...low.map((x, i) => high[i] - x)) / 2 || 1;
    this.options = { wire: false, flat: false, parts: false, planes: false, places: true, cut: -1, cutAt: 0.5, cutSide: 1 };
    this.buffers = Object.fromEntries(["positions", "normals", "colours", "triangles", "edges", "marked", "places", "quad"].map((name) => [name, gl.createBuffer()]));
    this.planes = [];
    this.events = 0;
    this.reset();
    this.listen();
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  reset() {
    this.azimuth = data.space === "ras" ? 1.05 : -1.05;
    this.elevation = 0.42;
    this.target = [...this.middle];
    // As near as all corners of the box allow.
    const rows = this.frame(), { low, high } = this.box, aspect = this.canvas.clientWidth / this.canvas.clientHeight || 1;
    const most = [Math.max(1, aspect), Math.max(1, 1 / aspect)].map((part) => 0.94 * part * Math.tan(0.26));
    this.distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const from = this.middle.map((m, i) => (corner >> i & 1 ? high[i] : low[i]) - m);
      const [x, y, z] = rows.map((r) => r[0] * from[0] + r[1] * from[1] + r[2] * from[2]);
      this.distance = Math.max(this.distance, z + Math.abs(x) / most[0], z + Math.abs(y) / most[1]);
    }
    this.draw();
  }

  fill(kind, name, values) {
    this.gl.bindBuffer(kind, this.buffers[name]);
    this.gl.bufferData(kind, values, this.gl.STATIC_DRAW);
  }

  show(mesh) {
    const { gl } = this;
    this.mesh = mesh;
    this.fill(gl.ARRAY_BUFFER, "positions", mesh.positions);
    this.fill(gl.ARRAY_BUFFER, "normals", mesh.normals);
    this.fill(gl.ELEMENT_ARRAY_BUFFER, "triangles", mesh.triangles);
    this.fill(gl.ELEMENT_ARRAY_BUFFER, "marked", mesh.marked);
    this.edges = this.colours = false;
    this.draw();
  }

  showPlaces(places) {
    this.events = places.length;
    this.fill(this.gl.ARRAY_BUFFER, "places", new Float32Array(places.flat()));
    this.draw();
  }

  // A slice in space: four corners, and its grey values in a picture of the given size.
  showPlane(axis, corners, picture, width, height) {
    const { gl } = this, plane = (this.planes[axis] ||= { texture: gl.createTexture() });
    plane.corners = corners;
    gl.bindTexture(gl.TEXTURE_2D, plane.texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, width, height, 0, gl.RED, gl.UNSIGNED_BYTE, picture);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    if (this.options.planes) this.draw();
  }

  // Rows: right, up, towards the eye.
  frame() {
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth), ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    return [[-sa, ca, 0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
  }

  // Column by column, as WebGL takes it.
  camera(rows) {
    const aspect = this.canvas.width / this.canvas.height, f = Math.min(1, aspect) / Math.tan(0.26);
    const near = Math.max(this.distance - 2.5 * this.radius, this.distance / 100), far = this.distance + 2.5 * this.radius;
    const shift = rows.map((r, i) => -r.reduce((sum, x, k) => sum + x * this.target[k], 0) - (i === 2 ? this.distance : 0));
    const out = new Float32Array(16);
    for (let column = 0; column < 4; ++column) {
      const [x, y, z] = rows.map((r, i) => (column < 3 ? r[column] : shift[i]));
      out.set([f / aspect * x, f * y, ((near + far) * z + (column === 3 ? 2 * near * far : 0)) / (near - far), -z], 4 * column);
    }
    return out;
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.paint();
    });
  }

  attribute(place, name, size, type = this.gl.FLOAT, normalized = false) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type, normalized, 0, 0);
  }

  paint() {
    const { gl, canvas, mesh, options: o } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.098, 0.118, 0.141, 1);
    gl.enable(gl.DEPTH_TEST);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const rows = this.frame(), camera = this.camera(rows);
    if (mesh) this.paintMesh(rows, camera);
    if (o.planes) this.paintPlanes(camera);
  }

  paintMesh(rows, camera) {
    const { gl, mesh, options: o } = this, { program, at } = this.surface;
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.camera, false, camera);
    gl.uniformMatrix3fv(at.turn, false, [0, 1, 2].flatMap((k) => rows.map((r) => r[k])));
    const cut = [0, 0, 0, 1];
    if (o.cut >= 0) {
      cut[o.cut] = o.cutSide;
      cut[3] = o.cutSide * (this.box.low[o.cut] + o.cutAt * (this.box.high[o.cut] - this.box.low[o.cut]));
    }
    gl.uniform4fv(at.cut, cut);
    gl.uniform1i(at.flatly, o.flat);
    gl.uniform1i(at.own, o.parts);
    gl.uniform1i(at.dots, 0);
    this.attribute(0, "positions", 3);
    this.attribute(1, "normals", 3);
    if (o.parts && !this.colours) this.fill(gl.ARRAY_BUFFER, "colours", (this.colours = partColours(mesh)));
    gl.disableVertexAttribArray(2);
    if (o.parts) this.attribute(2, "colours", 4, gl.UNSIGNED_BYTE, true);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    gl.uniform4f(at.paint, 0.435, 0.66, 0.863, 1);
    this.elements(gl.TRIANGLES, "triangles", mesh.triangles.length);
    gl.uniform1i(at.own, 0);
    this.paintMarked(at);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    if (o.wire) {
      if (!this.edges) this.fill(gl.ELEMENT_ARRAY_BUFFER, "edges", (this.edges = edgesOf(mesh.triangles)));
      this.blend(true);
      gl.uniform4f(at.paint, 0.04, 0.08, 0.13, -0.55);
      this.elements(gl.LINES, "edges", this.edges.length);
      this.blend(false);
    }
    if (o.places && this.events > 0) this.paintPlaces(at);
  }

  blend(on) {
    const { gl } = this;
    if (on) gl.enable(gl.BLEND);
    else gl.disable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  // Through what lies before them, faintly; then where they are seen.
  paintMarked(at) {
    const { gl, mesh } = this;
    gl.polygonOffset(0.5, 0.5);
    this.blend(true);
    gl.disable(gl.DEPTH_TEST);
    gl.uniform4f(at.paint, 1, 0.3, 0.26, -0.45);
    this.elements(gl.TRIANGLES, "marked", mesh.marked.length);
    this.blend(false);
    gl.enable(gl.DEPTH_TEST);
    gl.uniform4f(at.paint, 0.96, 0.26, 0.22, -1);
    this.elements(gl.TRIANGLES, "marked", mesh.marked.length);
  }

  paintPlaces(at) {
    const { gl } = this;
    gl.disable(gl.DEPTH_TEST);
    gl.uniform1i(at.dots, 1);
    gl.uniform1f(at.size, 11 * Math.min(window.devicePixelRatio || 1, 2));
    gl.uniform4f(at.paint, 1, 0.706, 0.329, 1);
    this.attribute(0, "places", 3);
    gl.disableVertexAttribArray(1);
    gl.disableVertexAttribArray(2);
    gl.drawArrays(gl.POINTS, 0, this.events);
    gl.enable(gl.DEPTH_TEST);
  }

  elements(kind, name, count) {
    if (count === 0) return;
    this.gl.bindBuffer(this.gl.ELEMENT_ARRAY_BUFFER, this.buffers[name]);
    this.gl.drawElements(kind, count, this.gl.UNSIGNED_INT, 0);
  }

  paintPlanes(camera) {
    const { gl } = this, { program, at } = this.plane;
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.camera, false, camera);
    gl.uniform2f(at.window, ...this.window);
    gl.disableVertexAttribArray(2);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.quad);
    for (const place of [0, 1]) gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 20, 0);
    gl.vertexAttribPointer(1, 2, gl.FLOAT, false, 20, 12);
    for (const { corners, texture } of this.planes) {
      const texels = [[0, 0], [1, 0], [0, 1], [1, 1]];
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(corners.flatMap((p, i) => [...p, ...texels[i]])), gl.STATIC_DRAW);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    }
  }

  rotate(dx, dy) {
    this.azimuth -= dx;
    this.elevation = Math.max(-1.57, Math.min(1.57, this.elevation + dy));
    this.draw();
  }

  move(dx, dy) {
    const rows = this.frame(), scale = 2 * Math.tan(0.26) * this.distance / this.canvas.clientHeight;
    for (let i = 0; i < 3; ++i) this.target[i] += scale * (dy * rows[1][i] - dx * rows[0][i]);
    this.draw();
  }

  zoom(factor) {
    this.distance = Math.max(this.radius / 50, Math.min(20 * this.radius, this.distance * factor));
    this.draw();
  }

  listen() {
    const { canvas } = this, pointers = new Map();
    const spread = () => {
      const [a, b] = [...pointers.values()];
      return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, size: Math.hypot(a.x - b.x, a.y - b.y) };
    };
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      pointers.set(e.pointerId, { x: e.clientX, y: e.clientY });
    });
    canvas.addEventListener("pointermove", (e) => {
      const last = pointers.get(e.pointerId);
      if (!last) return;
      const before = pointers.size > 1 ? spread() : null, dx = e.clientX - last.x, dy = e.clientY - last.y;
      pointers.set(e.pointerId, { x: e.clientX, y: e.clientY });
      if (before) {
        const now = spread();
        this.zoom(before.size / Math.max(now.size, 1));
        this.move(now.x - before.x, now.y - before.y);
      } else if (e.buttons & 2 || e.shiftKey) this.move(dx, dy);
      else this.rotate(dx / 160, dy / 160);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (e) => pointers.delete(e.pointerId));
    canvas.addEventListener("contextmenu", (e) => e.preventDefault());
    canvas.addEventListener("wheel", (e) => {
      e.preventDefault();
      this.zoom(Math.exp(e.deltaY / 600));
    }, { passive: false });
    const keys = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
    canvas.addEventListener("keydown", (e) => {
      if (keys[e.key]) this.rotate(...keys[e.key]);
      else if (e.key === "+" || e.key === "=") this.zoom(0.9);
      else if (e.key === "-") this.zoom(1.1);
      else return;
      e.preventDefault();
    });
  }
}
