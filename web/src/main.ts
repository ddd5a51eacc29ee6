// The page: who is who, and the first question.
import "./style/page.css";
import "./style/parts.css";
import { engineWorkers } from "./engine/compiled";
import { Answer } from "./page/answer";
import { ComparisonView } from "./page/comparison";
import { DecisionView } from "./page/decision_view";
import { Desk } from "./page/desk";
import { Form } from "./page/form";
import { Gallery } from "./page/gallery";
import { MapView } from "./page/map_view";
import { Notices } from "./page/notices";
import { Stage } from "./page/stage";
import { StudyFiles } from "./page/study_files";
import { SweepView } from "./page/sweep_view";
import { FIRST_STUDY } from "./setting/first_study.mjs";
import { fromHash, type Setting } from "./setting/setting";
import { Crew } from "./work/crew";

const place = (id: string): HTMLElement => document.getElementById(id)!;

async function begin(): Promise<void> {
  const notices = new Notices(place("notices"));
  const crew = new Crew(
    engineWorkers((error) => notices.say(`This browser cannot run the engine: ${error.message}`, true)),
    (why) => notices.say(`A worker stopped (${why}) and was started again; what it was computing is computed anew.`),
  );
  const presets = await crew.ask("presets");
  const first: Setting = (await fromHash(window.location.hash)) ?? {
    source: { preset: presets.some(({ name }) => name === FIRST_STUDY) ? FIRST_STUDY : presets[0]!.name },
    overrides: [],
    start: { index: 0 },
    pinned: null,
    sweep: null,
  };
  const desk = new Desk(crew, presets, first);
  desk.trouble.listen((words) => words && notices.say(words, true));
  const stage = new Stage(desk, place("stage"), place("strips"));
  new DecisionView(desk, place("judgement"), place("figures"));
  new Answer(desk, place("verdict"), place("share-bar"), place("share-list"));
  new MapView(desk, place("map"));
  new Form(desk, place("form"));
  new Gallery(desk, stage, place("gallery"));
  new ComparisonView(desk, place("comparison"));
  new SweepView(desk, place("sweep-form"), place("sweep-chart"));
  new StudyFiles(desk, presets, place("terminal"));
  if (window.matchMedia("(max-width: 760px)").matches) place("settings-fold").removeAttribute("open");
  await desk.take(first);
  const { version } = await crew.ask("version");
  place("foot").textContent = `Equipoise ${version}. Everything is computed in this page; nothing leaves it.`;
}

begin().catch((error: Error) => new Notices(place("notices")).say(`The page could not begin: ${error.message}`, true));
