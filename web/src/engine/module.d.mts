// Types of module.mjs.
import type { EquipoiseFactory } from "*/equipoise.mjs";
import type { Calls, Problem, Progress } from "./protocol";

export type Engine = (call: keyof Calls, args: unknown[]) => { result: unknown } | { error: Problem };

export function loadEngine(
  createEquipoise: EquipoiseFactory,
  compiled: WebAssembly.Module,
  onProgress?: (progress: Progress) => void,
): Promise<Engine>;
