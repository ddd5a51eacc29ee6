// Numbers as people read them.
import type { Scales, Share } from "../engine/protocol";

/** So many significant digits, without trailing zeros and without exponents where they are not needed. */
export function digits(value: number, count = 3): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4)
    return value
      .toExponential(count - 1)
      .replace(/\.?0+e/, "e")
      .replace("e+", "e");
  const rounded = Number(value.toPrecision(count));
  return size >= 10 ** (count - 1) ? String(Math.round(rounded)) : String(rounded);
}

/** As many places behind the point as its 95 % interval tells. */
export function percent(share: number, interval?: { low: number; high: number }): string {
  if (share === 0 || share === 1) return `${100 * share} %`;
  const width = interval ? 100 * (interval.high - interval.low) : 1;
  const places = width < 0.05 ? 3 : width < 0.5 ? 2 : width < 10 ? 1 : 0;
  return `${(100 * share).toFixed(places)} %`;
}

/** "59.4 to 61.3 %", and bounds for what never or always happened. */
export function intervalText(share: Share): string {
  const places = 100 * (share.high - share.low) < 0.5 ? 2 : 100 * (share.high - share.low) < 10 ? 1 : 0;
  const text = (value: number) => (100 * value).toFixed(places);
  if (share.count === 0) return `below ${digits(100 * share.high, 2)} %`;
  if (share.count === share.total) return `above ${digits(100 * share.low, 4)} %`;
  return `${text(share.low)} to ${text(share.high)} %`;
}

export function count(value: number): string {
  return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, "\u202f");
}


const TURN = 2 * Math.PI;

/** Degrees from 0 to below 360. */
export function degrees(angle: number): number {
  const turned = angle % TURN;
  return ((turned < 0 ? turned + TURN : turned) * 180) / Math.PI;
}

export const radians = (degree: number): number => (degree * Math.PI) / 180;

const NOTHING = 1e-9; // race radii: roundings of the integrator, no displacement

/** One unit for each kind of quantity, dimensionless or of the machine. */
export interface Unit {
  factor: number;
  name: string;
}

/** In what times, lengths and speeds are shown: SI of a machine that is known, else the equations' own. */
export class Units {
  readonly time: Unit;
  readonly length: Unit;
  readonly speed: Unit;

  constructor(scales: Scales | null) {
    this.time = scales ? { factor: scales.time, name: "s" } : { factor: 1, name: "1/ωc" };
    this.length = scales ? { factor: 1000 * scales.length, name: "mm" } : { factor: 1, name: "R" };
    this.speed = scales ? { factor: scales.speed_rpm, name: "rpm" } : { factor: 1, name: "ωc" };
  }

  timeText = (value: number): string => digits(value * this.time.factor) + (this.time.name === "s" ? "\u00a0s" : "/ωc");
  lengthText = (value: number): string =>
    `${digits(Math.abs(value) < NOTHING ? 0 : value * this.length.factor)}\u00a0${this.length.name}`;
  speedText = (value: number): string => `${digits(value * this.speed.factor)}\u00a0${this.speed.name}`;
}
