// SPDX-License-Identifier: MIT
// What the tests of the page share: a headless Chromium without a network, and the page from the disk.
import { existsSync } from "node:fs";
import { chromium } from "playwright-core";

const page_file = new URL("../dist/index.html", import.meta.url);
const executable = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"]
  .find((path) => path !== undefined && existsSync(path));

// Of a single act, in milliseconds: a busy machine without a graphics processor is slow.
const patience = 300000;

export const no_chromium = executable === undefined ? "no chromium" : undefined;
export const missing = no_chromium ?? (existsSync(page_file) ? undefined : "no dist/index.html: npm run build");

export async function open_browser() {
  const args = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage"];
  if (process.getuid?.() === 0) args.push("--no-sandbox");
  return chromium.launch({ executablePath: executable, args, timeout: patience });
}

/** A page that has begun and stands still, and the list of the errors of its console. With a script `first`, which runs
 * before those of the page, the page is handed over at once. */
export async function open_page(browser, { address = "", size = [800, 500], in_full = false, first = "" } = {}) {
  const context = await browser.newContext({ viewport: { width: size[0], height: size[1] }, hasTouch: true });
  await context.setOffline(true);
  context.setDefaultTimeout(patience);
  context.setDefaultNavigationTimeout(patience);
  const page = await context.newPage();
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  if (first !== "") await page.addInitScript(first);
  await page.goto(page_file.href + address);
  if (first !== "") return { page, errors };
  await page.waitForFunction(() => window.page?.started, null, { polling: 50 });
  // Tiny pictures without new shadows, for processors that draw by themselves.
  await page.evaluate((drawn_in_full) => {
    const { renderer, controls } = window.page.stage;
    renderer.setAnimationLoop(null);
    controls.enableDamping = false;  // the camera stops where a hand leaves it
    if (drawn_in_full) return;
    renderer.setPixelRatio(0.05);
    renderer.shadowMap.autoUpdate = false;
  }, in_full);
  return { page, errors };
}

/** Frames without waiting for the display; all pictures are finished at the end, or the last alone is drawn. */
export const run = (page, frames, { draw_all = false } = {}) =>
  page.evaluate(([count, all]) => {
    const { renderer } = window.page.stage, context = renderer.getContext(), pixel = new Uint8Array(4);
    const draw = renderer.render;
    for (let i = 0; i < count; ++i) {
      renderer.render = all || i === count - 1 ? draw : () => {};
      window.page.frame();
    }
    context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, pixel);
  }, [frames, draw_all]);

export const start = (page, scene, settings) =>
  page.evaluate(([name, values]) => window.page.start(name, values), [scene, settings]);

export const shown = (page, id) => page.locator(`#${id}`).textContent();
