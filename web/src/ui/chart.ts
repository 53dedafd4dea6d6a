/** Length of the best path over time, a step line for each run. */

import type { Trace } from "../app/trace";
import type { Palette } from "../draw/palette";
import { type Run, runName } from "../model/problem";

const HEIGHT = 216;
const [TOP, BOTTOM] = [12, 176];
const LEFT = 52;
/** Room for the names beside the lines. */
const NAMES = 172;
/** Told apart without colours, too. */
const DASHES = ["", "7 4", "2 3", "10 3 2 3"];
const SVG = "http://www.w3.org/2000/svg";

/** From values to pixels. */
interface Scale {
  low: number;
  high: number;
  at(value: number): number;
}

function scale(low: number, high: number, from: number, to: number): Scale {
  return { low, high, at: (value) => from + ((value - low) / (high - low)) * (to - from) };
}

/** Round numbers from low to high, about `wanted` of them. */
export function ticks(low: number, high: number, wanted: number): number[] {
  const raw = (high - low) / wanted;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((value) => value >= raw)!;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, index) => (first + index) * step);
}

/** Null where no run has found a path; `width` in pixels. */
export function chart(
  runs: readonly Run[],
  traces: readonly Trace[],
  colours: Palette,
  width: number,
): SVGSVGElement | null {
  const lengths = traces.flatMap((trace) => trace.history.map(({ length }) => length));
  if (lengths.length === 0) return null;
  const margin = Math.max(0.06 * (Math.max(...lengths) - Math.min(...lengths)), 0.02);
  const right = width - NAMES;
  const longest = Math.max(0.01, ...traces.map((trace) => trace.seconds));
  const x = scale(0, longest, LEFT, right);
  const y = scale(Math.min(...lengths) - margin, Math.max(...lengths) + margin, BOTTOM, TOP);
  const svg = node("svg", { width, height: HEIGHT, role: "img" });
  svg.append(node("title", {}, summary(runs, traces)));
  drawAxes(svg, x, y, right);
  const labels: { y: number; text: string; colour: string }[] = [];
  traces.forEach((trace, index) => {
    const last = trace.history.at(-1);
    if (!last) return;
    const colour = colours.runs[index]!;
    svg.append(stepLine(trace, x, y, colour, DASHES[index]!));
    labels.push({ y: y.at(last.length), text: runName(runs[index]!), colour });
  });
  for (const label of spread(labels, 15)) {
    svg.append(
      node("text", { x: right + 8, y: label.y + 4, style: `fill: ${label.colour}` }, label.text),
    );
  }
  return svg;
}

function drawAxes(svg: SVGElement, x: Scale, y: Scale, right: number): void {
  for (const value of ticks(y.low, y.high, 4)) {
    const at = y.at(value);
    svg.append(
      node("line", { class: "grid", x1: LEFT, x2: right, y1: at, y2: at }),
      node("text", { x: LEFT - 8, y: at + 4, "text-anchor": "end" }, short(value)),
    );
  }
  for (const value of ticks(x.low, x.high, 5)) {
    const at = x.at(value);
    svg.append(node("text", { x: at, y: BOTTOM + 18, "text-anchor": "middle" }, short(value)));
  }
  svg.append(
    node("text", { x: right, y: BOTTOM + 34, "text-anchor": "end" }, "seconds of search"),
    node("text", { x: 8, y: BOTTOM + 34 }, "metres"),
  );
}

function stepLine(
  { history, seconds }: Trace,
  x: Scale,
  y: Scale,
  colour: string,
  dashes: string,
): SVGElement {
  const steps = history.map(({ seconds: at, length }, index) => {
    const [px, py] = [x.at(at).toFixed(1), y.at(length).toFixed(1)];
    return index === 0 ? `M${px} ${py}` : `H${px}V${py}`;
  });
  return node("path", {
    d: `${steps.join("")}H${x.at(seconds).toFixed(1)}`,
    fill: "none",
    stroke: colour,
    "stroke-width": 2,
    "stroke-dasharray": dashes,
    "stroke-linejoin": "round",
  });
}

/** Moves labels apart so that none covers another. */
export function spread<T extends { y: number }>(labels: readonly T[], distance: number): T[] {
  const sorted = labels.map((label) => ({ ...label })).sort((a, b) => a.y - b.y);
  for (let i = 1; i < sorted.length; i++) {
    sorted[i]!.y = Math.max(sorted[i]!.y, sorted[i - 1]!.y + distance);
  }
  return sorted;
}

function summary(runs: readonly Run[], traces: readonly Trace[]): string {
  const parts = traces.map(({ history }, index) => {
    const [first, last] = [history[0], history.at(-1)];
    const name = runName(runs[index]!);
    if (!first || !last) return `${name}: no path`;
    const begin = `${first.length.toFixed(2)} m after ${first.seconds.toFixed(2)} s`;
    return `${name}: ${begin}, ${last.length.toFixed(2)} m at the end`;
  });
  return parts.join("; ");
}

function short(value: number): string {
  return String(Number(value.toPrecision(6)));
}

function node<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number>,
  text = "",
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.textContent = text;
  return element;
}
