// Two settings side by side, on common starts: what the change is worth, and how surely.
import type { Comparison, Override, StudyCheck } from "../engine/protocol";
import { h, swatch, throttled } from "../base/dom";
import { count, percent } from "../base/numbers";
import { csv, saveText } from "../base/save";
import { EnsembleRun } from "../work/ensemble_run";
import { URGENCY } from "../work/urgency";
import type { Desk } from "./desk";
import { saveMenu } from "./save_menu";

const STARTS = 4000; // of common starts: most differences of two points show

const points = (value: number): string =>
  `${value > 0 ? "+" : value < 0 ? "\u2212" : ""}${Math.abs(100 * value).toFixed(1)}`;

export class ComparisonView {
  private readonly words = h("div");
  private readonly keepButton = h("button", {
    type: "button",
    class: "main",
    click: () => this.desk.pin([...this.desk.setting.overrides]),
  });
  private readonly drop = h("button", { type: "button", click: () => this.desk.pin(null) }, "Stop comparing");
  private readonly back = h("button", { type: "button", click: () => this.goBack() }, "Back to the first");
  private readonly menu = saveMenu("Save the comparison", { "differences (CSV)": () => this.save() });
  private kept: { check: StudyCheck; run: EnsembleRun; overrides: Override[] } | null = null;
  private latest: Comparison | null = null;
  private asked = 0;
  private readonly compare = throttled(300, () => void this.ask());

  constructor(
    private readonly desk: Desk,
    place: HTMLElement,
  ) {
    this.drop.hidden = this.back.hidden = this.menu.hidden = true;
    place.append(this.words, h("div", { class: "row" }, this.keepButton, this.back, this.drop, this.menu));
    desk.pinned.listen((overrides) => void this.keep(overrides));
    desk.shares.listen(() => this.compare());
    desk.checked.listen(() => this.show());
    this.show();
  }

  /** Starts of the setting that is kept, the same as those of the one on the desk. */
  private async keep(overrides: Override[] | null): Promise<void> {
    const number = ++this.asked;
    this.kept?.run.stop();
    this.kept = null;
    this.latest = null;
    if (overrides) {
      try {
        const check = await this.desk.checkWith(overrides);
        if (number !== this.asked) return;
        const run: EnsembleRun = new EnsembleRun(this.desk.crew, check, STARTS, URGENCY.comparison, false, () => {
          if (run.failure) this.desk.fail(run.failure);
          this.compare();
        });
        run.extend(STARTS);
        this.kept = { check, run, overrides };
      } catch (error) {
        this.desk.fail(error as Error);
      }
    }
    this.show();
    this.compare();
  }

  private async ask(): Promise<void> {
    const [kept, run] = [this.kept, this.desk.run];
    if (!kept || !run || kept.check.toml === run.check.toml) {
      this.latest = null;
      return this.show();
    }
    const starts = Math.min(kept.run.prefix, run.prefix);
    if (starts < 100) return this.show(); // too few to say anything
    const side = (one: EnsembleRun) => ({
      toml: one.check.toml,
      outcomes: one.outcomes.list,
      outcome: one.outcome.slice(0, starts),
    });
    try {
      const comparison = await this.desk.crew.ask("compare_shares", side(kept.run), side(run));
      if (this.kept === kept && this.desk.run === run) this.latest = comparison;
    } catch (error) {
      this.desk.fail(error as Error);
    }
    this.show();
  }

  private goBack(): void {
    if (this.kept) void this.desk.take({ ...this.desk.setting, overrides: this.kept.overrides });
  }

  private show(): void {
    this.drop.hidden = this.back.hidden = this.kept === null;
    this.menu.hidden = this.latest === null;
    this.keepButton.textContent = this.kept ? "Keep this one instead" : "Keep this setting as the first";
    if (!this.kept) {
      const words =
        "Keep the present setting, then change something under “What if?”: both are computed on the same starts, so that a small difference shows too.";
      return this.words.replaceChildren(h("p", { class: "quiet" }, words));
    }
    const waiting = this.desk.isPinnedHere
      ? "Both are the same so far: change something under “What if?”."
      : "Following the same starts in both…";
    this.words.replaceChildren(
      this.changes(),
      this.latest ? this.table(this.latest) : h("p", { class: "quiet" }, waiting),
    );
  }

  /** What is unlike: only keys whose values differ. */
  private changes(): HTMLElement {
    const [first, second] = [this.kept!.check.fields, this.desk.checked.value?.fields ?? []];
    const text = (value: string, unit: string) => (unit ? `${value} ${unit}` : value);
    const lines: HTMLElement[] = [];
    for (const field of second) {
      const before = first.find(({ key }) => key === field.key);
      const [was, is] = [before ? text(before.value, before.unit) : "–", text(field.value, field.unit)];
      if (was !== is)
        lines.push(h("span", {}, `${field.label || field.key}: `, h("b", {}, was), " → ", h("b", {}, is)));
    }
    return h("div", { class: "changes" }, ...lines);
  }

  private table(comparison: Comparison): HTMLElement {
    const head = ["ends in", "first", "second", "difference, points", "95 % interval"].map((words) =>
      h("th", { scope: "col" }, words),
    );
    const known = [...this.desk.run!.outcomes.list, ...this.kept!.run.outcomes.list];
    const colourOf = (row: { name: string; alias: string }) =>
      known.find(({ name, alias }) => name === row.name && alias === row.alias)?.colour ?? "#888888";
    const rows = comparison.shares
      .filter(({ first, second }) => first.count + second.count > 0)
      .map((row) => {
        const { difference, low, high } = row.difference;
        return h(
          "tr",
          {},
          h("td", {}, swatch(colourOf(row)), row.title),
          h("td", {}, percent(row.first.share, row.first)),
          h("td", {}, percent(row.second.share, row.second)),
          h("td", {}, points(difference)),
          h("td", {}, `${points(low)} to ${points(high)}`),
        );
      });
    const on = comparison.common ? `on ${count(comparison.starts)} common starts` : comparison.why_not;
    const bar = (which: "first" | "second") => {
      const parts = comparison.shares.map((row) => {
        const part = h("span");
        part.style.flex = `${row[which].count} 0 0`;
        part.style.background = colourOf(row);
        return part;
      });
      return h(
        "div",
        { class: "sidebar", "aria-hidden": "true" },
        h("span", { class: "quiet" }, which),
        h("div", { class: "stack" }, ...parts),
      );
    };
    return h(
      "div",
      {},
      h("p", {}, h("b", {}, comparison.verdict)),
      bar("first"),
      bar("second"),
      h("table", {}, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...rows)),
      h("p", { class: "quiet" }, on),
    );
  }

  private save(): void {
    const rows = this.latest!.shares.map((row) => [
      row.name,
      row.alias,
      row.first.share,
      row.second.share,
      row.difference.difference,
      row.difference.low,
      row.difference.high,
    ]);
    saveText(
      "comparison.csv",
      csv(["name", "alias", "first", "second", "difference", "low", "high"], rows),
      "text/csv",
    );
  }
}
