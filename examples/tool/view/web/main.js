// SPDX-License-Identifier: MIT
// main: puts the parts of the page together.

const unitOf = (power) => (data.unit ? ` ${data.unit}${power}` : "");

function fact(name, value) {
  const row = document.createElement("div");
  row.append(Object.assign(document.createElement("dt"), { textContent: name }));
  row.append(Object.assign(document.createElement("dd"), { textContent: value, id: "fact_" + name }));
  byId("facts").append(row);
}

function showFacts() {
  const { report } = data, sum = (key) => report.components.reduce((total, part) => total + part[key], 0);
  document.title = `${data.title} - topoadapt ${data.command}`;
  byId("title").textContent = data.title;
  fact("genus", text(sum("genus")));
  fact("components", text(report.components.length));
  fact("volume", text(sum("volume"), 6) + unitOf("³"));
  fact("vertices", text(report.vertices));
  fact("triangles", text(report.triangles));
  if (report.fill) fact("filled", `${text(Math.floor(1000 * report.fill.share) / 10, 4)} %`);
  fact("crossings", text(report.self_intersections));
  const notes = [...(report.objections || []), ...(data.notes.length ? [`Left out of this page: ${data.notes.join("; ")}.`] : [])];
  for (const line of notes) byId("notes").append(Object.assign(document.createElement("p"), { textContent: line }));
}

// The last moment up to a time.
function momentAt(time) {
  let found = data.moments[0];
  for (const m of data.moments) if (m[0] <= time) found = m;
  return found;
}

class Run {
  constructor(views) {
    this.views = views;
    this.slider = byId("frame");
    this.slider.max = data.frames.length - 1;
    this.playing = null;
    const named = data.frames.some((f) => f.name);
    byId("run").hidden = data.frames.length < 2;
    byId("run").classList.toggle("named", named);
    byId("play").hidden = named;
    if (!named && data.frames.length > 1) this.chart = new Chart(byId("chart"), (time) => this.seek(time));
    this.slider.addEventListener("input", () => {
      this.stop();
      this.show(+this.slider.value);
    });
    byId("play").addEventListener("click", () => this.toggle());
    document.addEventListener("keydown", (e) => {
      if (e.key !== " " || e.target.matches("button, input, select") || byId("run").hidden || named) return;
      e.preventDefault();
      this.toggle();
    });
  }

  seek(time) {
    this.stop();
    let best = 0;
    data.frames.forEach((f, i) => {
      if (Math.abs(f.time - time) < Math.abs(data.frames[best].time - time)) best = i;
    });
    return this.show(best);
  }

  async show(index) {
    this.slider.value = index;
    this.wanted = index;
    const mesh = await frameMesh(index);
    // Another frame may have been asked for meanwhile.
    if (this.wanted !== index) return;
    for (const view of this.views) view.show(mesh);
    this.describe(index, mesh);
  }

  describe(index, mesh) {
    const frame = data.frames[index], since = index > 0 ? data.frames[index - 1].time : -Infinity;
    const [, genus, parts, vertices, volume] = momentAt(frame.time);
    byId("moment").value = `${frame.name || `${data.time_name} ${text(frame.time, 4)}`}: genus ${genus}, ${text(parts)} ${parts === 1 ? "component" : "components"}, volume ${text(volume, 5)}${unitOf("³")}, ${text(vertices)} vertices`;
    if (frame.name) {
      byId("legend").textContent = mesh.marked.length ? `${text(mesh.marked.length / 3)} triangles that meet others, red` : "";
      return;
    }
    const now = data.events.filter((e) => e.time > since && e.time <= frame.time);
    this.views[0].showPlaces(now.flatMap((e) => e.places));
    byId("legend").textContent = eventKinds.map(([key, name]) => [now.reduce((sum, e) => sum + e[key], 0), name]).filter(([n]) => n > 0).map(([n, name]) => `${n} ${name}`).join(", ");
    if (this.chart) this.chart.mark(frame.time);
  }

  stop() {
    clearTimeout(this.playing);
    this.playing = null;
    byId("play").setAttribute("aria-label", "Play");
    byId("play").classList.remove("playing");
  }

  toggle() {
    if (this.playing !== null) return this.stop();
    byId("play").setAttribute("aria-label", "Pause");
    byId("play").classList.add("playing");
    let index = this.wanted >= data.frames.length - 1 ? 0 : this.wanted;
    const next = async () => {
      await this.show(index);
      if (this.playing === null) return;
      if (++index < data.frames.length) this.playing = setTimeout(next, Math.max(60, Math.min(250, 8000 / data.frames.length)));
      else this.stop();
    };
    this.playing = setTimeout(next, 0);
  }
}

function listenToTools(view) {
  for (const name of ["wire", "flat", "parts", "planes", "places"]) {
    const box = byId(name);
    view.options[name] = box.checked;
    box.addEventListener("change", () => {
      view.options[name] = box.checked;
      view.draw();
    });
  }
  byId("cut").addEventListener("change", (e) => {
    view.options.cut = e.target.value === "" ? -1 : +e.target.value;
    // The near side goes.
    if (view.options.cut >= 0) view.options.cutSide = view.frame()[2][view.options.cut] < 0 ? -1 : 1;
    byId("cut_at").hidden = view.options.cut < 0;
    view.draw();
  });
  byId("cut_at").addEventListener("input", (e) => {
    view.options.cutAt = +e.target.value / 1000;
    view.draw();
  });
  byId("reset").addEventListener("click", () => view.reset());
}

async function begin() {
  showFacts();
  byId("places").parentElement.hidden = !data.events.some((e) => e.places.length);
  byId("planes").parentElement.hidden = !data.volume;
  byId("slices").hidden = !data.volume;
  byId("main").classList.toggle("sliced", !!data.volume);
  const view = new MeshView(byId("mesh")), views = [view];
  if (data.volume) {
    byId("planes").checked = false;
    views.push(new Slices(byId("slices"), await volumeBytes(), view));
  }
  byId("flat").checked = data.command === "resolve";
  listenToTools(view);
  const run = new Run(views);
  await run.show(data.frames.length - 1);
  document.body.dataset.ready = "yes";
}

begin().catch((error) => {
  console.error(error);
  const line = document.createElement("p");
  line.className = "failed";
  line.textContent = `This page cannot be shown: ${error.message}. It needs WebGL 2 and DecompressionStream (Chrome 80, Firefox 113, Safari 16.4, or newer).`;
  byId("scene").replaceChildren(line);
});
