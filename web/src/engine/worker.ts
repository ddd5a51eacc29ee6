// The worker: is given the compiled engine, makes one of its own of it and answers calls in the order in which they come.
import createEquipoise from "../../../build/web-engine/equipoise.mjs";
import { loadEngine, type Engine } from "./module.mjs";
import type { Problem, Request, Response } from "./protocol";

const say = (response: Response, transfer: Transferable[] = []) =>
  (self as unknown as { postMessage(message: unknown, transfer: Transferable[]): void }).postMessage(
    response,
    transfer,
  );

/** The typed arrays of an answer: they are handed over, not copied. */
function arraysOf(result: unknown): Transferable[] {
  if (typeof result !== "object" || result === null) return [];
  return Object.values(result).flatMap((value) => (ArrayBuffer.isView(value) ? [value.buffer as ArrayBuffer] : []));
}

function crash(error: unknown): Problem {
  const message = error instanceof Error ? error.message : String(error);
  return { message, key: "", value: "", problem: message, allowed: "", line: 0, kind: "crash" };
}

let current = 0;
let give: (compiled: WebAssembly.Module) => void;
const engine: Promise<Engine> = new Promise<WebAssembly.Module>((resolve) => (give = resolve)).then((compiled) =>
  loadEngine(createEquipoise, compiled, (progress) => say({ id: current, progress })),
);

self.addEventListener("message", (event: MessageEvent<WebAssembly.Module | Request>) => {
  if (event.data instanceof WebAssembly.Module) return give(event.data);
  const { id, call, args } = event.data;
  void engine
    .then((ask) => {
      current = id;
      const answer = ask(call, args);
      if ("error" in answer) say({ id, error: answer.error });
      else say({ id, result: answer.result }, arraysOf(answer.result));
    })
    // What the module does not answer leaves it in no state to go on in.
    .catch((error: unknown) => say({ id, error: crash(error) }));
});
