// SPDX-License-Identifier: MIT
// main: the page. Pointer, touch and keys become the input of a frame; the frame advances the world, and the picture
// follows.
import { load } from "topoadapt-wasm";
import { World, idle, tool } from "./sim/world.js";
import { scenes } from "./sim/scenes.js";
import { Inputs, address_of, parse } from "./sim/share.js";
import { Stage } from "./view/stage.js";
import { Surface } from "./view/surface.js";
import { hit } from "./view/hit.js";
import { Panel } from "./view/panel.js";
import { phantom } from "./view/phantom.js";

const get = (id) => document.getElementById(id);
const tools = { blobs: "pull", balloon: "press", carving: "carve", tangles: "none" };

class Page {
  constructor(library) {
    this.library = library;
    this.stage = new Stage(get("canvas"));
    this.surface = new Surface(this.stage.scene);
    this.panel = new Panel();
    this.paused = false;
    this.growing = false;
    this.replayed = null;
    this.pending = null;  // an input for the next frame alone
    this.hold = null;  // { ray, point }: the tool at work
    this.chosen = 0;
    this.glass = null;
    this.times = [];
    this.#make_tabs();
    this.#listen();
    get("about").textContent = `${library.buildInfo}. Drawn with three.js (MIT licence, in this page's source).`;
  }

  // ---------------------------------------------------------------- scenes

  /** Begins a scene. */
  start(name, settings = {}) {
    this.world = new World(this.library, name, settings);
    this.inputs = new Inputs();
    this.replayed = null;
    this.hold = this.pending = null;
    this.chosen = 0;
    this.times = [];
    this.glass?.removeFromParent();
    this.glass = name === "balloon" ? phantom(this.world.settings.phantom) : null;
    if (this.glass !== null) this.stage.scene.add(this.glass);
    this.panel.show_scene(name, this.world.scene, this.world.settings);
    this.draw();
    if (name === "tangles") this.panel.toast(`${this.world.state.contacts} pairs of triangles run through each other`);
  }

  reset() {
    const { name, settings, state } = this.world;
    this.start(name, name === "carving" ? { ...settings, brush: state.brush } : settings);
  }

  /** Restores the scene of an address: plays its inputs again. */
  async restore(text) {
    const told = await parse(text);
    if (told === null || scenes[told.scene] === undefined) return false;
    this.start(told.scene, told.settings);
    if (told.view !== null) this.stage.view = told.view;
    this.replayed = { inputs: told.inputs[Symbol.iterator](), digest: told.digest, count: told.inputs.frames };
    return true;
  }

  async share() {
    const { name: scene, settings, mesh } = this.world;
    const text = await address_of({ scene, settings, view: this.stage.view, inputs: this.inputs, digest: mesh.digest() });
    history.replaceState(null, "", `#${text}`);
    // Pages from a disk and old browsers have no clipboard.
    const copied = navigator.clipboard?.writeText(location.href) ?? Promise.reject(new Error("no clipboard"));
    await copied.then(
      () => this.panel.toast("The address of this scene is copied"),
      () => this.panel.toast("The address bar holds this scene"),
    );
  }

  // ---------------------------------------------------------------- frames

  /** A frame of the display. */
  frame() {
    if (this.replayed !== null) this.#replay();
    else if (!this.paused) this.advance(this.#input());
    this.draw();
  }

  /** Advances the world by a frame. Times are of the library with the motion, and of the upload. */
  advance(input) {
    const { world } = this;
    this.inputs.add(input);
    const before = performance.now(), was_settled = world.settled && input.kind === "none";
    try {
      world.frame(input);
    } catch (error) {
      // The mesh is as before the call.
      if (error.name !== "TopoadaptError") throw error;
      this.panel.toast(error.message);
      world.settled = true;
    }
    this.library_time = performance.now() - before;
    if (input.kind === "action") this.panel.toast(`${world.state.contacts} pairs of triangles run through each other now`);
    this.panel.add_events(world.marks, world.frames);
    this.worked = !was_settled;
  }

  draw() {
    const before = performance.now();
    const changed = this.surface.update(this.world);
    const upload = performance.now() - before;
    this.stage.draw(changed);
    if (this.worked) {
      this.times.push({ library: this.library_time, upload });
      this.panel.add_time(this.library_time, upload);
    }
    this.worked = false;
    this.panel.show_world(this.world);
    this.panel.show_times();
    this.panel.place_marks(this.stage);
  }

  // Plays as many frames as fit between two pictures.
  #replay() {
    const { replayed } = this, until = performance.now() + 24;
    do {
      const { value, done } = replayed.inputs.next();
      if (done) {
        const same = replayed.digest === null || this.world.mesh.digest().toString(16) === replayed.digest;
        this.replayed = null;
        this.restored = same;
        if (replayed.count > 0) this.panel.toast(same ? "Restored, bit for bit" : "Restored, with other bits");
        return;
      }
      this.advance(value);
    } while (performance.now() < until);
  }

  // ---------------------------------------------------------------- input

  #kind() {
    const kind = tools[this.world.name];
    return kind === "carve" && this.growing ? "grow" : kind;
  }

  #input() {
    if (this.pending !== null) {
      const input = this.pending;
      this.pending = null;
      return input;
    }
    const { hold } = this, kind = this.#kind();
    if (hold === null || kind === "none") return idle;
    if (hold.target !== undefined) return tool("pull", hold.target);
    // The hand closes where the pointer came down, however far the pointer has gone since.
    if (!hold.closed) {
      hold.closed = true;
      if (kind === "pull") return tool(kind, hold.point);
    }
    const ray = this.stage.ray(...hold.pixel);
    if (kind === "pull" || kind === "press") return tool(kind, this.stage.on_plane(ray, hold.point));
    const point = hit(this.world.mesh, ray);
    return point === null ? idle : tool(kind, point, ray.direction);
  }

  // Takes the tool to a pixel; true if the surface is there.
  #take(pixel) {
    const point = hit(this.world.mesh, this.stage.ray(...pixel));
    if (point === null || this.#kind() === "none") return false;
    this.hold = { pixel, point };
    return true;
  }

  #listen() {
    const canvas = get("canvas");
    let pointer = null;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.focus({ preventScroll: true });
      if (event.button !== 0) return;
      // A second finger ends the work of the first, and zooms.
      if (!event.isPrimary) {
        this.hold = pointer = null;
        this.stage.controls.enabled = true;
        return;
      }
      if (event.shiftKey) this.#grow(true);
      if (!this.#take([event.clientX, event.clientY])) return;
      pointer = event.pointerId;
      this.stage.controls.enabled = false;
      canvas.setPointerCapture(pointer);
    }, { capture: true });
    canvas.addEventListener("pointermove", (event) => {
      const pixel = [event.clientX, event.clientY];
      if (event.pointerId === pointer && this.hold !== null) this.hold.pixel = pixel;
      else if (event.pointerType === "mouse" && this.#kind() !== "none" && event.buttons === 0)
        canvas.classList.toggle("hot", hit(this.world.mesh, this.stage.ray(...pixel)) !== null);
    });
    const release = (event) => {
      if (event.pointerId !== pointer) return;
      if (event.shiftKey) this.#grow(false);
      this.hold = pointer = null;
      this.stage.controls.enabled = true;
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);

    window.addEventListener("resize", () => this.stage.resize());
    window.addEventListener("hashchange", () => this.restore(location.hash.slice(1)));
    window.addEventListener("keydown", (event) => this.#key(event));
    window.addEventListener("keyup", (event) => {
      if (event.key === " " || event.key.startsWith("Arrow")) this.#release_keys();
    });
    const click = (id, act) => get(id).addEventListener("click", act);
    click("action", () => this.#action());
    click("wireframe", () => this.#toggle_wireframe());
    click("pause", () => this.#toggle_pause());
    click("reset", () => this.reset());
    click("share", () => this.share());
    click("carve", () => this.#grow(false));
    click("grow", () => this.#grow(true));
    get("variant").addEventListener("change", ({ target }) =>
      this.start(this.world.name, { [this.world.scene.variants.name]: target.value }));
    get("brush").addEventListener("input", ({ target }) => this.#set_brush(Number(target.value)));
  }

  #set_brush(size) {
    const brush = Math.max(12, Math.min(60, size));
    get("brush").value = brush;
    this.pending = { kind: "brush", at: [brush, 0, 0, 0, 0, 0] };
  }

  #grow(growing) {
    this.growing = growing;
    this.panel.press("carve", !growing);
    this.panel.press("grow", growing);
  }

  #toggle_wireframe() {
    this.surface.wireframe = !this.surface.wireframe;
    this.panel.press("wireframe", this.surface.wireframe);
  }

  #toggle_pause() {
    this.paused = !this.paused;
    this.panel.press("pause", this.paused);
  }

  // The large button: another blob, another phantom, or the untangling.
  #action() {
    const { name, scene, settings, state, components } = this.world;
    if (name === "blobs") {
      this.chosen = (this.chosen + 1) % components.length;
      this.panel.toast(`Blob ${this.chosen + 1} of ${components.length}: pull it with the arrows`);
    } else if (name === "balloon") {
      const all = Object.keys(scene.variants.of);
      this.start(name, { phantom: all[(all.indexOf(settings.phantom) + 1) % all.length] });
    } else if (name === "tangles" && state.contacts > 0) {
      this.pending = { kind: "action" };
    }
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("select, input")) return;
    const in_button = event.target.matches("button, summary");
    const key = event.key.toLowerCase();
    const names = Object.keys(scenes);
    const arrows = { arrowleft: [-1, 0], arrowright: [1, 0], arrowup: [0, 1], arrowdown: [0, -1] };
    if (names[Number(key) - 1] !== undefined) this.start(names[Number(key) - 1]);
    else if (key === "w") this.#toggle_wireframe();
    else if (key === "p") this.#toggle_pause();
    else if (key === "r") this.reset();
    else if (key === "s") this.share();
    else if (key === "+" || key === "=") this.#plus(1);
    else if (key === "-") this.#plus(-1);
    else if (key === "enter" && !in_button) this.#action();
    else if (key === " " && !in_button) this.#space();
    else if (arrows[key] !== undefined) this.#arrow(...arrows[key], event.shiftKey);
    else return;
    event.preventDefault();
  }

  #plus(sign) {
    if (this.world.name === "carving") this.#set_brush(this.world.state.brush + 4 * sign);
    else this.stage.zoom(1 - 0.08 * sign);
  }

  #space() {
    get("crosshair").hidden = false;
    [get("crosshair").style.left, get("crosshair").style.top] = this.stage.middle.map((x) => `${x}px`);
    if (this.hold === null) this.#take(this.stage.middle);
  }

  #arrow(right, up, shifted) {
    const { world, stage } = this;
    if (world.name !== "blobs" || shifted) return stage.turn(0.08 * right, 0.08 * up);
    const { box } = world.components[Math.min(this.chosen, world.components.length - 1)];
    const { right: x, up: y } = stage.axes;
    // The hand holds the side of the blob to which the arrow points.
    if (this.hold?.target === undefined) {
      const middle = [0, 1, 2].map((k) => (box[k] + box[k + 3]) / 2), size = (box[3] - box[0]) / 2;
      this.hold = { target: middle.map((m, k) => m + 0.9 * size * (right * x[k] + up * y[k])) };
    }
    this.hold.target = this.hold.target.map((t, k) => t + 0.12 * (right * x[k] + up * y[k]));
  }

  #release_keys() {
    this.hold = null;
    get("crosshair").hidden = true;
  }

  #make_tabs() {
    Object.entries(scenes).forEach(([name, { title }]) => {
      const tab = document.createElement("button");
      tab.dataset.scene = name;
      tab.textContent = title;
      tab.setAttribute("role", "tab");
      tab.addEventListener("click", () => this.start(name));
      get("scenes").append(tab);
    });
  }
}

/** Says in place of the picture why there is none. */
function apologize(text, error) {
  document.body.classList.add("without-picture");
  get("hint").textContent = `${text} (${error.message})`;
}

async function begin() {
  const library = await load().catch((error) => apologize("This browser does not run WebAssembly with 128-bit vectors.", error));
  if (library === undefined) return;
  let page;
  try {
    page = new Page(library);
  } catch (error) {
    apologize("This browser draws no WebGL. Turn on hardware acceleration, or try another browser.", error);
    return;
  }
  page.start("blobs");
  window.page = page;  // for tests, and for whoever likes consoles
  await page.restore(location.hash.slice(1)).catch((error) => page.panel.toast(error.message));
  page.stage.renderer.setAnimationLoop(() => page.frame());
  page.started = true;
}

await begin();
