/** A search tree on a canvas of its own, so that tens of thousands of edges are drawn once: new ones
 * are added as they come, and moving the view moves the image until it rests.
 */

import type { TreeResponse } from "../api/types";
import { between, type Size, type View, worldMatrix } from "../geometry/view";
import { TreeLines } from "../model/tree";

/** Segments a stroke: one stroke of all would take the browser many times as long. */
const BATCH = 500;
const WIDTH = 0.8;
const [LEAST_OPACITY, MOST_OPACITY] = [0.22, 0.75];
/** Vertices up to which a tree is drawn with full opacity. */
const SPARSE = 600;
/** Edges that moved are drawn anew only after this many times what that took the last time. */
const PATIENCE = 8;

export class TreeLayer {
  private canvas: OffscreenCanvas | null = null;
  private context: OffscreenCanvasRenderingContext2D | null = null;
  private lines = new TreeLines();
  /** The view, size and colour of the image; null where there is none. */
  private view: View | null = null;
  private key = "";
  private drawn = 0;
  private stale = false;
  private cost = 0;
  private drawnAt = Number.NEGATIVE_INFINITY;

  clear(): void {
    this.lines = new TreeLines();
    this.view = null;
    this.stale = false;
  }

  add(tree: TreeResponse): void {
    if (this.lines.add(tree)) this.stale = true;
    this.drawn = Math.min(this.drawn, this.lines.vertices);
  }

  /** Whether the image lags behind and wants to be drawn again when there is time. */
  get lags(): boolean {
    return this.stale && this.lines.vertices > 0;
  }

  /** Draws on a context in device pixels. While the view `moves`, a former image is good enough. */
  draw(
    target: CanvasRenderingContext2D,
    view: View,
    size: Size,
    ratio: number,
    colour: string,
    moves: boolean,
  ): void {
    if (this.lines.vertices === 0) return;
    const key = `${size.width} ${size.height} ${ratio} ${colour}`;
    const moved = this.view?.scale !== view.scale || this.view.centre !== view.centre;
    const patient = performance.now() - this.drawnAt < PATIENCE * this.cost;
    if (!this.view || key !== this.key || (moved && !moves) || (this.stale && !patient)) {
      this.drawAll(view, size, ratio, colour);
      this.key = key;
    } else {
      this.drawNew(this.view, size, ratio, colour);
    }
    const { scale, dx, dy } = between(this.view!, view, size);
    target.setTransform(scale, 0, 0, scale, dx * ratio, dy * ratio);
    target.globalAlpha = opacity(this.lines.vertices);
    target.drawImage(this.canvas!, 0, 0);
    target.globalAlpha = 1;
  }

  private drawAll(view: View, size: Size, ratio: number, colour: string): void {
    const begun = performance.now();
    this.canvas ??= new OffscreenCanvas(1, 1);
    this.context ??= this.canvas.getContext("2d")!;
    this.canvas.width = Math.max(1, Math.round(size.width * ratio)); // clears it, too
    this.canvas.height = Math.max(1, Math.round(size.height * ratio));
    this.view = view;
    this.drawn = 0;
    this.stale = false;
    this.drawNew(view, size, ratio, colour);
    const { lines } = this;
    strokeEdges(this.context, lines.links, (link) => lines.linkCurve(link), 0);
    this.drawnAt = performance.now();
    this.cost = this.drawnAt - begun;
  }

  private drawNew(view: View, size: Size, ratio: number, colour: string): void {
    const context = this.context!;
    context.setTransform(...worldMatrix(view, size, ratio));
    context.strokeStyle = colour;
    context.lineWidth = WIDTH / view.scale;
    const { lines } = this;
    strokeEdges(context, lines.segments, (segment) => lines.curve(segment), this.drawn);
    this.drawn = this.lines.vertices;
  }
}

function strokeEdges(
  context: OffscreenCanvasRenderingContext2D,
  segments: Float32Array,
  curveOf: (segment: number) => readonly number[],
  first: number,
): void {
  for (let from = 4 * first; from < segments.length; from += 4 * BATCH) {
    context.beginPath();
    for (let i = from; i < Math.min(from + 4 * BATCH, segments.length); i += 4) {
      context.moveTo(segments[i]!, segments[i + 1]!);
      const curve = curveOf(i / 4);
      for (let j = 0; j + 1 < curve.length; j += 2) context.lineTo(curve[j]!, curve[j + 1]!);
      context.lineTo(segments[i + 2]!, segments[i + 3]!);
    }
    context.stroke();
  }
}

/** Lower for a dense tree, so that the heat map shows through. */
function opacity(vertices: number): number {
  return Math.max(LEAST_OPACITY, MOST_OPACITY * Math.min(1, Math.sqrt(SPARSE / vertices)));
}
