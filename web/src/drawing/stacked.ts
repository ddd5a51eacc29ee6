// Stacked shares along a parameter, balanced below, with its interval.
import type { OutcomeInfo } from "../engine/protocol";
import { s } from "../base/dom";
import { digits, percent } from "../base/numbers";
import type { Cell } from "../work/sweep_run";

const [WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM] = [760, 320, 46, 12, 10, 46];
const BALANCED = 1;

/** Outcomes that any cell came to, in the order in which they are stacked: by name, since motions without a number of
    their own are counted anew in every cell. */
export function layersOf(cells: readonly Cell[]): OutcomeInfo[] {
  const layers = new Map<string, OutcomeInfo>();
  for (const cell of cells)
    for (const share of cell.shares ?? []) {
      const outcome = cell.outcomes.find(({ code }) => code === share.code);
      if (outcome && (share.count > 0 || share.code === BALANCED)) {
        const name = outcome.title;
        if (!layers.has(name)) layers.set(name, outcome);
      }
    }
  const rank = (code: number) => (code > 0 ? code : 1_000_000 - code);
  return [...layers.values()].sort((a, b) => rank(a.code) - rank(b.code));
}

function shareOf(cell: Cell, layer: OutcomeInfo): number {
  const own = cell.outcomes.find((outcome) => outcome.title === layer.title);
  return cell.shares?.find(({ code }) => code === own?.code)?.share ?? 0;
}

function text(x: number, y: number, words: string, more: Record<string, string | number> = {}): SVGElement {
  return s("text", { x, y, "font-size": 12, fill: "currentColor", "text-anchor": "middle", ...more }, words);
}

function axes(label: string): SVGElement[] {
  const parts: SVGElement[] = [];
  for (const share of [0, 0.25, 0.5, 0.75, 1]) {
    const y = TOP + (1 - share) * (HEIGHT - TOP - BOTTOM);
    parts.push(
      s("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: y, y2: y, stroke: "currentColor", "stroke-opacity": 0.15 }),
    );
    parts.push(text(LEFT - 8, y + 4, `${100 * share} %`, { "text-anchor": "end" }));
  }
  parts.push(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 8, label));
  return parts;
}

function bar(
  cell: Cell,
  x: number,
  width: number,
  layers: readonly OutcomeInfo[],
  chosen: (cell: Cell) => void,
): SVGElement {
  const tall = HEIGHT - TOP - BOTTOM;
  const words = layers.map((layer) => `${layer.title} ${percent(shareOf(cell, layer))}`).join(", ");
  const hint = cell.problem || `${cell.text}: ${cell.shares ? words : "being computed"}`;
  const group = s(
    "g",
    { role: "button", tabindex: 0, "aria-label": hint, style: "cursor:pointer" },
    s("title", {}, hint),
  );
  group.addEventListener("click", () => chosen(cell));
  group.addEventListener("keydown", (event) => (event as KeyboardEvent).key === "Enter" && chosen(cell));
  group.append(
    s("rect", { x, y: TOP, width, height: tall, fill: "currentColor", "fill-opacity": cell.problem ? 0.02 : 0.06 }),
  );
  let sum = 0;
  for (const layer of layers) {
    const share = shareOf(cell, layer);
    if (share > 0)
      group.append(
        s("rect", { x, y: TOP + (1 - sum - share) * tall, width, height: share * tall, fill: layer.colour }),
      );
    sum += share;
  }
  const balanced = cell.shares?.find(({ code }) => code === BALANCED);
  if (balanced) {
    const [middle, y] = [x + width / 2, (share: number) => TOP + (1 - share) * tall];
    const line = (x1: number, x2: number, y1: number, y2: number) =>
      s("line", { x1, x2, y1, y2, stroke: "#1b1f24", "stroke-width": 1.5 });
    group.append(line(middle, middle, y(balanced.low), y(balanced.high)));
    for (const share of [balanced.low, balanced.high]) group.append(line(middle - 4, middle + 4, y(share), y(share)));
  }
  return group;
}

export function stackedShares(cells: readonly Cell[], label: string, chosen: (cell: Cell) => void): SVGElement {
  const layers = layersOf(cells);
  const step = (WIDTH - LEFT - RIGHT) / cells.length;
  const every = Math.ceil(cells.length / Math.floor((WIDTH - LEFT - RIGHT) / 58));
  const bars = cells.map((cell, k) => bar(cell, LEFT + (k + 0.1) * step, 0.8 * step, layers, chosen));
  const ticks = cells.map((cell, k) =>
    k % every === 0 ? text(LEFT + (k + 0.5) * step, HEIGHT - BOTTOM + 17, digits(cell.value)) : null,
  );
  const attributes = {
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    role: "group",
    "aria-label": `Shares of outcomes along ${label}`,
  };
  return s("svg", attributes, ...axes(label), ...bars, ...ticks);
}
