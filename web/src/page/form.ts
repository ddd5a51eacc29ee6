// Every key of the study as a field: number, slider, unit; what is wrong stands beside it in the program's own words.
import type { OfferedKey, Problem, StudyCheck, StudyField } from "../engine/protocol";
import { h, settled } from "../base/dom";
import { inUnit, numberOf, offeredText, rounded, shownText, sliderRange, speedTable, valueText } from "../setting/values";
import type { Desk } from "./desk";

const GROUPS: Record<string, string> = {
  rotor: "Rotor",
  balancer: "Balancer",
  speed: "Speed",
  release: "Release",
  limits: "Limits",
  standards: "Standards",
  initial: "Initial state",
  sampling: "Starts",
  numerics: "Numerics",
  units: "Units",
};
const SIDE_GROUPS = new Set(["initial", "sampling", "numerics", "units"]); // seldom touched: folded away
const MANY_PLACES = 2; // more are folded
const QUIET = 140; // ms after the last movement of a slider

interface Entry {
  element: HTMLElement;
  wrong: HTMLElement;
  show(field: StudyField): void;
}

export class Form {
  private readonly entries = new Map<string, Entry>();
  private readonly general = h("p", { class: "wrong wholewidth", role: "alert" });
  private readonly reset = h(
    "button",
    { type: "button", class: "text", click: () => void this.desk.dropOverrides() },
    "Undo all changes",
  );
  private shape = "";
  /** Values before anything was changed: the middle of sliders. */
  private base = new Map<string, number>();
  private baseSource = "";

  constructor(
    private readonly desk: Desk,
    private readonly place: HTMLElement,
  ) {
    desk.checked.listen((check) => check && this.take(check));
    desk.problem.listen((problem) => this.tell(problem));
  }

  private take(check: StudyCheck): void {
    if (this.desk.source !== this.baseSource) {
      this.baseSource = this.desk.source;
      this.base = new Map(check.fields.map((field) => [field.key, numberOf(field)]));
    }
    const shape = JSON.stringify([
      check.fields.map(({ key, kind, units, given }) => [key, kind, units, given]),
      check.offers.map(({ key }) => key),
    ]);
    if (shape !== this.shape) this.build(check);
    this.shape = shape;
    for (const field of check.fields) this.entries.get(field.key)?.show(field);
    this.reset.hidden = !this.desk.isChanged;
  }

  private build(check: StudyCheck): void {
    this.entries.clear();
    const groups = new Map<string, StudyField[]>();
    const tables = new Set(check.fields.map(({ key }) => key.split(".")[0]!));
    for (const field of check.fields) {
      const [table, entry] = field.key.split(".");
      const group = table === "place" ? `Place ${entry}` : table!; // [[place]] is a list of tables
      groups.set(group, [...(groups.get(group) ?? []), field]);
    }
    for (const { key } of check.offers) {
      const table = key.split(".")[0]!;
      if (!tables.has(table) && !groups.has(table)) groups.set(table, []);
    }
    const offers = (group: string) => check.offers.filter(({ key }) => key.startsWith(`${group}.`));
    const places = [...groups.keys()].filter((group) => group.startsWith("Place ")).length;

    const intro = h("p", { class: "quiet wholewidth" }, "Change anything; everything is computed again. ", this.reset);
    this.place.replaceChildren(intro, this.general);
    const order = Object.keys(GROUPS);
    const rank = (group: string) => (order.includes(group) ? order.indexOf(group) : 0.5); // places after the rotor
    for (const [group, fields] of [...groups].sort(([a], [b]) => rank(a) - rank(b)))
      if (!SIDE_GROUPS.has(group))
        this.place.append(
          group.startsWith("Place ") && places > MANY_PLACES
            ? this.folded(group, fields)
            : this.fieldset(group, fields, false, offers(group)),
        );
    const side = [...groups].filter(([group]) => SIDE_GROUPS.has(group));
    if (side.length === 0) return;
    const inside = h("div", {}, ...side.map(([group, fields]) => this.fieldset(group, fields, true, offers(group))));
    this.place.append(h("details", {}, h("summary", {}, "Initial state, starts, numerics"), inside));
  }

  /** One of many places, told in a line. */
  private folded(group: string, fields: readonly StudyField[]): HTMLElement {
    const told = (key: string) => fields.find((field) => field.key.endsWith(`.${key}`));
    const words = ["name", "mass", "angle"].map(told).map((field) => field && `${field.value} ${field.unit}`.trim());
    const summary = h("summary", {}, `${group}: ${words.filter(Boolean).join(", ")}`);
    return h("details", {}, summary, h("div", {}, ...fields.map((field) => this.entry(field))));
  }

  /** Keys that have no value yet: choose one, say what it shall be. */
  private adder(offers: readonly OfferedKey[]): HTMLElement {
    const option = ({ key, label }: OfferedKey) => h("option", { value: key }, label);
    const menu = h("select", { "aria-label": "Key to be stated" }, h("option", { value: "" }, "state more…"), ...offers.map(option));
    const input = h("input", { "aria-label": "Its value, with its unit", placeholder: "value", autocomplete: "off", hidden: true });
    const told = h("p", { class: "quiet wide" });
    menu.addEventListener("change", () => {
      const sentence = offers.find(({ key }) => key === menu.value)?.sentence ?? "";
      // "..., in R": of a study without units.
      const physical = this.desk.checked.value?.physical;
      told.textContent = sentence.replaceAll("`", "").replace(physical ? /, in [^,;]*$/ : "", "");
      input.hidden = menu.value === "";
      if (menu.value) input.focus();
    });
    input.addEventListener("change", () => menu.value && input.value.trim() && this.set(menu.value, offeredText(input.value)));
    return h("div", { class: "field adder" }, menu, input, told);
  }

  private fieldset(
    group: string,
    fields: readonly StudyField[],
    all: boolean,
    offers: readonly OfferedKey[],
  ): HTMLElement {
    const made = fields.map((field) => ({ given: field.given || all, element: this.entry(field) }));
    const [given, others] = [made.filter((one) => one.given), made.filter((one) => !one.given)];
    const set = h("fieldset", {}, h("legend", {}, GROUPS[group] ?? group), ...given.map(({ element }) => element));
    const adder = offers.length > 0 ? this.adder(offers) : null;
    if (others.length > 0)
      set.append(
        h(
          "details",
          {},
          h("summary", {}, `more (${others.length + offers.length})`),
          h("div", {}, ...others.map(({ element }) => element), adder),
        ),
      );
    else if (adder) set.append(adder);
    return set;
  }

  private entry(field: StudyField): HTMLElement {
    const id = `field-${field.key.replaceAll(".", "-")}`;
    const wrong = h("p", { class: "wrong", id: `${id}-wrong`, role: "alert" });
    const control = this.control(field, id);
    const element = h(
      "div",
      { class: "field", "data-key": field.key },
      h("label", { for: id, title: `${field.key}: ${field.allowed}` }, field.label || field.key),
      h("span", { class: "entry" }, ...control.parts),
      control.slider,
      wrong,
    );
    const show = (now: StudyField) => {
      const changed = this.desk.setting.overrides.some(([key]) => key === now.key);
      element.classList.toggle("changed", changed);
      control.show(now);
    };
    this.entries.set(field.key, { element, wrong, show });
    return element;
  }

  private set(key: string, value: string): void {
    void this.desk.override(key, value);
  }

  private control(
    field: StudyField,
    id: string,
  ): { parts: HTMLElement[]; slider: HTMLElement | null; show(field: StudyField): void } {
    if (field.kind === "flag") return this.flag(field, id);
    if (field.kind === "choice") return this.choice(field, id);
    return this.number(field, id);
  }

  private flag(field: StudyField, id: string) {
    const box = h("input", { type: "checkbox", id, change: () => this.set(field.key, String(box.checked)) });
    return { parts: [box], slider: null, show: (now: StudyField) => void (box.checked = now.value === "true") };
  }

  private choice(field: StudyField, id: string) {
    const menu = h("select", { id }, ...field.choices.map((choice) => h("option", { value: choice }, choice)));
    menu.addEventListener("change", () => {
      if (field.key === "speed.profile") this.set("speed", speedTable(menu.value, this.desk.checked.value!));
      else this.set(field.key, valueText(field, menu.value, ""));
    });
    return { parts: [menu], slider: null, show: (now: StudyField) => void (menu.value = now.value) };
  }

  private number(field: StudyField, id: string) {
    const wide = field.kind === "list" || field.kind === "text" || field.value.length > 8;
    const input = h("input", {
      id,
      class: wide ? "wide" : "",
      inputmode: field.kind === "text" ? "text" : "decimal",
      autocomplete: "off",
      spellcheck: "false",
      "aria-describedby": `${id}-wrong`,
    });
    let now = field;
    const units = this.unitMenu(field, () => now);
    const unit = () => (units instanceof HTMLSelectElement ? units.value : now.unit);
    const send = () => this.set(field.key, valueText(now, input.value, unit()));
    input.addEventListener("change", send);
    const range = field.kind === "number" ? sliderRange(field.key, this.base.get(field.key) ?? numberOf(field)) : null;
    const slider =
      range && h("input", { type: "range", min: 0, max: 1, step: 0.002, "aria-label": `${field.label}, slider` });
    const soon = settled(QUIET, send);
    slider?.addEventListener("input", () => {
      input.value = rounded(range!.at(Number(slider.value)));
      slider.setAttribute("aria-valuetext", `${input.value} ${unit()}`);
      soon();
    });
    const show = (shown: StudyField) => {
      now = shown;
      input.value = shownText(shown);
      input.removeAttribute("aria-invalid");
      if (units instanceof HTMLSelectElement) units.value = shown.unit;
      if (slider && document.activeElement !== slider) slider.value = String(range!.place(numberOf(shown)));
    };
    return { parts: units ? [input, units] : [input], slider, show };
  }

  /** Units to choose from; the quantity stays what it is, its number changes. */
  private unitMenu(field: StudyField, now: () => StudyField): HTMLElement | null {
    if (!field.unit) return null;
    if (field.units.length < 2) return h("span", { class: "quiet" }, field.unit);
    const menu = h(
      "select",
      { class: "unit", "aria-label": `unit of ${field.label}` },
      ...field.units.map((unit) => h("option", { value: unit }, unit)),
    );
    menu.addEventListener("change", () => this.set(field.key, valueText(now(), inUnit(now(), menu.value), menu.value)));
    return menu;
  }

  private tell(problem: Problem | null): void {
    this.general.textContent = "";
    for (const { wrong } of this.entries.values()) wrong.textContent = "";
    if (!problem) return;
    // A key of a table within a table belongs to the field that stands for it.
    const keys = [
      problem.key,
      problem.key.replace(/\.\d+$|\[\d+\]$/, ""),
      problem.key.split(".").slice(0, 2).join("."),
    ];
    const entry = keys.map((key) => this.entries.get(key)).find((found) => found !== undefined);
    if (!entry) return void (this.general.textContent = problem.message);
    entry.wrong.textContent = problem.message;
    entry.element.querySelector("input, select")?.setAttribute("aria-invalid", "true");
    for (let fold = entry.element.closest("details"); fold; fold = fold.parentElement!.closest("details"))
      fold.open = true;
  }
}
