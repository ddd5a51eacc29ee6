// What came with the page (prepare.mjs): answers that its engine gave when it was built, and the first starts of the first
// study.
import text from "../../../build/web-engine/prepared.json?raw";
import type { Calls, Fates } from "../engine/protocol";

type Listed<T> = { [K in keyof T]: T[K] extends Int32Array | Float64Array ? number[] : T[K] };
interface Prepared {
  answers: { call: keyof Calls; args: unknown[]; answer: unknown }[];
  toml: string;
  fates: Listed<Fates>;
}
const prepared = JSON.parse(text) as Prepared;

const keyOf = (call: keyof Calls, args: readonly unknown[]) => JSON.stringify([call, ...args]);
const calls = new Set(prepared.answers.map(({ call }) => call));
const answers = new Map(prepared.answers.map(({ call, args, answer }) => [keyOf(call, args), answer]));

/** The engine's answer to this very call, where it came with the page. */
export function preparedAnswer<K extends keyof Calls>(call: K, args: Parameters<Calls[K]>): ReturnType<Calls[K]> | null {
  if (!calls.has(call)) return null; // what others take is much to compare
  return (answers.get(keyOf(call, args)) as ReturnType<Calls[K]> | undefined) ?? null;
}

/** The first starts of a study, if they came with the page. */
export function preparedStarts(toml: string): Fates | null {
  if (toml !== prepared.toml) return null;
  const { outcome, time, angles, ...rest } = prepared.fates;
  return {
    ...rest,
    outcome: Int32Array.from(outcome),
    time: Float64Array.from(time),
    speed: new Float64Array(0),
    figures: new Float64Array(0),
    angles: Float64Array.from(angles),
  };
}
