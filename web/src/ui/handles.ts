/** Start and goal, and the knobs that turn a car: buttons over the canvas, so that mouse, touch,
 * keyboard and screen readers get hold of them.
 */

import type { App, End } from "../app/app";
import { HANDLE_ARM } from "../draw/scene";
import type { Point, Pose } from "../geometry/points";
import { wrapAngle } from "../geometry/points";
import { type Size, toScreen, toWorld, type View } from "../geometry/view";
import { isCar } from "../model/problem";
import { make } from "./dom";

const TURN = (5 * Math.PI) / 180;
const ARROWS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

export interface Lens {
  view: View;
  size: Size;
}

export class Handles {
  private readonly buttons: Record<End, HTMLButtonElement>;
  private readonly knobs: Record<End, HTMLButtonElement>;

  constructor(
    private readonly app: App,
    private readonly parent: HTMLElement,
    private readonly lens: () => Lens,
  ) {
    this.buttons = { start: this.button("start", false), goal: this.button("goal", false) };
    this.knobs = { start: this.button("start", true), goal: this.button("goal", true) };
    for (const end of ["start", "goal"] as const) {
      this.onDrag(this.buttons[end], (at, grip) => this.moveTo(end, at, grip));
      this.onDrag(this.knobs[end], (at) => this.turnTo(end, at));
      this.onKeys(end, this.buttons[end]);
      this.onKeys(end, this.knobs[end]);
    }
  }

  /** Puts the buttons where the ends are. */
  place(): void {
    const { problem } = this.app.store.current;
    if (!problem) return;
    const { view, size } = this.lens();
    const car = isCar(problem.robot);
    for (const end of ["start", "goal"] as const) {
      const pose = problem[end];
      const at = toScreen(view, size, pose);
      put(this.buttons[end], at);
      this.buttons[end].setAttribute("aria-label", label(end, pose, car));
      this.knobs[end].hidden = !car;
      put(this.knobs[end], {
        x: at.x + HANDLE_ARM * Math.cos(pose.yaw),
        y: at.y - HANDLE_ARM * Math.sin(pose.yaw),
      });
    }
  }

  private button(end: End, turns: boolean): HTMLButtonElement {
    const button = make("button", {
      type: "button",
      class: turns ? "handle heading" : "handle",
      "data-end": end,
      "aria-label": turns ? `Heading of the ${end}; comma and full stop turn it` : end,
    });
    this.parent.append(button);
    return button;
  }

  private onDrag(button: HTMLButtonElement, move: (at: Point, grip: Point) => void): void {
    /** From the handle's middle to where it was taken. */
    let grip: Point | null = null;
    const position = (event: PointerEvent): Point => {
      const box = this.parent.getBoundingClientRect();
      return { x: event.clientX - box.left, y: event.clientY - box.top };
    };
    button.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      button.setPointerCapture(event.pointerId);
      const box = button.getBoundingClientRect();
      grip = {
        x: event.clientX - (box.left + box.width / 2),
        y: event.clientY - (box.top + box.height / 2),
      };
    });
    button.addEventListener("pointermove", (event) => {
      if (grip) move(position(event), grip);
    });
    const end = () => {
      grip = null;
      this.app.rest();
    };
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
      button.addEventListener(name, end);
    }
  }

  private moveTo(end: End, at: Point, grip: Point): void {
    const { problem } = this.app.store.current;
    if (!problem) return;
    const { view, size } = this.lens();
    const world = toWorld(view, size, { x: at.x - grip.x, y: at.y - grip.y });
    this.app.moveEnd(end, { ...problem[end], ...world }, true);
  }

  private turnTo(end: End, at: Point): void {
    const { problem } = this.app.store.current;
    if (!problem) return;
    const { view, size } = this.lens();
    const world = toWorld(view, size, at);
    const pose = problem[end];
    const yaw = Math.atan2(world.y - pose.y, world.x - pose.x);
    this.app.moveEnd(end, { ...pose, yaw }, true);
  }

  private onKeys(end: End, button: HTMLButtonElement): void {
    button.addEventListener("keydown", (event) => {
      const { problem } = this.app.store.current;
      if (!problem || event.ctrlKey || event.metaKey || event.altKey) return;
      const pose = problem[end];
      const arrow = ARROWS[event.key];
      const turn = isCar(problem.robot) ? { ",": TURN, ".": -TURN }[event.key] : undefined;
      if (arrow) {
        const step = problem.map.resolution * (event.shiftKey ? 10 : 1);
        const [x, y] = [pose.x + step * arrow[0], pose.y + step * arrow[1]];
        this.app.moveEnd(end, { ...pose, x, y }, true);
      } else if (turn !== undefined) {
        this.app.moveEnd(end, { ...pose, yaw: wrapAngle(pose.yaw + turn) }, true);
      } else {
        return;
      }
      event.preventDefault();
      event.stopPropagation();
    });
    button.addEventListener("keyup", () => this.app.rest());
    button.addEventListener("blur", () => this.app.rest());
  }
}

function put(button: HTMLElement, { x, y }: Point): void {
  button.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
}

function label(end: End, { x, y, yaw }: Pose, car: boolean): string {
  const heading = car ? `, heading ${((yaw * 180) / Math.PI).toFixed(0)} degrees` : "";
  return `${end} at ${x.toFixed(2)}, ${y.toFixed(2)} metres${heading}; arrow keys move it`;
}
