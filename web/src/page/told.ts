// Tables and sentences of the library, as elements.
import type { ToldBlock, ToldTable } from "../engine/protocol";
import { h } from "../base/dom";

export function tableOf({ header, rows, caption }: ToldTable): HTMLElement {
  const head = header.map((words) => h("th", { scope: "col" }, words));
  const body = rows.map(({ cells, tone }) => h("tr", { class: tone }, ...cells.map((text) => h("td", {}, text))));
  return h(
    "div",
    { class: "told-table" },
    h("div", { class: "wide" }, h("table", {}, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...body))),
    caption ? h("p", { class: "quiet" }, caption) : null,
  );
}

export const blocksOf = (blocks: readonly ToldBlock[]): HTMLElement[] =>
  blocks.map((block) => ("table" in block ? tableOf(block.table) : h("p", {}, block.text)));
