// The browser's engine under Node.js: calls from standard input, one JSON list [name, ...arguments] a line; answers on
// standard output, one a line, typed arrays as lists.
//
//     engine.mjs ENGINE_FOLDER MODULE_MJS
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";
import { resolve } from "node:path";

const [folder, door] = process.argv.slice(2).map((path) => resolve(path));
const { default: createEquipoise } = await import(pathToFileURL(`${folder}/equipoise.mjs`));
const { loadEngine } = await import(pathToFileURL(door));
const ask = await loadEngine(createEquipoise, await WebAssembly.compile(readFileSync(`${folder}/equipoise.wasm`)));

/** Lists that are meant to be typed arrays come as {"f64": [...]} or {"i32": [...]}. */
const typed = (_key, value) =>
  value?.f64 ? Float64Array.from(value.f64) : value?.i32 ? Int32Array.from(value.i32) : value;
const listed = (_key, value) => (ArrayBuffer.isView(value) ? Array.from(value) : value);

for await (const line of createInterface({ input: process.stdin })) {
  const [call, ...args] = JSON.parse(line, typed);
  const begin = performance.now();
  const answer = ask(call, args);
  process.stdout.write(JSON.stringify({ ...answer, seconds: (performance.now() - begin) / 1000 }, listed) + "\n");
}
