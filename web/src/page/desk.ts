// What is asked now, the work that follows from it, and who wants to hear of either.
import {
  EngineError,
  type Discovery,
  type OutcomeShare,
  type Override,
  type PlayStart,
  type Preset,
  type Problem,
  type Progress,
  type StudyCheck,
  type Told,
} from "../engine/protocol";
import { settled } from "../base/dom";
import { Topic } from "../base/topic";
import { fromHash, sameOverrides, toHash, withOverride, type Setting, type SweepSetting } from "../setting/setting";
import type { Crew } from "../work/crew";
import { DecisionRun } from "../work/decision_run";
import { EnsembleRun } from "../work/ensemble_run";
import { MapRun } from "../work/map_run";
import { isAborted } from "../work/pool";
import { preparedStarts } from "../work/prepared";
import { URGENCY } from "../work/urgency";

const FIRST_STARTS = 500; // shares are worth showing from here on, before the map takes its half of the workers
const STARTS = 10_000; // +- 1 point
const WATCHED_STARTS = 300; // of a study without units, whose figures are gathered too: that takes three times as long
const MOST_STARTS = 100_000; // +- 0.3 points: who wants more has the program, whose command stands below
const MAP_SIDE = window.matchMedia("(max-width: 600px)").matches ? 128 : 256;
const TURN = 2 * Math.PI;

export class Desk {
  readonly checked = new Topic<StudyCheck | null>(null);
  readonly problem = new Topic<Problem | null>(null);
  readonly discovery = new Topic<Discovery | null>(null);
  readonly finding = new Topic<Progress | null>(null);
  readonly shares = new Topic<OutcomeShare[]>([]);
  /** What the starts come to for those who decide. */
  readonly decision = new Topic<DecisionRun | null>(null);
  readonly mapChanged = new Topic<MapRun | null>(null);
  readonly start = new Topic<PlayStart>({ index: 0 });
  readonly pinned = new Topic<Override[] | null>(null);
  readonly sweep = new Topic<SweepSetting | null>(null);
  /** Work that could not be done: the page shows it and goes on. */
  readonly trouble = new Topic<string>("");

  run: EnsembleRun | null = null;
  setting: Setting;
  private stopper = new AbortController();
  private asked = 0;
  private goesOn = false; // past the first starts
  private watched: Told | null = null; // figures of the first starts, where not all are gathered
  private readonly writeAddress = settled(150, () => void this.keepAddress());

  constructor(
    readonly crew: Crew,
    readonly presets: readonly Preset[],
    first: Setting,
  ) {
    this.setting = first;
    window.addEventListener("hashchange", () => void this.followAddress());
  }

  get source(): string {
    const { source } = this.setting;
    return "toml" in source ? source.toml : (this.presets.find(({ name }) => name === source.preset)?.toml ?? "");
  }

  /** Another study, another start: everything from the beginning. */
  async take(setting: Setting): Promise<void> {
    this.setting = setting;
    this.start.set(setting.start);
    this.pinned.set(setting.pinned);
    this.sweep.set(setting.sweep);
    await this.ask();
  }

  async open(source: Setting["source"]): Promise<void> {
    await this.take({ source, overrides: [], start: { index: 0 }, pinned: null, sweep: null });
  }

  async override(key: string, value: string): Promise<void> {
    this.setting = { ...this.setting, overrides: withOverride(this.setting.overrides, key, value) };
    await this.ask();
  }

  async dropOverrides(): Promise<void> {
    this.setting = { ...this.setting, overrides: [] };
    await this.ask();
  }

  play(start: PlayStart): void {
    this.setting = { ...this.setting, start };
    this.start.set(start);
    this.writeAddress();
  }

  pin(overrides: Override[] | null): void {
    this.setting = { ...this.setting, pinned: overrides };
    this.pinned.set(overrides);
    this.writeAddress();
  }

  setSweep(sweep: SweepSetting): void {
    this.setting = { ...this.setting, sweep };
    this.sweep.set(sweep);
    this.writeAddress();
  }

  /** Computes so many starts more. */
  more(starts: number): void {
    this.run?.extend(this.run.wanted + starts);
  }

  /** The study that is asked with these overrides instead of its own. */
  checkWith(overrides: readonly Override[]): Promise<StudyCheck> {
    return this.crew.ask("check", this.source, overrides);
  }

  private async ask(): Promise<void> {
    const number = ++this.asked;
    try {
      const check = await this.checkWith(this.setting.overrides);
      if (number !== this.asked) return;
      this.problem.set(check.decidable ? null : check.problem);
      this.writeAddress();
      if (this.checked.value?.toml === check.toml) return;
      this.checked.set(check);
      this.begin(check);
    } catch (error) {
      if (number !== this.asked) return;
      if (error instanceof EngineError) this.problem.set(error.problem);
      else throw error;
    }
  }

  private begin(check: StudyCheck): void {
    this.stopper.abort();
    this.stopper = new AbortController();
    this.run?.stop();
    this.mapChanged.value?.stop();
    this.run = null;
    this.decision.set(null); // first: it tells of the run
    this.goesOn = false;
    this.shares.set([]);
    this.discovery.set(null);
    this.finding.set(null);
    this.mapChanged.set(null);
    this.watched = null;
    if (check.decidable) void this.compute(check, this.stopper.signal);
  }

  private async compute(check: StudyCheck, signal: AbortSignal): Promise<void> {
    try {
      const progress = (at: Progress) => signal.aborted || this.finding.set(at);
      const found = await this.crew.compute("discover", [check.toml], { urgency: URGENCY.discovery, signal, progress });
      this.finding.set(null);
      this.discovery.set(found);
      // As the program does: of a machine, every start's figures.
      const changed = () => void this.count(check);
      this.run = new EnsembleRun(this.crew, check, MOST_STARTS, URGENCY.starts, check.physical, changed);
      this.run.outcomes.adopt(found.outcomes, new Int32Array(0));
      const prepared = preparedStarts(check.toml);
      if (prepared) this.run.beginWith(prepared);
      this.run.extend(Math.min(FIRST_STARTS, check.starts));
      this.decide(check, signal);
    } catch (error) {
      if (!isAborted(error)) this.fail(error as Error);
    }
  }

  private decide(check: StudyCheck, signal: AbortSignal): void {
    const run = this.run!;
    const starts = () => ({
      count: run.gathers ? run.prefix : (this.watched?.outcome.length ?? 0),
      over: run.done >= run.wanted,
      told: () => (run.gathers ? run.told(run.prefix) : this.watched!),
    });
    const decision = new DecisionRun(
      this.crew,
      check,
      signal,
      starts,
      () => this.decision.value === decision && this.decision.set(decision),
      (error) => this.fail(error),
    );
    this.decision.set(decision);
    void decision.follow();
  }

  private async watch(check: StudyCheck, signal: AbortSignal): Promise<void> {
    const count = Math.min(WATCHED_STARTS, check.starts);
    try {
      const options = { urgency: URGENCY.figures, signal };
      const fates = await this.crew.compute("ensemble", [check.toml, 0, count, { figures: true }], options);
      this.run?.outcomes.adopt(fates.outcomes, fates.outcome);
      this.watched = fates;
      this.decision.value?.look();
    } catch (error) {
      if (!isAborted(error)) this.fail(error as Error);
    }
  }

  private mapBegins(check: StudyCheck): void {
    const map: MapRun = new MapRun(this.crew, check, MAP_SIDE, this.otherAngles(check), URGENCY.map, () => {
      if (map.failure) this.fail(map.failure);
      if (this.mapChanged.value === map) this.mapChanged.set(map);
    });
    this.mapChanged.set(map);
  }

  /** Balls beyond the second, which a map holds still: spread evenly, off the axes. */
  private otherAngles(check: StudyCheck): number[] {
    const balls = check.machine.balls;
    return Array.from({ length: Math.max(0, balls - 2) }, (_, k) => (TURN * (k + 1)) / (balls - 1));
  }

  private async count(check: StudyCheck): Promise<void> {
    const run = this.run;
    if (!run || run.check !== check) return;
    if (run.failure) return this.fail(run.failure);
    if (!this.goesOn && run.done >= Math.min(FIRST_STARTS, run.wanted)) {
      this.goesOn = true;
      run.extend(Math.min(STARTS, check.starts));
      if (check.machine.balls > 1 && !check.uncertain) this.mapBegins(check);
      if (!run.gathers) void this.watch(check, this.stopper.signal);
    }
    this.decision.value?.look();
    try {
      const shares = await this.crew.ask("shares", run.counts());
      if (this.run === run) this.shares.set(shares);
    } catch (error) {
      this.fail(error as Error);
    }
  }

  fail(error: Error): void {
    this.finding.set(null);
    this.trouble.set(error.message);
  }

  private async keepAddress(): Promise<void> {
    const hash = await toHash(this.setting);
    if (`#${hash}` !== window.location.hash) window.history.replaceState(null, "", `#${hash}`);
  }

  /** Somebody put another address in: the page follows. */
  private async followAddress(): Promise<void> {
    const setting = await fromHash(window.location.hash);
    if (setting && (await toHash(setting)) !== (await toHash(this.setting))) await this.take(setting);
  }

  get isChanged(): boolean {
    return this.setting.overrides.length > 0;
  }

  get isPinnedHere(): boolean {
    return this.setting.pinned !== null && sameOverrides(this.setting.pinned, this.setting.overrides);
  }
}
