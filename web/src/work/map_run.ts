// The map over two ball angles, from coarse to fine: every level fills in the pixels that the one before left out.
import type { StudyCheck } from "../engine/protocol";
import { throttled } from "../base/dom";
import type { Crew } from "./crew";
import { ChunkSize } from "./ensemble_run";
import { Outcomes } from "./outcomes";
import { isAborted } from "./pool";

export const NO_PIXEL = -32768;
const COARSEST = 8; // pixels a side of the first picture: there at once
const TURN = 2 * Math.PI;

/** Pixels of one level: those of its lattice that are not of a coarser one's. */
export function newPixels(side: number, step: number): number[] {
  const pixels: number[] = [];
  const first = step * COARSEST === side;
  for (let row = 0; row < side; row += step)
    for (let column = 0; column < side; column += step)
      if (first || row % (2 * step) !== 0 || column % (2 * step) !== 0) pixels.push(row * side + column);
  return pixels;
}

/** Whether any two balls are less than `least` apart. */
function overlap(angles: readonly number[], least: number): boolean {
  return angles.some((first, i) =>
    angles.slice(0, i).some((second) => {
      const apart = Math.abs(first - second) % TURN;
      return Math.min(apart, TURN - apart) < least;
    }),
  );
}

export class MapRun {
  readonly outcome: Int32Array;
  readonly time: Float64Array;
  readonly outcomes = new Outcomes();
  done = 0;
  failure: Error | null = null;
  /** Pixels a side of the finest picture that is complete. */
  complete = 0;

  private readonly blank: Uint8Array;
  private queue: number[] = [];
  private next = 0;
  private step: number;
  private inFlight = 0;
  private readonly chunk = new ChunkSize();
  private readonly stopper = new AbortController();
  private readonly changed: () => void;

  /** `side`: COARSEST times a power of two. `others`: angles of the third ball and further ones, the same in all pixels. */
  constructor(
    private readonly crew: Crew,
    readonly check: StudyCheck,
    readonly side: number,
    readonly others: readonly number[],
    private readonly urgency: number,
    changed: () => void,
  ) {
    this.outcome = new Int32Array(side * side).fill(NO_PIXEL);
    this.time = new Float64Array(side * side);
    const least = check.machine.contact_angle;
    this.blank = new Uint8Array(side * side);
    if (least > 0) this.blank.forEach((_, pixel, all) => (all[pixel] = Number(overlap(this.angles(pixel), least))));
    this.step = (2 * side) / COARSEST;
    this.changed = throttled(120, changed);
    for (let k = 0; k < crew.computing.size; ++k) void this.work();
  }

  stop(): void {
    this.stopper.abort();
  }

  /** Angles of all balls at a pixel: its middle. */
  angles(pixel: number): number[] {
    const at = (index: number) => (TURN * (index + 0.5)) / this.side;
    const [first, second] = [at(pixel % this.side), at(Math.floor(pixel / this.side))];
    return [first, second, ...this.others].slice(0, this.check.machine.balls);
  }

  /** Balls in contact would overlap there: no start, and never computed. */
  overlaps(pixel: number): boolean {
    return this.blank[pixel] === 1;
  }

  pixelAt(phi: readonly number[]): number {
    const index = (angle: number) => Math.floor((((angle / TURN) % 1) + 1) * this.side) % this.side;
    return index(phi[1] ?? 0) * this.side + index(phi[0] ?? 0);
  }

  /** The pixel that stands for this one as long as it is not computed itself; NO_PIXEL if there is none yet. */
  standIn(pixel: number): number {
    const [row, column] = [Math.floor(pixel / this.side), pixel % this.side];
    for (let step = 1; step <= this.side / COARSEST; step *= 2) {
      const candidate = (row - (row % step)) * this.side + column - (column % step);
      if (this.outcome[candidate] !== NO_PIXEL) return candidate;
    }
    return NO_PIXEL;
  }

  private async work(): Promise<void> {
    const { signal } = this.stopper;
    while (!signal.aborted && !this.failure) {
      const pixels = this.take();
      if (pixels.length === 0) return;
      this.inFlight += 1;
      try {
        await this.compute(pixels, signal);
      } catch (error) {
        if (isAborted(error)) return;
        this.failure = error as Error;
      }
      this.inFlight -= 1;
      if (this.next >= this.queue.length && this.inFlight === 0) this.complete = this.side / this.step;
      this.changed();
    }
  }

  /** The next pixels of this level, or of the one below it. */
  private take(): number[] {
    while (this.next >= this.queue.length && this.step > 1) {
      this.step /= 2;
      this.queue = newPixels(this.side, this.step).filter((pixel) => !this.overlaps(pixel));
      this.next = 0;
    }
    const pixels = this.queue.slice(this.next, this.next + this.chunk.size);
    this.next += pixels.length;
    return pixels;
  }

  private async compute(pixels: number[], signal: AbortSignal): Promise<void> {
    const balls = this.check.machine.balls;
    const phi = new Float64Array(pixels.length * balls);
    pixels.forEach((pixel, k) => phi.set(this.angles(pixel), k * balls));
    const fates = await this.crew.compute("states", [this.check.toml, phi], { urgency: this.urgency, signal });
    this.chunk.took(pixels.length, fates.seconds);
    this.outcomes.adopt(fates.outcomes, fates.outcome);
    pixels.forEach((pixel, k) => {
      this.outcome[pixel] = fates.outcome[k]!;
      this.time[pixel] = fates.time[k]!;
    });
    this.done += pixels.length;
  }
}
