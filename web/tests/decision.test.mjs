// What is told before everything else: the verdict, as the program gives it, and what it rests on.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { after, before, test } from "node:test";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { LONGEST, STILL, browse, missing, openPage, sharedPage } from "./browser.mjs";

const PROGRAM = process.env.EQUIPOISE_PROGRAM ?? fileURLToPath(new URL("../../build/release/equipoise", import.meta.url));
const STARTS = 150;

let browser;
before(async () => {
  if (!missing) browser = await browse();
});
after(() => browser?.close());

/** A machine, asked with so many starts and other values. */
const hashOf = (name, starts, ...set) => {
  const parameters = new URLSearchParams({ study: name });
  for (const one of [`sampling.starts=${starts}`, ...set]) parameters.append("set", one);
  return parameters.toString();
};
/** One page for all: it follows its address from machine to machine. */
const only = sharedPage(() => openPage(browser, { ...STILL, ready: false, hash: hashOf("spin-dryer", 20) }));
const ask = async (...wanted) => {
  const page = await only();
  await page.evaluate((hash) => (window.location.hash = hash), hashOf(...wanted));
  return page;
};
const check = (name, work) => test(name, { skip: missing, timeout: LONGEST }, work);

const judgedOn = (page, starts) =>
  page.waitForFunction(
    (wanted) => document.querySelector("#judgement .number")?.textContent.startsWith(`From the first ${wanted} starts`),
    starts,
  );
const linesOf = async (page) => ({
  words: await page.textContent("#judgement .call"),
  because: await page.textContent("#judgement dd >> nth=0"),
  change: await page.textContent("#judgement dd >> nth=1"),
});

check("too few starts decide nothing: the page says so, and more decide", async () => {
  const page = await only();
  await judgedOn(page, 20);
  const { words, because } = await linesOf(page);
  assert.match(words, /^Too close to call/);
  assert.match(because, /\(above [\d.]+ %\) of runs/);
  await page.click("#judgement button");
  await page.waitForFunction(() => /^Fit it/.test(document.querySelector("#judgement .call").textContent));
});

check("the three lines, tables and names are the program's", async () => {
  if (!existsSync(PROGRAM)) return test.skip(`${PROGRAM} is not built`);
  const study = fileURLToPath(new URL("../../studies/machines/fan.toml", import.meta.url));
  const folder = mkdtempSync(join(tmpdir(), "decision-"));
  after(() => rmSync(folder, { recursive: true }));
  // Kept: for the text they are read.
  const kept = ["-o", join(folder, "kept.nc")];
  const options = ["basin", study, "--starts", String(STARTS), "--quiet", "--cpu", "scalar", ...kept];
  const { words, because, change } = JSON.parse(execFileSync(PROGRAM, [...options, "--json"])).verdict;
  const page = await ask("fan", STARTS);
  await judgedOn(page, STARTS);
  assert.deepEqual(await linesOf(page), { words, because, change });
  // With balls held for so many starts: the caption says when that is done.
  await page.waitForFunction((n) => document.querySelector("#figures").textContent.includes(`median of ${n}.`), STARTS);
  const text = execFileSync(PROGRAM, [...options, "--details", "--wide"], { encoding: "utf8" }).split("\n");
  const lines = new Set(text.map((line) => line.trim().replaceAll(/ +/g, " ")));
  const rows = await page.$$eval("#figures tbody tr", (all) =>
    all.map((row) => [...row.cells].map((cell) => cell.textContent).join(" ")),
  );
  assert.ok(rows.length > 8, String(rows.length));
  for (const row of rows) assert.ok(lines.has(row), row);
});

check("what the balls do is said in an engineer's words", async () => {
  // Table 2 at 2.4 as a machine of 1 kg, 1 N/m and 1 m.
  const toml = `[rotor]\nmass = "1 kg"\nstiffness = "1 N/m"\ndamping = "0.5 N s/m"\neccentricity = "1 cm"
[balancer]\nballs = 2\nrace_radius = "1 m"\nmass = "50 g"\ndrag = "0.0025 N m s"
[speed]\nprofile = "constant"\nspeed = "2.4 rad/s"\n[sampling]\nstarts = 400\n`;
  const page = await only();
  await page.setInputFiles("#study-file", { name: "own.toml", mimeType: "text/plain", buffer: Buffer.from(toml) });
  await judgedOn(page, 400);
  const names = await page.$$eval("#share-list tbody tr", (all) => all.map((row) => row.cells[0].textContent));
  assert.deepEqual(names, ["balanced", "balls circulate together (V1)", "balls circulate apart (V2)"]);
  const velocities = await page.$$eval("#share-list tbody tr", (all) => all.map((row) => row.cells[4].textContent));
  assert.equal(velocities[0], "0");
  assert.ok(velocities.slice(1).every((text) => Number(text) > 1), String(velocities)); // mm/s
});

check("changes are tried when asked for, and the best is told", async () => {
  const page = await ask("fan", 60, "limits.displacement=0.25 mm", "limits.velocity=1 mm/s");
  await judgedOn(page, 60);
  const before = await linesOf(page);
  assert.match(before.words, /^Change the design: /);
  await page.getByRole("button", { name: "Try changes" }).click();
  await page.waitForFunction(() => /Trying twice the drag, 1 of \d/.test(document.querySelector("#judgement").textContent));
  await page.waitForFunction(() => {
    const { textContent } = document.querySelector("#judgement");
    return /on 100 starts, best first/.test(textContent) && !/Trying/.test(textContent);
  });
  const { change } = await linesOf(page);
  assert.match(change, /^.* \d+ of 100 trial runs stayed within every limit .*\.$/);
  assert.ok((await page.$$("#judgement tbody tr")).length > 2);
});

check("a limit that is stated in the form counts at once; so does what a place holds", async () => {
  const page = await ask("grinder-230", 64);
  await judgedOn(page, 64);
  assert.match((await linesOf(page)).words, /^Fit it if you can accept more vibration/);
  const limits = page.locator("fieldset:has(legend:text-is('Limits'))");
  await limits.locator(".adder select").selectOption("limits.velocity");
  assert.match(await limits.locator(".adder p").textContent(), /^root mean square of both directions together, of the centre of the race$/);
  await limits.locator(".adder input").fill("0.001 mm/s");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /stay within every limit/.test(document.querySelector("#judgement dd")?.textContent ?? ""));
  assert.equal(await page.inputValue('[data-key="limits.velocity"] .entry input'), "0.001");
  await ask("centrifuge-12", 10);
  const place = page.locator("#form details:has(> summary:text('Place 1: tube 1'))");
  await place.locator("> summary").click();
  const radius = place.locator('[data-key="place.1.radius"] .entry input');
  assert.equal(await radius.inputValue(), "120");
  await radius.fill("110");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /place\.1\.radius/.test(decodeURIComponent(location.hash)));
  assert.equal(await place.locator('[data-key="place.1.radius"] .wrong').textContent(), "");
});
