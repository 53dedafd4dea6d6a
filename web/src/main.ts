/** Puts the page together. */

import { ApiError, Client } from "./api/client";
import { App } from "./app/app";
import { Alert } from "./ui/alert";
import { chart, legend } from "./ui/chart";
import { Controls } from "./ui/controls";
import { byId, setText } from "./ui/dom";
import { listenToDrops } from "./ui/drop";
import { Exports } from "./ui/exports";
import { listenToKeys } from "./ui/keys";
import { Stage } from "./ui/stage";
import { ThemeSwitch } from "./ui/theme";
import { Toolbar } from "./ui/toolbar";

async function main(): Promise<void> {
  let changed = () => {};
  const theme = new ThemeSwitch(() => changed());
  const client = new Client(document.baseURI);
  const options = await client.options();
  const app = new App(client, options, () => changed());
  const stage = new Stage(app, () => theme.current);
  const toolbar = new Toolbar(app, stage);
  const alert = new Alert(app);
  const exports = new Exports(app, stage);

  const upload = async (files: Iterable<File>) => {
    const before = app.store.current.problem?.map;
    await app.upload(files, controls.resolution);
    if (app.store.current.problem?.map === before) return;
    toolbar.choose("start");
    await controls.refreshMaps();
  };
  const controls = new Controls(app, stage, upload);

  changed = () => {
    stage.invalidate();
    toolbar.update();
    controls.update();
    alert.update();
    showFacts(app);
    showChart(app, stage);
  };

  listenToDrops(upload);
  listenToKeys({ app, stage, toolbar, exports });
  keepAddress(app);
  await app.begin(location.hash);
  await controls.refreshMaps();
}

function showFacts(app: App): void {
  const { problem } = app.store.current;
  if (!problem) return;
  const { name, width, height, columns, rows } = problem.map;
  const size = `${width.toFixed(1)} × ${height.toFixed(1)} m`;
  setText(byId("facts"), `${name} · ${size} · ${columns} × ${rows} cells`);
}

function showChart(app: App, stage: Stage): void {
  const { runs, live } = app.store.current;
  if (live) return;
  const traces = app.planning.traces.slice(0, runs.length);
  byId("chart").hidden = traces.every(({ history }) => history.length === 0);
  const drawing = chart(runs, traces, stage.colours, byId("chart-body").clientWidth);
  byId("chart-legend").replaceChildren(...legend(runs, stage.colours));
  byId("chart-body").replaceChildren(...(drawing ? [drawing] : []));
}

/** The address bar holds a link to what is shown, and a link that is put there is shown. */
function keepAddress(app: App): void {
  let written = "";
  app.store.subscribe(({ live }) => {
    if (live || app.link === written) return;
    // A link whose map cannot be had for now stays until the visitor changes what is shown instead.
    const standsIn = written === "" && app.mapError?.isTransient;
    written = app.link;
    if (!standsIn) history.replaceState(null, "", written);
  });
  window.addEventListener("hashchange", () => {
    if (location.hash === written) return;
    written = "";
    void app.begin(location.hash);
  });
}

main().catch((error: unknown) => {
  byId("alert").hidden = false;
  byId("alert-text").textContent =
    error instanceof ApiError ? error.message : `The page failed: ${String(error)}`;
  throw error;
});
