// The engine, compiled once for all workers. It comes inside the page, so that nothing has to be fetched.
import packed from "../../../build/web-engine/equipoise.wasm?packed";
import EngineWorker from "./worker?worker&inline";

async function unpacked(base64: string): Promise<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = text.charCodeAt(k);
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

/** What makes a worker: it can be asked at once, and answers when the engine is compiled. `failed`: that it cannot be. */
export function engineWorkers(failed: (error: Error) => void): () => Worker {
  const compiled = unpacked(packed).then((bytes) => WebAssembly.compile(bytes));
  compiled.catch(failed);
  return () => {
    const worker = new EngineWorker();
    compiled.then(
      (module) => worker.postMessage(module),
      () => undefined, // said once, for all of them
    );
    return worker;
  };
}
