// Studies in and out: presets, files opened and dropped, the address, the command for a terminal.
import type { Preset, StudyCheck } from "../engine/protocol";
import { h } from "../base/dom";
import { saveText } from "../base/save";
import type { Desk } from "./desk";

const GROUPS = {
  machines: "Machines",
  examples: "Examples in depth",
  new: "A machine of your kind",
  paper: "Wright and Peng (2019)",
} as const;
const LARGEST = 1_000_000; // bytes: no study is a thousandth of it

/** What a group's label says already need not be said again. */
function titleIn(label: string, title: string): string {
  const rest = title.startsWith(`${label}, `) ? title.slice(label.length + 2) : title;
  return rest.charAt(0).toUpperCase() + rest.slice(1);
}

export class StudyFiles {
  private readonly menu = document.querySelector<HTMLSelectElement>("#preset")!;
  private readonly file = document.querySelector<HTMLInputElement>("#study-file")!;

  constructor(
    private readonly desk: Desk,
    presets: readonly Preset[],
    private readonly terminal: HTMLElement,
  ) {
    for (const [group, label] of Object.entries(GROUPS)) {
      const own = presets.filter((preset) => preset.group === group);
      this.menu.append(
        h("optgroup", { label }, ...own.map(({ name, title }) => h("option", { value: name }, titleIn(label, title)))),
      );
    }
    this.menu.append(h("option", { value: "", hidden: true }, "your own study"));
    this.listen();
    desk.checked.listen((check) => check && this.show(check));
  }

  private show(check: StudyCheck): void {
    const { source } = this.desk.setting;
    this.menu.value = "preset" in source ? source.preset : "";
    const lines = (text: string) => h("pre", { tabindex: "0" }, text.trim());
    const copy = h(
      "button",
      { type: "button", click: () => void navigator.clipboard?.writeText(check.command) },
      "Copy",
    );
    this.terminal.replaceChildren(
      h(
        "div",
        { class: "row apart" },
        h(
          "p",
          { class: "quiet" },
          "This page runs the program's own code; the program is faster and takes more starts.",
        ),
        copy,
      ),
      lines(check.command),
      ...check.warnings.map((warning) => h("p", { class: "quiet" }, warning)),
      h("details", {}, h("summary", {}, "The study, explained"), lines(check.explain)),
      h("details", {}, h("summary", {}, "The study file"), lines(check.toml)),
    );
  }

  private listen(): void {
    this.menu.addEventListener("change", () => this.menu.value && void this.desk.open({ preset: this.menu.value }));
    this.on("open-study", () => this.file.click());
    this.on("save-study", () =>
      saveText("study.toml", this.desk.checked.value?.toml ?? this.desk.source, "application/toml"),
    );
    this.on("copy-address", (button) => void this.copyAddress(button));
    this.file.addEventListener("change", () => void this.read(this.file.files?.[0]));
    const body = document.body;
    body.addEventListener("dragover", (event) => {
      event.preventDefault();
      body.classList.add("drop");
    });
    body.addEventListener("dragleave", () => body.classList.remove("drop"));
    body.addEventListener("drop", (event) => {
      event.preventDefault();
      body.classList.remove("drop");
      void this.read(event.dataTransfer?.files[0]);
    });
  }

  private on(id: string, act: (button: HTMLElement) => void): void {
    const button = document.getElementById(id)!;
    button.addEventListener("click", () => act(button));
  }

  private async read(file: File | undefined): Promise<void> {
    this.file.value = "";
    if (!file) return;
    if (file.size > LARGEST) return this.desk.trouble.set(`${file.name} is no study: ${file.size} bytes.`);
    await this.desk.open({ toml: await file.text() });
  }

  private async copyAddress(button: HTMLElement): Promise<void> {
    const words = button.textContent;
    try {
      await navigator.clipboard.writeText(window.location.href);
      button.textContent = "Copied";
    } catch {
      button.textContent = "It is in the address bar";
    }
    window.setTimeout(() => (button.textContent = words), 2000);
  }
}
