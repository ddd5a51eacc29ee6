// What a visitor takes home: files made in the page.
import { h } from "./dom";

export function saveBlob(name: string, blob: Blob): void {
  const address = URL.createObjectURL(blob);
  const link = h("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  window.setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

export function saveText(name: string, text: string, type = "text/plain"): void {
  saveBlob(name, new Blob([text], { type: `${type};charset=utf-8` }));
}

export function saveCanvas(name: string, canvas: HTMLCanvasElement): void {
  canvas.toBlob((blob) => blob && saveBlob(name, blob), "image/png");
}

/** Names and numbers with commas between, one row a line (RFC 4180). */
export function csv(header: readonly string[], rows: Iterable<readonly (string | number)[]>): string {
  const cell = (value: string | number) => {
    const text = String(value);
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  const lines = [header.map(cell).join(",")];
  for (const row of rows) lines.push(row.map(cell).join(","));
  return lines.join("\n") + "\n";
}

/** A drawing that stands alone: dark on white, with the page's text face. */
function standalone(drawing: SVGElement): { text: string; width: number; height: number } {
  const [width, height] = drawing.getAttribute("viewBox")!.split(" ").slice(2).map(Number) as [number, number];
  const copy = drawing.cloneNode(true) as SVGElement;
  const attributes = { xmlns: "http://www.w3.org/2000/svg", "font-family": "system-ui, sans-serif", width, height };
  for (const [name, value] of Object.entries(attributes)) copy.setAttribute(name, String(value));
  copy.setAttribute("style", "color: #1b1f24; background: #ffffff");
  return { text: new XMLSerializer().serializeToString(copy), width, height };
}

export function saveSvg(name: string, drawing: SVGElement): void {
  saveText(name, standalone(drawing).text, "image/svg+xml");
}

/** A drawing as a picture of twice its size. */
export function saveSvgAsPng(name: string, drawing: SVGElement): void {
  const { text, width, height } = standalone(drawing);
  const image = new Image();
  image.onload = () => {
    const canvas = h("canvas", { width: 2 * width, height: 2 * height });
    const context = canvas.getContext("2d")!;
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    saveCanvas(name, canvas);
  };
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
}
