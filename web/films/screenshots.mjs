// A screenshot of the built page for docs/explanation/web.md, as small as their flat colours allow.
//
//     node web/films/screenshots.mjs        (with ffmpeg; writes docs/figures/explorer/desktop.png)
import { execFileSync } from "node:child_process";
import { mkdirSync, rmSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { browse, closePage, openPage, settledShares } from "../tests/browser.mjs";

const FOLDER = fileURLToPath(new URL("../../docs/figures/explorer/", import.meta.url));

mkdirSync(FOLDER, { recursive: true });
const browser = await browse();
const page = await openPage(browser, { viewport: { width: 1440, height: 900 }, ready: false });
await page.waitForSelector("#verdict .big");
await settledShares(page, 10_000);
const sharp = (least) => Number(/(\d+) ×/.exec(document.querySelector("#map .quiet").textContent)?.[1] ?? 0) >= least;
await page.waitForFunction(sharp, 64);
const [raw, small] = [`${FOLDER}desktop.raw.png`, `${FOLDER}desktop.png`];
await page.screenshot({ path: raw });
await closePage(page);
const palette = "split[a][b];[a]palettegen=max_colors=128[p];[b][p]paletteuse=dither=none";
execFileSync("ffmpeg", ["-y", "-loglevel", "error", "-i", raw, "-filter_complex", palette, small]);
rmSync(raw);
await browser.close();
