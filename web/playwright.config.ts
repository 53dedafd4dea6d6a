import { defineConfig } from "@playwright/test";

/** The server under test: `planformer serve` of the environment that runs this. */
const PORT = 8765;
const PYTHON = process.env.PYTHON ?? "python3";

export default defineConfig({
  testDir: "browser",
  outputDir: "test-results",
  // Plans take the time that they are given; on a busy machine pages wait for their turn.
  timeout: 60_000,
  expect: { timeout: 20_000 },
  fullyParallel: true,
  workers: 2,
  forbidOnly: true,
  reporter: [["list"]],
  use: {
    baseURL: `http://127.0.0.1:${PORT}`,
    viewport: { width: 1280, height: 900 },
    trace: "retain-on-failure",
    launchOptions: {
      executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
      args: ["--no-sandbox", "--disable-gpu"], // containers run as root, without a GPU
    },
  },
  webServer: {
    command: `${PYTHON} -m planformer.cli serve --port ${PORT} --plans 4`,
    url: `http://127.0.0.1:${PORT}/health`,
    timeout: 60_000,
  },
});
