// A small menu of files that can be taken home.
import { h } from "../base/dom";

export function saveMenu(label: string, items: Record<string, () => void>): HTMLElement {
  const menu = h("details", { class: "save" }, h("summary", { "aria-label": label }, "Save"));
  const list = h("div");
  for (const [words, work] of Object.entries(items)) {
    const act = () => {
      menu.open = false;
      work();
    };
    list.append(h("button", { type: "button", click: act }, words));
  }
  menu.append(list);
  menu.addEventListener("focusout", (event) => {
    if (!menu.contains(event.relatedTarget as Node | null)) menu.open = false;
  });
  return menu;
}
