// The recorder under the machine: speed, whirl radius and ball angles from the beginning of the run.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { darkScheme, h, styleColour, throttled } from "../base/dom";
import { degrees, type Units } from "../base/numbers";
import type { Moment } from "../work/player";

const MOST_POINTS = 3000; // twice the pixels of a wide strip; beyond, every other one goes
const HEIGHTS = [62, 86, 86]; // the speed says least
const BALL_COLOURS = [
  "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8a8f98", "#882255",
  "#332288", "#CC6677", "#117733", "#AA4499", "#999933", "#88CCEE", "#44AA99", "#DDCC77",
];

/** What is kept of a run, evenly thinned as it grows; of radii that go the largest stays. */
class Record {
  t: number[] = [];
  speed: number[] = [];
  radial: number[] = [];
  phi: (number | null)[][] = [];
  private every = 1;
  private count = 0;

  constructor(readonly balls: number) {
    this.phi = Array.from({ length: balls }, () => []);
  }

  add(moment: Moment): void {
    if (this.count++ % this.every !== 0) {
      const last = this.radial.length - 1;
      this.radial[last] = Math.max(this.radial[last]!, moment.radial);
      return;
    }
    this.t.push(moment.t);
    this.speed.push(moment.speed);
    this.radial.push(moment.radial);
    this.phi.forEach((list, k) => list.push(degrees(moment.phi[k]!)));
    if (this.t.length > MOST_POINTS) this.thin();
  }

  private thin(): void {
    const even = <T>(list: T[]) => list.filter((_, k) => k % 2 === 0);
    this.radial = even(this.radial.map((r, k) => Math.max(r, this.radial[k + 1] ?? 0)));
    this.t = even(this.t);
    this.speed = even(this.speed);
    this.phi = this.phi.map(even);
    this.every *= 2;
  }
}

/** A ball that passes 360 degrees goes on at 0: no line between. */
function broken(angles: readonly (number | null)[]): (number | null)[] {
  return angles.map((angle, k) => (k > 0 && Math.abs(angle! - angles[k - 1]!) > 180 ? null : angle));
}

/** Between two looks; null where nothing is known yet. */
function valueAt({ t, radial }: { t: readonly number[]; radial: readonly number[] }, time: number): number | null {
  let [low, high] = [0, t.length - 1];
  if (high < 0 || time < t[0]! || time > t[high]!) return null;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (t[middle]! <= time) low = middle;
    else high = middle;
  }
  const part = high > low ? (time - t[low]!) / (t[high]! - t[low]!) : 0;
  return radial[low]! + part * (radial[high]! - radial[low]!);
}

export class Strips {
  private record = new Record(0);
  private plots: uPlot[] = [];
  private bare: { t: number[]; radial: number[] } = { t: [], radial: [] };
  private until = 1;
  private readonly redraw = throttled(110, () => this.draw());
  private units: Units | null = null;

  constructor(private readonly place: HTMLElement) {
    new ResizeObserver(() => this.resize()).observe(place);
    darkScheme.addEventListener("change", () => this.units && this.build());
  }

  /** A new run of so many balls, most of which is over at `until`. */
  begin(balls: number, until: number, units: Units): void {
    const rebuilt = balls !== this.record.balls || units.time.factor !== this.units?.time.factor;
    this.record = new Record(balls);
    this.bare = { t: [], radial: [] };
    this.until = until;
    this.units = units;
    if (rebuilt || this.plots.length === 0) this.build();
    this.redraw();
  }

  add(moments: readonly Moment[]): void {
    for (const moment of moments) this.record.add(moment);
    if (moments.length > 0) this.redraw();
  }

  /** The whirl of the rotor without balls, which goes ahead of the run. */
  addBare(t: readonly number[], radial: readonly number[]): void {
    this.bare.t.push(...t);
    this.bare.radial.push(...radial);
    this.redraw();
  }

  /** t, speed, whirl radius and angles as kept; dimensionless. */
  rows(): (number | string)[][] {
    const { t, speed, radial, phi } = this.record;
    return t.map((time, k) => [time, speed[k]!, radial[k]!, ...phi.map((list) => list[k] ?? "")]);
  }

  header(): string[] {
    return ["t", "psi_dot", "radial", ...this.record.phi.map((_, k) => `phi_${k + 1}_degrees`)];
  }

  private build(): void {
    for (const plot of this.plots) plot.destroy();
    const u = this.units!;
    const balls = Array.from({ length: this.record.balls }, (_, k) => BALL_COLOURS[k % BALL_COLOURS.length]!);
    const one = [styleColour("--chart")];
    const marked = (words: string, colour: string) => {
      const mark = h("span", {}, words);
      mark.style.color = colour;
      return mark;
    };
    const bare = styleColour("--heavy");
    const specs: [string, string[], [number, number] | null, HTMLElement[]][] = [
      [`speed (${u.speed.name})`, one, null, []],
      [`whirl radius (${u.length.name})`, [...one, bare], null, [marked("with balls", one[0]!), marked("without", bare)]],
      ["angle from the heavy side (°)", balls, [0, 360], balls.map((colour, k) => marked(`ball ${k + 1}`, colour))],
    ];
    this.place.replaceChildren();
    this.plots = specs.map(([label, colours, range, marks], k) => {
      const strip = h("div", { class: "strip" });
      const caption = h("p", { class: "quiet legend" }, h("span", {}, label), ...marks);
      this.place.append(caption, strip);
      return new uPlot(
        this.options(colours, range, HEIGHTS[k]!),
        [[0], ...colours.map(() => [null])] as uPlot.AlignedData,
        strip,
      );
    });
  }

  private options(colours: readonly string[], range: [number, number] | null, height: number): uPlot.Options {
    const [line, quiet] = [styleColour("--rule"), styleColour("--quiet")];
    const axis = { stroke: quiet, grid: { stroke: line, width: 1 }, ticks: { show: false }, font: "11px system-ui" };
    return {
      width: Math.max(120, this.place.clientWidth),
      height,
      padding: [6, 12, 0, 0],
      legend: { show: false },
      cursor: { drag: { x: false, y: false }, points: { show: false } },
      scales: {
        x: {
          time: false,
          range: (_plot, _low, high) => [0, Math.max(high || 0, this.until * this.units!.time.factor)],
        },
        y: { range: range ?? ((_plot, _low, high) => [0, 1.12 * Math.max(high || 0, 1e-9)]) },
      },
      axes: [
        { ...axis, size: 20, gap: 2 },
        { ...axis, size: 46, gap: 4, space: 22, ...(range ? { splits: () => [0, 180, 360] } : {}) },
      ],
      series: [{}, ...colours.map((stroke) => ({ stroke, width: 1.5, points: { show: false } }))],
    };
  }

  private draw(): void {
    const { t, speed, radial, phi } = this.record;
    const u = this.units;
    if (!u || this.plots.length < 3) return;
    const times = t.map((time) => time * u.time.factor);
    this.plots[0]!.setData([times, speed.map((value) => value * u.speed.factor)]);
    const ahead = this.bare.t.findIndex((time) => time > (t.at(-1) ?? -1));
    const later = ahead < 0 ? [] : this.bare.t.slice(ahead);
    const bare = [...t.map((time) => valueAt(this.bare, time)), ...later.map((_, k) => this.bare.radial[ahead + k]!)];
    this.plots[1]!.setData([
      [...times, ...later.map((time) => time * u.time.factor)],
      [...radial.map((value) => value * u.length.factor), ...later.map(() => null)],
      bare.map((value) => (value === null ? null : value * u.length.factor)),
    ]);
    this.plots[2]!.setData([times, ...phi.map(broken)] as uPlot.AlignedData);
  }

  private resize(): void {
    const width = Math.max(120, this.place.clientWidth);
    for (const plot of this.plots) if (plot.width !== width) plot.setSize({ width, height: plot.height });
  }
}
