/** The settings beside the map. */

import type { MapInfo, MapKind, RobotKind } from "../api/types";
import type { App } from "../app/app";
import { isCar } from "../model/problem";
import { byId, setChoices, setText } from "./dom";
import type { Stage } from "./stage";
import { metres } from "./words";

const OTHER = "";

export class Controls {
  private readonly mapSeed = byId<HTMLInputElement>("map-seed");
  private readonly mapSide = byId<HTMLInputElement>("map-side");
  private readonly files = byId<HTMLInputElement>("upload-files");
  private readonly maps = byId<HTMLSelectElement>("maps");
  private readonly radius = byId<HTMLInputElement>("radius");
  private readonly turning = byId<HTMLInputElement>("turning");
  private readonly time = byId<HTMLInputElement>("time");
  private readonly seed = byId<HTMLInputElement>("seed");
  private known: MapInfo[] = [];

  constructor(
    private readonly app: App,
    stage: Stage,
    private readonly upload: (files: Iterable<File>) => Promise<void>,
  ) {
    byId("controls").addEventListener("submit", (event) => event.preventDefault());
    this.time.max = String(app.options.limits.plan_seconds);
    this.listenToMaps();
    this.listenToRobot();
    this.listenToSearch();
    for (const box of document.querySelectorAll<HTMLInputElement>("[data-layer]")) {
      box.addEventListener("change", () => {
        stage.layers[box.dataset.layer as keyof Stage["layers"]] = box.checked;
        stage.invalidate();
      });
    }
  }

  /** Metres a cell for files that do not say; null for the default. */
  get resolution(): number | null {
    const { value } = byId<HTMLInputElement>("map-resolution");
    return value === "" ? null : Number(value);
  }

  update(): void {
    const { problem, limits } = this.app.store.current;
    setValue(this.time, limits.time);
    setText(byId("time-value"), `${limits.time.toFixed(1)} s`);
    setValue(this.seed, limits.seed ?? "");
    if (!problem) return;
    const { robot, source, map } = problem;
    const kind = document.querySelector<HTMLInputElement>(`[name=robot][value=${robot.kind}]`)!;
    kind.checked = true;
    setValue(this.radius, robot.radius);
    setText(byId("radius-value"), metres(robot.radius));
    byId("turning-field").hidden = !isCar(robot);
    setValue(this.turning, robot.turningRadius);
    setText(byId("turning-value"), metres(robot.turningRadius));
    if (source.kind === "generated") {
      setValue(this.mapSeed, source.request.seed);
      setValue(this.mapSide, source.request.width);
    }
    this.maps.value = this.known.some(({ id }) => id === map.id) ? map.id : OTHER;
  }

  /** Asks the server which maps it has. */
  async refreshMaps(): Promise<void> {
    const maps = await this.app.storedMaps();
    if (!maps) return;
    this.known = maps;
    byId("maps-field").hidden = this.known.length === 0;
    const choices = this.known.map(
      ({ id, name, columns, rows }) => [id, `${name}, ${columns} × ${rows}`] as const,
    );
    setChoices(this.maps, [[OTHER, "choose…"], ...choices], OTHER);
    this.update();
  }

  private listenToMaps(): void {
    const { app } = this;
    let kind: MapKind = "indoor";
    const generate = async () => {
      if (!this.mapSeed.checkValidity() || !this.mapSide.checkValidity()) return;
      await app.generate(kind, Number(this.mapSeed.value), Number(this.mapSide.value));
    };
    for (const button of document.querySelectorAll<HTMLElement>("[data-generate]")) {
      button.addEventListener("click", () => {
        const wanted = button.dataset.generate as MapKind;
        const { source } = app.store.current.problem ?? {};
        const again = source?.kind === "generated" && source.request.kind === wanted;
        if (again && Number(this.mapSeed.value) === source.request.seed) {
          this.mapSeed.value = String(source.request.seed + 1); // another one of the kind
        }
        kind = wanted;
        void generate();
      });
    }
    for (const input of [this.mapSeed, this.mapSide]) {
      input.addEventListener("change", () => {
        const { source } = app.store.current.problem ?? {};
        if (source?.kind === "generated") kind = source.request.kind;
        void generate();
      });
    }
    byId("upload").addEventListener("click", () => this.files.click());
    this.files.addEventListener("change", () => {
      const files = [...(this.files.files ?? [])];
      this.files.value = ""; // so that the same file can be chosen again
      void this.upload(files);
    });
    this.maps.addEventListener("change", () => {
      const chosen = this.known.find(({ id }) => id === this.maps.value);
      if (chosen) void app.open(chosen);
    });
  }

  private listenToRobot(): void {
    const { app } = this;
    for (const radio of document.querySelectorAll<HTMLInputElement>("[name=robot]")) {
      radio.addEventListener("change", () => app.setRobotKind(radio.value as RobotKind));
    }
    this.onSlide(this.radius, (radius) => app.setRobotSize({ radius }, true));
    this.onSlide(this.turning, (turningRadius) => app.setRobotSize({ turningRadius }, true));
  }

  private listenToSearch(): void {
    const { app } = this;
    this.time.addEventListener("input", () =>
      setText(byId("time-value"), `${Number(this.time.value).toFixed(1)} s`),
    );
    this.time.addEventListener("change", () => app.setLimits({ time: Number(this.time.value) }));
    this.seed.addEventListener("change", () => {
      if (!this.seed.checkValidity()) return;
      app.setLimits({ seed: this.seed.value === "" ? null : Number(this.seed.value) });
    });
    byId("plan").addEventListener("click", () => app.planAgain());
    byId("add-run").addEventListener("click", () => app.addRun());
  }

  /** While a slider moves, plans follow it. */
  private onSlide(slider: HTMLInputElement, move: (value: number) => void): void {
    slider.addEventListener("input", () => move(Number(slider.value)));
    slider.addEventListener("change", () => this.app.rest());
  }
}

/** Leaves alone what the visitor is typing. */
function setValue(input: HTMLInputElement, value: number | string): void {
  if (input === document.activeElement && input.type === "number") return;
  if (input.value !== String(value)) input.value = String(value);
}
