import { expect, test } from "@playwright/test";
import { link, Playground } from "./page";

/** A MovingAI map: a room of so many cells, with a wall across it that leaves a door. */
function room(cells: number): string {
  const rows = Array.from({ length: cells }, (_, row) =>
    Array.from({ length: cells }, (_, column) =>
      row === cells / 2 && column > cells / 5 ? "@" : ".",
    ).join(""),
  );
  return ["type octile", `height ${cells}`, `width ${cells}`, "map", ...rows, ""].join("\n");
}

/** A ROS map: a PGM image and its YAML. */
function rosPair(cells: number) {
  const pixels = Buffer.alloc(cells * cells, 254);
  pixels.fill(0, 0, cells);
  return [
    {
      name: "depot.yaml",
      mimeType: "application/yaml",
      buffer: Buffer.from(
        "image: depot.pgm\nresolution: 0.1\norigin: [-5.0, -4.0, 0.0]\nnegate: 0\n" +
          "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
      ),
    },
    {
      name: "depot.pgm",
      mimeType: "image/x-portable-graymap",
      buffer: Buffer.concat([Buffer.from(`P5\n${cells} ${cells}\n255\n`), pixels]),
    },
  ];
}

const ROOM = { name: "room.map", mimeType: "text/plain", buffer: Buffer.from(room(200)) };
const BROKEN = { name: "broken.png", mimeType: "image/png", buffer: Buffer.from("not a picture") };

test("an uploaded map is planned on, with ends far apart to begin with", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  await page.locator("#upload-files").setInputFiles(ROOM);
  await expect(page.locator("#facts")).toContainText("200 × 200 cells");
  await expect(page.locator("#facts")).toContainText("room");
  const { length } = await playground.figures();
  expect(length).toBeGreaterThan(13); // around the wall of a room of 10 x 10 m
  await expect(page.locator("#hint")).toContainText("starts");
  await playground.clickAt(5, 2);
  await playground.clickAt(8, 2);
  await expect.poll(async () => (await playground.figures()).length).toBeLessThan(3.2);
});

test("a ROS map keeps its resolution and origin", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  await page.locator("#upload-files").setInputFiles(rosPair(120));
  await expect(page.locator("#facts")).toContainText("12.0 × 12.0 m · 120 × 120 cells");
  await playground.planned();
  const { x, y } = await playground.place("start");
  expect(x).toBeLessThan(-4);
  expect(y).toBeLessThan(-3);
});

test("a damaged file is refused in words, and the map stays", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  await page.locator("#upload-files").setInputFiles(BROKEN);
  await expect(page.getByRole("alert")).toContainText("broken.png");
  await expect(page.locator("#facts")).toContainText("forest 1");
  await page.getByRole("button", { name: "Close" }).first().click();
  await expect(page.getByRole("alert")).toBeHidden();
});

test("what is wrong with the start is told even after a damaged file", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({ edits: "w1,12,12" }));
  await page.locator("#upload-files").setInputFiles(BROKEN);
  const alert = page.getByRole("alert");
  await expect(alert).toContainText("broken.png");
  await playground.choose("Start");
  await playground.clickAt(12, 12);
  await expect(alert).toContainText("in collision at the start");
  await alert.getByRole("button", { name: "Close" }).click();
  await expect(alert).toBeHidden();
});

test("a list of maps that cannot be had is told of", async ({ page }) => {
  const playground = new Playground(page);
  const failures: string[] = [];
  page.on("pageerror", ({ message }) => failures.push(message));
  await playground.open(link({}));
  await page.route("**/maps", (route) =>
    route.request().method() === "GET"
      ? route.fulfill({ status: 500, json: { error: "InternalError", message: "no list today" } })
      : route.continue(),
  );
  await page.locator("#upload-files").setInputFiles(ROOM);
  await expect(page.getByRole("alert")).toContainText("list today");
  await expect(page.locator("#facts")).toContainText("room");
  await expect(page.locator("#upload-files")).toHaveValue("");
  expect(failures).toEqual([]);
});

test("of two maps, the one asked for last is shown", async ({ page }) => {
  await new Playground(page).open(link({}));
  await page.route("**/maps/generate", async (route) => {
    if (route.request().postDataJSON().kind === "forest") {
      await new Promise((resolve) => setTimeout(resolve, 2000));
    }
    await route.continue();
  });
  await page.locator("#map-seed").fill("3"); // asks for a forest when the focus leaves it
  await page.getByRole("button", { name: "Maze" }).click();
  await expect(page.locator("#facts")).toContainText("maze 3");
  await page.waitForTimeout(3000);
  await expect(page.locator("#facts")).toContainText("maze 3");
});

test("maps are generated from a kind and a seed", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  await page.locator("#map-seed").fill("3");
  await page.getByRole("button", { name: "Maze" }).click();
  await expect(page.locator("#facts")).toContainText("maze 3");
  await playground.planned();
  await expect(page).toHaveURL(/map=maze,3,24,24/);
});

test("maps of the server can be opened again", async ({ page }) => {
  const playground = new Playground(page);
  await playground.open(link({}));
  await page.locator("#upload-files").setInputFiles(rosPair(100));
  await expect(page.locator("#facts")).toContainText("100 × 100 cells");
  await page.getByRole("button", { name: "Forest" }).click();
  await expect(page.locator("#facts")).toContainText("480 × 480 cells");
  await page.locator("#maps").selectOption({ label: "depot, 100 × 100" });
  await expect(page.locator("#facts")).toContainText("100 × 100 cells");
});
