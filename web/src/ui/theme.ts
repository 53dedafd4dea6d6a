/** Light or dark: as the system has it, until the visitor chooses. */

import type { Theme } from "../draw/palette";
import { byId } from "./dom";

const KEY = "planformer-theme";

export class ThemeSwitch {
  private chosen = stored();
  private readonly system = matchMedia("(prefers-color-scheme: dark)");

  constructor(changed: () => void) {
    const apply = () => {
      document.documentElement.dataset.theme = this.current;
      changed();
    };
    this.system.addEventListener("change", apply);
    byId("theme").addEventListener("click", () => {
      this.chosen = this.current === "dark" ? "light" : "dark";
      store(this.chosen);
      apply();
    });
    document.documentElement.dataset.theme = this.current;
  }

  get current(): Theme {
    return this.chosen ?? (this.system.matches ? "dark" : "light");
  }
}

// A browser that keeps nothing for this page throws.
function stored(): Theme | null {
  try {
    const value = localStorage.getItem(KEY);
    return value === "light" || value === "dark" ? value : null;
  } catch {
    return null;
  }
}

function store(theme: Theme): void {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // It lasts until the page is closed, then.
  }
}
