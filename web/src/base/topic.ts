// A value that others want to hear of when it changes.

export class Topic<T> {
  private readonly listeners = new Set<(value: T) => void>();

  constructor(private held: T) {}

  get value(): T {
    return this.held;
  }

  set(value: T): void {
    this.held = value;
    for (const listener of this.listeners) listener(value);
  }

  /** Calls at every change from now on. */
  listen(listener: (value: T) => void): void {
    this.listeners.add(listener);
  }
}
