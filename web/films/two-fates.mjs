// The moving picture of README: one machine, two starts; one ends balanced, the other does not. The built page plays both.
//
//     node web/films/two-fates.mjs        (with ffmpeg; writes docs/figures/two-fates.gif)
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { browse, closePage, openPage } from "../tests/browser.mjs";

const PICTURES = 110;
const STEPS = 5; // sixteenths of a turn between two pictures
const RATE = 12; // pictures a second
const SIZE = 280; // of a machine, in pixels
const BACK = fileURLToPath(new URL("../../docs/figures/two-fates.gif", import.meta.url));

/** The first start that ends so. */
async function startThatEnds(page, name) {
  for (let start = 0; start < 200; ++start) {
    const known = (k) => document.querySelector("#stage .fate").textContent.startsWith(`Start ${k} ends`);
    await page.waitForFunction(known, start);
    if ((await page.textContent("#stage .fate")).includes(name)) return start;
    await page.getByRole("button", { name: "Other start" }).click();
  }
  throw new Error(`no start ends ${name}`);
}

/** Pictures of the run, each with the words under it, as PNG in base64. */
function pictures({ count, steps, width, height }) {
  const text = (selector) => document.querySelector(selector).textContent;
  const [machine, step] = [
    document.querySelector("#stage canvas"),
    [...document.querySelectorAll("#stage button")].find((one) => one.textContent === "Step"),
  ];
  const picture = Object.assign(document.createElement("canvas"), { width, height });
  const context = picture.getContext("2d");
  const draw = () => {
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, width, height);
    context.drawImage(machine, 0, 0, width, width);
    context.textAlign = "center";
    context.fillStyle = "#1b1f24";
    context.font = "600 16px system-ui, sans-serif";
    context.fillText(
      text("#stage .fate")
        .replace(/^Start \d+ ends (in )?|, certain.*$/g, "")
        .replace(/[“”]/g, ""),
      width / 2,
      width + 18,
    );
    context.font = "14px system-ui, sans-serif";
    context.fillStyle = "#57606a";
    const words = text("#stage .readout").replace(/speed .*critical/, "");
    context.fillText(
      words.replace("time", "time ").replace("whirl", "   whirl ").replace(/ +/g, " "),
      width / 2,
      width + 40,
    );
    return picture.toDataURL("image/png").split(",")[1];
  };
  const later = () => new Promise((resolve) => setTimeout(resolve, 4));
  return (async () => {
    const all = [];
    for (let k = 0; k < count; ++k) {
      all.push(draw());
      for (let one = 0; one < steps; ++one) {
        const before = text("#stage .readout b");
        for (let tries = 0; tries < 2000 && text("#stage .readout b") === before; ++tries) {
          step.click();
          await later();
        }
      }
    }
    return all;
  })();
}

async function film(browser, name, folder) {
  const page = await openPage(browser, {
    viewport: { width: 400, height: 1200 },
    reducedMotion: "reduce",
    wait: 300_000,
  });
  await startThatEnds(page, name);
  const all = await page.evaluate(pictures, { count: PICTURES, steps: STEPS, width: SIZE, height: SIZE + 50 });
  all.forEach((picture, k) =>
    writeFileSync(join(folder, `${String(k).padStart(4, "0")}.png`), Buffer.from(picture, "base64")),
  );
  await closePage(page);
}

const folders = ["balanced", "drifting apart"].map((name) => ({ name, path: mkdtempSync(join(tmpdir(), "film-")) }));
const browser = await browse();
for (const { name, path } of folders) await film(browser, name, path);
await browser.close();
const inputs = folders.flatMap(({ path }) => ["-framerate", String(RATE), "-i", join(path, "%04d.png")]);
const filter = "[0][1]hstack,split[a][b];[a]palettegen=max_colors=20[p];[b][p]paletteuse=dither=none";
execFileSync("ffmpeg", ["-y", "-loglevel", "error", ...inputs, "-filter_complex", filter, BACK]);
for (const { path } of folders) rmSync(path, { recursive: true });
