/** What the tests do on the page and read off it, as a visitor would. */

import { expect, type Locator, type Page } from "@playwright/test";

export type End = "start" | "goal";

export interface Figures {
  length: number;
  vertices: number;
}

export class Playground {
  constructor(readonly page: Page) {}

  /** Opens the page and waits for its first plan. */
  async open(fragment = ""): Promise<void> {
    await this.page.goto(`./${fragment}`);
    await this.planned();
  }

  panel(index = 0): Locator {
    return this.page.locator(".panel").nth(index);
  }

  figure(name: string, index = 0): Locator {
    return this.panel(index).locator(`[data-figure=${name}]`);
  }

  private async text(name: string, index: number): Promise<string> {
    return (await this.figure(name, index).textContent()) ?? "";
  }

  handle(end: End): Locator {
    return this.panel().locator(`.handle[data-end=${end}]:not(.heading)`);
  }

  knob(end: End): Locator {
    return this.panel().locator(`.handle.heading[data-end=${end}]`);
  }

  /** Waits until the plan for what the page shows has ended, with a path or without. */
  async planned(index = 0): Promise<void> {
    await this.drawn();
    await expect(this.figure("status", index)).toHaveText(/^(found|none) \(/);
  }

  /** Waits until figures and pictures are those of the page's state: the next frame brings them. */
  private async drawn(): Promise<void> {
    await this.page.evaluate(
      () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
    );
  }

  async figures(index = 0): Promise<Figures> {
    await this.planned(index);
    const length = await this.text("length", index);
    const vertices = await this.text("vertices", index);
    return { length: Number.parseFloat(length), vertices: Number(vertices.replaceAll(",", "")) };
  }

  /** The end's place in the world, from what its handle tells screen readers. */
  async place(end: End): Promise<{ x: number; y: number; heading: number | null }> {
    const label = (await this.handle(end).getAttribute("aria-label"))!;
    const [, x, y, heading] = /at (-?[\d.]+), (-?[\d.]+) metres(?:, heading (-?\d+))?/.exec(label)!;
    return { x: Number(x), y: Number(y), heading: heading === undefined ? null : Number(heading) };
  }

  /** Drags something by so many pixels, in small steps. */
  async drag(what: Locator, dx: number, dy: number): Promise<void> {
    const { x, y } = await middle(what);
    await this.page.mouse.move(x, y);
    await this.page.mouse.down();
    await this.page.mouse.move(x + dx, y + dy, { steps: 12 });
    await this.page.mouse.up();
  }

  /** Where a point of the world is on the screen, by the places of start and goal. */
  async screen(x: number, y: number): Promise<{ x: number; y: number }> {
    const [start, goal] = [await this.place("start"), await this.place("goal")];
    const [from, to] = [await middle(this.handle("start")), await middle(this.handle("goal"))];
    const share = (value: number, a: number, b: number) => (value - a) / (b - a);
    return {
      x: from.x + share(x, start.x, goal.x) * (to.x - from.x),
      y: from.y + share(y, start.y, goal.y) * (to.y - from.y),
    };
  }

  async choose(tool: "Move" | "Start" | "Goal" | "Wall" | "Erase"): Promise<void> {
    await this.page.locator(".tools").getByText(tool, { exact: true }).click();
  }

  async clickAt(x: number, y: number): Promise<void> {
    const at = await this.screen(x, y);
    await this.page.mouse.click(at.x, at.y);
  }

  /** Draws or erases along a line between two points of the world. */
  async stroke(from: [number, number], to: [number, number]): Promise<void> {
    const [begin, end] = [await this.screen(...from), await this.screen(...to)];
    await this.page.mouse.move(begin.x, begin.y);
    await this.page.mouse.down();
    await this.page.mouse.move(end.x, end.y, { steps: 10 });
    await this.page.mouse.up();
  }

  /** How many pixels of a panel's picture have nearly this colour. */
  pixels(colour: [number, number, number], index = 0): Promise<number> {
    return this.panel(index)
      .locator("canvas")
      .evaluate((canvas: HTMLCanvasElement, wanted) => {
        const context = canvas.getContext("2d")!;
        const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
        let count = 0;
        for (let i = 0; i < data.length; i += 4) {
          if (wanted.every((value, channel) => Math.abs(data[i + channel]! - value) < 12)) count++;
        }
        return count;
      }, colour);
  }
}

export async function middle(what: Locator): Promise<{ x: number; y: number }> {
  const box = (await what.boundingBox())!;
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** Link to a problem on a map without obstacles but one: a square room with a gap at the top. */
export function link(fields: Record<string, string>): string {
  const all = {
    map: "forest,1,24,24,0.05",
    id: "0000000000000000", // unknown to the server: the map is made again
    robot: "point,0.1,0.55",
    start: "2,2,0",
    goal: "21.5,21.5,0",
    run: "RRTstar,mpt,0",
    time: "0.3",
    seed: "1",
    ...fields,
  };
  return `#${Object.entries(all)
    .map(([key, value]) => `${key}=${value}`)
    .join("&")}`;
}
