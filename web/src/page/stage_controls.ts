// Buttons and words under the machine.
import type { PlayStart, StudyCheck } from "../engine/protocol";
import { h, swatch } from "../base/dom";
import { degrees, digits, radians, Units } from "../base/numbers";
import { saveMenu } from "./save_menu";
import { saveCanvas, saveText, csv } from "../base/save";
import type { Moment } from "../work/player";
import { isAborted } from "../work/pool";
import type { Frame } from "../drawing/machine";
import { URGENCY } from "../work/urgency";
import type { Desk } from "./desk";
import type { Stage } from "./stage";

const PACE_RANGE = 30; // how much slower or faster than the pace proposed
const MAGNIFICATIONS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

export class StageControls {
  readonly element: HTMLElement;
  private readonly playButton = h("button", {
    type: "button",
    class: "main",
    click: () => this.stage.play(!this.stage.playing),
  });
  private readonly stepButton = h("button", { type: "button", click: () => this.stage.step() }, "Step");
  private readonly againButton = h("button", { type: "button", click: () => this.stage.again() });
  private readonly releaseButton = h(
    "button",
    { type: "button", click: () => void this.stage.release() },
    "Let the balls go",
  );
  private readonly otherButton = h("button", { type: "button", click: () => this.other() }, "Other start");
  private readonly paceSlider = h("input", {
    type: "range",
    min: -1,
    max: 1,
    step: 0.01,
    value: 0,
    "aria-label": "Pace",
  });
  private readonly paceText = h("span", { class: "number" });
  private readonly views: Record<Frame, HTMLButtonElement>;
  private readonly magnifySelect = h("select", { "aria-label": "How much larger than life displacements are drawn" });
  private readonly readout = h("div", { class: "readout number" });
  private readonly fateLine = h("p", { class: "fate", "aria-live": "polite" });
  readonly angles = h("div", { class: "angles" });
  private basePace = 1;
  private check: StudyCheck | null = null;
  private fates = new AbortController();

  constructor(
    private readonly desk: Desk,
    private readonly stage: Stage,
  ) {
    const view = (frame: Frame, words: string) =>
      h("button", { type: "button", "aria-pressed": "false", click: () => this.stage.look(frame) }, words);
    this.views = { rotor: view("rotor", "with the rotor"), room: view("room", "from the room") };
    for (const m of MAGNIFICATIONS) this.magnifySelect.append(h("option", { value: m }, `× ${m}`));
    this.magnifySelect.addEventListener("change", () => this.stage.setMagnification(Number(this.magnifySelect.value)));
    this.paceSlider.addEventListener("input", () =>
      this.stage.setPace(this.basePace * PACE_RANGE ** Number(this.paceSlider.value)),
    );
    const segments = h(
      "span",
      { class: "segments", role: "group", "aria-label": "Seen turning with the rotor, or standing in the room" },
      this.views.rotor,
      this.views.room,
    );
    const buttons = [this.playButton, this.stepButton, this.againButton, this.releaseButton, this.otherButton];
    const pace = h("label", { class: "pace" }, "Pace", this.paceSlider, this.paceText);
    const enlarged = h("label", { class: "quiet" }, "whirl drawn ", this.magnifySelect);
    this.element = h(
      "div",
      { class: "under" },
      this.readout,
      this.fateLine,
      h("div", { class: "row" }, ...buttons, pace),
      h("div", { class: "row apart" }, segments, enlarged, this.saves()),
    );
    this.refresh();
  }

  take(check: StudyCheck): void {
    this.check = check;
    this.basePace = this.stage.pace;
    this.paceSlider.value = "0";
    this.refresh();
  }

  refresh(): void {
    this.playButton.textContent = this.stage.playing ? "Pause" : "Play";
    const spunUp = this.check?.machine.spun_up;
    this.againButton.textContent = spunUp === 0 ? "Again" : "Spin up again";
    this.releaseButton.hidden = this.check?.machine.release_time === 0;
    for (const [frame, button] of Object.entries(this.views))
      button.setAttribute("aria-pressed", String(this.stage.looksFrom === frame));
    this.magnifySelect.value = String(this.stage.magnification);
    this.paceText.textContent = this.paceWords();
  }

  private paceWords(): string {
    const scales = this.check?.scales;
    if (!scales) return `${digits(this.stage.pace, 2)}/ωc a second`;
    const ratio = this.stage.pace * scales.time;
    return ratio < 0.95
      ? `${digits(1 / ratio, 2)} × slower`
      : ratio > 1.05
        ? `${digits(ratio, 2)} × faster`
        : "as in life";
  }

  /** The run begins with the balls at these angles. */
  begin(phi: readonly number[]): void {
    if (this.angles.querySelectorAll("input").length !== phi.length) {
      const field = (_: number, k: number) =>
        h(
          "label",
          {},
          `ball ${k + 1} `,
          h("input", {
            inputmode: "decimal",
            "aria-label": `Start angle of ball ${k + 1} in degrees`,
            change: () => this.typed(),
          }),
          "°",
        );
      this.angles.replaceChildren(
        h("span", { class: "quiet" }, "Drag a ball to where it starts, or type:"),
        ...phi.map(field),
      );
    }
    this.angles.querySelectorAll("input").forEach((input, k) => (input.value = degrees(phi[k]!).toFixed(1)));
    this.magnifySelect.value = String(this.stage.magnification);
  }

  private typed(): void {
    const values = [...this.angles.querySelectorAll("input")].map((input) => Number(input.value.replace(",", ".")));
    if (values.every(Number.isFinite)) this.desk.play({ phi: values.map(radians) });
  }

  private other(): void {
    const { start } = this.desk.setting;
    this.desk.play({ index: "index" in start ? start.index + 1 : 0 });
  }

  tell(moment: Moment | null): void {
    const u: Units = this.stage.shownUnits;
    this.releaseButton.disabled = !moment?.held;
    this.stepButton.disabled = moment === null;
    if (!moment)
      return void this.readout.replaceChildren(h("span", { class: "quiet" }, "a motion that goes on for ever"));
    const item = (words: string, text: string) => h("span", {}, `${words} `, h("b", {}, text));
    this.readout.replaceChildren(
      item("time", u.timeText(moment.t)),
      item("speed", u.speedText(moment.speed)),
      item("whirl", u.lengthText(moment.radial)),
      moment.held ? h("b", {}, "balls held") : "",
    );
  }

  /** What is shown ends so, or is this; a start's fate that is still being computed is no longer told. */
  fate(words: string, colour: string | null): void {
    this.fates.abort();
    this.say(words, colour);
  }

  private say(words: string, colour: string | null): void {
    this.fateLine.replaceChildren(...(colour ? [swatch(colour)] : []), words);
  }

  /** What this start comes to, by the same decision as all others. */
  async tellFate(start: PlayStart, check: StudyCheck): Promise<void> {
    this.fates.abort();
    this.fates = new AbortController();
    const which = "index" in start ? `Start ${start.index}` : "This start";
    if (!check.decidable) return this.say("", null);
    this.say(`${which}: where it will end is being computed…`, null);
    const { signal } = this.fates;
    try {
      const options = { urgency: URGENCY.fate, signal, gentle: true };
      const fates =
        "index" in start
          ? await this.desk.crew.compute("ensemble", [check.toml, start.index, 1], options)
          : await this.desk.crew.compute("states", [check.toml, Float64Array.from(start.phi)], options);
      if (signal.aborted) return;
      const outcome = fates.outcomes.find(({ code }) => code === fates.outcome[0]);
      if (!outcome) return this.say(`${which} stays undecided.`, null);
      const when = this.stage.shownUnits.timeText(fates.time[0]!);
      this.say(
        `${which} ends ${outcome.code > 0 ? "in " : ""}“${outcome.title}”, certain at ${when}.`,
        outcome.colour,
      );
    } catch (error) {
      if (!isAborted(error) && !signal.aborted) this.say((error as Error).message, null);
    }
  }

  private saves(): HTMLElement {
    return saveMenu("Save the machine or its run", {
      "picture (PNG)": () => saveCanvas("machine.png", this.stage.canvas),
      "run (CSV)": () => saveText("run.csv", csv(this.stage.strips.header(), this.stage.strips.rows()), "text/csv"),
    });
  }
}
