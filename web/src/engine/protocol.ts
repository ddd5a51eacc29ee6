// What the page and the engine say to one another: the library's calls in the browser, one module a worker.
//
// Everything crosses as JSON and typed arrays. Times, speeds and lengths are dimensionless (1/omega_c, omega_c, R), as in
// the study's equations, unless a field says otherwise; StudyCheck.scales turns them into SI units. A call that cannot be
// answered throws EngineError; its parts are those of the program's own message.

/** One of the study's keys with another value, as `--set key=value` has it: ["rotor.eccentricity", "0.02"]. */
export type Override = readonly [key: string, value: string];

/** What is wrong with an input, as the program says it. */
export interface Problem {
  /** One line: place, key, value, what is wrong, what is allowed. */
  message: string;
  /** Dotted key; empty where the trouble is none of a key's. */
  key: string;
  value: string;
  /** What is wrong, without place, key and value. */
  problem: string;
  /** What the value may be; empty if nothing can be said. */
  allowed: string;
  /** Line of the study's text, from 1; 0: not known. */
  line: number;
  /** "input": the study or an argument; "run": work that could not be finished; "crash": the module is lost. */
  kind: "input" | "run" | "crash";
}

/** A key of a study as a form shows it. */
export interface StudyField {
  /** Dotted, as an override takes it: "speed.final". */
  key: string;
  /** In words: "final speed". */
  label: string;
  /** What the field shows, without its unit: "12", "0.05, 0.06", "ramp", "true". */
  value: string;
  /** "kg"; empty: a plain number or no number. One unit for all entries of a list. */
  unit: string;
  /** Other units in use for this quantity, `unit` among them. */
  units: string[];
  /** SI units that one of each of `units` is. */
  worth: number[];
  /** What the value may be, in words. */
  allowed: string;
  /** Values of a choice, else empty. */
  choices: string[];
  kind: "number" | "whole" | "list" | "choice" | "flag" | "text";
  /** Written in the study; otherwise a default. */
  given: boolean;
}

/** What of the machine a drawing needs. Dimensionless. */
export interface Machine {
  balls: number;
  /** One a ball: mass over the rotor's mass, and radius over that of the race (0: not known). */
  mass: number[];
  ball_radius: number[];
  /** Distance of the centre of mass from the centre of the shaft; balls' angles count from its direction. */
  eccentricity: number;
  /** Where the race's centre lies in the disc. */
  race_offset: [number, number];
  /** Least angle between two balls' places; 0: they pass one another. */
  contact_angle: number;
  gravity: number;
  /** Y, in the room's axes, at which the centre rests under the weight: what displacement is counted from. */
  sag: number;
  /** A motor turns the rotor. */
  driven: boolean;
  /** Final speed prescribed or aimed at; null: nothing prescribes one. */
  final_speed: number | null;
  /** When balls are let go; null: when a speed is reached. */
  release_time: number | null;
  /** When the speed is prescribed to change no more; null: that depends on the motor. */
  spun_up: number | null;
  /** A good time to watch until. */
  watch_until: number;
  /** Limits of the study, where it has them. */
  limits: { displacement: number | null; force: number | null; velocity: number | null; settled: number | null };
}

/** SI value of one dimensionless unit. */
export interface Scales {
  mass: number;
  length: number;
  time: number;
  force: number;
  velocity: number;
  /** Of rotation: rad/s, and the same in rpm. */
  speed: number;
  speed_rpm: number;
}

/** A key that may be stated besides. */
export interface OfferedKey {
  key: string;
  label: string;
  /** What it is. */
  sentence: string;
}

export interface StudyCheck {
  /** The study with the overrides in it: what all other calls take. */
  toml: string;
  /** All keys, defaults included, dimensionless, as results echo them. */
  study: Record<string, unknown>;
  physical: boolean;
  scales: Scales | null;
  machine: Machine;
  fields: StudyField[];
  offers: OfferedKey[];
  /** Text of `equipoise explain`. */
  explain: string;
  warnings: string[];
  /** What to type in a terminal for the same question. */
  command: string;
  /** Every start draws a rotor of its own: balls cannot be put to where somebody wants them to start. */
  uncertain: boolean;
  /** Whether starts can be decided (`problem` says why not), and drawn rotors with them (uncertain values). */
  decidable: boolean;
  problem: Problem | null;
  starts: number;
  seed: number;
}

export interface Preset {
  name: string;
  title: string;
  group: "machines" | "examples" | "new" | "paper";
  toml: string;
}

/** What a start can come to. `code`: an attractor's identifier from 1; 0 and below: see the constants. */
export interface OutcomeInfo {
  code: number;
  name: string;
  /** The paper's name, where it has one. */
  alias: string;
  /** What a reader is told: what the balls do, in a study of a machine; the name and the paper's name, in any other. */
  title: string;
  /** "#rrggbb", the same in all pictures of the project. */
  colour: string;
}
export const UNDECIDED = 0;
export const DIVERGED = -1;
export const FAILED = -2;
export const STALLED = -3;

/** A stretch of a motion at equally spaced times: centre in the room's axes, from where the rotor rests. */
export interface MotionPath {
  duration: number;
  psi: number[];
  x: number[];
  y: number[];
  /** By ball: angle from the heavy side, seen from the turning rotor, unwrapped. */
  phi: number[][];
}

/** A motion in which starts may end: the keys of `equipoise attractors --json`, and a path to draw. */
export interface AttractorInfo extends OutcomeInfo {
  id: number;
  kind: string;
  stable: boolean;
  radial: { min: number; mean: number; max: number };
  drift: number[];
  period: number | null;
  /** Of a driven rotor. */
  speed?: { min: number; mean: number; max: number };
  /** In words, as the table of `equipoise attractors` has it. */
  stability: string;
  path: MotionPath;
}

export interface Discovery {
  outcomes: OutcomeInfo[];
  attractors: AttractorInfo[];
  /** Why no start can end balanced, if so. */
  note: string;
  /** The horizon that was chosen or given. */
  horizon: number;
  seconds: number;
}

/** What runs came to, as judge() takes it: one entry a run, of figures as many as the library has. */
export interface Told {
  /** Attractor's identifier, or a code such as UNDECIDED. */
  outcome: Int32Array;
  /** Of a driven rotor, in the end. */
  speed: Float64Array;
  /** One run after another; empty unless asked for. */
  figures: Float64Array;
}

/** Fates, one entry a start in every array. */
export interface Fates extends Told {
  first: number;
  count: number;
  /** Study time at which the outcome was known. */
  time: Float64Array;
  /** Initial ball angles, `balls` a start. */
  angles: Float64Array;
  balls: number;
  /** That it took, a search for attractors left out. */
  seconds: number;
  /** Outcomes known by now: those of the discovery, and motions that these starts were the first to meet. */
  outcomes: OutcomeInfo[];
}

export interface Share {
  count: number;
  total: number;
  share: number;
  /** 95 % interval. */
  low: number;
  high: number;
  /** Bounds at the same confidence whatever undecided starts come to. */
  least: number;
  most: number;
}

export interface OutcomeShare extends Share {
  code: number;
}

/** One side of a comparison: what was asked, and what start i came to. */
export interface Outcomes {
  toml: string;
  outcomes: OutcomeInfo[];
  outcome: Int32Array;
}

export interface Comparison {
  /** Whether start i began alike in both; `why_not` otherwise. */
  common: boolean;
  why_not: string;
  starts: number;
  shares: {
    name: string;
    alias: string;
    title: string;
    first: Share;
    second: Share;
    /** Second less first, with its 95 % interval. */
    difference: { difference: number; low: number; high: number };
  }[];
  /** In one sentence. */
  verdict: string;
}

export interface ToldTable {
  header: string[];
  rows: { cells: string[]; tone: Tone }[];
  caption: string;
}
export type Tone = "plain" | "good" | "bad" | "open";
/** A table, or a sentence below it. */
export type ToldBlock = { table: ToldTable } | { text: string };

/** What `equipoise basin` says first, in its words. */
export interface Verdict {
  decision: "fit" | "not_needed" | "caution" | "change" | "do_not_fit" | "open";
  words: string;
  because: string;
  change: string;
  tone: Tone;
  /** Changes tried, in order. */
  tried?: { words: string; decision: Verdict["decision"] }[];
}

export interface Judgement {
  /** On which all this rests: the first ones. */
  starts: number;
  /** Null: too few starts. */
  verdict: Verdict | null;
  /** Changes that may be tried, if the verdict asks for any. */
  possible: string[];
  /** Those tried, best first. */
  changes: ToldTable | null;
  /** Without balls and with; limits kept; standards. */
  groups: ToldBlock[][];
  /** RMS velocity at the end, the mean of an outcome's starts, by code. */
  velocity: { unit: string; of: Record<string, string> };
}

export interface TriedChange extends Told {
  change: number;
  bare: Told;
}

/** Where a played run begins: a start of the study's ensemble, or ball angles. */
export type PlayStart = { index: number } | { phi: number[] };

export interface PlayHeader {
  handle: number;
  balls: number;
  /** Of a row: t, psi, psi_dot, x, y, x_dot, y_dot, phi_1.., phi_dot_1.., radial, held. */
  columns: string[];
  /** The state at t = 0. */
  row: Float64Array;
}

export interface PlayRow {
  /** One entry a column; x, y and phi in the rotating frame, radial from where the rotor rests, held 1 or 0. */
  row: Float64Array;
  /** "done", or how the integration came to an end before `until`. */
  status: string;
}

export interface Progress {
  /** "pilot trajectories", "starts". */
  what: string;
  done: number;
  /** 0: not known. */
  total: number;
  preparing: boolean;
}

/** The calls, as a module answers them in its worker. */
export interface Calls {
  version(): { version: string };
  presets(): Preset[];
  check(toml: string, overrides?: readonly Override[]): StudyCheck;
  discover(toml: string): Discovery;
  /** Starts first .. first + count - 1 of the study's sample, each the same as in `equipoise basin`. */
  ensemble(toml: string, first: number, count: number, options?: EnsembleOptions): Fates;
  /** What balls that begin at these angles, `balls` a state, come to. */
  states(toml: string, phi: Float64Array): Fates;
  /** Shares of these counts; `total` of each is their sum. */
  shares(counts: readonly { code: number; count: number }[]): OutcomeShare[];
  compare_shares(first: Outcomes, second: Outcomes): Comparison;
  /**
   * The rotor of starts first .. first + count - 1 as one body, without balls or with balls held where they start. `needed`:
   * the most such runs that are counted; beyond it there are none.
   */
  one_body(toml: string, balls: boolean, first: number, count: number): Told & { needed: number };
  /** The starts of one of Judgement.possible, by its place there. */
  try_change(toml: string, change: number): TriedChange;
  /** Starts, rotors without balls and with balls held (null: not known yet), from the first on, and changes tried in order. */
  judge(toml: string, starts: Told, bare: Told, held: Told | null, tried: readonly TriedChange[]): Judgement;
  /** `bare`: without balls. */
  play_open(toml: string, start?: PlayStart & { bare?: boolean }): PlayHeader;
  /** Goes on to study time `until` and answers the row there. */
  play_advance(handle: number, until: number): PlayRow;
  /** The same for several times in order: rows one after another. */
  play_rows(handle: number, times: Float64Array): PlayRow;
  play_close(handle: number): void;
}

export interface EnsembleOptions {
  /** Instead of the study's. */
  seed?: number;
  /** Gather figures of transients: that takes up to three times as long. */
  figures?: boolean;
}

/** To a worker; the answer has the same number. */
export interface Request {
  id: number;
  call: keyof Calls;
  args: unknown[];
}

export type Response =
  | { id: number; result: unknown }
  | { id: number; error: Problem }
  | { id: number; progress: Progress };

export class EngineError extends Error {
  constructor(readonly problem: Problem) {
    super(problem.message);
    this.name = "EngineError";
  }
}
