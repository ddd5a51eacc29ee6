// Workers side by side: tasks wait in one line, the most urgent first; a worker that breaks is replaced.
import { EngineError, type Calls, type Problem, type Progress, type Request, type Response } from "../engine/protocol";

type Result<K extends keyof Calls> = ReturnType<Calls[K]>;

export interface TaskOptions {
  /** Smaller goes first. */
  urgency?: number;
  /** Taken out of the line; a worker that is already at it is replaced unless it is done at once, or `gentle` is said. */
  signal?: AbortSignal;
  /** Work that has begun is finished: it is short, and what the worker knows is worth more. */
  gentle?: boolean;
  progress?: (progress: Progress) => void;
}

interface Task {
  call: keyof Calls;
  args: unknown[];
  urgency: number;
  order: number;
  signal: AbortSignal | undefined;
  gentle: boolean;
  progress: ((progress: Progress) => void) | undefined;
  broken: number;
  resolve: (result: never) => void;
  reject: (error: Error) => void;
}

interface Seat {
  worker: Worker;
  task: Task | null;
  number: number;
}

const GRACE = 200; // ms that an abandoned call may still take: less than what loading a module anew costs
const MOST_BREAKS = 2; // a task that broke so many workers is given up
const MOST_LOST = 12; // workers lost in a row without an answer: no browser to go on in

export class Pool {
  private readonly seats: Seat[] = [];
  private line: Task[] = [];
  private order = 0;
  private lost = 0;
  private resting = false;

  constructor(
    size: number,
    private readonly makeWorker: () => Worker,
    private readonly broke: (why: string) => void,
  ) {
    for (let k = 0; k < size; ++k)
      this.seats.push({ worker: null as unknown as Worker, task: null, number: 0 });
    for (const seat of this.seats) this.start(seat);
  }

  get size(): number {
    return this.seats.length;
  }

  get waiting(): number {
    return this.line.length;
  }

  /** A pool at rest finishes what it is at and begins nothing. */
  rest(resting: boolean): void {
    this.resting = resting;
    this.feed();
  }

  run<K extends keyof Calls>(call: K, args: Parameters<Calls[K]>, options: TaskOptions = {}): Promise<Result<K>> {
    return new Promise((resolve, reject) => {
      const { signal } = options;
      if (signal?.aborted) return reject(aborted());
      const task: Task = {
        call,
        args,
        urgency: options.urgency ?? 0,
        order: this.order++,
        signal,
        gentle: options.gentle ?? false,
        progress: options.progress,
        broken: 0,
        resolve,
        reject,
      };
      signal?.addEventListener("abort", () => this.abandon(task), { once: true });
      this.enqueue(task);
      this.feed();
    });
  }

  private enqueue(task: Task): void {
    const at = this.line.findIndex(
      (other) => other.urgency > task.urgency || (other.urgency === task.urgency && other.order > task.order),
    );
    this.line.splice(at < 0 ? this.line.length : at, 0, task);
  }

  private feed(): void {
    if (this.resting) return;
    for (const seat of this.seats) {
      if (seat.task) continue;
      const task = this.line.shift();
      if (!task) return;
      seat.task = task;
      seat.number += 1;
      seat.worker.postMessage({ id: seat.number, call: task.call, args: task.args } satisfies Request);
    }
  }

  private start(seat: Seat): void {
    const worker = this.makeWorker();
    seat.worker = worker;
    worker.onmessage = (event: MessageEvent<Response>) => seat.worker === worker && this.hear(seat, event.data);
    worker.onerror = (event) => {
      event.preventDefault();
      if (seat.worker === worker) this.replace(seat, event.message || "it stopped without a word");
    };
    worker.onmessageerror = () => seat.worker === worker && this.replace(seat, "its answer could not be read");
  }

  private hear(seat: Seat, response: Response): void {
    const task = seat.task;
    if (!task || response.id !== seat.number) return;
    if ("progress" in response) return task.progress?.(response.progress);
    if ("error" in response && response.error.kind === "crash") return this.replace(seat, response.error.message);
    seat.task = null;
    this.lost = 0;
    if ("error" in response) task.reject(new EngineError(response.error));
    else if ("result" in response) task.resolve(response.result as never);
    this.feed();
  }

  /** The worker is lost: its task goes to a new one, unless it is what breaks them. */
  private replace(seat: Seat, why: string): void {
    const task = seat.task;
    seat.task = null;
    seat.worker.terminate();
    this.lost += 1;
    if (task) {
      task.broken += 1;
      if (task.signal?.aborted) task.reject(aborted());
      else if (task.broken >= MOST_BREAKS) task.reject(new EngineError(crash(why)));
      else this.enqueue(task);
    }
    if (this.lost > MOST_LOST) return this.giveUp(why);
    this.broke(why);
    this.start(seat);
    this.feed();
  }

  private giveUp(why: string): void {
    this.broke(`${why}; no worker lasts in this browser`);
    for (const task of this.line.splice(0)) task.reject(new EngineError(crash(why)));
    this.resting = true;
  }

  private abandon(task: Task): void {
    const at = this.line.indexOf(task);
    if (at >= 0) {
      this.line.splice(at, 1);
      return task.reject(aborted());
    }
    const seat = this.seats.find((candidate) => candidate.task === task);
    if (!seat || task.gentle) return;
    window.setTimeout(() => {
      if (seat.task !== task) return;
      seat.task = null;
      seat.worker.terminate();
      this.start(seat);
      task.reject(aborted());
      this.feed();
    }, GRACE);
  }
}

function aborted(): Error {
  return new DOMException("no longer wanted", "AbortError");
}

export function isAborted(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

function crash(message: string): Problem {
  return { message, key: "", value: "", problem: message, allowed: "", line: 0, kind: "crash" };
}
