import { expect, test } from "vitest";
import type { Point } from "../src/geometry/points";
import { listenToGestures } from "../src/ui/gestures";

test("a finger that stayed after a pinch begins the next one where it is", () => {
  const element = Object.assign(new EventTarget(), {
    setPointerCapture: () => {},
    getBoundingClientRect: () => ({ left: 0, top: 0 }),
  });
  const pinches: { from: Point; to: Point; factor: number }[] = [];
  listenToGestures(element as unknown as HTMLElement, {
    dragStart: () => {},
    dragMove: () => {},
    dragEnd: () => {},
    click: () => {},
    pinch: (from, to, factor) => pinches.push({ from, to, factor }),
  });
  const send = (type: string, pointerId: number, clientX: number) =>
    element.dispatchEvent(
      Object.assign(new Event(type), { pointerId, clientX, clientY: 0, button: 0 }),
    );
  send("pointerdown", 1, 0);
  send("pointerdown", 2, 100);
  send("pointerup", 2, 100);
  send("pointermove", 1, 50);
  send("pointerdown", 3, 150);
  send("pointermove", 3, 250);
  expect(pinches).toEqual([{ from: { x: 100, y: 0 }, to: { x: 150, y: 0 }, factor: 2 }]);
});
