// A run that is played: the integrator computes ahead in its worker, the page shows what is due.
import type { PlayStart, StudyCheck } from "../engine/protocol";
import type { Crew } from "./crew";

/** The machine at one time; x, y and angles seen from the turning rotor, as in the equations. */
export interface Moment {
  t: number;
  psi: number;
  speed: number;
  x: number;
  y: number;
  phi: number[];
  radial: number;
  held: boolean;
}

const AHEAD = 0.4; // seconds of showing that are computed in advance: longer than any stop of the worker seen
const MOST_ROWS = 1500; // a request: a few ms of work
const TURN_A_ROW = 0.25; // rad: straight lines between rows then miss a circle by less than a hundredth of it

export class Player {
  /** Time units shown in a second. */
  pace = 5;
  playing = false;
  /** Why the run went no further than it did; empty while it goes on. */
  ended = "";
  /** Rows computed, oldest first; the shown moment lies between the first two. */
  private rows: Moment[] = [];
  private shown: Moment | null = null;
  private handle: number | null = null;
  private asking = false;
  private generation = 0;
  private computedTo = 0;
  private fastest = 1;
  private recovering = false;

  constructor(
    private readonly crew: Crew,
    private readonly troubled: (error: Error) => void,
  ) {}

  get moment(): Moment | null {
    return this.shown;
  }

  get toml(): string {
    return this.check?.toml ?? "";
  }

  private check: StudyCheck | null = null;
  private start: PlayStart = { index: 0 };

  /** Opens a run; with `from`, one that has come as far as that already. */
  async open(check: StudyCheck, start: PlayStart, from = 0): Promise<void> {
    const generation = ++this.generation;
    this.check = check;
    this.start = start;
    this.fastest = Math.max(1, Math.abs(check.machine.final_speed ?? 1));
    const old = this.handle;
    this.handle = null;
    if (old !== null) void this.crew.ask("play_close", old).catch(() => undefined);
    try {
      const header = await this.crew.ask("play_open", check.toml, start);
      if (generation !== this.generation) return void this.crew.ask("play_close", header.handle).catch(() => undefined);
      const row = from > 0 ? (await this.crew.ask("play_advance", header.handle, from)).row : header.row;
      if (generation !== this.generation) return;
      this.handle = header.handle;
      this.ended = "";
      this.rows = [momentOf(row, 0, header.balls)];
      this.shown = this.rows[0]!;
      this.computedTo = this.shown.t;
      this.fill();
    } catch (error) {
      if (generation === this.generation) this.troubled(error as Error);
    }
  }

  /** Where the balls stand before anything moves. */
  begin(moment: Moment): void {
    this.generation += 1;
    this.rows = [];
    this.shown = moment;
  }

  /** Goes on by so many seconds of showing; the moments passed, the last of which is shown now. */
  advance(seconds: number): Moment[] {
    if (!this.shown || !this.playing) return [];
    return this.goTo(this.shown.t + seconds * this.pace);
  }

  /** One small step: a sixteenth of a turn at the final speed. */
  step(): Moment[] {
    return this.shown ? this.goTo(this.shown.t + Math.PI / 8 / this.fastest) : [];
  }

  private goTo(time: number): Moment[] {
    const passed: Moment[] = [];
    while (this.rows.length > 1 && this.rows[1]!.t <= time) {
      this.rows.shift();
      passed.push(this.rows[0]!);
    }
    if (this.rows.length > 1) this.shown = between(this.rows[0]!, this.rows[1]!, time);
    else if (this.rows.length === 1) this.shown = this.rows[0]!;
    this.fill();
    return passed;
  }

  /** Time between two rows: fine enough for the eye, no finer than a few a frame. */
  private get spacing(): number {
    const speed = Math.max(this.fastest, Math.abs(this.shown?.speed ?? 0));
    return Math.max(TURN_A_ROW / speed, this.pace / 60 / 8);
  }

  private fill(): void {
    if (this.handle === null || this.asking || this.ended || !this.shown || !this.check) return;
    const wanted = this.shown.t + this.pace * AHEAD;
    if (this.computedTo >= wanted) return;
    const spacing = this.spacing;
    const count = Math.min(MOST_ROWS, Math.ceil((wanted - this.computedTo) / spacing) + 1);
    const times = Float64Array.from({ length: count }, (_, k) => this.computedTo + (k + 1) * spacing);
    void this.fetch(this.handle, times, this.check.machine.balls);
  }

  private async fetch(handle: number, times: Float64Array, balls: number): Promise<void> {
    const generation = this.generation;
    this.asking = true;
    try {
      const { row, status } = await this.crew.ask("play_rows", handle, times);
      if (generation === this.generation) {
        const width = 7 + 2 * balls + 2;
        for (let at = 0; at + width <= row.length; at += width) this.rows.push(momentOf(row, at, balls));
        this.computedTo = this.rows.at(-1)?.t ?? this.computedTo;
        if (status !== "done") this.ended = status;
        this.recovering = false;
      }
    } catch (error) {
      if (generation === this.generation) this.recover(error as Error);
    }
    this.asking = false;
    this.fill();
  }

  /** The worker that held the run is gone: the same run again, as far as it was shown. */
  private recover(error: Error): void {
    this.handle = null;
    const again = !this.recovering && this.check !== null;
    this.recovering = true;
    if (again && this.check) void this.open(this.check, this.start, this.shown?.t ?? 0);
    else this.troubled(error);
  }
}

function momentOf(row: Float64Array, at: number, balls: number): Moment {
  const end = at + 7 + 2 * balls;
  return {
    t: row[at]!,
    psi: row[at + 1]!,
    speed: row[at + 2]!,
    x: row[at + 3]!,
    y: row[at + 4]!,
    phi: Array.from(row.subarray(at + 7, at + 7 + balls)),
    radial: row[end]!,
    held: row[end + 1]! !== 0,
  };
}

function between(a: Moment, b: Moment, time: number): Moment {
  const w = Math.min(1, Math.max(0, (time - a.t) / (b.t - a.t || 1)));
  const mix = (from: number, to: number) => from + w * (to - from);
  return {
    t: mix(a.t, b.t),
    psi: mix(a.psi, b.psi),
    speed: mix(a.speed, b.speed),
    x: mix(a.x, b.x),
    y: mix(a.y, b.y),
    phi: a.phi.map((angle, k) => mix(angle, b.phi[k]!)),
    radial: mix(a.radial, b.radial),
    held: a.held,
  };
}
