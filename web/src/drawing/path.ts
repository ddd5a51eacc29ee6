// A motion's path between its points, round and round.
import type { MotionPath } from "../engine/protocol";
import type { Pose } from "./machine";

/** The pose after `time`; a path that is over begins again. */
export function poseAt(path: MotionPath, time: number): Pose {
  const last = path.psi.length - 1;
  const place = path.duration > 0 && last > 0 ? ((time / path.duration) % 1) * last : 0;
  const k = Math.min(Math.floor(place), Math.max(0, last - 1));
  const w = place - k;
  const mix = (list: readonly number[]) => list[k]! + w * ((list[k + 1] ?? list[k]!) - list[k]!);
  const [psi, X, Y] = [mix(path.psi), mix(path.x), mix(path.y)];
  // The path is in the room's axes; a pose is seen from the rotor.
  const [c, s] = [Math.cos(psi), Math.sin(psi)];
  return { psi, x: c * X + s * Y, y: c * Y - s * X, phi: path.phi.map(mix) };
}

/** The whole of a path as poses. */
export function posesOf(path: MotionPath): Pose[] {
  const last = path.psi.length - 1;
  return Array.from({ length: last }, (_, k) => poseAt(path, (path.duration * k) / last));
}
