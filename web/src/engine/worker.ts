// The worker: loads one module and answers calls in the order in which they come.
import createEquipoise from "../../../build/web-engine/equipoise.mjs";
import packed from "../../../build/web-engine/equipoise.wasm?packed";
import { loadEngine } from "./module.mjs";
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

// The module comes inside the script, so that nothing has to be fetched.
async function unpacked(base64: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

function crash(error: unknown): Problem {
  const message = error instanceof Error ? error.message : String(error);
  return { message, key: "", value: "", problem: message, allowed: "", line: 0, kind: "crash" };
}

let current = 0;
const engine = unpacked(packed).then((bytes) =>
  loadEngine(createEquipoise, bytes, (progress) => say({ id: current, progress })),
);

self.addEventListener("message", (event: MessageEvent<Request>) => {
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

void engine.then(
  () => say({ id: 0, ready: true }),
  () => undefined, // told in answer to the first call
);
