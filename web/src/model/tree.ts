/** A search tree as line segments ready to draw, whole or as it grows. */

import type { TreeResponse } from "../api/types";

/** Coordinates that grow in number. */
class Floats {
  private values = new Float32Array(4096);
  length = 0;

  push4(a: number, b: number, c: number, d: number): void {
    if (this.length + 4 > this.values.length) {
      const larger = new Float32Array(2 * this.values.length);
      larger.set(this.values);
      this.values = larger;
    }
    this.set4(this.length, a, b, c, d);
    this.length += 4;
  }

  set4(at: number, a: number, b: number, c: number, d: number): void {
    this.values[at] = a;
    this.values[at + 1] = b;
    this.values[at + 2] = c;
    this.values[at + 3] = d;
  }

  shorten(length: number): void {
    this.length = Math.min(this.length, length);
  }

  get view(): Float32Array {
    return this.values.subarray(0, this.length);
  }
}

/** x0, y0, ... between the ends of an edge; none where it is straight. */
type Curve = readonly number[];

const STRAIGHT: Curve = [];

export class TreeLines {
  private edges = new Floats();
  private roadmap = new Floats();
  /** Of each vertex' edge, of each link; nothing for a point robot. */
  private edgeCurves: Curve[] = [];
  private linkCurves: Curve[] = [];

  /** x0, y0, x1, y1 in metres from each vertex's parent to the vertex; a point for a root. */
  get segments(): Float32Array {
    return this.edges.view;
  }

  /** The same for the further edges of a roadmap. */
  get links(): Float32Array {
    return this.roadmap.view;
  }

  /** What lies between the ends of a segment. */
  curve(segment: number): Curve {
    return this.edgeCurves[segment] ?? STRAIGHT;
  }

  /** What lies between the ends of a link. */
  linkCurve(link: number): Curve {
    return this.linkCurves[link] ?? STRAIGHT;
  }

  get vertices(): number {
    return this.edges.length / 4;
  }

  /**
   * Adds an increment: the vertices from `first` on are replaced by the new ones.
   *
   * @returns Whether segments that were there have changed.
   */
  add(tree: TreeResponse): boolean {
    const { first = 0, vertices, parents, changed = [], links = [], curves = [] } = tree;
    if (first > this.vertices) {
      throw new RangeError(`increment from vertex ${first} after ${this.vertices}`);
    }
    const replaces = first < this.vertices;
    this.edges.shorten(4 * first);
    this.append(vertices, parents);
    for (let i = 0; i + 1 < changed.length; i += 2) this.hang(changed[i]!, changed[i + 1]!);
    this.bend(first, parents.length, changed, curves);
    const hadLinks = this.roadmap.length > 0;
    this.roadmap = new Floats();
    for (let i = 0; i + 1 < links.length; i += 2) {
      this.roadmap.push4(...this.at(links[i]!), ...this.at(links[i + 1]!));
    }
    return replaces || changed.length > 0 || links.length > 0 || hadLinks;
  }

  private append(vertices: readonly number[], parents: readonly number[]): void {
    const first = this.vertices;
    for (let i = 0; i < parents.length; i++) {
      const [x, y] = [vertices[2 * i]!, vertices[2 * i + 1]!];
      this.edges.push4(x, y, x, y);
    }
    // A parent may come after its child.
    for (let i = 0; i < parents.length; i++) this.hang(first + i, parents[i]!);
  }

  /** Notes the curves of `count` vertices from `first` on, of changed ones and of links. */
  private bend(first: number, count: number, changed: readonly number[], curves: Curve[]): void {
    this.edgeCurves.length = Math.min(this.edgeCurves.length, first);
    if (curves.length === 0) return;
    for (let i = 0; i < count; i++) this.edgeCurves[first + i] = curves[i]!;
    for (let i = 0; 2 * i < changed.length; i++) {
      this.edgeCurves[changed[2 * i]!] = curves[count + i]!;
    }
    this.linkCurves = curves.slice(count + changed.length / 2);
  }

  /** Makes a vertex the child of another. */
  private hang(child: number, parent: number): void {
    const to = this.at(child);
    this.edges.set4(4 * child, ...(parent < 0 ? to : this.at(parent)), ...to);
  }

  private at(vertex: number): [number, number] {
    const { view } = this.edges;
    return [view[4 * vertex + 2]!, view[4 * vertex + 3]!];
  }
}
