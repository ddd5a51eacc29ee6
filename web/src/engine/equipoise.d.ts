// What Emscripten makes of web/engine: only module.mjs looks inside.
declare module "*/equipoise.mjs" {
  export type EquipoiseFactory = (given: object) => Promise<unknown>;
  const createEquipoise: EquipoiseFactory;
  export default createEquipoise;
}
declare module "*?packed" {
  const base64: string;
  export default base64;
}
