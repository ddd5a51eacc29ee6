// The machine, live: what is shown, how fast, and who moves it.
import type { AttractorInfo, PlayStart, StudyCheck } from "../engine/protocol";
import { darkScheme, h, reducedMotion, sharpContext } from "../base/dom";
import { degrees, Units } from "../base/numbers";
import { ink } from "../drawing/ink";
import { angleAt, ballAt, drawMachine, goodMagnification, type Frame, type Pose, type Scene } from "../drawing/machine";
import { poseAt } from "../drawing/path";
import type { Moment } from "../work/player";
import { Player } from "../work/player";
import type { Desk } from "./desk";
import { StageControls } from "./stage_controls";
import { Strips } from "./strips";

const WAY_SHOWN = 4; // seconds for which the way of the centre stays in sight
const MOST_WAY = 900;
const SHOW_TIME = 30; // seconds for what is worth watching, unless the visitor wants it slower or faster
const [BARE_PIECES, BARE_LOOKS] = [40, 30]; // of the run without balls
const EASY_TURN = 0.45; // rad a picture: beyond, an eye in the room no longer follows the rotor

export class Stage {
  readonly canvas = h("canvas", { role: "img", "aria-label": "The machine seen along its axis" });
  readonly player: Player;
  readonly strips: Strips;
  private readonly controls: StageControls;
  private frame: Frame = "rotor";
  private magnify = 1;
  private autoMagnify = true;
  private check: StudyCheck | null = null;
  private units = new Units(null);
  private first: Moment | null = null;
  private way: Pose[] = [];
  private dragged: { ball: number; phi: number[]; wasPlaying: boolean } | null = null;
  /** A motion of the gallery, looped, instead of a run. */
  private motion: { info: AttractorInfo; time: number } | null = null;
  private last = 0;
  private lastTold = 0;
  private bare = 0; // the run without balls that is followed now

  constructor(
    private readonly desk: Desk,
    place: HTMLElement,
    stripsPlace: HTMLElement,
  ) {
    this.player = new Player(desk.crew, (error) => desk.fail(error));
    this.strips = new Strips(stripsPlace);
    this.controls = new StageControls(desk, this);
    place.append(this.canvas, this.controls.element);
    stripsPlace.after(this.controls.angles);
    this.listen();
    desk.checked.listen((check) => check && this.take(check));
    desk.start.listen((start) => this.check && void this.playStart(start));
    desk.discovery.listen((found) => found && this.fitTo(found.attractors));
    darkScheme.addEventListener("change", () => this.draw());
    requestAnimationFrame((now) => this.tick(now));
  }

  get shown(): Moment | null {
    return this.player.moment;
  }

  get playing(): boolean {
    return this.player.playing;
  }

  play(playing: boolean): void {
    this.player.playing = playing;
    this.controls.refresh();
  }

  step(): void {
    this.play(false);
    if (this.motion) {
      this.motion = null;
      void this.controls.tellFate(this.desk.setting.start, this.check!);
    }
    this.keep(this.player.step());
    this.draw();
    this.tell();
  }

  again(): void {
    void this.playStart(this.desk.setting.start);
  }

  look(frame: Frame): void {
    this.frame = frame;
    this.way = this.way.slice(-1);
    this.draw();
    this.controls.refresh();
  }

  get looksFrom(): Frame {
    return this.frame;
  }

  get pace(): number {
    return this.player.pace;
  }

  setPace(pace: number): void {
    this.player.pace = pace;
    this.controls.refresh();
  }

  get magnification(): number {
    return this.magnify;
  }

  setMagnification(magnify: number): void {
    this.magnify = magnify;
    this.autoMagnify = false;
    this.draw();
  }

  get shownUnits(): Units {
    return this.units;
  }

  get motionShown(): AttractorInfo | null {
    return this.motion?.info ?? null;
  }

  /** The same run, but its balls are let go now. */
  async release(): Promise<void> {
    const now = this.shown;
    if (!now || !this.check || !now.held) return;
    const scales = this.check.scales;
    const time = this.check.physical && scales ? `"${now.t * scales.time} s"` : String(now.t);
    try {
      const check = await this.desk.checkWith([...this.desk.setting.overrides, ["release", `{ time = ${time} }`]]);
      await this.player.open(check, this.desk.setting.start, now.t);
    } catch (error) {
      this.desk.fail(error as Error);
    }
  }

  /** Shows one of the motions in which starts end, round and round. */
  showMotion(info: AttractorInfo): void {
    this.motion = { info, time: 0 };
    this.way = [];
    if (!reducedMotion.matches) this.play(true);
    this.controls.fate(`This is the motion itself, over and over: ${info.title}.`, info.colour);
    this.draw();
  }

  private take(check: StudyCheck): void {
    this.check = check;
    this.units = new Units(check.scales);
    this.autoMagnify = true;
    const speed = Math.max(1, Math.abs(check.machine.final_speed ?? 1));
    this.player.pace = Math.max(0.2, check.machine.watch_until / SHOW_TIME);
    this.frame = (speed * this.player.pace) / 60 < EASY_TURN / 2 ? this.frame : "rotor";
    const limits = [check.machine.limits.displacement ?? 0, check.machine.eccentricity * 10];
    this.magnify = goodMagnification(Math.max(...limits));
    this.controls.take(check);
    void this.playStart(this.desk.setting.start);
  }

  private async playStart(start: PlayStart): Promise<void> {
    const check = this.check!;
    const [wasShown, wanted] = [this.first !== null, this.player.playing];
    this.motion = null;
    this.way = [];
    await this.player.open(check, start);
    this.first = this.shown;
    if (!this.first) return;
    this.strips.begin(check.machine.balls, check.machine.watch_until, this.units);
    this.keep([this.first]);
    void this.followBare(check, start);
    this.play(wasShown ? wanted || !reducedMotion.matches : !reducedMotion.matches);
    this.controls.begin(this.first.phi);
    if (!this.motion) void this.controls.tellFate(start, check); // a motion may have been asked for meanwhile
    this.draw();
    this.tell();
  }

  /** The same run without balls, beside it: in pieces, so that the worker still plays. */
  private async followBare(check: StudyCheck, start: PlayStart): Promise<void> {
    const until = check.machine.watch_until;
    const mine = ++this.bare;
    const row = (rows: Float64Array, width: number, at: number, k: number) => rows[k * width + at]!;
    try {
      const { handle, columns } = await this.desk.crew.ask("play_open", check.toml, { ...start, bare: true });
      const at = columns.indexOf("radial");
      for (let piece = 0; piece < BARE_PIECES && mine === this.bare; ++piece) {
        const step = until / (BARE_PIECES * BARE_LOOKS);
        const times = Float64Array.from({ length: BARE_LOOKS }, (_, k) => (piece * BARE_LOOKS + k + 1) * step);
        const { row: rows, status } = await this.desk.crew.ask("play_rows", handle, times);
        if (mine !== this.bare || status !== "done") break;
        this.strips.addBare([...times], [...times].map((_, k) => row(rows, columns.length, at, k)));
      }
      await this.desk.crew.ask("play_close", handle);
    } catch (error) {
      if (mine === this.bare) this.desk.fail(error as Error);
    }
  }

  private fitTo(attractors: readonly AttractorInfo[]): void {
    const largest = Math.max(
      ...attractors.map(({ radial }) => radial.max),
      this.check?.machine.limits.displacement ?? 0,
    );
    if (this.autoMagnify && largest > 0) this.magnify = goodMagnification(largest);
    this.draw();
    this.controls.refresh();
  }

  private tick(now: number): void {
    requestAnimationFrame((next) => this.tick(next));
    const seconds = Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    if (!this.player.playing || this.dragged) return;
    if (this.motion) this.motion.time += seconds * this.player.pace;
    else this.keep(this.player.advance(seconds));
    this.draw();
    if (now - this.lastTold > 100) {
      this.lastTold = now;
      this.tell();
    }
  }

  private keep(passed: readonly Moment[]): void {
    this.strips.add(passed);
    const most = Math.min(MOST_WAY, Math.ceil(WAY_SHOWN * 60 * 8));
    const since = (this.shown?.t ?? 0) - WAY_SHOWN * this.player.pace;
    for (const moment of passed) if (moment.t >= since) this.way.push(this.fromRest(moment));
    if (this.way.length > most) this.way.splice(0, this.way.length - most);
  }

  /** The pose with the place where the rotor rests, under its weight, in the middle. */
  private fromRest(moment: Moment): Pose {
    const sag = this.check?.machine.sag ?? 0;
    const [c, s] = [Math.cos(moment.psi), Math.sin(moment.psi)];
    return { psi: moment.psi, x: moment.x - sag * s, y: moment.y - sag * c, phi: moment.phi };
  }

  private scene(): Scene {
    const machine = this.check!.machine;
    const limit = machine.limits.displacement ?? machine.limits.settled;
    return { machine, frame: this.frame, magnify: this.magnify, limit, ink: ink() };
  }

  private pose(): Pose | null {
    if (this.motion) return poseAt(this.motion.info.path, this.motion.time);
    const shown = this.dragged ? this.first : this.shown;
    if (!shown) return null;
    return this.fromRest(this.dragged ? { ...shown, phi: this.dragged.phi } : shown);
  }

  private get size(): number {
    return this.canvas.clientWidth || 400;
  }

  draw(): void {
    const pose = this.check ? this.pose() : null;
    if (!pose) return;
    const context = sharpContext(this.canvas, this.size, this.size);
    if (this.motion) {
      this.way.push(pose);
      if (this.way.length > WAY_SHOWN * 60) this.way.shift();
    }
    drawMachine(
      context,
      this.size,
      this.scene(),
      pose,
      this.dragged ? [] : this.motion ? this.way : [...this.way, pose],
    );
  }

  private tell(): void {
    const { shown, units } = this;
    if (!shown) return;
    this.controls.tell(this.motion ? null : shown);
    const balls = shown.phi.map((angle, k) => `ball ${k + 1} at ${degrees(angle).toFixed(0)}°`).join(", ");
    const words = this.motion
      ? `the motion “${this.motion.info.title}”`
      : `time ${units.timeText(shown.t)}, whirl ${units.lengthText(shown.radial)}, ${balls} from the heavy side`;
    this.canvas.setAttribute("aria-label", `The machine seen along its axis: ${words}`);
  }

  private at(event: { clientX: number; clientY: number }): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private ballUnder(event: { clientX: number; clientY: number }): number {
    const pose = this.check && !this.motion ? this.pose() : null;
    return pose ? ballAt(...this.at(event), this.size, this.scene(), pose) : -1;
  }

  private listen(): void {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => {
      const ball = this.ballUnder(event);
      if (ball < 0 || !this.first || !this.shown) return;
      canvas.setPointerCapture(event.pointerId);
      this.dragged = { ball, phi: [...this.first.phi], wasPlaying: this.playing };
      this.drag(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (this.dragged) this.drag(event);
      else canvas.classList.toggle("holds", event.pointerType === "mouse" && this.ballUnder(event) >= 0);
    });
    const drop = () => {
      const phi = this.dragged?.phi;
      this.dragged = null;
      if (phi) this.desk.play({ phi });
    };
    canvas.addEventListener("pointerup", drop);
    canvas.addEventListener("pointercancel", drop);
    // A finger on a ball moves the ball, elsewhere the page.
    const hold = (event: TouchEvent) =>
      event.touches.length === 1 && this.ballUnder(event.touches[0]!) >= 0 && event.preventDefault();
    canvas.addEventListener("touchstart", hold, { passive: false });
  }

  private drag(event: PointerEvent): void {
    const { ball, phi } = this.dragged!;
    phi[ball] = angleAt(...this.at(event), this.size, this.first!, this.frame);
    this.controls.begin(phi.map((angle) => (degrees(angle) * Math.PI) / 180));
    this.draw();
  }
}
