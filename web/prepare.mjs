// What the page knows as it opens: build/web-engine/prepared.json, what its first study is, the motions it ends in and where the
// first of its starts end, as the engine answers that the page holds. Whoever comes need not wait until their browser has
// found the same.
//
//     node prepare.mjs
import { readFileSync, writeFileSync } from "node:fs";
import { loadEngine } from "./src/engine/module.mjs";
import { FIRST_STUDY } from "./src/setting/first_study.mjs";

const STARTS = 1000; // 60.5 % to within 3 points
const folder = new URL("../build/web-engine/", import.meta.url);
const { default: createEquipoise } = await import(new URL("equipoise.mjs", folder));
const engine = await loadEngine(
  createEquipoise,
  await WebAssembly.compile(readFileSync(new URL("equipoise.wasm", folder))),
);

function ask(call, ...args) {
  const answer = engine(call, args);
  if ("error" in answer) throw new Error(answer.error.message);
  return answer.result;
}

const answers = [];
function known(call, ...args) {
  const answer = ask(call, ...args);
  answers.push({ call, args, answer });
  return answer;
}

known("version");
const { toml } = known("check", known("presets").find(({ name }) => name === FIRST_STUDY).toml, []);
const discovery = known("discover", toml);
const { speed, figures, ...fates } = ask("ensemble", toml, 0, STARTS);

// As EnsembleRun.counts() asks for them: motions first, then what is none.
const rank = ({ code }) => (code > 0 ? code : 1_000_000 - code);
const counts = [...fates.outcomes]
  .sort((a, b) => rank(a) - rank(b))
  .map(({ code }) => ({ code, count: fates.outcome.filter((one) => one === code).length }));
known("shares", counts);

const asLists = (_key, value) => (ArrayBuffer.isView(value) ? [...value] : value);
// Paths are drawn, and on no screen is a pixel a millionth of the race.
const asDrawn = (path) =>
  JSON.parse(JSON.stringify(path), (_key, value) => (typeof value === "number" ? Number(value.toFixed(6)) : value));
for (const attractor of discovery.attractors) attractor.path = asDrawn(attractor.path);
writeFileSync(new URL("prepared.json", folder), JSON.stringify({ answers, toml, fates }, asLists));
