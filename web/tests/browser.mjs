// The built page in Chromium: what all tests of the page begin with.
import { existsSync } from "node:fs";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
const PAGE = process.env.EQUIPOISE_PAGE ?? fileURLToPath(new URL("../../build/web/index.html", import.meta.url));

/** For a test; a free machine needs a few seconds, one that builds beside it a hundred times as long. */
export const LONGEST = 800_000;
const PATIENCE = 240_000; // for anything that a page is to show

/** Why these tests cannot run here; false: they can. */
export const missing = !existsSync(CHROMIUM)
  ? `${CHROMIUM} is missing`
  : !existsSync(PAGE)
    ? `${PAGE} is not built`
    : false;

export const address = pathToFileURL(PAGE).href;

export async function browse() {
  return chromium.launch({ executablePath: CHROMIUM, args: ["--no-sandbox", "--enable-precise-memory-info"] });
}

/**
 * A page that keeps what it asks of the world and what breaks in it; workers can be broken from outside. `before`: run in it
 * ahead of its own scripts.
 */
export async function openPage(browser, { hash = "", ready = true, before = () => undefined, ...options } = {}) {
  const context = await browser.newContext({
    viewport: { width: 1440, height: 900 },
    acceptDownloads: true,
    ...options,
  });
  context.setDefaultTimeout(PATIENCE);
  const page = await context.newPage();
  page.errors = [];
  page.requests = [];
  page.on("pageerror", (error) => page.errors.push(error.message));
  page.on("request", (request) => page.requests.push(request.url()));
  await page.addInitScript(() => {
    const Real = window.Worker;
    window.workers = [];
    window.Worker = class extends Real {
      constructor(...args) {
        super(...args);
        window.workers.push(this);
      }
    };
  });
  await page.addInitScript(before);
  await page.goto(address + (hash ? `#${hash}` : ""));
  if (ready) await page.waitForSelector("#verdict .big", { timeout: PATIENCE });
  return page;
}

/** For pages of which no motion is looked at: nothing is drawn anew sixty times a second. */
export const STILL = { reducedMotion: "reduce" };

/** One page for checks that follow one another on it: opened by the first of them. Loading and searching take longest. */
export function sharedPage(open) {
  let page;
  return () => (page ??= open());
}

export const closePage = (page) => page.context().close();

/** The number in the first text that looks like one. */
export function numberIn(text) {
  return Number(/-?\d+(?:\.\d+)?/.exec(text.replaceAll("\u202f", ""))[0]);
}

/** Shares in the table of outcomes, by name. */
export async function sharesOn(page) {
  const rows = await page.$$eval("#share-list tbody tr", (all) =>
    all.map((row) => [...row.cells].map((cell) => cell.textContent)),
  );
  return Object.fromEntries(
    rows.map(([name, share, interval, starts]) => [
      name,
      { share: numberIn(share), interval, starts: numberIn(starts) },
    ]),
  );
}

export async function settledShares(page, starts) {
  await page.waitForFunction(
    (least) =>
      Number(
        (document.querySelector("#verdict .quiet")?.textContent ?? "")
          .replaceAll("\u202f", "")
          .match(/from (\d+)/)?.[1] ?? 0,
      ) >= least,
    starts,
  );
  return sharesOn(page);
}

export async function download(page, action) {
  const [file] = await Promise.all([page.waitForEvent("download"), action()]);
  const stream = await file.createReadStream();
  const parts = [];
  for await (const part of stream) parts.push(part);
  return { name: file.suggestedFilename(), bytes: Buffer.concat(parts) };
}

/** Opens one of the save menus and takes one of its files. */
export async function saved(page, menu, item) {
  const box = page.locator(`details.save:has(summary[aria-label="${menu}"])`);
  await box.locator("summary").click();
  return download(page, () => box.getByRole("button", { name: item }).click());
}
