// The verdict on a study: of its starts, of its rotor without balls, and of changes tried; anew as starts come in.
import type { Judgement, StudyCheck, Told, TriedChange } from "../engine/protocol";
import type { Crew } from "./crew";
import { isAborted } from "./pool";
import { URGENCY } from "./urgency";

const MOST_HELD = 256; // as the program
const PIECE = 32; // runs at once
const GROWTH = 1.1; // starts come in all the time: a verdict on so many more is worth the work

const together = (pieces: readonly Told[]): Told => {
  const all = <T extends Float64Array | Int32Array>(part: (piece: Told) => T) => pieces.flatMap((piece) => [...part(piece)]);
  return {
    outcome: Int32Array.from(all(({ outcome }) => outcome)),
    speed: Float64Array.from(all(({ speed }) => speed)),
    figures: Float64Array.from(all(({ figures }) => figures)),
  };
};

export class DecisionRun {
  judgement: Judgement | null = null;
  /** What is being tried, and how many changes there are. */
  trying: { words: string; place: number; of: number } | null = null;

  private bare: Told | null = null;
  private held: Told | null = null;
  private readonly tried: TriedChange[] = [];
  private asking = false;
  private judged = 0;
  private stale = true;

  constructor(
    private readonly crew: Crew,
    private readonly check: StudyCheck,
    private readonly signal: AbortSignal,
    /** The starts known by now: how many, whether more are coming, and what they came to. */
    private readonly starts: () => { count: number; over: boolean; told: () => Told },
    private readonly changed: () => void,
    private readonly failed: (error: Error) => void,
  ) {}

  get triedAny(): boolean {
    return this.tried.length > 0;
  }

  /** The rotor as one body: first without balls, which the verdict waits for. */
  async follow(): Promise<void> {
    try {
      this.bare = await this.runs(false, URGENCY.bare);
      this.renew();
      this.held = await this.runs(true, URGENCY.held);
      this.renew();
    } catch (error) {
      if (!isAborted(error)) this.failed(error as Error);
    }
  }

  private async runs(balls: boolean, urgency: number): Promise<Told> {
    const most = Math.min(MOST_HELD, this.check.starts);
    const piece = async (first: number) =>
      this.crew.compute("one_body", [this.check.toml, balls, first, Math.min(PIECE, most - first)], {
        urgency,
        signal: this.signal,
        gentle: true,
      });
    const first = await piece(0);
    const later = [];
    for (let k = PIECE; k < Math.min(most, first.needed); k += PIECE) later.push(piece(k));
    return together([first, ...(await Promise.all(later))]);
  }

  private renew(): void {
    this.stale = true;
    this.look();
  }

  /** Starts have come in. */
  look(): void {
    const { count, over, told } = this.starts();
    if (!this.bare || this.asking || count === 0 || this.signal.aborted) return;
    if (!this.stale && (count === this.judged || (!over && count < GROWTH * this.judged))) return;
    this.asking = true;
    this.stale = false;
    void this.judge(count, told());
  }

  private async judge(count: number, told: Told): Promise<void> {
    try {
      await this.judgeOn(count, told);
    } catch (error) {
      if (!isAborted(error) && !this.signal.aborted) this.failed(error as Error);
    }
    this.asking = false;
    this.look();
  }

  private async judgeOn(count: number, told: Told): Promise<void> {
    const judgement = await this.crew.ask("judge", this.check.toml, told, this.bare!, this.held, this.tried);
    if (this.signal.aborted) return;
    this.judgement = judgement;
    this.judged = count;
    this.changed();
  }

  /** Every change that the verdict asks for, all at once; those after the first that makes the balancer fit do not count. */
  async tryChanges(): Promise<void> {
    const possible = this.judgement?.possible ?? [];
    if (this.trying || this.triedAny || possible.length === 0) return;
    const stopper = new AbortController();
    this.signal.addEventListener("abort", () => stopper.abort(), { once: true });
    const tasks = possible.map((_, k) =>
      this.crew.compute("try_change", [this.check.toml, k], { urgency: URGENCY.changes, signal: stopper.signal }),
    );
    for (const task of tasks) task.catch(() => undefined);
    try {
      for (const [k, task] of tasks.entries()) {
        this.trying = { words: possible[k]!, place: k + 1, of: possible.length };
        this.changed();
        this.tried.push(await task);
        const { count, told } = this.starts();
        await this.judgeOn(count, told());
        if (this.judgement?.verdict?.tried?.at(-1)?.decision === "fit") break;
      }
    } catch (error) {
      if (!isAborted(error)) this.failed(error as Error);
    }
    stopper.abort();
    this.trying = null;
    if (this.signal.aborted) return;
    this.changed();
    this.renew();
  }
}
