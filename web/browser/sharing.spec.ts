import { execFile } from "node:child_process";
import { readFile, writeFile } from "node:fs/promises";
import { promisify } from "node:util";
import { expect, type Page, test } from "@playwright/test";
import { link, Playground } from "./page";

const PYTHON = process.env.PYTHON ?? "python3";

async function exported(page: Page, item: string): Promise<{ name: string; content: string }> {
  const download = page.waitForEvent("download");
  await page.locator("#export summary").click();
  await page.locator(item).click();
  const done = await download;
  return { name: done.suggestedFilename(), content: await readFile(await done.path(), "utf8") };
}

test("a link restores the problem on another page", async ({ page, context }) => {
  const playground = new Playground(page);
  await playground.open(link({ robot: "dubins,0.25,0.7", run: "RRTstar,mpt-dubins,0.1" }));
  await page.locator("#add-run").click();
  await playground.choose("Wall");
  await playground.stroke([8, 16], [12, 12]);
  await expect(page.locator("#undo")).toBeEnabled();
  await playground.choose("Move");
  await playground.drag(playground.handle("goal"), 0, 12);
  await playground.planned(1);
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.locator("#share").click();
  await expect(page.locator("#toast")).toHaveText("Link copied");
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  expect(copied).toBe(page.url());
  expect(copied).toContain("edits=w0.25,8");

  const second = new Playground(await context.newPage());
  await second.page.goto(copied);
  await second.planned(1);
  expect(second.page.url()).toBe(copied); // the map made again has the same content
  expect(await second.place("goal")).toEqual(await playground.place("goal"));
  await expect(second.page.locator("#radius-value")).toHaveText("0.25 m");
  await expect(second.page.locator("#turning-value")).toHaveText("0.70 m");
  await expect(second.page.locator("#seed")).toHaveValue("1");
  await expect(second.panel(1).getByLabel("Guide")).toHaveValue("none");
});

test("a damaged link opens the first problem, and says so", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open("#map=jungle&start=here");
  await expect(page.locator("#facts")).toContainText("indoor");
  await expect(page.getByRole("alert")).toContainText("This link is damaged");
});

test("a link whose map cannot be had for now stays until something changes", async ({ page }) => {
  const playground = new Playground(page);
  await page.route("**/maps/0000000000000000", (route) =>
    route.fulfill({
      status: 503,
      headers: { "retry-after": "3600" },
      json: { error: "ShuttingDown", message: "back in an hour" },
    }),
  );
  const fragment = link({});
  await playground.open(fragment);
  await expect(page.locator("#facts")).toContainText("indoor");
  await expect(page.getByRole("alert")).toContainText("in an hour");
  expect(new URL(page.url()).hash).toBe(fragment);
  await page.locator("#add-run").click();
  await expect(page).toHaveURL(/map=indoor/);
});

test("the path can be taken away as CSV and JSON", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  const { length } = await playground.figures();
  const csv = await exported(page, "#export-csv");
  expect(csv.name).toBe("path.csv");
  const states = csv.content.trim().split("\n").slice(1);
  expect(states[0]).toBe("2.0,2.0".replaceAll(".0", ""));
  const json = JSON.parse((await exported(page, "#export-json")).content);
  expect(json.length).toBeCloseTo(length, 2);
  expect(json.path).toHaveLength(states.length);
  expect(json).toMatchObject({ solved: true, planner: "RRTstar", guide: "mpt", seed: 1 });
});

test("the picture is a PNG of the size of the map", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  const { name, content } = await exported(page, "#export-picture");
  expect(name).toBe("plan.png");
  expect(content.slice(1, 4)).toBe("PNG");
  expect(content.length).toBeGreaterThan(10_000);
});

for (const [name, fields] of Object.entries({
  "a generated map": {},
  "an edited map and a car": {
    edits: "w0.3,9,15,10,14",
    robot: "reeds-shepp,0.2,0.55",
    run: "RRTstar,mpt-dubins,0.1",
    time: "1",
  },
})) {
  test(`the Python program for ${name} plans the same problem`, async ({ page }, info) => {
    const playground = new Playground(page);
    await playground.open(link(fields));
    const { length } = await playground.figures();
    await page.locator("#export summary").click();
    await page.locator("#export-python").click();
    const file = info.outputPath("plan.py");
    await writeFile(file, (await page.locator("#code").textContent()) ?? "");
    const { stdout } = await promisify(execFile)(PYTHON, [file]);
    const [, found] = /PlanResult\(length=([\d.]+) m/.exec(stdout) ?? [];
    expect(Number(found)).toBeGreaterThan(0.8 * length);
    expect(Number(found)).toBeLessThan(1.25 * length);
  });
}
