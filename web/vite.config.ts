import { defineConfig } from "vitest/config";

const server = process.env.PLANFORMER_SERVER ?? "http://127.0.0.1:8000";
const api = ["/health", "/metrics", "/options", "/maps", "/propose", "/plan", "/compare"];

export default defineConfig({
  base: "./", // works behind a proxy's prefix as well
  build: {
    outDir: process.env.PAGE_OUT ?? "../src/planformer/serve/page",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: { polyfill: false },
  },
  server: { proxy: Object.fromEntries(api.map((path) => [path, server])) },
  test: { include: ["tests/**/*.test.ts"] },
});
