// SPDX-License-Identifier: MIT
// panel: numbers, buttons, the list of events, and the marks where events happen.

const get = (id) => document.getElementById(id);
const names = {
  merge: () => "merge",
  split: (n) => `split into ${n}`,
  "genus-up": (n) => `genus +${n}`,
  "genus-down": (n) => `genus −${n}`,
  death: (n) => (n === 1 ? "one vanished" : `${n} vanished`),
  rollback: () => "held back",
};
const shown_frames = 120;

export class Panel {
  #marks = [];
  #times = [];
  #toast_timer = 0;

  constructor() {
    this.chart = get("chart").getContext("2d");
  }

  /** Fits the controls to a scene. */
  show_scene(name, scene, settings) {
    for (const tab of get("scenes").children) tab.setAttribute("aria-selected", String(tab.dataset.scene === name));
    get("hint").textContent = scene.hint;
    get("action").textContent = scene.action;
    get("action").hidden = name === "carving";
    get("tools").hidden = get("brush-row").hidden = name !== "carving";
    if (name === "carving") get("brush").value = settings.brush;
    get("variant-row").hidden = scene.variants === undefined;
    if (scene.variants !== undefined) {
      const { name: setting, of } = scene.variants;
      get("variant-name").textContent = setting[0].toUpperCase() + setting.slice(1);
      get("variant").replaceChildren(...Object.entries(of).map(([value, { title }]) =>
        new Option(title, value, false, value === settings[setting])));
    }
    this.clear();
  }

  clear() {
    this.#marks.forEach(({ element }) => element.remove());
    this.#marks = [];
    this.#times = [];
    const empty = document.createElement("li");
    empty.className = "empty";
    empty.textContent = "none yet";
    get("log").replaceChildren(empty);
  }

  press(id, pressed) {
    get(id).setAttribute("aria-pressed", String(pressed));
  }

  toast(text) {
    get("toast").textContent = text;
    get("toast").classList.add("shown");
    clearTimeout(this.#toast_timer);
    this.#toast_timer = setTimeout(() => get("toast").classList.remove("shown"), 3200);
  }

  show_world(world) {
    put("components", String(world.components.length));
    put("genus", String(world.genus));
    put("volume", world.volume.toFixed(3), false);
    put("vertices", world.mesh.vertexCount.toLocaleString("en"), false);
  }

  add_time(library, upload) {
    this.#times.push({ library, upload });
    if (this.#times.length > shown_frames) this.#times.shift();
  }

  show_times() {
    if (this.#times.length === 0) return;
    const middle = (of) => quantile(this.#times.map(of), 0.5);
    const sums = this.#times.map(({ library, upload }) => library + upload);
    get("frame-time").textContent = `${quantile(sums, 0.5).toFixed(1)} ms · 95 % ${quantile(sums, 0.95).toFixed(1)}`;
    get("library-time").textContent = middle(({ library }) => library).toFixed(1);
    get("upload-time").textContent = middle(({ upload }) => upload).toFixed(1);
    this.#draw_chart();
  }

  // Bars of the last frames; the line is 16 ms.
  #draw_chart() {
    const { chart } = this, { width, height } = chart.canvas;
    const scale = height / 24, bar = width / shown_frames;
    chart.clearRect(0, 0, width, height);
    this.#times.forEach(({ library, upload }, i) => {
      chart.fillStyle = "#2a7f9e";
      chart.fillRect(i * bar, height - library * scale, bar - 1, library * scale);
      chart.fillStyle = "#e0a43c";
      chart.fillRect(i * bar, height - (library + upload) * scale, bar - 1, upload * scale);
    });
    chart.fillStyle = "#26303a66";
    chart.fillRect(0, height - 16 * scale, width, 1.5);
  }

  /** Lists the events of a frame, and marks them. */
  add_events(marks, frame) {
    for (const { type, amount, position } of marks) {
      const text = names[type](amount);
      const line = document.createElement("li");
      line.innerHTML = "<b></b><span></span>";
      line.firstChild.textContent = text;
      line.lastChild.textContent = `frame ${frame}`;
      get("log").querySelector(".empty")?.remove();
      get("log").prepend(line);
      while (get("log").children.length > 5) get("log").lastChild.remove();
      const element = document.createElement("div");
      element.className = `mark ${type}`;
      element.innerHTML = "<span></span>";
      element.firstChild.textContent = text;
      // Marks of one place stand on top of each other.
      const level = marks.findIndex((mark) => mark.type === type);
      element.firstChild.style.marginTop = `${-28 * level}px`;
      get("marks").append(element);
      this.#marks.push({ element, position });
      element.addEventListener("animationend", (event) => {
        if (event.animationName !== "fade") return;
        element.remove();
        this.#marks = this.#marks.filter((mark) => mark.element !== element);
      });
    }
  }

  place_marks(stage) {
    for (const { element, position } of this.#marks) {
      const pixel = stage.pixel(position);
      element.hidden = pixel === null;
      if (pixel !== null) element.style.transform = `translate(${pixel[0]}px, ${pixel[1]}px)`;
    }
  }
}

export function quantile(numbers, part) {
  const sorted = [...numbers].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];
}

function put(id, text, flashes = true) {
  const element = get(id);
  if (element.textContent === text) return;
  const first = element.textContent === "–";
  element.textContent = text;
  if (!flashes || first) return;
  element.classList.remove("flash");
  void element.offsetWidth;  // the animation begins anew
  element.classList.add("flash");
}
