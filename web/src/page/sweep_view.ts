// Along one parameter: which, from where to where; the shares as they come.
import type { StudyField } from "../engine/protocol";
import { h, swatch } from "../base/dom";
import { csv, saveSvg, saveSvgAsPng, saveText } from "../base/save";
import { layersOf, stackedShares } from "../drawing/stacked";
import { numberOf, rounded, valueText } from "../setting/values";
import { sweepProblem, withOverride, type SweepSetting } from "../setting/setting";
import { SweepRun } from "../work/sweep_run";
import { URGENCY } from "../work/urgency";
import type { Desk } from "./desk";
import { saveMenu } from "./save_menu";

const [VALUES, STARTS] = [13, 300];
const PREFERRED = ["speed.final", "speed.speed", "balancer.drag"];

export class SweepView {
  private readonly key = h("select", { "aria-label": "Parameter" });
  private readonly from = h("input", { inputmode: "decimal" });
  private readonly to = h("input", { inputmode: "decimal" });
  private readonly values = h("input", { inputmode: "numeric", value: VALUES });
  private readonly starts = h("input", { inputmode: "numeric", value: STARTS });
  private readonly unit = h("span", { class: "quiet" });
  private readonly button = h("button", { type: "button", class: "main", click: () => this.press() }, "Sweep");
  private readonly wrong = h("p", { class: "wrong", role: "alert" });
  private readonly state = h("p", { class: "quiet" });
  private readonly picture = h("div");
  private chart: SVGElement | null = null;
  private readonly menu = saveMenu("Save the sweep", {
    "picture (SVG)": () => this.chart && saveSvg("sweep.svg", this.chart),
    "picture (PNG)": () => this.chart && saveSvgAsPng("sweep.png", this.chart),
    "shares (CSV)": () => this.run && this.save(this.run),
  });
  private run: SweepRun | null = null;
  private ofStudy = "";

  constructor(
    private readonly desk: Desk,
    form: HTMLElement,
    chart: HTMLElement,
  ) {
    this.key.addEventListener("change", () => this.propose());
    const label = (words: string, input: HTMLElement) => h("label", {}, words, input);
    const row = h(
      "div",
      { class: "row" },
      label("vary", this.key),
      label("from", this.from),
      label("to", this.to),
      this.unit,
      label("values", this.values),
      label("starts each", this.starts),
      this.button,
    );
    this.menu.hidden = true;
    form.append(row, this.wrong);
    chart.append(h("div", { class: "row apart" }, this.state, this.menu), this.picture);
    desk.checked.listen(() => this.offer());
  }

  private get fields(): StudyField[] {
    const fields = this.desk.checked.value?.fields ?? [];
    const wanted = /^(rotor|balancer|speed|release)\./;
    return fields.filter((field) => field.kind === "number" && wanted.test(field.key) && numberOf(field) > 0);
  }

  private get field(): StudyField | undefined {
    return this.fields.find(({ key }) => key === this.key.value);
  }

  private offer(): void {
    const before = this.key.value;
    const fields = this.fields;
    this.key.replaceChildren(...fields.map(({ key, label }) => h("option", { value: key }, label || key)));
    const asked = this.desk.setting.sweep?.key;
    const choice = [before, asked, ...PREFERRED].find((key) => fields.some((field) => field.key === key));
    if (choice) this.key.value = choice;
    if (this.ofStudy !== this.desk.source) {
      this.ofStudy = this.desk.source;
      this.stop();
      this.picture.replaceChildren();
      this.state.textContent = "";
      this.menu.hidden = true;
      const sweep = this.desk.setting.sweep;
      if (sweep && fields.some(({ key }) => key === sweep.key)) return this.resume(sweep);
      this.propose();
    } else if (this.key.value !== before) this.propose();
  }

  /** From half of what it is to half as much again. */
  private propose(): void {
    const value = this.field ? numberOf(this.field) : NaN;
    if (!Number.isFinite(value)) return;
    this.from.value = rounded(0.5 * value);
    this.to.value = rounded(1.5 * value);
    this.unit.textContent = this.field!.unit;
  }

  private resume(sweep: SweepSetting): void {
    this.key.value = sweep.key;
    this.from.value = String(sweep.from);
    this.to.value = String(sweep.to);
    this.values.value = String(sweep.values);
    this.starts.value = String(sweep.starts);
    this.unit.textContent = this.field?.unit ?? "";
    this.begin(sweep);
  }

  private press(): void {
    if (this.run && this.run.done < this.run.cells.length) return this.stop();
    const [from, to, values, starts] = [this.from, this.to, this.values, this.starts].map((input) =>
      Number(input.value.replace(",", ".")),
    );
    if (!this.field) return;
    const sweep = {
      key: this.field.key,
      from: from!,
      to: to!,
      values: Math.round(values!),
      starts: Math.round(starts!),
      unit: this.field.unit,
    };
    this.wrong.textContent = sweepProblem(sweep);
    if (this.wrong.textContent) return;
    this.desk.setSweep(sweep);
    this.begin(sweep);
  }

  private stop(): void {
    this.run?.stop();
    this.run = null;
    this.button.textContent = "Sweep";
  }

  private begin(sweep: SweepSetting): void {
    this.stop();
    const field = this.field;
    if (!field) return;
    const values = Array.from({ length: sweep.values }, (_, k) => {
      const value = Number((sweep.from + ((sweep.to - sweep.from) * k) / (sweep.values - 1)).toPrecision(6));
      return { value, text: String(value) };
    });
    const { overrides } = this.desk.setting;
    const setting = (text: string) => withOverride(overrides, field.key, valueText(field, text, sweep.unit));
    const label = `${field.label || field.key}${sweep.unit ? ` (${sweep.unit})` : ""}`;
    this.run = new SweepRun(this.desk.crew, this.desk.source, values, setting, sweep.starts, URGENCY.sweep, () =>
      this.show(label, field, sweep),
    );
    this.button.textContent = "Stop";
    this.show(label, field, sweep);
  }

  private show(label: string, field: StudyField, sweep: SweepSetting): void {
    const run = this.run;
    if (!run) return;
    const over = run.done === run.cells.length;
    if (over) this.button.textContent = "Sweep";
    const chosen = (text: string) => void this.desk.override(field.key, valueText(field, text, sweep.unit));
    this.chart = stackedShares(run.cells, label, (cell) => chosen(cell.text));
    const legend = layersOf(run.cells).map((layer) => h("span", {}, swatch(layer.colour), layer.title));
    const problems = [...new Set(run.cells.map(({ problem }) => problem).filter(Boolean))];
    this.state.textContent = over
      ? "Bars: 95 % interval of balanced. Click a bar to go there."
      : `${run.done} of ${run.cells.length} values`;
    this.menu.hidden = false;
    this.picture.replaceChildren(
      this.chart,
      h("div", { class: "legend" }, ...legend),
      ...problems.map((problem) => h("p", { class: "wrong" }, problem)),
    );
  }

  private save(run: SweepRun): void {
    const rows = run.cells.flatMap((cell) =>
      (cell.shares ?? []).map((share) => {
        const outcome = cell.outcomes.find(({ code }) => code === share.code);
        return [
          cell.value,
          outcome?.name ?? share.code,
          outcome?.alias ?? "",
          share.count,
          share.total,
          share.share,
          share.low,
          share.high,
        ];
      }),
    );
    saveText(
      "sweep.csv",
      csv(["value", "outcome", "alias", "count", "total", "share", "low", "high"], rows),
      "text/csv",
    );
  }
}
