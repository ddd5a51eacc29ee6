// Who works for the page: one worker that answers at once, and as many as the machine has room for that compute.
import type { Calls } from "../engine/protocol";
import { Pool, type TaskOptions } from "./pool";
import { preparedAnswer } from "./prepared";

const MOST_COMPUTING = 8; // each holds a module and the attractors it found: some 50 MB

export class Crew {
  /** Checks, shares of counts, and the run that is played: short calls, in turn. */
  readonly front: Pool;
  /** Discoveries and starts. */
  readonly computing: Pool;

  constructor(makeWorker: () => Worker, broke: (why: string) => void) {
    const cores = navigator.hardwareConcurrency || 2;
    this.front = new Pool(1, makeWorker, broke);
    this.computing = new Pool(Math.max(1, Math.min(cores - 1, MOST_COMPUTING)), makeWorker, broke);
    document.addEventListener("visibilitychange", () => this.computing.rest(document.hidden));
  }

  ask<K extends keyof Calls>(call: K, ...args: Parameters<Calls[K]>): Promise<ReturnType<Calls[K]>> {
    const prepared = preparedAnswer(call, args);
    return prepared ? Promise.resolve(prepared) : this.front.run(call, args);
  }

  compute<K extends keyof Calls>(
    call: K,
    args: Parameters<Calls[K]>,
    options: TaskOptions,
  ): Promise<ReturnType<Calls[K]>> {
    const prepared = preparedAnswer(call, args);
    return prepared ? Promise.resolve(prepared) : this.computing.run(call, args, options);
  }
}
