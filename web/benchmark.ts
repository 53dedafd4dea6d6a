/**
 * Measures the page in Chromium on this machine and writes what it finds as JSON:
 *
 *     node web/benchmark.ts [benchmarks/results/playground/playground.json]
 *
 * PYTHON names the interpreter that has planformer, CHROMIUM the browser. Frames: replans that
 * were drawn while the goal of a plan on 480 x 480 cells was dragged, in a second.
 */

import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { cpus, loadavg } from "node:os";
import { dirname } from "node:path";
import { type Browser, chromium, type Page } from "@playwright/test";

const PYTHON = process.env.PYTHON ?? "python3";
const PORT = 8766;
const URL = `http://127.0.0.1:${PORT}/`;
const DRAG_SECONDS = 5;
const MOUSE_HERTZ = 60;
const ROUNDS = 5;
const TREE_EDGES = 50_000;

const PROBLEMS = {
  indoor: "",
  forest:
    "#map=forest,1,24,24,0.05&id=0000000000000000&robot=point,0.1,0.55&start=2,2,0" +
    "&goal=21.5,21.5,0&run=RRTstar,mpt,0&time=0.5&seed=1",
  "forest, Dubins car":
    "#map=forest,1,24,24,0.05&id=0000000000000000&robot=dubins,0.2,0.55&start=2,2,0" +
    "&goal=21.5,21.5,0&run=RRTstar,mpt-dubins,0&time=0.5&seed=1",
};

function median(values: number[]): number {
  return values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)]!;
}

async function open(browser: Browser, fragment: string): Promise<Page> {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  await page.goto(URL + fragment);
  await page.locator("[data-figure=status]", { hasText: "(" }).waitFor();
  return page;
}

/** Replans drawn a second while a mouse of 60 Hz drags the goal round a small circle. */
async function dragFrames(page: Page): Promise<number> {
  const goal = (await page.locator(".handle[data-end=goal]:not(.heading)").boundingBox())!;
  const [x, y] = [goal.x + goal.width / 2 - 10, goal.y + goal.height / 2 + 10];
  await page.evaluate(() => {
    const counter = { frames: 0 };
    // The figures change, all at once, in the frame in which the plan is drawn.
    new MutationObserver(() => counter.frames++).observe(document.querySelector(".stats")!, {
      childList: true,
      subtree: true,
    });
    Object.assign(window, { counter });
  });
  const frames = () =>
    page.evaluate(() => (window as never as { counter: { frames: number } }).counter.frames);
  await page.mouse.move(x + 10, y - 10);
  await page.mouse.down();
  await page.mouse.move(x, y);
  const before = await frames();
  const moves: Promise<void>[] = [];
  const begun = performance.now();
  while (performance.now() - begun < 1000 * DRAG_SECONDS) {
    const angle = (performance.now() - begun) / 200;
    moves.push(page.mouse.move(x + 8 * Math.cos(angle), y + 8 * Math.sin(angle)));
    await new Promise((resolve) => setTimeout(resolve, 1000 / MOUSE_HERTZ));
  }
  const rate = ((await frames()) - before) / ((performance.now() - begun) / 1000);
  await Promise.all(moves);
  await page.mouse.up();
  return rate;
}

/** A plan whose tree has so many edges, each to a vertex near its parent. */
function largePlan(edges: number): string {
  const vertices = [12, 12];
  const parents = [-1];
  for (let i = 1; i <= edges; i++) {
    const parent = Math.floor((((i * 2654435761) % 2 ** 32) / 2 ** 32) * i);
    const clamp = (value: number) => Math.min(Math.max(value, 0.5), 23.5);
    vertices.push(
      clamp(vertices[2 * parent]! + Math.cos(i)),
      clamp(vertices[2 * parent + 1]! + Math.sin(i)),
    );
    parents.push(parent);
  }
  const result = {
    solved: false,
    status: "time limit",
    path: [],
    length: null,
    vertices: edges + 1,
    planning_seconds: 1,
    proposal_seconds: 0,
    total_seconds: 1,
    planner: "RRTstar",
    guide: null,
    seed: 1,
    region: null,
    tree: { vertices, parents, links: [] },
  };
  return `event: result\ndata: ${JSON.stringify(result)}\n\n`;
}

/** Frames a second while a map with a large tree is moved, and the longest of them in ms. */
async function panFrames(browser: Browser): Promise<{ per_second: number; longest_ms: number }> {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  await page.route("**/plan/stream", (route) =>
    route.fulfill({ contentType: "text/event-stream", body: largePlan(TREE_EDGES) }),
  );
  await page.goto(URL);
  await page.locator("[data-figure=status]", { hasText: "(" }).waitFor();
  await page.waitForTimeout(1000);
  const box = (await page.locator(".view canvas").boundingBox())!;
  const [x, y] = [box.x + box.width / 4, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.evaluate(() => {
    const times: number[] = [];
    const tick = (time: number) => {
      times.push(time);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
    Object.assign(window, { times });
  });
  const moves: Promise<void>[] = [];
  const begun = performance.now();
  while (performance.now() - begun < 1000 * DRAG_SECONDS) {
    const angle = (performance.now() - begun) / 300;
    moves.push(page.mouse.move(x + 60 * Math.cos(angle), y + 60 * Math.sin(angle)));
    await new Promise((resolve) => setTimeout(resolve, 1000 / MOUSE_HERTZ));
  }
  await Promise.all(moves);
  const times = await page.evaluate(() => (window as never as { times: number[] }).times);
  await page.close();
  const gaps = times.slice(1).map((time, index) => time - times[index]!);
  return {
    per_second: Number((1000 / (gaps.reduce((sum, gap) => sum + gap, 0) / gaps.length)).toFixed(1)),
    longest_ms: Number(Math.max(...gaps).toFixed(0)),
  };
}

/** Milliseconds until the first paint with content, and kilobytes that came over the line. */
async function load(browser: Browser): Promise<{ paint: number; kilobytes: number }> {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  await page.goto(URL, { waitUntil: "load" });
  await page.waitForFunction(() => performance.getEntriesByName("first-contentful-paint").length);
  const found = await page.evaluate(() => {
    const files = performance
      .getEntriesByType("resource")
      .filter(({ name }) => name.includes("/assets/")) as PerformanceResourceTiming[];
    const [document] = performance.getEntriesByType("navigation") as PerformanceResourceTiming[];
    return {
      paint: performance.getEntriesByName("first-contentful-paint")[0]!.startTime,
      kilobytes: [document!, ...files].reduce((sum, file) => sum + file.encodedBodySize, 0) / 1000,
    };
  });
  await page.close();
  return found;
}

async function measure(browser: Browser) {
  const loads = [];
  for (let round = 0; round < ROUNDS; round++) loads.push(await load(browser));
  const frames: Record<string, number> = {};
  for (const [name, fragment] of Object.entries(PROBLEMS)) {
    const page = await open(browser, fragment);
    frames[name] = Number((await dragFrames(page)).toFixed(1));
    await page.close();
  }
  return {
    first_paint_ms: Number(median(loads.map(({ paint }) => paint)).toFixed(0)),
    page_weight_kb: Number(median(loads.map(({ kilobytes }) => kilobytes)).toFixed(1)),
    drag_frames_per_second: frames,
    pan_frames_with_50000_edges: await panFrames(browser),
  };
}

async function untilUp(): Promise<void> {
  for (let tries = 0; tries < 300; tries++) {
    if (await fetch(`${URL}health`).catch(() => null)) return;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  throw new Error("planformer serve did not start");
}

const output = process.argv[2] ?? "benchmarks/results/playground/playground.json";
const server = spawn(PYTHON, ["-m", "planformer.cli", "serve", "--port", String(PORT)], {
  stdio: "ignore",
});
try {
  await untilUp();
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu"],
  });
  const record = {
    command: `node web/benchmark.ts ${output}`,
    commit: execFileSync("git", ["rev-parse", "HEAD"], { encoding: "utf8" }).trim(),
    date: new Date().toISOString().slice(0, 10),
    machine: { cpu: cpus()[0]!.model, cores: cpus().length, load: loadavg()[0] },
    browser: browser.version(),
    ...(await measure(browser)),
  };
  await browser.close();
  mkdirSync(dirname(output), { recursive: true });
  writeFileSync(output, `${JSON.stringify(record, null, 2)}\n`);
  console.log(JSON.stringify(record, null, 2));
} finally {
  server.kill("SIGINT");
}
