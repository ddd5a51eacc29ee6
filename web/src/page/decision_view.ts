// Before everything else: fit the balancer, change it, or leave it out; why; and what to change. Below it, elsewhere, the figures.
import type { Judgement, Verdict } from "../engine/protocol";
import { h } from "../base/dom";
import { count } from "../base/numbers";
import type { DecisionRun } from "../work/decision_run";
import type { Desk } from "./desk";
import { blocksOf, tableOf } from "./told";

export class DecisionView {
  constructor(
    private readonly desk: Desk,
    private readonly place: HTMLElement,
    private readonly figures: HTMLElement,
  ) {
    for (const topic of [desk.decision, desk.checked, desk.discovery, desk.problem] as const)
      (topic as { listen(listener: () => void): void }).listen(() => this.show());
    desk.shares.listen(() => this.desk.decision.value?.judgement || this.show());
  }

  private show(): void {
    const run = this.desk.decision.value;
    const judgement = run?.judgement;
    this.figures.replaceChildren(...(judgement?.groups ?? []).map((group) => h("div", {}, ...blocksOf(group))));
    this.figures.closest("section")!.hidden = !judgement || judgement.groups.length === 0;
    if (!run || !judgement?.verdict || !this.desk.run) return this.place.replaceChildren(h("p", { class: "quiet" }, this.waiting()));
    const { verdict } = judgement;
    const line = (label: string, ...words: (Node | string)[]) => [h("dt", {}, label), h("dd", {}, ...words)];
    this.place.replaceChildren(
      h("p", { class: `call ${verdict.tone}` }, verdict.words),
      h("dl", {}, ...line("why", verdict.because), ...line("try next", ...this.change(run, judgement, verdict))),
      h("p", { class: "quiet number" }, this.basis(judgement)),
      ...(judgement.changes ? [tableOf(judgement.changes)] : []),
    );
  }

  private waiting(): string {
    const { problem, discovery, decision, checked } = this.desk;
    if (problem.value && checked.value && !checked.value.decidable) return "No verdict: see below.";
    if (!discovery.value) return "No verdict yet: first every motion is looked for that the machine can end in.";
    const starts = decision.value?.judgement?.starts ?? 0;
    return starts > 0 ? `No verdict yet: ${count(starts)} starts are too few.` : "No verdict yet: the first starts are followed.";
  }

  private basis({ starts }: Judgement): string {
    const run = this.desk.run!;
    const more = run.gathers && run.done < run.wanted ? `; ${count(run.wanted)} are asked for` : "";
    return `From the first ${count(starts)} starts, seed ${run.check.seed}${more}.`;
  }

  private change(run: DecisionRun, judgement: Judgement, verdict: Verdict): (Node | string)[] {
    if (verdict.decision === "open") return this.moreStarts(judgement, verdict);
    const { trying } = run;
    const state = trying ? ` Trying ${trying.words}, ${trying.place} of ${trying.of}.` : "";
    if (run.triedAny) return [verdict.change + state];
    if (trying) return [state.trim()];
    if (judgement.possible.length === 0) return [verdict.change];
    const tryThem = () => void run.tryChanges();
    return [
      h("button", { type: "button", click: tryThem }, "Try changes"),
      ` ${judgement.possible.length} of them, each on starts of its own: ${judgement.possible.join("; ")}.`,
    ];
  }

  /** The program names its option; here starts come of themselves, or are asked for by a button. */
  private moreStarts(judgement: Judgement, verdict: Verdict): (Node | string)[] {
    const run = this.desk.run!;
    const undecided = this.desk.shares.value.find(({ code }) => code === 0)?.count ?? 0;
    if (undecided > 0 || !run.gathers) return [verdict.change];
    if (run.done < run.wanted) return ["More starts decide; they are being computed."];
    const more = 3 * Math.max(judgement.starts, 250);
    const button = h("button", { type: "button", click: () => this.desk.more(more) }, `${count(more)} more starts`);
    return ["More starts decide: ", button];
  }
}
