/** One picture of a problem: the map and, on it, what a run proposes, searches and finds. */

import type { MapInfo, Stroke } from "../api/types";
import { along, carOutline, type Path } from "../geometry/path";
import type { Pose } from "../geometry/points";
import { type Size, type View, worldMatrix } from "../geometry/view";
import { isCar, type RobotModel } from "../model/problem";
import type { Palette } from "./palette";
import { clipToMap, drawPlaced, fillMap, type Placed, smoothing } from "./rasters";
import type { TreeLayer } from "./treeLayer";

export interface Layers {
  heat: boolean;
  region: boolean;
  tree: boolean;
  path: boolean;
  band: boolean;
  best: boolean;
}

export interface Scene {
  view: View;
  size: Size;
  /** Device pixels a CSS pixel. */
  ratio: number;
  /** Whether the view moves: the tree may then be a little blurred. */
  moves: boolean;
  colours: Palette;
  layers: Layers;
  map: MapInfo;
  obstacles: Placed;
  heat: Placed | null;
  region: Placed | null;
  tree: TreeLayer;
  robot: RobotModel;
  start: Pose;
  goal: Pose;
  path: Path;
  pathColour: string;
  /** The shortest path that any run has found for this problem. */
  best: Path;
  /** Where the robot drives at the moment. */
  driver: Pose | null;
  /** What the brush has drawn and the server has not yet. */
  strokes: readonly Stroke[];
}

export function drawScene(context: CanvasRenderingContext2D, scene: Scene): void {
  const { view, size, ratio, layers, map, colours } = scene;
  const inWorld = () => context.setTransform(...worldMatrix(view, size, ratio));
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, context.canvas.width, context.canvas.height);
  inWorld();
  context.save();
  clipToMap(context, map);
  fillMap(context, map, colours.floor);
  if (layers.heat && scene.heat) drawPlaced(context, map, scene.heat, "low");
  const smooth = ({ width, image }: Placed) =>
    smoothing((width / image.width) * view.scale * ratio);
  if (layers.region && scene.region) {
    drawPlaced(context, map, scene.region, smooth(scene.region));
  }
  drawPlaced(context, map, scene.obstacles, smooth(scene.obstacles));
  for (const stroke of scene.strokes) drawStroke(context, stroke, colours);
  context.restore();
  if (layers.tree) scene.tree.draw(context, view, size, ratio, colours.tree, scene.moves);
  inWorld();
  drawPaths(context, scene);
  drawEnds(context, scene);
  if (scene.driver) drawDriver(context, scene, scene.driver);
}

function drawStroke(context: CanvasRenderingContext2D, stroke: Stroke, colours: Palette): void {
  const colour = stroke.occupied ? colours.obstacle : colours.floor;
  trace(context, stroke.points);
  context.strokeStyle = colour;
  context.lineWidth = 2 * stroke.radius;
  context.lineCap = "round";
  context.lineJoin = "round";
  context.stroke();
}

/** Begins a path along the points; a single one becomes a dot. */
function trace(context: CanvasRenderingContext2D, path: Path): void {
  context.beginPath();
  path.forEach(([x, y], index) => {
    if (index === 0) context.moveTo(x!, y!);
    context.lineTo(x!, y!);
  });
}

function drawPaths(context: CanvasRenderingContext2D, scene: Scene): void {
  const { layers, robot, path, best, colours, pathColour, view } = scene;
  const pixel = 1 / view.scale;
  context.lineCap = "round";
  context.lineJoin = "round";
  if (layers.band && path.length > 1) {
    trace(context, path);
    context.globalAlpha = 0.2;
    line(context, pathColour, 2 * robot.radius);
    context.globalAlpha = 1;
  }
  if (layers.best && best.length > 1) {
    trace(context, best);
    context.setLineDash([2 * pixel, 6 * pixel]);
    line(context, colours.best, 3 * pixel);
    context.setLineDash([]);
  }
  if (layers.path && path.length > 1) {
    trace(context, path);
    line(context, colours.halo, 5.5 * pixel);
    line(context, pathColour, 2.6 * pixel);
    if (isCar(robot)) drawCars(context, scene);
  }
}

function line(context: CanvasRenderingContext2D, colour: string, width: number): void {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
}

const MOST_CARS = 14;

/** A small robot on a large map is drawn larger than it is: its heading must be seen. */
function carSize({ robot, view }: Scene): number {
  return Math.max(robot.radius, 7 / view.scale);
}

function drawCars(context: CanvasRenderingContext2D, scene: Scene): void {
  const size = carSize(scene);
  for (const pose of along(scene.path, 4 * size, MOST_CARS)) {
    drawCar(context, pose, size, scene.colours.body, scene.pathColour, 1.2 / scene.view.scale);
  }
}

function drawCar(
  context: CanvasRenderingContext2D,
  pose: Pose,
  size: number,
  fill: string,
  edge: string,
  width: number,
): void {
  trace(context, carOutline(pose, size));
  context.closePath();
  context.fillStyle = fill;
  context.fill();
  line(context, edge, width);
}

function drawDriver(context: CanvasRenderingContext2D, scene: Scene, pose: Pose): void {
  const { colours, pathColour, robot, view } = scene;
  const pixel = 1 / view.scale;
  if (isCar(robot)) {
    drawCar(context, pose, 1.3 * carSize(scene), pathColour, colours.halo, 2 * pixel);
    return;
  }
  disc(context, pose, Math.max(robot.radius, 7 * pixel));
  context.fillStyle = pathColour;
  context.fill();
  line(context, colours.halo, 2 * pixel);
}

function disc(context: CanvasRenderingContext2D, { x, y }: Pose, radius: number): void {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
}

export const HANDLE_ARM = 34;
/** Length in pixels of the arm that a heading handle sits on. */

function drawEnds(context: CanvasRenderingContext2D, scene: Scene): void {
  const { colours, robot, start, goal } = scene;
  for (const [pose, colour, isGoal] of [
    [start, colours.start, false],
    [goal, colours.goal, true],
  ] as const) {
    drawFootprint(context, scene, pose, colour);
    if (isCar(robot)) drawDart(context, scene, pose, colour);
    else if (isGoal) drawStar(context, scene, pose, colour);
    else marker(context, scene, colour, () => disc(context, pose, 7.5 / scene.view.scale));
  }
}

/** The robot's disc, true to scale. */
function drawFootprint(
  context: CanvasRenderingContext2D,
  { robot, view }: Scene,
  pose: Pose,
  colour: string,
): void {
  disc(context, pose, robot.radius);
  context.globalAlpha = 0.25;
  context.fillStyle = colour;
  context.fill();
  context.globalAlpha = 1;
  line(context, colour, 1 / view.scale);
}

function marker(
  context: CanvasRenderingContext2D,
  { colours, view }: Scene,
  colour: string,
  outline: () => void,
): void {
  outline();
  line(context, colours.halo, 4 / view.scale);
  context.fillStyle = colour;
  context.fill();
}

function drawStar(
  context: CanvasRenderingContext2D,
  scene: Scene,
  { x, y }: Pose,
  colour: string,
): void {
  const points = Array.from({ length: 10 }, (_, index) => {
    const radius = (index % 2 === 0 ? 11 : 4.8) / scene.view.scale;
    const angle = Math.PI / 2 + (index * Math.PI) / 5;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)] as const;
  });
  marker(context, scene, colour, () => {
    trace(context, points);
    context.closePath();
  });
}

const DART = [
  [1, 0],
  [-0.8, 0.72],
  [-0.42, 0],
  [-0.8, -0.72],
] as const;

/** An arrowhead along the heading, and the arm and knob that turn it. */
function drawDart(
  context: CanvasRenderingContext2D,
  scene: Scene,
  { x, y, yaw }: Pose,
  colour: string,
): void {
  const pixel = 1 / scene.view.scale;
  const [c, s] = [Math.cos(yaw) * pixel, Math.sin(yaw) * pixel];
  const at = (u: number, v: number) => [x + c * u - s * v, y + s * u + c * v] as const;
  trace(context, [at(0, 0), at(HANDLE_ARM, 0)]);
  line(context, colour, 1.5 * pixel);
  const [knobX, knobY] = at(HANDLE_ARM, 0);
  marker(context, scene, colour, () => disc(context, { x: knobX, y: knobY, yaw }, 4.5 * pixel));
  marker(context, scene, colour, () => {
    trace(
      context,
      DART.map(([u, v]) => at(12 * u, 12 * v)),
    );
    context.closePath();
  });
}
