// SPDX-License-Identifier: MIT
// chart: genus and volume over time, with the events above them.

const eventKinds = [
  ["merge", "merge", "#6fa8dc"], ["split", "split", "#d678aa"], ["genus_up", "genus up", "#ffb454"],
  ["genus_down", "genus down", "#c9a36a"], ["death", "death", "#9aa5b1"], ["rollback", "kept back", "#e0564f"],
];

const svgNode = (name, attributes, text) => {
  const node = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
};

class Chart {
  // Calls pick(time) for a click or drag.
  constructor(parent, pick) {
    this.svg = svgNode("svg", { role: "img", "aria-label": "Genus and volume over time" });
    parent.append(this.svg);
    this.now = data.frames[0].time;
    const seek = (e) => {
      const x = e.clientX - this.svg.getBoundingClientRect().left;
      pick(this.from + ((x - this.left) / (this.right - this.left)) * (this.to - this.from));
    };
    this.svg.addEventListener("pointerdown", (e) => {
      this.svg.setPointerCapture(e.pointerId);
      seek(e);
    });
    this.svg.addEventListener("pointermove", (e) => e.buttons && seek(e));
    new ResizeObserver(() => this.draw()).observe(parent);
  }

  x(time) {
    return this.left + ((time - this.from) / (this.to - this.from || 1)) * (this.right - this.left);
  }

  draw() {
    const { svg } = this, width = svg.clientWidth || 800, moments = data.moments;
    svg.setAttribute("viewBox", `0 0 ${width} 170`);
    svg.replaceChildren();
    Object.assign(this, { left: 64, right: width - 14, from: moments[0][0], to: moments[moments.length - 1][0] });
    const kinds = this.drawEvents(14);
    this.drawLine(moments, 1, "genus", "genus", 28, 84, true);
    this.drawLine(moments, 4, "size", "volume", 96, 148, false);
    this.drawTicks(164);
    this.drawKinds(kinds, width - 80);
    this.cursor = svgNode("line", { y1: 6, y2: 148, stroke: "#e7eaee", "stroke-width": 1, opacity: 0.75 });
    svg.append(this.cursor);
    this.mark(this.now);
  }

  drawEvents(y) {
    const seen = new Set();
    for (const event of data.events) {
      const here = eventKinds.filter(([key]) => event[key] > 0);
      here.forEach(([key, name, colour], i) => {
        const dot = svgNode("circle", { cx: this.x(event.time), cy: y - 4 + 5 * (i - (here.length - 1) / 2), r: 3.2, fill: colour });
        dot.append(svgNode("title", {}, `${data.time_name} ${text(event.time)}: ${event[key]} ${name}`));
        this.svg.append(dot);
        seen.add(key);
      });
    }
    return seen;
  }

  drawKinds(kinds, x) {
    for (const [key, name, colour] of [...eventKinds].reverse()) {
      if (!kinds.has(key)) continue;
      const label = svgNode("text", { x, y: 164, "text-anchor": "end" }, name);
      this.svg.append(label);
      x -= label.getComputedTextLength() + 8;
      this.svg.append(svgNode("circle", { cx: x, cy: 160, r: 3.2, fill: colour }));
      x -= 14;
    }
  }

  drawLine(moments, column, kind, name, top, bottom, stepped) {
    const values = moments.map((m) => m[column]);
    const low = Math.min(0, ...values), high = Math.max(low + (stepped ? 1 : 1e-30), ...values);
    const y = (v) => bottom - ((v - low) / (high - low)) * (bottom - top);
    const line = (at, opacity) => this.svg.append(svgNode("line", { x1: this.left, x2: this.right, y1: y(at), y2: y(at), stroke: "#2b323b", "stroke-width": 1, opacity }));
    for (const at of [low, high]) {
      line(at, 1);
      this.svg.append(svgNode("text", { x: this.left - 8, y: y(at) + 4, "text-anchor": "end" }, text(at, 3)));
    }
    let path = "";
    moments.forEach((m, i) => {
      const px = this.x(m[0]).toFixed(1), py = y(m[column]).toFixed(1);
      path += i === 0 ? `M${px} ${py}` : stepped ? `H${px}V${py}` : `L${px} ${py}`;
    });
    this.svg.append(svgNode("path", { d: path, class: kind, fill: "none", "stroke-width": 1.8, "stroke-linejoin": "round" }));
    this.svg.append(svgNode("text", { x: this.left - 8, y: (top + bottom) / 2 + 4, "text-anchor": "end", class: `name ${kind}` }, name));
  }

  drawTicks(y) {
    const named = { start: `${data.time_name} ${text(this.from, 3)}`, end: text(this.to, 3) };
    for (const [anchor, tick] of Object.entries(named))
      this.svg.append(svgNode("text", { x: anchor === "start" ? this.left : this.right, y, "text-anchor": anchor }, tick));
  }

  mark(time) {
    this.now = time;
    if (!this.cursor) return;
    this.cursor.setAttribute("x1", this.x(time));
    this.cursor.setAttribute("x2", this.x(time));
  }
}
