/** Length of the best path over time, a step line for each run. */

import type { Trace } from "../app/trace";
import type { Palette } from "../draw/palette";
import { type Run, runName } from "../model/problem";
import { make } from "./dom";

const HEIGHT = 200;
const [TOP, BOTTOM] = [12, 176];
const [LEFT, RIGHT] = [64, 20];
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

/** The lines, for a chart so many pixels wide; null where no run has found a path. */
export function chart(
  runs: readonly Run[],
  traces: readonly Trace[],
  colours: Palette,
  width: number,
): SVGSVGElement | null {
  const lengths = traces.flatMap((trace) => trace.history.map(({ length }) => length));
  if (lengths.length === 0) return null;
  const margin = Math.max(0.06 * (Math.max(...lengths) - Math.min(...lengths)), 0.02);
  const longest = Math.max(0.01, ...traces.map((trace) => trace.seconds));
  const x = scale(0, longest, LEFT, width - RIGHT);
  const y = scale(Math.min(...lengths) - margin, Math.max(...lengths) + margin, BOTTOM, TOP);
  const svg = node("svg", { width, height: HEIGHT, role: "img" });
  svg.append(node("title", {}, summary(runs, traces)));
  drawAxes(svg, x, y, width - RIGHT);
  traces.forEach((trace, index) => {
    if (trace.history.length > 0) svg.append(stepLine(trace, x, y, strokeOf(index, colours)));
  });
  return svg;
}

/** What the lines stand for. */
export function legend(runs: readonly Run[], colours: Palette): HTMLLIElement[] {
  return runs.map((run, index) => {
    const svg = node("svg", { width: 34, height: 8, "aria-hidden": "true" });
    svg.append(node("path", { d: "M1 4H33", ...strokeOf(index, colours) }));
    return make("li", {}, svg, runName(run));
  });
}

function strokeOf(index: number, colours: Palette) {
  return {
    fill: "none",
    stroke: colours.runs[index]!,
    "stroke-width": 2,
    "stroke-dasharray": DASHES[index]!,
    "stroke-linejoin": "round",
  };
}

function drawAxes(svg: SVGElement, x: Scale, y: Scale, right: number): void {
  for (const value of ticks(y.low, y.high, 4)) {
    const at = y.at(value);
    svg.append(
      node("line", { class: "grid", x1: LEFT, x2: right, y1: at, y2: at }),
      node("text", { x: LEFT - 8, y: at + 4, "text-anchor": "end" }, `${short(value)} m`),
    );
  }
  for (const value of ticks(x.low, x.high, 5)) {
    const at = x.at(value);
    svg.append(
      node("text", { x: at, y: BOTTOM + 18, "text-anchor": "middle" }, `${short(value)} s`),
    );
  }
}

function stepLine(
  { history, seconds }: Trace,
  x: Scale,
  y: Scale,
  stroke: Record<string, string | number>,
): SVGElement {
  const steps = history.map(({ seconds: at, length }, index) => {
    const [px, py] = [x.at(at).toFixed(1), y.at(length).toFixed(1)];
    return index === 0 ? `M${px} ${py}` : `H${px}V${py}`;
  });
  return node("path", { d: `${steps.join("")}H${x.at(seconds).toFixed(1)}`, ...stroke });
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
