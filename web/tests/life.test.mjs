// The page as a thing to live with: frame rate, memory, broken workers, phones, keyboards, dark rooms.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { LONGEST, STILL, browse, closePage, missing, openPage, settledShares, sharedPage } from "./browser.mjs";

let browser;
before(async () => {
  if (!missing) browser = await browse();
});
after(() => browser?.close());

/** The first study, playing. */
const playing = sharedPage(() => openPage(browser));
/** Of fewer starts, and standing still. */
const FEW = 2000;
const standing = sharedPage(() =>
  openPage(browser, { ...STILL, hash: `study=table-2-omega-2.4&set=sampling.starts%3D${FEW}` }),
);

const check = (name, work) => test(name, { skip: missing, timeout: LONGEST }, work);

// Counted in pictures and not in seconds: a busy machine draws fewer of them, and the same holds of each.
check("plays on from picture to picture while workers compute", async () => {
  const page = await playing();
  const { still, starts } = await page.evaluate(
    () =>
      new Promise((resolve) => {
        const text = (place) => document.querySelector(place)?.textContent ?? "";
        const seen = new Set();
        let time = "", same = 0, still = 0, pictures = 0;
        const tick = () => {
          seen.add(text("#verdict"));
          const now = text("#stage .readout b");
          same = now === time ? same + 1 : 0;
          still = Math.max(still, same);
          time = now;
          // Until workers have added starts some times, and at least for this many pictures.
          if (++pictures < 150 || (seen.size < 3 && pictures < 5000)) requestAnimationFrame(tick);
          else resolve({ still, starts: seen.size });
        };
        requestAnimationFrame(tick);
      }),
  );
  assert.ok(starts >= 3, `the answer was shown in ${starts} states`);
  // The time is shown in tenths: some pictures may share one.
  assert.ok(still < 30, `the rotor stood still for ${still} pictures`);
});

check("steps, pauses, lets held balls go, and a dragged ball starts where it is dropped", async () => {
  const page = await openPage(browser, { hash: "study=table-4-omega-2.4&start=0", ready: false });
  await page.waitForFunction(() => /balls held/.test(document.querySelector("#stage .readout")?.textContent ?? ""));
  await page.getByRole("button", { name: "Let the balls go" }).click();
  await page.waitForFunction(() => !/balls held/.test(document.querySelector("#stage .readout").textContent));
  await page.getByRole("button", { name: "Pause" }).click();
  const paused = await page.textContent("#stage .readout");
  await page.getByRole("button", { name: "Step" }).click();
  await page.waitForFunction((text) => document.querySelector("#stage .readout").textContent !== text, paused);
  await page.getByRole("button", { name: "with the rotor" }).click();
  // Watched from before the click: a busy machine may show time 0 for a single picture.
  await page.evaluate(() => {
    const readout = document.querySelector("#stage .readout");
    new MutationObserver(() => (window.begun ||= /time 0/.test(readout.textContent))).observe(readout, { childList: true });
  });
  await page.getByRole("button", { name: "Spin up again" }).click();
  await page.waitForFunction(() => window.begun);
  // Drag ball 1 to 90 degrees: straight up from the centre of the disc.
  const box = await page.locator("#stage canvas").boundingBox();
  const radius = box.width / 2 / (1.18 + 0.3);
  const from = (Math.PI / 180) * Number(await page.inputValue(".angles input"));
  const middle = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(middle[0] + radius * Math.cos(from), middle[1] - radius * Math.sin(from));
  await page.mouse.down();
  await page.mouse.move(middle[0], middle[1] - radius, { steps: 4 });
  await page.mouse.up();
  const angle = Number(await page.inputValue(".angles input"));
  assert.ok(Math.abs(angle - 90) < 2, String(angle));
  await page.waitForFunction(() => /This start/.test(document.querySelector("#stage .fate").textContent));
  await closePage(page);
});

check("a worker that breaks is replaced, said so, and the answer goes on", async () => {
  const page = await playing();
  await settledShares(page, 10_000);
  await page.evaluate(() => {
    [...document.querySelectorAll("button")].find((one) => one.textContent.includes("more starts")).click();
    for (const worker of [...window.workers]) {
      worker.dispatchEvent(new ErrorEvent("error", { message: "unreachable executed" }));
      worker.terminate();
    }
  });
  await page.waitForSelector("#notices .notice");
  assert.match(await page.textContent("#notices"), /started again/);
  await settledShares(page, 20_000);
  const time = await page.textContent("#stage .readout b");
  await page.waitForFunction((text) => document.querySelector("#stage .readout b").textContent !== text, time);
});

check("memory stays flat from study to study", async () => {
  const page = await playing();
  const names = await page.$$eval("#preset optgroup[label^='Wright'] option", (all) =>
    all.slice(0, 6).map((one) => one.value),
  );
  const session = await page.context().newCDPSession(page);
  const heap = async () => {
    await session.send("HeapProfiler.collectGarbage");
    return (await session.send("Runtime.getHeapUsage")).usedSize;
  };
  const rounds = [];
  for (let round = 0; round < 3; ++round) {
    for (const name of names) {
      await page.selectOption("#preset", name);
      await page.waitForTimeout(250);
    }
    rounds.push(await heap());
  }
  console.log(`heap after each round, MB: ${rounds.map((size) => (size / 1e6).toFixed(1)).join(", ")}`);
  // A study that leaked its map (256 x 256 x 12 bytes) and starts would add 15 MB a round of six.
  assert.ok(rounds[2] - rounds[0] < 8e6, String(rounds));
});

check("on a phone the verdict comes first, nothing is wider than the screen, and touch plays a start", async () => {
  const page = await openPage(browser, { ...STILL, viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  await page.waitForFunction(() => /^From the first/.test(document.querySelector("#judgement .number")?.textContent ?? ""));
  const top = (id) => page.$eval(id, (one) => one.getBoundingClientRect().top + window.scrollY);
  assert.ok((await top("#judgement .call")) < 300);
  assert.ok((await top("#decision")) < (await top("#answer")));
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  await page.waitForFunction(() => /(16|32|64|128) × /.test(document.querySelector("#map .quiet").textContent));
  await page.locator("#map canvas").tap();
  await page.waitForFunction(() => /This start/.test(document.querySelector("#stage .fate").textContent));
  const small = await page.$$eval("button, select", (all) =>
    all
      .filter(
        (one) =>
          one.offsetParent &&
          !one.closest(".segments") &&
          !one.classList.contains("text") &&
          one.getBoundingClientRect().height < 36,
      )
      .map((one) => one.textContent),
  );
  assert.deepEqual(small, []); // a fingertip
  await closePage(page);
});

check("shares are those of the starts, whatever the order in which workers took them", async () => {
  const page = await standing();
  const first = await settledShares(page, FEW);
  await page.reload();
  await page.waitForSelector("#verdict .big");
  assert.deepEqual(await settledShares(page, FEW), first);
});

check("by keyboard alone, with a name for everything", async () => {
  const page = await standing();
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "To the answer");
  await page.keyboard.press("Enter");
  const nameless = await page.$$eval("button, select, input:not([hidden]), [role=img], [role=button]", (all) =>
    all
      .filter((one) => !(one.getAttribute("aria-label") || one.labels?.length || one.textContent.trim()))
      .map((one) => one.outerHTML.slice(0, 80)),
  );
  assert.deepEqual(nameless, []);
  const slider = page.locator('[data-key="speed.speed"] input[type=range]');
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.querySelector('[data-key="speed.speed"]').classList.contains("changed"));
});

check("who asked for little motion gets a machine that stands until it is started", async () => {
  const page = await openPage(browser, { reducedMotion: "reduce", colorScheme: "dark" });
  assert.equal(await page.textContent("#stage button.main"), "Play");
  const paper = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  assert.equal(paper, "rgb(15, 19, 23)");
  await closePage(page);
});
