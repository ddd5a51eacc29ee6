// Values of a study's keys between a form and the text that sets them.
import type { StudyCheck, StudyField } from "../engine/protocol";

const quoted = (text: string): string => `"${text.replaceAll("\\", "").replaceAll('"', "")}"`;

/** What `--set key=` takes for what was entered into a field, in a unit. */
export function valueText(field: StudyField, entered: string, unit: string): string {
  if (/^\s*[{[]/.test(entered)) return entered.trim(); // a distribution, or a list as TOML has it
  const one = (text: string) => (unit ? quoted(`${text.trim()} ${unit}`) : text.trim());
  if (field.kind === "list" || (field.kind === "number" && entered.includes(",")))
    return `[${entered.split(",").map(one).join(", ")}]`;
  if (field.kind === "number") return one(entered);
  return field.kind === "choice" || field.kind === "text" ? quoted(entered) : entered.trim();
}

/** What --set takes for a key that has no field yet: numbers and what is TOML already as they are, the rest as text. */
export function offeredText(entered: string): string {
  const text = entered.trim();
  return /^([{["]|true$|false$|[-+]?[\d.]+(e[-+]?\d+)?$)/i.test(text) ? text : quoted(text);
}

/** A default that was computed, to so many digits as a reader takes in. */
export function shownText({ value, given }: StudyField): string {
  const short = (text: string) => (/\.\d{6,}/.test(text) ? String(Number(Number(text).toPrecision(6))) : text.trim());
  return given ? value : value.split(",").map(short).join(", ");
}

const DIGITS = 12; // more than anybody writes, fewer than a conversion's roundings show in

/** The field's value, or its values, in another of its units. */
export function inUnit(field: StudyField, unit: string): string {
  const worth = (name: string) => field.worth[field.units.indexOf(name)]!;
  const one = (text: string) => String(Number(((Number(text) * worth(field.unit)) / worth(unit)).toPrecision(DIGITS)));
  return field.value.split(",").map(one).join(", ");
}

/** A field's number; NaN: it holds none, or several. */
export function numberOf(field: StudyField): number {
  return field.value.trim() === "" ? NaN : Number(field.value);
}

export interface SliderRange {
  low: number;
  high: number;
  /** From the slider's place, 0 to 1, to the value, and back. */
  at(place: number): number;
  place(value: number): number;
}

/** Speeds from standstill to well above; anything else a decade to either side. Null: no slider makes sense. */
export function sliderRange(key: string, base: number): SliderRange | null {
  if (!Number.isFinite(base) || base <= 0) return null;
  if (/^speed\.(speed|final|peak)$|^release\.speed$/.test(key)) {
    const high = 2.5 * base;
    return { low: 0, high, at: (place) => high * place, place: (value) => value / high };
  }
  const [low, high] = [base / 10, base * 10];
  return { low, high, at: (place) => low * 100 ** place, place: (value) => Math.log(value / low) / Math.log(100) };
}

/** As the form shows numbers that a slider made. */
export function rounded(value: number): string {
  return String(Number(value.toPrecision(3)));
}

/** A whole [speed] table of another profile, with the final speed that the study has now. */
export function speedTable(profile: string, check: StudyCheck): string {
  const field = (key: string) => check.fields.find((one) => one.key === key);
  const final = field("speed.final") ?? field("speed.speed");
  const shown = final && Number.isFinite(numberOf(final)) ? numberOf(final) : (check.machine.final_speed ?? 2);
  const unit = final?.unit ?? "";
  const speed = (share: number) => (unit ? quoted(`${rounded(share * shown)} ${unit}`) : rounded(share * shown));
  const time = (value: number) =>
    check.physical && check.scales ? quoted(`${rounded(value * check.scales.time)} s`) : rounded(value);
  const tables: Record<string, string> = {
    constant: `speed = ${speed(1)}`,
    ramp: `final = ${speed(1)}, duration = ${time(300)}`,
    trapezoid: `peak = ${speed(1.3)}, final = ${speed(1)}, rise_until = ${time(100)}, hold_until = ${time(300)}, fall_until = ${time(400)}`,
    points: `times = [${time(0)}, ${time(300)}], speeds = [${speed(0)}, ${speed(1)}]`,
    hill: `final = ${speed(1)}, half_time = ${time(100)}, exponent = 3`,
    torque: check.physical
      ? `torque = { stall = "1 N m", no_load_speed = ${speed(1.1)} }`
      : `torque = { stall = 0.1, no_load_speed = ${speed(1.1)} }`,
  };
  return `{ profile = ${quoted(profile)}, ${tables[profile] ?? tables.constant} }`;
}
