// What went wrong, said once, while the page goes on.
import { h } from "../base/dom";

const STAYS = 12_000; // ms

export class Notices {
  constructor(private readonly place: HTMLElement) {}

  say(words: string, bad = false): void {
    if ([...this.place.children].some((one) => one.firstChild?.textContent === words)) return;
    const close = h("button", { type: "button", "aria-label": "Dismiss", click: () => notice.remove() }, "×");
    const notice: HTMLElement = h("div", { class: bad ? "notice bad" : "notice" }, h("span", {}, words), close);
    this.place.append(notice);
    if (!bad) window.setTimeout(() => notice.remove(), STAYS);
  }
}
