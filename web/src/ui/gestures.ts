/** Pointers and wheel on a canvas: drags, clicks and pinches, in its CSS pixels. */

import type { Point } from "../geometry/points";

export interface GestureTarget {
  /** A drag with one finger or the mouse. */
  dragStart(at: Point): void;
  dragMove(at: Point, from: Point): void;
  /** `cancelled`: a second finger came down, or the system took the pointer. */
  dragEnd(at: Point, cancelled: boolean): void;
  /** A press that did not move. */
  click(at: Point): void;
  /** Two fingers or the wheel: what was at `from` is now at `to`, so many times as large. */
  pinch(from: Point, to: Point, factor: number): void;
}

/** A press that moves fewer pixels is a click. */
const SLACK = 5;
const WHEEL_SPEED = 0.0015;

export function listenToGestures(element: HTMLElement, target: GestureTarget): void {
  const fingers = new Map<number, Point>();
  let begun: Point | null = null;
  let moved = false;

  const position = (event: MouseEvent): Point => {
    const box = element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };

  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    element.setPointerCapture(event.pointerId);
    const at = position(event);
    fingers.set(event.pointerId, at);
    if (fingers.size === 1) {
      begun = at;
      moved = false;
      target.dragStart(at);
    } else if (begun) {
      begun = null;
      target.dragEnd(at, true);
    }
  });

  element.addEventListener("pointermove", (event) => {
    const from = fingers.get(event.pointerId);
    if (!from) return;
    const at = position(event);
    const before = [...fingers.values()];
    fingers.set(event.pointerId, at);
    if (fingers.size === 2) {
      const [first, second] = before as [Point, Point];
      const [newFirst, newSecond] = [...fingers.values()] as [Point, Point];
      target.pinch(
        middle(first, second),
        middle(newFirst, newSecond),
        span(newFirst, newSecond) / Math.max(span(first, second), 1),
      );
    } else if (begun) {
      moved ||= span(begun, at) > SLACK;
      if (moved) target.dragMove(at, from);
    }
  });

  const end = (event: PointerEvent, cancelled: boolean) => {
    if (!fingers.delete(event.pointerId) || !begun) return;
    begun = null;
    const at = position(event);
    target.dragEnd(at, cancelled);
    if (!moved && !cancelled) target.click(at);
  };
  element.addEventListener("pointerup", (event) => end(event, false));
  element.addEventListener("pointercancel", (event) => end(event, true));

  element.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const at = position(event);
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
      target.pinch(at, at, Math.exp(-event.deltaY * lines * WHEEL_SPEED));
    },
    { passive: false },
  );
}

function middle(a: Point, b: Point): Point {
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
}

function span(a: Point, b: Point): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
