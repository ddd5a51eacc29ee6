// Starts of a study computed in small chunks, shared among workers; what is known so far.
import type { Fates, StudyCheck, Told } from "../engine/protocol";
import { throttled } from "../base/dom";
import type { Crew } from "./crew";
import { Outcomes } from "./outcomes";
import { isAborted } from "./pool";
import { URGENCY } from "./urgency";

const NOT_DONE = -32768;
const CHUNK_TIME = 0.15; // s: a worker is free again soon, and the message costs nothing beside it
const SOON = 1.5; // s in which what is asked for would be done: it then goes before the map
const [LEAST_CHUNK, MOST_CHUNK] = [16, 4096];

/** How many starts to give a worker at once, from what the last chunk took. */
export class ChunkSize {
  size = 64;
  private each = Infinity; // seconds

  took(starts: number, seconds: number): void {
    const wanted = (starts * CHUNK_TIME) / Math.max(1e-3, seconds);
    this.size = Math.round(Math.max(LEAST_CHUNK, Math.min(MOST_CHUNK, wanted, 4 * this.size)));
    this.each = seconds / starts;
  }

  /** By what the last chunk took; infinite before there was one. */
  secondsFor(starts: number): number {
    return starts * this.each;
  }
}

export class EnsembleRun {
  readonly outcome: Int32Array;
  readonly time: Float64Array;
  readonly angles: Float64Array;
  readonly outcomes = new Outcomes();
  private speed = new Float32Array(0);
  private figures = new Float32Array(0); // as the library keeps them
  private columns = 0;
  done = 0;
  failure: Error | null = null;

  private next = 0;
  private asked = 0;
  private busy = 0;
  private readonly chunk = new ChunkSize();
  private readonly stopper = new AbortController();
  private readonly changed: () => void;

  /** `check` holds the study; `most` starts can be asked for. `gathers`: their figures too. */
  constructor(
    private readonly crew: Crew,
    readonly check: StudyCheck,
    readonly most: number,
    private readonly urgency: number,
    readonly gathers: boolean,
    changed: () => void,
  ) {
    this.outcome = new Int32Array(most).fill(NOT_DONE);
    this.time = new Float64Array(most);
    this.angles = new Float64Array(most * check.machine.balls);
    this.changed = throttled(120, changed);
  }

  /** Computes on until so many starts are done. */
  extend(starts: number): void {
    this.asked = Math.max(this.asked, Math.min(starts, this.most));
    while (this.busy < this.crew.computing.size && this.next < this.asked && !this.failure) void this.work();
  }

  /** Takes the first starts from elsewhere; before any is asked for. */
  beginWith(fates: Fates): void {
    this.next = this.asked = fates.count;
    this.keep(fates, 0);
    this.changed();
  }

  get wanted(): number {
    return this.asked;
  }

  stop(): void {
    this.stopper.abort();
  }

  /** Starts 0 to below this are all done. */
  get prefix(): number {
    const at = this.outcome.subarray(0, this.next).indexOf(NOT_DONE);
    return at < 0 ? this.next : at;
  }

  /** The first so many starts, at most `prefix`, for judge(). */
  told(starts: number): Told {
    return {
      outcome: this.outcome.slice(0, starts),
      speed: Float64Array.from(this.speed.subarray(0, starts)),
      figures: Float64Array.from(this.figures.subarray(0, starts * this.columns)),
    };
  }

  /** How many starts came to each outcome that is known, in their order. */
  counts(): { code: number; count: number }[] {
    const counts = new Map<number, number>(this.outcomes.list.map(({ code }) => [code, 0]));
    for (let k = 0; k < this.next; ++k) {
      const code = this.outcome[k]!;
      if (code !== NOT_DONE) counts.set(code, (counts.get(code) ?? 0) + 1);
    }
    return [...counts].map(([code, count]) => ({ code, count }));
  }

  /** A start that came to this, if there is one among those done. */
  startOf(code: number): number | null {
    const at = this.outcome.indexOf(code);
    return at < 0 ? null : at;
  }

  isDone(start: number): boolean {
    return start < this.next && this.outcome[start] !== NOT_DONE;
  }

  private keep(fates: Fates, first: number): void {
    this.outcomes.adopt(fates.outcomes, fates.outcome);
    this.outcome.set(fates.outcome, first);
    this.time.set(fates.time, first);
    this.angles.set(fates.angles, first * fates.balls);
    if (this.gathers) this.keepFigures(fates, first);
    this.done += fates.count;
  }

  private keepFigures(fates: Fates, first: number): void {
    const grown = (kept: Float32Array, columns: number) => {
      if (kept.length >= this.next * columns) return kept;
      const larger = new Float32Array(2 * this.next * columns);
      larger.set(kept);
      return larger;
    };
    this.columns = fates.figures.length / fates.count;
    this.speed = grown(this.speed, 1) as Float32Array<ArrayBuffer>;
    this.figures = grown(this.figures, this.columns) as Float32Array<ArrayBuffer>;
    this.speed.set(fates.speed, first);
    this.figures.set(fates.figures, first * this.columns);
  }

  private async work(): Promise<void> {
    this.busy += 1;
    const { signal } = this.stopper;
    while (this.next < this.asked && !signal.aborted && !this.failure) {
      const first = this.next;
      const count = Math.min(this.chunk.size, this.asked - first);
      this.next += count;
      try {
        const soon = this.chunk.secondsFor(this.asked - first) / this.crew.computing.size < SOON;
        const options = { urgency: soon ? URGENCY.soonDone : this.urgency, signal };
        const fates = await this.crew.compute(
          "ensemble",
          [this.check.toml, first, count, { figures: this.gathers }],
          options,
        );
        if (fates.count !== count) throw new Error(`${count} starts were asked for, ${fates.count} came back.`);
        this.chunk.took(count, fates.seconds);
        this.keep(fates, first);
      } catch (error) {
        if (!isAborted(error)) this.failure = error as Error;
      }
      if (!signal.aborted) this.changed();
    }
    this.busy -= 1;
  }
}
