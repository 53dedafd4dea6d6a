import { expect, test } from "@playwright/test";
import { link, middle, Playground } from "./page";

const PATH: [number, number, number] = [18, 87, 214];

test("opens with a plan, and asks nobody but the server", async ({ page }) => {
  const hosts = new Set<string>();
  const errors: string[] = [];
  page.on("request", (request) => hosts.add(new URL(request.url()).host));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(error.message));
  const playground = new Playground(page);
  await playground.open();
  const { length, vertices } = await playground.figures();
  expect(length).toBeGreaterThan(30); // the README's problem
  expect(length).toBeLessThan(36);
  expect(vertices).toBeGreaterThan(50);
  expect(await playground.pixels(PATH)).toBeGreaterThan(500);
  await expect(page.locator("#facts")).toContainText("480 × 480 cells");
  expect([...hosts]).toHaveLength(1);
  expect(errors).toEqual([]);
});

test("plans between the points that are clicked", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  await playground.choose("Start");
  await expect(page.locator("#hint")).toContainText("starts");
  await playground.clickAt(3, 3);
  await expect(page.locator("#hint")).toContainText("go");
  await playground.clickAt(12, 12);
  await expect(page.locator("#hint")).toBeHidden();
  await expect.poll(async () => (await playground.place("goal")).x).toBeCloseTo(12, 0);
  await expect.poll(async () => (await playground.figures()).length).toBeLessThan(16);
  expect((await playground.figures()).length).toBeGreaterThan(12.6); // as the crow flies: 12.7
});

test("replans while the goal is dragged", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  const before = await playground.figures();
  await page.evaluate(() => {
    const time = document.querySelector("[data-figure=time]")!;
    const replans = new Set<string>();
    new MutationObserver(() => replans.add(time.textContent ?? "")).observe(time, {
      childList: true,
    });
    Object.assign(window, { replans });
  });
  await playground.page.mouse.move(0, 0);
  const goal = (await playground.handle("goal").boundingBox())!;
  await page.mouse.move(goal.x + 20, goal.y + 20);
  await page.mouse.down();
  for (let step = 1; step <= 20; step++) {
    await page.mouse.move(goal.x + 20 - 6 * step, goal.y + 20 + 6 * step);
    await page.waitForTimeout(50);
  }
  const replans = await page.evaluate(
    () => (window as unknown as { replans: Set<string> }).replans.size,
  );
  expect(replans).toBeGreaterThan(2); // with the button still down
  await page.mouse.up();
  const { x, y } = await playground.place("goal");
  expect(x).toBeLessThan(19);
  expect(y).toBeLessThan(19);
  await expect
    .poll(async () => (await playground.figures()).length)
    .toBeLessThan(before.length - 2);
});

test("a drag that the system ends is followed by a whole plan", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  const goal = playground.handle("goal");
  await goal.evaluate((handle: HTMLElement) => {
    let moves = 0;
    handle.addEventListener("pointermove", ({ pointerId }) => {
      if (++moves === 5) handle.releasePointerCapture(pointerId);
    });
  });
  const whole = page.waitForRequest("**/plan/stream");
  const { x, y } = await middle(goal);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 60, y + 60, { steps: 12 });
  await whole; // with the button still down
  await page.mouse.up();
});

test("a wall changes the path, an undo brings it back", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({ time: "2" })); // a busy machine finds a way round within it too
  const before = await playground.figures();
  await playground.choose("Wall");
  await playground.stroke([3, 21], [17, 7]);
  await expect(page.locator("#undo")).toBeEnabled();
  await expect
    .poll(async () => (await playground.figures()).length)
    .toBeGreaterThan(before.length + 0.5);
  await page.locator("#undo").click();
  await expect
    .poll(async () => (await playground.figures()).length)
    .toBeLessThan(before.length + 0.4);
  await expect(page.locator("#undo")).toBeDisabled();
});

test("Ctrl+Z takes a stroke back, and Ctrl+Shift+Z does not", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  await playground.choose("Wall");
  await playground.stroke([8, 16], [12, 12]);
  await expect(page.locator("#undo")).toBeEnabled();
  await page.keyboard.press("Control+Shift+Z");
  await playground.planned();
  await expect(page.locator("#undo")).toBeEnabled();
  await page.keyboard.press("Control+Z");
  await expect(page.locator("#undo")).toBeDisabled();
});

test("an opening lets a path through that a wall had closed", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({ edits: "w0.3,0,12,24,12", time: "2" }));
  await expect(playground.figure("status")).toHaveText("none (unreachable)");
  await playground.choose("Erase");
  await playground.stroke([11, 11], [11, 13.2]);
  await expect(playground.figure("status")).toHaveText(/^found/);
});

test("heading handles turn a car, and the path leaves along the heading", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(
    link({ robot: "dubins,0.2,0.55", run: "RRTstar,mpt-dubins,0", time: "0.6" }),
  );
  const before = await playground.figures();
  expect((await playground.place("start")).heading).toBe(0);
  const start = (await playground.handle("start").boundingBox())!;
  const knob = (await playground.knob("start").boundingBox())!;
  await page.mouse.move(knob.x + knob.width / 2, knob.y + knob.height / 2);
  await page.mouse.down();
  await page.mouse.move(start.x + 20, start.y - 40, { steps: 8 });
  await page.mouse.up();
  expect((await playground.place("start")).heading).toBe(90);
  await expect.poll(async () => (await playground.figures()).length).not.toBe(before.length);
  const download = page.waitForEvent("download");
  await page.locator("#export summary").click();
  await page.locator("#export-csv").click();
  const stream = await (await download).createReadStream();
  const lines = (await stream.toArray()).join("").trim().split("\n");
  expect(lines[0]).toBe("x,y,yaw");
  expect(lines[1]!.split(",").map(Number)).toEqual([2, 2, expect.closeTo(Math.PI / 2, 2)]);
});

test("a wider turning radius gives another path", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(
    link({ robot: "dubins,0.2,0.55", run: "RRTstar,mpt-dubins,0", time: "0.6" }),
  );
  const before = await playground.figures();
  await page.locator("#turning").fill("0.8");
  await expect(page.locator("#turning-value")).toHaveText("0.80 m");
  await expect.poll(async () => (await playground.figures()).length).not.toBe(before.length);
});

test("compares planners side by side, with a chart", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  await page.locator("#add-run").click();
  await page.locator("#add-run").click();
  await expect(page.locator(".panel")).toHaveCount(3);
  const [guided, unguided, other] = [
    await playground.figures(0),
    await playground.figures(1),
    await playground.figures(2),
  ];
  for (const { length } of [guided, unguided, other]) expect(length).toBeGreaterThan(27);
  await expect(page.locator("#chart-legend li")).toHaveText([
    "RRTstar · mpt",
    "RRTstar",
    "BITstar · mpt",
  ]);
  await expect(page.locator("#chart-body path")).toHaveCount(3);
  await playground.panel(1).getByLabel("Remove this planner").click();
  await expect(page.locator(".panel")).toHaveCount(2);
  await expect(page.locator("#chart-legend li")).toHaveText(["RRTstar · mpt", "BITstar · mpt"]);
});

test("a start in an obstacle is said in words, with a way out", async ({ page }) => {
  const playground = new Playground(page);
  await page.goto(`./${link({ edits: "w1,2,2" })}`);
  const alert = page.getByRole("alert");
  await expect(alert).toContainText("in collision at the start (2");
  expect(await playground.pixels(PATH)).toBeLessThan(20);
  await alert.getByRole("button", { name: "Move the start to the nearest free point" }).click();
  await expect(alert).toBeHidden();
  const { length } = await playground.figures();
  expect(length).toBeGreaterThan(25);
});

test("a search that breaks off is told of", async ({ page }) => {
  await page.route("**/plan/stream", (route) =>
    route.fulfill({ contentType: "text/event-stream", body: ": at work\n\n" }),
  );
  await page.goto(`./${link({})}`);
  await expect(page.getByRole("alert")).toContainText("does not answer");
  await expect(new Playground(page).figure("status")).toHaveText("no plan");
});

test("layers can be hidden", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  const shown = await playground.pixels(PATH);
  await page.locator("[data-layer=path]").uncheck();
  await expect.poll(() => playground.pixels(PATH)).toBeLessThan(shown / 10);
  await page.locator("[data-layer=heat]").uncheck();
  await page.locator("[data-layer=tree]").uncheck();
  await page.locator("[data-layer=region]").check();
  await expect.poll(() => playground.pixels([179, 95, 147])).toBeGreaterThan(100); // its outline
});

test("nothing is drawn while nothing changes and the tree is hidden", async ({ page }) => {
  await page.addInitScript(() => {
    const counter = { frames: 0 };
    const request = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (callback) => {
      counter.frames++;
      return request(callback);
    };
    Object.assign(window, { counter });
  });
  const playground = new Playground(page);
  await playground.open(link({}));
  await page.locator("[data-layer=tree]").uncheck();
  await page.locator("#plan").click();
  await playground.planned();
  const frames = () =>
    page.evaluate(() => (window as never as { counter: { frames: number } }).counter.frames);
  const framesInAWhile = async () => {
    const before = await frames();
    await page.waitForTimeout(500);
    return (await frames()) - before;
  };
  await expect.poll(framesInAWhile).toBe(0);
});

test("drives along the path and stops at the goal", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  const still = await playground.pixels(PATH);
  await page.locator("#drive").click();
  await expect(page.locator("#drive")).toHaveText("■ Stop");
  await expect.poll(() => playground.pixels(PATH)).toBeGreaterThan(still + 60); // the robot
  await expect(page.locator("#drive")).toHaveText("▶ Drive");
  await expect.poll(() => playground.pixels(PATH)).toBeLessThan(still + 20);
});
