// Will it balance? The share of balanced starts in large, all outcomes under it, filling in as starts are computed.
import type { OutcomeShare } from "../engine/protocol";
import { h, swatch } from "../base/dom";
import { count, intervalText, percent, Units } from "../base/numbers";
import { csv, saveText } from "../base/save";
import type { Desk } from "./desk";
import { saveMenu } from "./save_menu";

const BALANCED = 1;

/** The smallest of these values that such a part of them does not exceed. */
function quantilesOf(values: number[]): (part: number) => number {
  values.sort((a, b) => a - b);
  return (part) => values[Math.min(values.length - 1, Math.ceil(part * values.length) - 1)]!;
}

const MORE = 10_000;
const SLOW = 15_000; // ms of searching after which a visitor should know that there is a faster way

export class Answer {
  private readonly moreButton = h(
    "button",
    { type: "button", click: () => this.desk.more(MORE) },
    `${count(MORE)} more starts`,
  );
  private timer = 0;
  private isSlow = false;
  private readonly table = h("div");
  private readonly progress = h("div", { class: "bar", "aria-hidden": "true" }, h("span"));

  constructor(
    private readonly desk: Desk,
    private readonly verdict: HTMLElement,
    private readonly bar: HTMLElement,
    list: HTMLElement,
  ) {
    const menu = saveMenu("Save shares or starts", {
      "shares (CSV)": () => this.saveShares(),
      "every start and its fate (CSV)": () => this.saveStarts(),
    });
    list.append(
      this.table,
      this.progress,
      h("div", { class: "row apart", style: "margin-top:.4rem" }, this.moreButton, menu),
    );
    desk.checked.listen(() => this.timeSearch());
    for (const topic of [desk.decision, desk.checked, desk.discovery, desk.finding, desk.shares, desk.problem] as const)
      (topic as { listen(listener: () => void): void }).listen(() => this.show());
  }

  private timeSearch(): void {
    window.clearTimeout(this.timer);
    this.isSlow = false;
    const tell = () => {
      this.isSlow = true;
      this.show();
    };
    this.timer = window.setTimeout(tell, SLOW);
  }

  private show(): void {
    const shares = this.desk.shares.value;
    const run = this.desk.run;
    this.moreButton.disabled = !run || run.done < run.wanted || run.wanted >= run.most;
    if (!run || shares.length === 0) return this.showWaiting();
    const shown = shares.filter(({ code, count: n }) => n > 0 || code === BALANCED);
    this.showVerdict(
      shown.find(({ code }) => code === BALANCED),
      shares[0]!.total,
    );
    this.showBar(shown);
    this.showList(shown);
  }

  private showWaiting(): void {
    const { finding, checked, problem } = this.desk;
    this.bar.replaceChildren();
    this.table.replaceChildren();
    this.progress.style.visibility = "hidden";
    if (problem.value && checked.value && !checked.value.decidable)
      return this.verdict.replaceChildren(h("p", { class: "wrong" }, problem.value.message));
    const at = finding.value;
    const words = this.desk.discovery.value
      ? "Following the first starts…"
      : `Looking for every motion it can end in…${at && at.total > 0 ? ` ${count(at.done)} of ${count(at.total)} ${at.what.replace(/^.*: /, "")}` : ""}`;
    const hint =
      "This machine takes long in a browser; the program is faster, its command stands at the end of the page.";
    const slow = this.isSlow ? [h("p", { class: "quiet" }, hint)] : [];
    this.verdict.replaceChildren(h("p", { class: "quiet" }, words), ...slow);
  }

  private showVerdict(balanced: OutcomeShare | undefined, total: number): void {
    const note = this.desk.discovery.value?.note;
    if (!balanced) return this.verdict.replaceChildren(h("p", {}, note || "No start can end balanced."));
    this.verdict.replaceChildren(
      h(
        "p",
        { class: "big number" },
        percent(balanced.share, balanced),
        " ",
        h("small", {}, "of all starts end balanced"),
      ),
      h("p", { class: "quiet number" }, `95 % interval ${intervalText(balanced)}, from ${count(total)} starts`),
      ...this.wayWords().map((words) => h("p", { class: "quiet number" }, words)),
      ...(note ? [h("p", { class: "quiet" }, note)] : []),
    );
  }

  /** How fast: what the starts that were computed did, no estimate of others. */
  private wayWords(): string[] {
    const run = this.desk.run!;
    const units = new Units(run.check.scales);
    const times: number[] = [];
    for (let k = 0; k < run.prefix; ++k) if (run.outcome[k] === BALANCED) times.push(run.time[k]!);
    if (times.length === 0) return [];
    const at = quantilesOf(times);
    return [`Balanced for certain: half by ${units.timeText(at(0.5))}, 19 of 20 by ${units.timeText(at(0.95))}.`];
  }

  private showBar(shown: readonly OutcomeShare[]): void {
    this.bar.setAttribute("aria-hidden", "true");
    const parts = shown.map((share) => {
      const part = h("span", { title: this.desk.run!.outcomes.of(share.code).title });
      part.style.flex = `${share.count} 0 0`;
      part.style.background = this.desk.run!.outcomes.of(share.code).colour;
      return part;
    });
    this.bar.replaceChildren(...parts);
  }

  private showList(shown: readonly OutcomeShare[]): void {
    const velocity = this.desk.decision.value?.judgement?.velocity;
    const row = (share: OutcomeShare) => {
      const outcome = this.desk.run!.outcomes.of(share.code);
      const name = h("td", {}, swatch(outcome.colour), outcome.title);
      return h(
        "tr",
        {},
        name,
        h("td", {}, percent(share.share, share)),
        h("td", {}, intervalText(share)),
        h("td", {}, count(share.count)),
        velocity ? h("td", {}, velocity.of[share.code] ?? "–") : null,
      );
    };
    const head = h(
      "tr",
      {},
      ...["ends in", "share", "95 % interval", "starts"].map((words) => h("th", { scope: "col" }, words)),
      velocity ? h("th", { scope: "col" }, `RMS at end, ${velocity.unit}`) : null,
    );
    const open = this.undecided();
    const run = this.desk.run!;
    (this.progress.firstChild as HTMLElement).style.width = `${(100 * run.done) / Math.max(1, run.wanted)}%`;
    this.progress.style.visibility = run.done < run.wanted ? "visible" : "hidden";
    this.table.replaceChildren(h("table", {}, h("thead", {}, head), h("tbody", {}, ...shown.map(row))), open);
  }

  /** An undecided share is always said, even where it is none. */
  private undecided(): HTMLElement | string {
    const share = this.desk.shares.value.find(({ code }) => code === 0);
    if (!share || share.count > 0) return "";
    return h("p", { class: "quiet number" }, `Undecided: none, surely ${intervalText(share)}.`);
  }

  private saveShares(): void {
    const rows = this.desk.shares.value.map((share) => {
      const { name, alias } = this.desk.run!.outcomes.of(share.code);
      return [share.code, name, alias, share.count, share.total, share.share, share.low, share.high];
    });
    saveText("shares.csv", csv(["code", "name", "alias", "count", "total", "share", "low", "high"], rows), "text/csv");
  }

  private saveStarts(): void {
    const run = this.desk.run;
    if (!run) return;
    const balls = run.check.machine.balls;
    const rows = Array.from({ length: run.prefix }, (_, k) => [
      k,
      ...run.angles.subarray(k * balls, (k + 1) * balls),
      run.outcome[k]!,
      run.outcomes.of(run.outcome[k]!).name,
      run.time[k]!,
    ]);
    const angles = Array.from({ length: balls }, (_, k) => `phi_${k + 1}`);
    saveText("starts.csv", csv(["start", ...angles, "code", "outcome", "time"], rows), "text/csv");
  }
}
