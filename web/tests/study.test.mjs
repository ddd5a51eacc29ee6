// Studies in and out: the address, files, wrong values, units, and what can be taken home.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { deflateRawSync } from "node:zlib";
import {
  LONGEST,
  STILL,
  browse,
  closePage,
  download,
  missing,
  openPage,
  saved,
  settledShares,
  sharedPage,
  sharesOn,
} from "./browser.mjs";

let browser;
before(async () => {
  if (!missing) browser = await browse();
});
after(() => browser?.close());

/** The first study, from the moment it is opened on. */
const first = sharedPage(() => openPage(browser, STILL));

const check = (name, work) => test(name, { skip: missing, timeout: LONGEST }, work);
const machine = new URL("../../studies/examples/washing-machine.toml", import.meta.url);

check("the address reproduces the setting exactly", async () => {
  const page = await openPage(browser, { ...STILL, hash: "study=table-2-omega-2.4&set=sampling.starts%3D500", ready: false });
  await page.fill('[data-key="balancer.drag"] .entry input', "0.07");
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Other start" }).click();
  await page.waitForFunction(() => /drag%3D0.07|drag=0.07/.test(location.hash) && /start=1/.test(location.hash));
  const fates = async (of) => {
    await settledShares(of, 500); // all that were asked for
    const file = await saved(of, "Save shares or starts", "every start");
    return file.bytes.toString().trim().split("\n");
  };
  const fatesHere = await fates(page);
  assert.equal(fatesHere.length, 501);
  const angles = await page.$$eval(".angles input", (all) => all.map((input) => input.value));
  const other = await openPage(browser, { ...STILL, hash: new URL(page.url()).hash.slice(1) });
  assert.equal(await other.inputValue('[data-key="balancer.drag"] .entry input'), "0.07");
  assert.deepEqual(await fates(other), fatesHere);
  await other.waitForFunction((wanted) => document.querySelector(".angles input").value === wanted, angles[0]);
  await closePage(page);
  await closePage(other);
});

check("pictures and tables can be taken home", async () => {
  const page = await first();
  await settledShares(page, 500);
  const shares = await saved(page, "Save shares or starts", "shares (CSV)");
  assert.match(shares.bytes.toString(), /^code,name,alias,count,total,share,low,high\n1,balanced,/);
  const starts = (await saved(page, "Save shares or starts", "every start")).bytes.toString().trim().split("\n");
  assert.ok(starts.length > 500 && starts[0] === "start,phi_1,phi_2,code,outcome,time");
  const run = await saved(page, "Save the machine or its run", "run (CSV)");
  assert.match(run.bytes.toString(), /^t,psi_dot,radial,/);
  const png = await saved(page, "Save the machine or its run", "picture (PNG)");
  assert.equal(png.bytes.subarray(1, 4).toString(), "PNG");
  await page.waitForFunction(() => /(16|32|64|128|256) × /.test(document.querySelector("#map .quiet").textContent));
  for (const [item, begin] of [
    ["picture (SVG)", "<svg"],
    ["pixels (CSV)", "phi_1"],
    ["picture (PNG)", "\u0089PNG"],
  ]) {
    const { bytes } = await saved(page, "Save the map", item);
    assert.ok(bytes.toString("latin1").startsWith(begin), item);
  }
});

check("a wrong value is refused beside its field in the program's words, and what was there stays", async () => {
  const page = await first();
  const before = await sharesOn(page);
  await page.fill('[data-key="balancer.mass"] .entry input', "-1");
  await page.keyboard.press("Enter");
  const wrong = page.locator('[data-key="balancer.mass"] .wrong');
  await wrong.filter({ hasText: "greater than 0" }).waitFor();
  assert.match(await wrong.textContent(), /balancer\.mass.*-1/);
  assert.equal(await page.getAttribute('[data-key="balancer.mass"] .entry input', "aria-invalid"), "true");
  assert.ok("balanced" in (await sharesOn(page)) && "balanced" in before);
  await page.fill('[data-key="balancer.mass"] .entry input', "0.06");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector('[data-key="balancer.mass"] .wrong').textContent === "");
});

check("a broken file is refused in one line, and the page goes on", async () => {
  const page = await first();
  await page.setInputFiles("#study-file", {
    name: "broken.toml",
    mimeType: "text/plain",
    buffer: Buffer.from("[rotor\n"),
  });
  await page.waitForFunction(() => [...document.querySelectorAll(".wrong")].some((one) => one.textContent.length > 5));
  await page.selectOption("#preset", { label: await page.locator("#preset option").nth(1).textContent() });
  await page.waitForFunction(() => [...document.querySelectorAll(".wrong")].every((one) => one.textContent === ""));
});

check("a machine in physical units, opened from a file: units, menus, a study that comes back", async () => {
  const page = await first();
  await page.setInputFiles("#study-file", machine.pathname);
  // The study before may have a mass, too.
  const value = /^mass = "([\d.]+) kg"/m.exec(readFileSync(machine, "utf8"))[1];
  await page.waitForFunction(
    (kilograms) => document.querySelector('[data-key="rotor.mass"] .entry input')?.value === kilograms,
    value,
  );
  assert.equal(await page.inputValue('[data-key="rotor.mass"] select.unit'), "kg");
  // The same mass in grams: the number follows its unit, and the answer stays what it is.
  await page.selectOption('[data-key="rotor.mass"] select.unit', "g");
  await page.waitForFunction(
    (grams) => Number(document.querySelector('[data-key="rotor.mass"] .entry input').value) === grams,
    1000 * Number(value),
  );
  const study = await download(page, () => page.click("#save-study"));
  assert.match(study.bytes.toString(), /\[rotor\]/);
  assert.equal(study.name, "study.toml");
  assert.match(await page.textContent("#terminal pre"), /^equipoise basin /);
});

check("a link cannot ask for what takes the page down", async () => {
  const endless = "study=table-2-omega-2.4&sweep=balancer.drag~0~1~1e9~1e9~";
  const bomb = deflateRawSync(Buffer.alloc(64 << 20, 32)).toString("base64").replaceAll("+", "-").replaceAll("/", "_");
  for (const hash of [endless, `toml=${bomb}`]) {
    const page = await openPage(browser, { ...STILL, hash });
    assert.deepEqual(page.errors, []);
    assert.equal(await page.$("#sweep-chart svg"), null);
    await closePage(page);
  }
});

check("the page runs its own scripts alone, and reaches nothing", async () => {
  const page = await openPage(browser, STILL);
  const reached = await page.evaluate(async () => {
    const script = document.createElement("script");
    script.textContent = "window.injected = true";
    document.body.append(script);
    const answer = await fetch("data:,x").then(
      () => true,
      () => false,
    );
    return [window.injected === true, answer];
  });
  assert.deepEqual(reached, [false, false]);
  await closePage(page);
});
