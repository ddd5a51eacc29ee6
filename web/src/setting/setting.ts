// What the page is asked: a study, what was changed in it, the start that is played, a sweep. The address says it all.
import type { Override, PlayStart } from "../engine/protocol";

export interface SweepSetting {
  key: string;
  from: number;
  to: number;
  values: number;
  starts: number;
  unit: string;
}

export interface Setting {
  /** Name of an embedded study, or the text of one's own. */
  source: { preset: string } | { toml: string };
  overrides: Override[];
  start: PlayStart;
  /** Overrides of the setting that this one is compared with; null: none. */
  pinned: Override[] | null;
  sweep: SweepSetting | null;
}

/** With this key at this value; a value already there is replaced, in its place. */
export function withOverride(overrides: readonly Override[], key: string, value: string): Override[] {
  const others = overrides.map((one) => (one[0] === key ? ([key, value] as const) : one));
  return others.some((one) => one[0] === key) ? others : [...others, [key, value]];
}

export function sameOverrides(a: readonly Override[], b: readonly Override[]): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

const MOST_VALUES = 60;

/** Why it cannot be computed; empty if it can. */
export function sweepProblem(sweep: SweepSetting): string {
  const whole = (number: number, low: number, high: number) =>
    Number.isInteger(number) && number >= low && number <= high;
  if (![sweep.from, sweep.to].every(Number.isFinite)) return "From and to are numbers.";
  if (!whole(sweep.values, 2, MOST_VALUES)) return `Values: 2 to ${MOST_VALUES}.`;
  return whole(sweep.starts, 10, 100_000) ? "" : "Starts each: 10 to 100000.";
}

const LONGEST_STUDY = 1 << 20; // bytes; the longest study so far is a hundredth of this
const START_DIGITS = 6; // of an angle in the address: a millionth of a radian, far below a pixel

/** A few bytes may unpack to any number: beyond a study's length this throws. */
async function through(bytes: Uint8Array<ArrayBuffer>, pipe: GenericTransformStream): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([bytes]).stream().pipeThrough(pipe as ReadableWritablePair<Uint8Array, Uint8Array>);
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let length = 0;
  const reader = (stream as ReadableStream<Uint8Array<ArrayBuffer>>).getReader();
  for (let read = await reader.read(); !read.done; read = await reader.read()) {
    parts.push(read.value);
    length += read.value.length;
    if (length > LONGEST_STUDY) {
      void reader.cancel();
      throw new Error("too long for a study");
    }
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

async function packed(text: string): Promise<string> {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  let binary = "";
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

async function unpacked(text: string): Promise<string> {
  const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  return new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw")));
}

function startText(start: PlayStart): string {
  return "index" in start ? String(start.index) : start.phi.map((angle) => angle.toFixed(START_DIGITS)).join(",");
}

function startOf(text: string): PlayStart | null {
  if (/^\d+$/.test(text)) return { index: Number(text) };
  if (text === "") return null;
  const phi = text.split(",").map(Number);
  return phi.length > 0 && phi.every(Number.isFinite) ? { phi } : null;
}

/** Without the leading "#". */
export async function toHash(setting: Setting): Promise<string> {
  const parameters = new URLSearchParams();
  if ("preset" in setting.source) parameters.append("study", setting.source.preset);
  else parameters.append("toml", await packed(setting.source.toml));
  for (const [key, value] of setting.overrides) parameters.append("set", `${key}=${value}`);
  parameters.append("start", startText(setting.start));
  if (setting.pinned) {
    parameters.append("against", "1");
    for (const [key, value] of setting.pinned) parameters.append("pinned", `${key}=${value}`);
  }
  const w = setting.sweep;
  if (w) parameters.append("sweep", [w.key, w.from, w.to, w.values, w.starts, w.unit].join("~"));
  return parameters.toString();
}

function overridesOf(texts: readonly string[]): Override[] {
  return texts
    .filter((text) => text.indexOf("=") > 0)
    .map((text) => [text.slice(0, text.indexOf("=")), text.slice(text.indexOf("=") + 1)]);
}

function sweepOf(text: string | null): SweepSetting | null {
  const [key, from, to, values, starts, unit] = (text ?? "").split("~");
  if (!key) return null;
  const sweep = {
    key,
    from: Number(from),
    to: Number(to),
    values: Number(values),
    starts: Number(starts),
    unit: unit ?? "",
  };
  return sweepProblem(sweep) ? null : sweep;
}

/** What an address asks; null: nothing that could be read. */
export async function fromHash(hash: string): Promise<Setting | null> {
  const parameters = new URLSearchParams(hash.replace(/^#/, ""));
  const [preset, own] = [parameters.get("study"), parameters.get("toml")];
  if (!preset && !own) return null;
  try {
    return {
      source: preset ? { preset } : { toml: await unpacked(own!) },
      overrides: overridesOf(parameters.getAll("set")),
      start: startOf(parameters.get("start") ?? "") ?? { index: 0 },
      pinned: parameters.has("against") ? overridesOf(parameters.getAll("pinned")) : null,
      sweep: sweepOf(parameters.get("sweep")),
    };
  } catch {
    return null; // cut off or mangled on its way
  }
}
