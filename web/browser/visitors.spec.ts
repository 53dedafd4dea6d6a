/** The page for those who use a keyboard, a phone, a dark room or a screen reader. */

import AxeBuilder from "@axe-core/playwright";
import { expect, test } from "@playwright/test";
import { link, middle, Playground } from "./page";

test("the keyboard moves, turns, swaps and compares", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({ robot: "dubins,0.2,0.55", run: "RRTstar,mpt-dubins,0" }));
  await playground.handle("goal").focus();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Shift+ArrowDown");
  await page.keyboard.press(",");
  expect(await playground.place("goal")).toEqual({ x: 21.45, y: 21, heading: 5 });
  await page.keyboard.press("x");
  expect(await playground.place("start")).toEqual({ x: 21.45, y: 21, heading: 5 });
  await page.keyboard.press("w");
  await expect(page.locator("[name=tool][value=wall]")).toBeChecked();
  await page.keyboard.press("Escape");
  await page.keyboard.press("c");
  await expect(page.locator(".panel")).toHaveCount(2);
  await page.keyboard.press("?");
  await expect(page.getByRole("dialog", { name: "Help" })).toBeVisible();
});

test("zooming keeps the ends on their places on the map", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  const before = await middle(playground.handle("start"));
  await page.mouse.move(before.x, before.y);
  const canvas = playground.panel().locator("canvas");
  const box = (await canvas.boundingBox())!;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.wheel(0, -400);
  await expect
    .poll(async () => (await middle(playground.handle("start"))).x)
    .toBeLessThan(before.x - 50);
  await page.keyboard.press("0");
  await expect
    .poll(async () => (await middle(playground.handle("start"))).x)
    .toBeCloseTo(before.x, 0);
  expect((await playground.place("start")).x).toBe(2);
});

for (const colorScheme of ["light", "dark"] as const) {
  test(`nothing bars the way for assistive technology (${colorScheme})`, async ({ page }) => {
    await page.emulateMedia({ colorScheme });
    const playground = new Playground(page);
    await playground.open(link({}));
    await page.locator("#add-run").click();
    await playground.planned(1);
    const { violations } = await new AxeBuilder({ page }).analyze();
    expect(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)])).toEqual([]);
  });
}

test("dark is dark, and the visitor's choice stays", async ({ page }) => {
  await page.emulateMedia({ colorScheme: "dark" });
  const playground = new Playground(page);
  await playground.open(link({}));
  expect(await playground.pixels([24, 29, 36])).toBeGreaterThan(10_000); // the dark floor
  await page.locator("#theme").click();
  await expect.poll(() => playground.pixels([251, 248, 241])).toBeGreaterThan(10_000);
  await page.reload();
  await playground.planned();
  expect(await playground.pixels([251, 248, 241])).toBeGreaterThan(10_000);
});

test.describe("on a phone", () => {
  test.use({ viewport: { width: 360, height: 740 }, hasTouch: true, deviceScaleFactor: 2 });

  test("the page is no wider than the screen", async ({ page }) => {
    const playground = new Playground(page);
    await playground.open(link({ robot: "dubins,0.2,0.55", run: "RRTstar,mpt-dubins,0" }));
    await page.locator("#add-run").click();
    await playground.planned(1);
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    expect(width).toBeLessThanOrEqual(360);
  });

  test("fingers place start and goal, and drag them", async ({ page }) => {
    const playground = new Playground(page);
    await playground.open(link({}));
    await playground.choose("Goal");
    const at = await playground.screen(12, 12);
    await page.touchscreen.tap(at.x, at.y);
    await expect.poll(async () => (await playground.place("goal")).x).toBeCloseTo(12, 0);
    const client = await page.context().newCDPSession(page);
    const from = await middle(playground.handle("goal"));
    const touch = (type: string, points: { x: number; y: number }[]) =>
      client.send("Input.dispatchTouchEvent", { type: type as "touchStart", touchPoints: points });
    await touch("touchStart", [from]);
    for (let step = 1; step <= 8; step++) {
      await touch("touchMove", [{ x: from.x + 5 * step, y: from.y - 5 * step }]);
    }
    await touch("touchEnd", []);
    const { x, y } = await playground.place("goal");
    expect(x).toBeGreaterThan(13.5);
    expect(y).toBeGreaterThan(13.5);
    await playground.planned();
  });

  test("two fingers zoom", async ({ page }) => {
    const playground = new Playground(page);
    await playground.open(link({}));
    const before = await middle(playground.handle("start"));
    const box = (await playground.panel().locator("canvas").boundingBox())!;
    const centre = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    const client = await page.context().newCDPSession(page);
    const fingers = (apart: number) => [
      { x: centre.x - apart, y: centre.y, id: 0 },
      { x: centre.x + apart, y: centre.y, id: 1 },
    ];
    await client.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: fingers(20) });
    for (const apart of [25, 30, 35, 40]) {
      await client.send("Input.dispatchTouchEvent", {
        type: "touchMove",
        touchPoints: fingers(apart),
      });
    }
    await client.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    const after = await middle(playground.handle("start"));
    expect(centre.x - after.x).toBeGreaterThan(1.7 * (centre.x - before.x));
  });
});
