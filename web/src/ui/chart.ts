/** Length of the best path over time, a step line for each run. */

import type { Trace } from "../app/trace";
import type { Palette } from "../draw/palette";
import type { Run } from "../model/problem";

const [WIDTH, HEIGHT] = [720, 220];
const AREA = { left: 52, right: 610, top: 12, bottom: 184 };
/** Told apart without colours, too. */
const DASHES = ["", "7 4", "2 3", "10 3 2 3"];
const SVG = "http://www.w3.org/2000/svg";

interface Scale {
  low: number;
  high: number;
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

/** Null where no run has found a path. */
export function chart(
  runs: readonly Run[],
  traces: readonly Trace[],
  colours: Palette,
): SVGSVGElement | null {
  const lengths = traces.flatMap((trace) => trace.history.map(({ length }) => length));
  if (lengths.length === 0) return null;
  const margin = Math.max(0.06 * (Math.max(...lengths) - Math.min(...lengths)), 0.02);
  const y = { low: Math.min(...lengths) - margin, high: Math.max(...lengths) + margin };
  const x = { low: 0, high: Math.max(0.01, ...traces.map((trace) => trace.seconds)) };
  const svg = node("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img" });
  svg.append(node("title", {}, summary(runs, traces)));
  drawAxes(svg, x, y);
  const labels: { y: number; text: string; colour: string }[] = [];
  traces.forEach((trace, index) => {
    const last = trace.history.at(-1);
    if (!last) return;
    const colour = colours.runs[index]!;
    svg.append(stepLine(trace, x, y, colour, DASHES[index]!));
    labels.push({ y: down(y, last.length), text: runs[index]!.planner, colour });
  });
  for (const label of spread(labels, 15)) {
    svg.append(
      node(
        "text",
        { x: AREA.right + 8, y: label.y + 4, style: `fill: ${label.colour}` },
        label.text,
      ),
    );
  }
  return svg;
}

function across({ low, high }: Scale, value: number): number {
  return AREA.left + ((value - low) / (high - low)) * (AREA.right - AREA.left);
}

function down({ low, high }: Scale, value: number): number {
  return AREA.bottom - ((value - low) / (high - low)) * (AREA.bottom - AREA.top);
}

function drawAxes(svg: SVGElement, x: Scale, y: Scale): void {
  for (const value of ticks(y.low, y.high, 4)) {
    const at = down(y, value);
    svg.append(
      node("line", { class: "grid", x1: AREA.left, x2: AREA.right, y1: at, y2: at }),
      node("text", { x: AREA.left - 8, y: at + 4, "text-anchor": "end" }, short(value)),
    );
  }
  for (const value of ticks(x.low, x.high, 5)) {
    const at = across(x, value);
    svg.append(node("text", { x: at, y: AREA.bottom + 18, "text-anchor": "middle" }, short(value)));
  }
  svg.append(
    node("text", { x: AREA.right, y: AREA.bottom + 34, "text-anchor": "end" }, "seconds of search"),
    node("text", { x: 8, y: AREA.bottom + 34 }, "metres"),
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
    const [px, py] = [across(x, at).toFixed(1), down(y, length).toFixed(1)];
    return index === 0 ? `M${px} ${py}` : `H${px}V${py}`;
  });
  return node("path", {
    d: `${steps.join("")}H${across(x, seconds).toFixed(1)}`,
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
    const name = runs[index]?.planner ?? "";
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
