// SPDX-License-Identifier: MIT
// node tests/pictures.js DIR: pictures of the built page to look at, of a desk and of a phone.
import { mkdirSync } from "node:fs";
import { open_browser, open_page, run, start } from "./browser.js";

const folder = process.argv[2] ?? "pictures";
const acts = {
  async blobs(page) {
    await start(page, "blobs");
    for (let i = 0; i < 46; ++i) {
      await page.evaluate((x) => (window.page.hold = { target: [x, 0.1, 0.1] }), -0.6 + 0.03 * Math.min(i, 40));
      await run(page, 1);
    }
  },
  async balloon(page) {
    await start(page, "balloon");
    await run(page, 112);
  },
  async hollow(page) {
    await start(page, "balloon", { phantom: "frame" });
    await run(page, 250);
  },
  async carving(page) {
    await start(page, "carving");
    for (const x of [-0.7, 0, 0.7]) {
      await page.mouse.move(...(await page.evaluate((p) => window.page.stage.pixel(p), [x, 0.1, 0.5])));
      await page.mouse.down();
      await run(page, 40);
      await page.mouse.up();
    }
  },
  async tangles(page) {
    await start(page, "tangles");
    await run(page, 1);
  },
  async untangled(page) {
    await start(page, "tangles");
    await page.locator("#action").click();
    await run(page, 2);
  },
};

mkdirSync(folder, { recursive: true });
const browser = await open_browser();
for (const [kind, size] of Object.entries({ desk: [1280, 800], phone: [390, 780] })) {
  const { page } = await open_page(browser, { size, in_full: true });
  for (const [name, act] of Object.entries(acts)) {
    await act(page);
    await page.screenshot({ path: `${folder}/${name}-${kind}.png` });
    await page.keyboard.press("w");
    await run(page, 1);
    if (kind === "desk") await page.screenshot({ path: `${folder}/${name}-${kind}-wireframe.png` });
    await page.keyboard.press("w");
  }
}
await browser.close();
