// Ten minutes with the page: does it keep its memory? Studies, settings, maps, sweeps and comparisons follow one another; what
// Chromium holds, workers and their modules included, is written down every half minute.
//
//     node web/tests/endurance.mjs [MINUTES]
import { readFileSync, readdirSync } from "node:fs";
import { browse, closePage, openPage } from "./browser.mjs";

const minutes = Number(process.argv[2] ?? 10);
const BEGIN = 0.3; // of the time: by then every part of the page has been in use
const MOST_GROWTH = 1.15; // of the later half beside what comes before: less than one module of some 60 MB that was left behind

/** Memory of the browser's own of all processes that this one has started, in MB: shared pages count in parts. */
function memory() {
  const parents = new Map();
  for (const entry of readdirSync("/proc"))
    if (/^\d+$/.test(entry))
      try {
        parents.set(Number(entry), Number(/^PPid:\s+(\d+)/m.exec(readFileSync(`/proc/${entry}/status`, "utf8"))[1]));
      } catch {
        // It has ended meanwhile.
      }
  const ours = (id) => id === process.pid || (parents.has(id) && ours(parents.get(id)));
  let sum = 0;
  for (const id of parents.keys())
    if (id !== process.pid && ours(id))
      try {
        sum += Number(/^Pss:\s+(\d+)/m.exec(readFileSync(`/proc/${id}/smaps_rollup`, "utf8"))[1]) / 1000;
      } catch {
        // Likewise.
      }
  return sum;
}

const browser = await browse();
const page = await openPage(browser);
const names = await page.$$eval("#preset optgroup[label^='Wright'] option", (all) => all.map((one) => one.value));
const begin = performance.now();
const passed = () => (performance.now() - begin) / 60_000;
const looks = [];
for (let round = 0; passed() < minutes; ++round) {
  await page.selectOption("#preset", names[(7 * round) % names.length]);
  await page.waitForTimeout(5000);
  await page.fill('[data-key="balancer.drag"] .entry input', String(0.03 + 0.01 * (round % 5)));
  await page.keyboard.press("Enter");
  await page.waitForTimeout(15_000);
  if (round % 3 === 0) {
    await page.fill("#sweep-form input >> nth=3", "100");
    await page.getByRole("button", { name: "Sweep" }).click();
  }
  await page.waitForTimeout(10_000);
  looks.push({ at: passed(), size: memory() });
  console.log(`${passed().toFixed(1)} min: ${memory().toFixed(0)} MB`);
}
await closePage(page);
await browser.close();

const median = (all) => all.map(({ size }) => size).sort((a, b) => a - b)[Math.floor(all.length / 2)];
const used = looks.filter(({ at }) => at > BEGIN * minutes);
const half = used.length / 2;
const [earlier, later] = [median(used.slice(0, Math.floor(half))), median(used.slice(Math.ceil(half)))];
console.log(`median ${earlier.toFixed(0)} MB, then ${later.toFixed(0)} MB`);
process.exitCode = later < MOST_GROWTH * earlier ? 0 : 1;
