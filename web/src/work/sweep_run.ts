// Shares along one parameter: an ensemble in every cell, the ends first and then ever closer between.
import type { OutcomeInfo, OutcomeShare, Override } from "../engine/protocol";
import type { Crew } from "./crew";
import { isAborted } from "./pool";

export interface Cell {
  value: number;
  text: string;
  shares: OutcomeShare[] | null;
  outcomes: OutcomeInfo[];
  /** Why there are no shares, if that is so. */
  problem: string;
}

/** 0 to count - 1 such that every beginning of the list is spread widely. */
export function spreadOrder(count: number): number[] {
  const order = count > 1 ? [0, count - 1] : [0];
  for (let parts = 2; order.length < count; parts *= 2)
    for (let k = 1; k < parts; k += 2) {
      const at = Math.round((k * (count - 1)) / parts);
      if (!order.includes(at)) order.push(at);
    }
  return order.slice(0, count);
}

export class SweepRun {
  readonly cells: Cell[];
  done = 0;
  private readonly stopper = new AbortController();

  /** `setting`: the overrides that make a cell of its value. */
  constructor(
    private readonly crew: Crew,
    private readonly source: string,
    values: readonly { value: number; text: string }[],
    private readonly setting: (text: string) => Override[],
    private readonly starts: number,
    private readonly urgency: number,
    private readonly changed: () => void,
  ) {
    this.cells = values.map((one) => ({ ...one, shares: null, outcomes: [], problem: "" }));
    for (const k of spreadOrder(values.length)) void this.compute(this.cells[k]!);
  }

  stop(): void {
    this.stopper.abort();
  }

  private async compute(cell: Cell): Promise<void> {
    const options = { urgency: this.urgency, signal: this.stopper.signal };
    try {
      const check = await this.crew.ask("check", this.source, this.setting(cell.text));
      if (check.problem) throw new Error(check.problem.message);
      const fates = await this.crew.compute("ensemble", [check.toml, 0, this.starts], options);
      const counts = new Map<number, number>(fates.outcomes.map(({ code }) => [code, 0]));
      for (const code of fates.outcome) counts.set(code, (counts.get(code) ?? 0) + 1);
      cell.outcomes = fates.outcomes;
      cell.shares = await this.crew.ask(
        "shares",
        [...counts].map(([code, n]) => ({ code, count: n })),
      );
    } catch (error) {
      if (isAborted(error)) return;
      cell.problem = (error as Error).message;
    }
    if (this.stopper.signal.aborted) return;
    this.done += 1;
    this.changed();
  }
}
