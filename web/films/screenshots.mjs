// Screenshots of the built page for docs/explanation/web.md, as small as their flat colours allow.
//
//     node web/films/screenshots.mjs        (with ffmpeg; writes docs/figures/explorer/*.png)
import { execFileSync } from "node:child_process";
import { mkdirSync, rmSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { browse, closePage, openPage, settledShares } from "../tests/browser.mjs";

const FOLDER = fileURLToPath(new URL("../../docs/figures/explorer/", import.meta.url));
const MACHINE = "study=washing-machine&start=0";
const SHOTS = [
  { name: "desktop", viewport: { width: 1440, height: 900 } },
  { name: "tablet", viewport: { width: 1024, height: 768 }, colorScheme: "dark" },
  { name: "phone", viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true },
  { name: "verdict", viewport: { width: 1440, height: 900 }, hash: "study=grinder-230&start=0", starts: 1000, map: 8 },
  { name: "machine", viewport: { width: 1440, height: 900 }, hash: MACHINE, starts: 1000, map: 8 },
];

mkdirSync(FOLDER, { recursive: true });
const only = process.argv[2];
const browser = await browse();
for (const { name, starts = 10_000, map = 64, ...options } of SHOTS) {
  if (only && only !== name) continue;
  const page = await openPage(browser, { ...options, ready: false });
  await page.waitForSelector("#verdict .big");
  await settledShares(page, starts);
  const sharp = (least) => Number(/(\d+) ×/.exec(document.querySelector("#map .quiet").textContent)?.[1] ?? 0) >= least;
  await page.waitForFunction(sharp, map);
  const [raw, small] = [`${FOLDER}${name}.raw.png`, `${FOLDER}${name}.png`];
  await page.screenshot({ path: raw });
  await closePage(page);
  const palette = "split[a][b];[a]palettegen=max_colors=128[p];[b][p]paletteuse=dither=none";
  execFileSync("ffmpeg", ["-y", "-loglevel", "error", "-i", raw, "-filter_complex", palette, small]);
  rmSync(raw);
}
await browser.close();
