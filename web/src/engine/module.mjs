// The module's one door from the outside: calls as JSON, typed arrays through its memory. Plain JavaScript, so that
// Node.js runs it as it stands.

/**
 * @param {(given: object) => Promise<any>} createEquipoise default export of equipoise.mjs
 * @param {WebAssembly.Module} compiled equipoise.wasm
 * @param {(progress: object) => void} [onProgress]
 * @returns {Promise<(call: string, args: unknown[]) => {result: unknown} | {error: object}>}
 */
export async function loadEngine(createEquipoise, compiled, onProgress) {
  const module = await createEquipoise({
    instantiateWasm: (imports, done) => {
      void WebAssembly.instantiate(compiled, imports).then(done);
      return {}; // exports follow
    },
    onProgress: (what, done, total, preparing) => onProgress?.({ what, done, total, preparing }),
  });
  return (call, args) => asked(module, call, args);
}

function asked(module, call, args) {
  const taken = [];
  const take = (bytes) => {
    const at = module._malloc(bytes);
    if (at === 0) throw new RangeError("the module's memory is full");
    taken.push(at);
    return at;
  };
  try {
    const request = JSON.stringify({ call, args }, (_key, value) => stored(module, value, take));
    const size = module.lengthBytesUTF8(request) + 1;
    const at = take(size);
    module.stringToUTF8(request, at, size);
    return JSON.parse(module.UTF8ToString(module._equipoise_call(at)), (_key, value) => restored(module, value));
  } finally {
    for (const at of taken) module._free(at);
  }
}

/** A typed array of a request is put into memory; what the request says is where. */
function stored(module, value, take) {
  if (!(value instanceof Float64Array || value instanceof Int32Array)) return value;
  const at = take(Math.max(8, value.byteLength));
  module.HEAPU8.set(new Uint8Array(value.buffer, value.byteOffset, value.byteLength), at);
  return { $array: value instanceof Float64Array ? "f64" : "i32", at, length: value.length };
}

/** And one of a reply is copied out: it is gone with the next call. */
function restored(module, value) {
  if (typeof value !== "object" || value === null || !("$array" in value)) return value;
  const { $array, at, length } = value;
  const { buffer } = module.HEAPU8;
  return $array === "f64" ? new Float64Array(buffer, at, length).slice() : new Int32Array(buffer, at, length).slice();
}
