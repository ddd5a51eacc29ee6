// The style's colours for canvases, read again when the screen turns dark or light.
import { darkScheme, styleColour } from "../base/dom";
import type { Ink } from "./machine";

let held: Ink | null = null;
darkScheme.addEventListener("change", () => (held = null));

export function ink(): Ink {
  held ??= {
    line: styleColour("--ink"),
    quiet: styleColour("--quiet"),
    disc: styleColour("--disc"),
    race: styleColour("--race"),
    ball: styleColour("--ball"),
    ballText: styleColour("--ball-text"),
    heavy: styleColour("--heavy"),
    limit: styleColour("--limit"),
    way: styleColour("--way"),
  };
  return held;
}
