/** The Python program that plans the same problem with the library. */

import type { Pose } from "../geometry/points";
import { isCar, type Limits, type Problem, type RobotModel, type Run } from "./problem";

export interface SnippetOptions {
  problem: Problem;
  run: Run;
  limits: Limits;
  /** Where the map's image can be fetched, for maps that no generator makes. */
  imageUrl: string;
}

const CLASSES = { point: "PointRobot", dubins: "DubinsCar", "reeds-shepp": "ReedsSheppCar" };

export function snippet({ problem, run, limits, imageUrl }: SnippetOptions): string {
  const { robot, start, goal } = problem;
  const generated = problem.source.kind === "generated" && problem.source.strokes.length === 0;
  const options = [
    `planner=${text(run.planner)}`,
    `guide=${run.guide === null ? "None" : text(run.guide)}`,
    ...(run.guide !== null && run.exploration > 0 ? [`exploration=${run.exploration}`] : []),
    `time_limit=${limits.time}`,
    ...(limits.seed === null ? [] : [`seed=${limits.seed}`]),
  ];
  return [
    ...(generated ? [] : ["from io import BytesIO", "from urllib.request import urlopen", ""]),
    ...(generated ? [] : ["import numpy as np", "from PIL import Image", ""]),
    "import planformer as pf",
    "",
    ...(generated ? generatedMap(problem) : fetchedMap(problem, imageUrl)),
    `robot = ${robotCall(robot)}`,
    "result = pf.plan(",
    "    grid,",
    "    robot,",
    `    start=${tuple(robot, start)},`,
    `    goal=${tuple(robot, goal)},`,
    ...options.map((option) => `    ${option},`),
    ")",
    "print(result)",
    "print(result.path)",
    "",
  ].join("\n");
}

function generatedMap({ source }: Problem): string[] {
  if (source.kind !== "generated") return [];
  const { kind, seed, width, height, resolution } = source.request;
  const size = `width=${width}, height=${height}, resolution=${resolution}`;
  return [`grid = pf.generate_${kind}(seed=${seed}, ${size})`];
}

function fetchedMap({ map }: Problem, imageUrl: string): string[] {
  return [
    `# ${JSON.stringify(map.name).slice(1, -1)}, from the server of the page; the picture's first row is the highest y.`,
    `with urlopen(${text(imageUrl)}) as response:`,
    "    pixels = np.asarray(Image.open(BytesIO(response.read())))[::-1]",
    "grid = pf.OccupancyGrid(",
    "    pixels < 255,",
    `    resolution=${map.resolution},`,
    `    origin=(${map.origin.join(", ")}),`,
    "    unknown=pixels == 127,",
    ")",
  ];
}

function robotCall(robot: RobotModel): string {
  const turning = isCar(robot) ? `, turning_radius=${robot.turningRadius}` : "";
  return `pf.${CLASSES[robot.kind]}(radius=${robot.radius}${turning})`;
}

function tuple(robot: RobotModel, { x, y, yaw }: Pose): string {
  return `(${[x, y, ...(isCar(robot) ? [yaw] : [])].join(", ")})`;
}

/** A JSON string is a Python string as well. */
function text(value: string): string {
  return JSON.stringify(value);
}
