// The machine seen along its axis: disc, race, balls, the way of its centre and the circle it should stay in.
import type { Machine } from "../engine/protocol";

export type Frame = "room" | "rotor";

/** Where everything is; x, y and the balls' angles as seen from the turning rotor. */
export interface Pose {
  psi: number;
  x: number;
  y: number;
  phi: readonly number[];
}

export interface Scene {
  machine: Machine;
  frame: Frame;
  /** How much larger than life displacements are drawn. */
  magnify: number;
  /** Radius of the circle that the centre should stay in, in R. */
  limit: number | null;
  /** Colours by the page's style. */
  ink: Ink;
  /** Without words and fine lines, for small pictures. */
  small?: boolean;
}

export interface Ink {
  line: string;
  quiet: string;
  disc: string;
  race: string;
  ball: string;
  ballText: string;
  heavy: string;
  limit: string;
  way: string;
}

const DISC = 1.18; // radius in race radii
const AROUND = 0.3; // race radii left free around the disc, for its displacement
const FARTHEST = 0.4; // race radii by which the largest displacement is drawn at most: the disc's edge may leave the picture
const BALL = 0.085; // radius drawn where none is known
const LEAST_BALL = 0.05;

/** CSS pixels of a race radius in a square of this size. */
export function raceRadius(size: number): number {
  return size / 2 / (DISC + AROUND);
}

const MAGNIFICATIONS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

/** Such that a displacement of so many race radii is well seen. */
export function goodMagnification(largest: number): number {
  const most = FARTHEST / Math.max(largest, 1e-6);
  return MAGNIFICATIONS.filter((m) => m <= most).at(-1) ?? 1;
}

/** Direction from a point of the picture to the disc's centre, as a ball's angle in the turning rotor. */
export function angleAt(x: number, y: number, size: number, pose: Pose, frame: Frame): number {
  const angle = Math.atan2(size / 2 - y, x - size / 2);
  return frame === "room" ? angle - pose.psi : angle;
}

/** The ball under a point of the picture, with room for a finger; -1: none. */
export function ballAt(x: number, y: number, size: number, scene: Scene, pose: Pose): number {
  const places = pose.phi.map((phi) => ballPlace(size, scene, pose, phi));
  const distances = places.map(([bx, by]) => Math.hypot(bx - x, by - y));
  const nearest = distances.indexOf(Math.min(...distances));
  return nearest >= 0 && distances[nearest]! < Math.max(22, 0.14 * raceRadius(size)) ? nearest : -1;
}

function turned(x: number, y: number, angle: number): [number, number] {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [c * x - s * y, s * x + c * y];
}

/** The centre of the disc in the picture. */
function centre(size: number, scene: Scene, pose: Pose): [number, number] {
  const [x, y] = scene.frame === "room" ? turned(pose.x, pose.y, pose.psi) : [pose.x, pose.y];
  const scale = raceRadius(size) * scene.magnify;
  return [size / 2 + scale * x, size / 2 - scale * y];
}

function raceCentre(size: number, scene: Scene, pose: Pose): [number, number] {
  const [ox, oy] = scene.machine.race_offset;
  return centre(size, scene, { ...pose, x: pose.x + ox, y: pose.y + oy });
}

function ballPlace(size: number, scene: Scene, pose: Pose, phi: number): [number, number] {
  const [cx, cy] = raceCentre(size, scene, pose);
  const angle = phi + (scene.frame === "room" ? pose.psi : 0);
  return [cx + raceRadius(size) * Math.cos(angle), cy - raceRadius(size) * Math.sin(angle)];
}

type Context = CanvasRenderingContext2D;

function circle(context: Context, x: number, y: number, radius: number): void {
  context.beginPath();
  context.arc(x, y, Math.max(0, radius), 0, 2 * Math.PI);
}

function drawDisc(context: Context, size: number, scene: Scene, pose: Pose): void {
  const [cx, cy] = centre(size, scene, pose);
  const [rx, ry] = raceCentre(size, scene, pose);
  const R = raceRadius(size);
  circle(context, cx, cy, DISC * R);
  context.fillStyle = scene.ink.disc;
  context.fill();
  context.lineWidth = scene.small ? 1 : 1.5;
  context.strokeStyle = scene.ink.quiet;
  context.stroke();
  circle(context, rx, ry, R);
  context.lineWidth = 2.3 * ballRadius(scene, 0) * R;
  context.strokeStyle = scene.ink.race;
  context.stroke();
}

function ballRadius(scene: Scene, ball: number): number {
  return Math.max(LEAST_BALL, scene.machine.ball_radius[ball] || BALL) * (scene.small ? 1.25 : 1);
}

/** The rotor's heavy side: where its unbalance points, from which the balls' angles count. */
function drawHeavySide(context: Context, size: number, scene: Scene, pose: Pose): void {
  const [cx, cy] = centre(size, scene, pose);
  const angle = scene.frame === "room" ? pose.psi : 0;
  const R = raceRadius(size);
  const at = (radius: number): [number, number] => [
    cx + radius * R * Math.cos(angle),
    cy - radius * R * Math.sin(angle),
  ];
  context.strokeStyle = context.fillStyle = scene.ink.heavy;
  context.lineWidth = scene.small ? 1.5 : 2;
  context.beginPath();
  context.moveTo(...at(0.12));
  context.lineTo(...at(0.6));
  context.stroke();
  circle(context, ...at(0.66), (scene.small ? 0.09 : 0.065) * R);
  context.fill();
  if (scene.small) return;
  context.font = "500 12px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  const [tx, ty] = at(0.4);
  // Beside the line, upright whichever way the rotor has turned.
  context.fillText(
    "heavy side",
    tx - 14 * Math.sin(angle) * Math.sign(Math.cos(angle) || 1),
    ty - 13 * Math.abs(Math.cos(angle)) - 2,
  );
}

function drawBalls(context: Context, size: number, scene: Scene, pose: Pose): void {
  const R = raceRadius(size);
  pose.phi.forEach((phi, k) => {
    const [x, y] = ballPlace(size, scene, pose, phi);
    const radius = ballRadius(scene, k) * R;
    circle(context, x, y, radius);
    context.fillStyle = scene.ink.ball;
    context.fill();
    if (radius < 8 || scene.small) return;
    context.fillStyle = scene.ink.ballText;
    context.font = `600 ${Math.min(14, 1.1 * radius)}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText(String(k + 1), x, y + 0.5);
  });
}

function drawWay(context: Context, size: number, scene: Scene, way: readonly Pose[]): void {
  if (way.length < 2) return;
  context.strokeStyle = scene.ink.way;
  context.lineWidth = scene.small ? 1.25 : 1.75;
  context.lineJoin = "round";
  // Older parts fade: a few strokes of falling weight look like a gradient.
  const parts = scene.small ? 1 : 6;
  for (let part = 0; part < parts; ++part) {
    const [from, to] = [Math.floor((part * way.length) / parts), Math.floor(((part + 1) * way.length) / parts)];
    context.globalAlpha = (part + 1) / parts;
    context.beginPath();
    for (let k = Math.max(0, from - 1); k < to; ++k) {
      const [x, y] = centre(size, scene, way[k]!);
      if (k === Math.max(0, from - 1)) context.moveTo(x, y);
      else context.lineTo(x, y);
    }
    context.stroke();
  }
  context.globalAlpha = 1;
}

function drawRest(context: Context, size: number, scene: Scene): void {
  const middle = size / 2;
  if (!scene.small) {
    context.strokeStyle = scene.ink.quiet;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(middle - 9, middle);
    context.lineTo(middle + 9, middle);
    context.moveTo(middle, middle - 9);
    context.lineTo(middle, middle + 9);
    context.stroke();
  }
  if (scene.limit === null) return;
  circle(context, middle, middle, scene.limit * scene.magnify * raceRadius(size));
  context.setLineDash([5, 4]);
  context.strokeStyle = scene.ink.limit;
  context.lineWidth = 1.5;
  context.stroke();
  context.setLineDash([]);
}

/** Draws into a square of `size` CSS pixels; `way`: poses of the centre up to now, oldest first. */
export function drawMachine(context: Context, size: number, scene: Scene, pose: Pose, way: readonly Pose[]): void {
  context.clearRect(0, 0, size, size);
  drawDisc(context, size, scene, pose);
  drawHeavySide(context, size, scene, pose);
  drawBalls(context, size, scene, pose);
  drawRest(context, size, scene);
  drawWay(context, size, scene, way);
  const [cx, cy] = centre(size, scene, pose);
  circle(context, cx, cy, scene.small ? 2 : 3.5);
  context.fillStyle = scene.ink.way;
  context.fill();
}
