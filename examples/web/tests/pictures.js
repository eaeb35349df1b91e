// SPDX-License-Identifier: MIT
// node tests/pictures.js DIR [NAME...]: pictures of the built page to look at, of a desk and of a phone.
import { mkdirSync } from "node:fs";
import { open_browser, open_page, start } from "./browser.js";

// Frames, of which the last is drawn.
const play = (page, frames) =>
  page.evaluate((count) => {
    const { page } = window, { renderer } = page.stage, { render } = renderer;
    renderer.render = () => {};
    for (let i = 1; i < count; ++i) page.frame();
    renderer.render = render;
    page.stage.resize();
    page.frame();
  }, frames);

const folder = process.argv[2] ?? "pictures";
const acts = {
  async blobs(page) {
    await start(page, "blobs");
    await page.evaluate(() => (window.page.hold = { target: [-0.6, 0.1, 0.1] }));
    await play(page, 2);
    await page.evaluate(() => (window.page.hold = { target: [0.6, 0.1, 0.1] }));
    await play(page, 44);
  },
  async balloon(page) {
    await start(page, "balloon");
    await play(page, 112);
  },
  async hollow(page) {
    await start(page, "balloon", { phantom: "frame" });
    await play(page, 250);
  },
  async carving(page) {
    await start(page, "carving");
    for (const x of [-0.7, 0, 0.7]) {
      await page.mouse.move(...(await page.evaluate((p) => window.page.stage.pixel(p), [x, 0.1, 0.5])));
      await page.mouse.down();
      await play(page, 40);
      await page.mouse.up();
    }
  },
  async tangles(page) {
    await start(page, "tangles");
    await play(page, 1);
  },
  async untangled(page) {
    await start(page, "tangles");
    await page.locator("#action").click();
    await play(page, 2);
  },
};

mkdirSync(folder, { recursive: true });
const browser = await open_browser();
for (const [kind, size] of Object.entries({ desk: [1280, 800], phone: [390, 780] })) {
  const { page } = await open_page(browser, { size, in_full: true });
  for (const [name, act] of Object.entries(acts)) {
    if (process.argv.length > 3 && !process.argv.includes(name)) continue;
    await act(page);
    await page.screenshot({ path: `${folder}/${name}-${kind}.png` });
    await page.keyboard.press("w");
    await play(page, 1);
    if (kind === "desk") await page.screenshot({ path: `${folder}/${name}-${kind}-wireframe.png` });
    await page.keyboard.press("w");
  }
}
await browser.close();
