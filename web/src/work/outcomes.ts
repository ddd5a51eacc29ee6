// Which outcomes are known: those of the discovery, and motions that starts met since.
import type { OutcomeInfo } from "../engine/protocol";

/** Of one study. Workers that meet an unlisted motion each number it for themselves; here it has one code, by its name. */
export class Outcomes {
  private readonly byCode = new Map<number, OutcomeInfo>();

  constructor(known: readonly OutcomeInfo[] = []) {
    for (const outcome of known) this.byCode.set(outcome.code, outcome);
  }

  get list(): OutcomeInfo[] {
    // Balanced and the paper's motions first, then the others; what is no motion last.
    const rank = (code: number) => (code > 0 ? code : 1_000_000 - code);
    return [...this.byCode.values()].sort((a, b) => rank(a.code) - rank(b.code));
  }

  of(code: number): OutcomeInfo {
    return this.byCode.get(code) ?? { code, name: `motion ${code}`, alias: "", title: `motion ${code}`, colour: "#888888" };
  }

  /** Takes the outcomes a worker knows and rewrites its codes where they say something else here. */
  adopt(theirs: readonly OutcomeInfo[], codes: Int32Array): void {
    const changed = new Map<number, number>();
    for (const outcome of theirs) {
      const here = this.codeFor(outcome);
      if (here !== outcome.code) changed.set(outcome.code, here);
    }
    if (changed.size === 0) return;
    for (let k = 0; k < codes.length; ++k) codes[k] = changed.get(codes[k]!) ?? codes[k]!;
  }

  private codeFor(outcome: OutcomeInfo): number {
    const held = this.byCode.get(outcome.code);
    if (!held) {
      this.byCode.set(outcome.code, outcome);
      return outcome.code;
    }
    if (held.name === outcome.name && held.alias === outcome.alias) return outcome.code;
    for (const other of this.byCode.values())
      if (other.code > 0 && other.name === outcome.name && other.alias === outcome.alias) return other.code;
    const free = Math.max(...this.byCode.keys()) + 1;
    this.byCode.set(free, { ...outcome, code: free });
    return free;
  }
}
