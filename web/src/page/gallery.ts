// What it can end in: every motion as a small moving picture, with how it shakes and how stable it is.
import type { AttractorInfo, OutcomeShare } from "../engine/protocol";
import { darkScheme, h, reducedMotion, sharpContext, swatch } from "../base/dom";
import { digits, percent, Units } from "../base/numbers";
import { ink } from "../drawing/ink";
import { drawMachine, goodMagnification, type Pose } from "../drawing/machine";
import { posesOf } from "../drawing/path";
import { saveMenu } from "./save_menu";
import { csv, saveText } from "../base/save";
import type { Desk } from "./desk";
import type { Stage } from "./stage";

const SIZE = 104;
const LOOP = 5; // seconds for one round of a small picture
const FRAME = 50; // ms: small pictures need no more, and the large one keeps its 60 a second

interface Card {
  info: AttractorInfo;
  element: HTMLElement;
  canvas: HTMLCanvasElement;
  share: HTMLElement;
  poses: Pose[];
  visible: boolean;
}

export class Gallery {
  private cards: Card[] = [];
  private last = 0;
  private readonly seen = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const card = this.cards.find(({ canvas }) => canvas === target);
      if (card) card.visible = isIntersecting;
    }
  });

  constructor(
    private readonly desk: Desk,
    private readonly stage: Stage,
    private readonly place: HTMLElement,
  ) {
    desk.discovery.listen((found) => this.show(found?.attractors ?? null));
    desk.shares.listen((shares) => this.fill(shares));
    desk.start.listen(() => this.press(null));
    const menu = saveMenu("Save the motions", { "table (CSV)": () => this.save() });
    document.getElementById("motions-title")!.after(menu);
    darkScheme.addEventListener("change", () => this.draw(0));
    requestAnimationFrame((now) => this.tick(now));
  }

  private show(attractors: readonly AttractorInfo[] | null): void {
    this.seen.disconnect();
    this.cards = [];
    if (!attractors) {
      const words = this.desk.checked.value?.decidable === false ? "" : "Looking for every motion…";
      return this.place.replaceChildren(h("p", { class: "quiet" }, words));
    }
    const units = new Units(this.desk.checked.value?.scales ?? null);
    this.cards = attractors.map((info) => this.card(info, units));
    this.place.replaceChildren(...this.cards.map(({ element }) => element));
    for (const { canvas } of this.cards) this.seen.observe(canvas);
    this.draw(0);
  }

  private card(info: AttractorInfo, units: Units): Card {
    const canvas = h("canvas", { "aria-hidden": "true" });
    const share = h("span", { class: "number" });
    const { min, max } = info.radial;
    const whirl =
      max < 1e-6
        ? "no whirl"
        : max - min < 0.005 * max
          ? `whirl ${units.lengthText(max)}`
          : `whirl ${digits(min * units.length.factor)} to ${units.lengthText(max)}`;
    const figures = h(
      "span",
      { class: "figures" },
      h("span", {}, whirl),
      h("span", { class: "quiet" }, info.stability),
      share,
    );
    const name = h("b", {}, swatch(info.colour), info.title);
    const words = h("span", {}, name, figures);
    const click = () => {
      this.stage.showMotion(info);
      this.press(info);
      document.getElementById("machine")!.scrollIntoView({ block: "nearest" });
    };
    const element = h("div", { class: "motioncell" });
    const button = h("button", { type: "button", class: "motion", "aria-pressed": "false", click }, canvas, words);
    const start = h(
      "button",
      { type: "button", class: "text", click: () => this.playStart(info) },
      "watch a start that ends here",
    );
    element.append(button, start);
    return { info, element, canvas, share, poses: posesOf(info.path), visible: false };
  }

  private press(info: AttractorInfo | null): void {
    for (const card of this.cards)
      card.element.querySelector("button")!.setAttribute("aria-pressed", String(card.info === info));
  }

  private playStart(info: AttractorInfo): void {
    const start = this.desk.run?.startOf(info.code) ?? null;
    if (start !== null) this.desk.play({ index: start });
    document.getElementById("machine")!.scrollIntoView({ block: "nearest" });
  }

  private fill(shares: readonly OutcomeShare[]): void {
    for (const card of this.cards) {
      const share = shares.find(({ code }) => code === card.info.code);
      card.share.textContent = share ? `${percent(share.share, share)} of starts` : "";
      const button = card.element.querySelector<HTMLButtonElement>("button.text")!;
      button.disabled = !share || share.count === 0;
    }
  }

  private tick(now: number): void {
    requestAnimationFrame((next) => this.tick(next));
    if (reducedMotion.matches || now - this.last < FRAME) return;
    this.last = now;
    this.draw(now / 1000);
  }

  private draw(seconds: number): void {
    const machine = this.desk.checked.value?.machine;
    if (!machine) return;
    const largest = Math.max(...this.cards.map(({ info }) => info.radial.max), 1e-9);
    for (const card of this.cards) {
      if (!card.visible && seconds > 0) continue;
      const count = card.poses.length;
      const pose = card.poses[Math.floor(((seconds / LOOP) % 1) * count)];
      if (!pose) continue;
      const scene = {
        machine,
        frame: "rotor",
        magnify: goodMagnification(largest),
        limit: null,
        ink: ink(),
        small: true,
      } as const;
      drawMachine(sharpContext(card.canvas, SIZE, SIZE), SIZE, scene, pose, card.poses);
    }
  }

  private save(): void {
    const rows = this.cards.map(({ info }) => [
      info.id,
      info.name,
      info.alias,
      info.kind,
      String(info.stable),
      info.radial.min,
      info.radial.mean,
      info.radial.max,
      info.period ?? "",
      info.stability,
    ]);
    const header = [
      "id",
      "name",
      "alias",
      "kind",
      "stable",
      "radial_min",
      "radial_mean",
      "radial_max",
      "period",
      "stability",
    ];
    saveText("motions.csv", csv(header, rows), "text/csv");
  }
}
