// The basin map: where the first two balls start, coloured by where the machine ends.
import { h, s } from "../base/dom";
import { degrees, Units } from "../base/numbers";
import { csv, saveCanvas, saveSvg, saveText } from "../base/save";
import { NO_PIXEL, type MapRun } from "../work/map_run";
import type { Desk } from "./desk";
import { saveMenu } from "./save_menu";

export class MapView {
  readonly canvas = h("canvas", { tabindex: "0", role: "img" });
  private readonly picture = h("canvas"); // one pixel a start
  private readonly told = h("p", { class: "told number", "aria-live": "polite" });
  private readonly heading = h("h3", {}, "Where the balls start decides");
  private readonly words = h("p", { class: "quiet" });
  private readonly frame: HTMLElement;
  private cursor: number | null = null;
  private pointed: number | null = null; // the pixel that is told of
  private colours = new Map<string, number>();

  constructor(
    private readonly desk: Desk,
    private readonly place: HTMLElement,
  ) {
    const menu = saveMenu("Save the map", {
      "picture (PNG)": () => saveCanvas("map.png", this.enlarged()),
      "picture (SVG)": () => saveSvg("map.svg", this.drawing()),
      "pixels (CSV)": () => this.saveTable(),
    });
    const ends = () => [h("span", {}, "0°"), h("span", {}, "180°"), h("span", {}, "360°")];
    const up = h("div", { class: "up" }, ...ends());
    const across = h("div", { class: "across" }, ...ends());
    (up.children[1] as HTMLElement).textContent = "start angle of ball 2";
    (across.children[1] as HTMLElement).textContent = "start angle of ball 1, from the heavy side";
    this.frame = h("div", { class: "mapframe" }, up, this.canvas, across);
    place.append(
      h("div", { class: "row apart", style: "margin-top:.8rem" }, this.heading, menu),
      this.words,
      this.frame,
      this.told,
    );
    this.listen();
    desk.mapChanged.listen((map) => this.show(map));
    desk.start.listen(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  private get map(): MapRun | null {
    return this.desk.mapChanged.value;
  }

  private show(map: MapRun | null): void {
    this.cursor = map ? this.cursor : null;
    this.pointed = map ? this.pointed : null;
    const balls = this.desk.checked.value?.machine.balls ?? 2;
    this.place.hidden = balls < 2;
    if (!map) {
      this.words.textContent = "";
      this.told.textContent = "";
    } else {
      const others = map.others.map((angle, k) => `ball ${k + 3} at ${degrees(angle).toFixed(0)}°`).join(", ");
      const state =
        map.complete === map.side
          ? `${map.side} × ${map.side} starts`
          : `sharpening: ${map.complete || "…"} × ${map.complete || "…"}`;
      const blank = map.check.machine.contact_angle > 0 ? " Blank: balls would overlap." : "";
      this.words.textContent = `${state}${others ? `; ${others}` : ""}. Click a point to watch that start.${blank}`;
    }
    this.paint();
    this.draw();
    this.describe();
    this.tell(this.pointed);
  }

  private packed(colour: string): number {
    let value = this.colours.get(colour);
    if (value === undefined) {
      const [r, g, b] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)) as [number, number, number];
      value = (255 << 24) | (b << 16) | (g << 8) | r;
      this.colours.set(colour, value);
    }
    return value;
  }

  /** Every pixel in the colour of its outcome, or of the coarser pixel that stands for it. */
  private paint(): void {
    const map = this.map;
    const context = this.picture.getContext("2d")!;
    if (!map) return context.clearRect(0, 0, this.picture.width, this.picture.height);
    const { side } = map;
    this.picture.width = this.picture.height = side;
    const image = context.createImageData(side, side);
    const pixels = new Int32Array(image.data.buffer);
    const byCode = new Map<number, number>();
    const colourOf = (code: number) => {
      if (!byCode.has(code)) byCode.set(code, this.packed(map.outcomes.of(code).colour));
      return byCode.get(code)!;
    };
    for (let pixel = 0; pixel < side * side; ++pixel) {
      const known = map.outcome[pixel] !== NO_PIXEL ? pixel : map.standIn(pixel);
      if (known === NO_PIXEL || map.overlaps(pixel)) continue;
      const row = side - 1 - Math.floor(pixel / side); // angles grow upwards
      pixels[row * side + (pixel % side)] = colourOf(map.outcome[known]!);
    }
    context.putImageData(image, 0, 0);
  }

  private draw(): void {
    const size = Math.max(40, this.canvas.clientWidth);
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.canvas.width = this.canvas.height = Math.round(size * ratio);
    const context = this.canvas.getContext("2d")!;
    context.imageSmoothingEnabled = false;
    if (this.map) context.drawImage(this.picture, 0, 0, this.canvas.width, this.canvas.height);
    context.scale(ratio, ratio);
    const played = this.playedPixel();
    if (played !== null) this.mark(context, size, played, 6);
    if (this.cursor !== null) this.mark(context, size, this.cursor, 9);
  }

  private playedPixel(): number | null {
    const { start } = this.desk.setting;
    const run = this.desk.run;
    if (!this.map) return null;
    if ("phi" in start) return this.map.pixelAt(start.phi);
    if (this.map.check.machine.balls > 2 || !run?.isDone(start.index)) return null;
    return this.map.pixelAt([run.angles[2 * start.index]!, run.angles[2 * start.index + 1]!]);
  }

  private mark(context: CanvasRenderingContext2D, size: number, pixel: number, radius: number): void {
    const { side } = this.map!;
    const x = (size * ((pixel % side) + 0.5)) / side;
    const y = size - (size * (Math.floor(pixel / side) + 0.5)) / side;
    for (const [colour, width] of [
      ["#000000", 4],
      ["#ffffff", 2],
    ] as const) {
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.stroke();
    }
  }

  private pixelUnder(event: MouseEvent): number | null {
    if (!this.map) return null;
    const box = this.canvas.getBoundingClientRect();
    const { side } = this.map;
    const column = Math.floor((side * (event.clientX - box.left)) / box.width);
    const row = side - 1 - Math.floor((side * (event.clientY - box.top)) / box.height);
    return column < 0 || row < 0 || column >= side || row >= side ? null : row * side + column;
  }

  private tell(pixel: number | null): void {
    const map = this.map;
    this.pointed = pixel;
    if (!map || pixel === null) return this.say("");
    const [first, second] = map.angles(pixel).map((angle) => degrees(angle).toFixed(0));
    const known = map.standIn(pixel);
    const at = `Balls at ${first}° and ${second}°: `;
    if (map.overlaps(pixel)) return this.say(`${at}they would overlap`);
    if (known === NO_PIXEL) return this.say(`${at}not computed yet`);
    const outcome = map.outcomes.of(map.outcome[known]!);
    if (known !== pixel) return this.say(`${at}not computed yet, beside it ${outcome.title}`);
    const when = new Units(map.check.scales).timeText(map.time[known]!);
    this.say(`${at}${outcome.title}${outcome.code > 0 ? `, certain at ${when}` : ""}`);
  }

  private say(text: string): void {
    if (this.told.textContent !== text) this.told.textContent = text; // said aloud once only
  }

  private listen(): void {
    this.canvas.addEventListener("pointermove", (event) => this.tell(this.pixelUnder(event)));
    this.canvas.addEventListener("pointerleave", () => this.tell(null));
    this.canvas.addEventListener("click", (event) => this.playPixel(this.pixelUnder(event)));
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    this.canvas.addEventListener("blur", () => this.moveTo(null));
  }

  private playPixel(pixel: number | null): void {
    if (this.map && pixel !== null && !this.map.overlaps(pixel)) this.desk.play({ phi: this.map.angles(pixel) });
  }

  private moveTo(pixel: number | null): void {
    this.cursor = pixel;
    this.tell(pixel);
    this.draw();
  }

  private key(event: KeyboardEvent): void {
    const map = this.map;
    if (!map) return;
    const { side } = map;
    const steps: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    const step = steps[event.key];
    if (event.key === "Enter" || event.key === " ") this.playPixel(this.cursor);
    else if (step) {
      const from = this.cursor ?? this.playedPixel() ?? (side * side) / 2 + side / 2;
      const far = event.shiftKey ? 1 : side / 32;
      const column = ((from % side) + step[0] * far + side) % side;
      const row = (Math.floor(from / side) + step[1] * far + side) % side;
      this.moveTo(row * side + column);
    } else return;
    event.preventDefault();
  }

  private describe(): void {
    const map = this.map;
    const counts = new Map<number, number>();
    if (map) for (const code of map.outcome) if (code !== NO_PIXEL) counts.set(code, (counts.get(code) ?? 0) + 1);
    const parts = [...counts].map(
      ([code, n]) => `${map!.outcomes.of(code).title} ${((100 * n) / map!.done).toFixed(0)} %`,
    );
    this.canvas.setAttribute(
      "aria-label",
      `Map of outcomes over the start angles of balls 1 and 2: ${parts.join(", ") || "being computed"}. Arrow keys move, Enter plays.`,
    );
  }

  /** With whole pixels, large enough for a slide. */
  private enlarged(): HTMLCanvasElement {
    const scale = Math.ceil(1024 / (this.map?.side ?? 1024));
    const large = h("canvas", { width: this.picture.width * scale, height: this.picture.height * scale });
    const context = large.getContext("2d")!;
    context.imageSmoothingEnabled = false;
    context.drawImage(this.picture, 0, 0, large.width, large.height);
    return large;
  }

  private drawing(): SVGElement {
    const [left, size] = [54, 480];
    const word = (x: number, y: number, text: string, more = {}) =>
      s("text", { x, y, "font-size": 13, fill: "currentColor", "text-anchor": "middle", ...more }, text);
    const codes = new Set(this.map ? [...this.map.outcome] : []);
    const known = (this.map?.outcomes.list ?? []).filter(({ code }) => codes.has(code));
    const legend = known.flatMap((outcome, k) => [
      s("rect", { x: left, y: size + 66 + 20 * k, width: 12, height: 12, fill: outcome.colour }),
      word(left + 20, size + 77 + 20 * k, outcome.title, { "text-anchor": "start" }),
    ]);
    const image = s("image", {
      href: this.picture.toDataURL(),
      x: left,
      y: 16,
      width: size,
      height: size,
      style: "image-rendering:pixelated",
    });
    const ends = ["0°", "180°", "360°"].flatMap((text, k) => [
      word(left + (k * size) / 2, size + 34, text),
      word(left - 8, 20 + size - (k * size) / 2, text, { "text-anchor": "end" }),
    ]);
    const middle = 16 + size / 2 - 60;
    const axes = [
      word(left + size / 2, size + 52, "start angle of ball 1"),
      word(14, middle, "start angle of ball 2", { transform: `rotate(-90 14 ${middle})` }),
    ];
    const box = `0 0 ${left + size + 24} ${size + 76 + 20 * known.length}`;
    return s("svg", { viewBox: box }, image, ...ends, ...axes, ...legend);
  }

  private saveTable(): void {
    const map = this.map;
    if (!map) return;
    const rows: (string | number)[][] = [];
    map.outcome.forEach((code, pixel) => {
      if (code !== NO_PIXEL) rows.push([...map.angles(pixel), code, map.outcomes.of(code).name, map.time[pixel]!]);
    });
    const angles = Array.from({ length: map.check.machine.balls }, (_, k) => `phi_${k + 1}`);
    saveText("map.csv", csv([...angles, "code", "outcome", "time"], rows), "text/csv");
  }
}
