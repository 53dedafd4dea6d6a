/** Colours of the canvas: those of the library's pictures, and their counterparts in the dark. */

export interface Palette {
  floor: string;
  obstacle: string;
  unknown: string;
  tree: string;
  halo: string;
  /** Of the cars along a path. */
  body: string;
  region: string;
  start: string;
  goal: string;
  alarm: string;
  best: string;
  /** One a run: told apart by colour-blind people too, and repeated in the chart by dashes. */
  runs: readonly string[];
  /** The probable is darker than the floor in the light, and brighter in the dark. */
  heat: { reversed: boolean; opacity: number };
}

const LIGHT: Palette = {
  floor: "#fbf8f1",
  obstacle: "#2b3441",
  unknown: "#bdc1c5",
  tree: "#3f6b8f",
  halo: "#ffffff",
  body: "#ffffff",
  region: "#a3357a",
  start: "#00a67d",
  goal: "#d81e4a",
  alarm: "#c22f3d",
  best: "#20262e",
  runs: ["#1257d6", "#b85c00", "#8a2be2", "#00745a"],
  heat: { reversed: false, opacity: 0.88 },
};

const DARK: Palette = {
  floor: "#181d24",
  obstacle: "#76869a",
  unknown: "#3a424d",
  tree: "#86b4dc",
  halo: "#0c1015",
  body: "#f2f4f7",
  region: "#f08cc4",
  start: "#1fd1a1",
  goal: "#ff5d80",
  alarm: "#ff7a86",
  best: "#f2f4f7",
  runs: ["#6ea6ff", "#ffa94d", "#c89bff", "#3fd6a8"],
  heat: { reversed: true, opacity: 0.7 },
};

export type Theme = "light" | "dark";

export function palette(theme: Theme): Palette {
  return theme === "dark" ? DARK : LIGHT;
}

/** Matplotlib's plasma between 0.95 and 0.42, as in the library's pictures. */
const HEAT = [
  [247, 228, 37],
  [253, 200, 39],
  [253, 174, 50],
  [248, 149, 64],
  [240, 127, 79],
  [229, 106, 93],
  [215, 86, 108],
  [200, 67, 123],
  [182, 48, 139],
] as const;
/** Probability from which the heat is as opaque as it gets. */
const FULL_FROM = 0.55;

/** Red, green, blue and opacity, 0 to 255, of a probability. */
export function heat(
  probability: number,
  { reversed, opacity }: Palette["heat"],
): [number, number, number, number] {
  const position = (reversed ? 1 - probability : probability) * (HEAT.length - 1);
  const index = Math.min(Math.floor(position), HEAT.length - 2);
  const share = position - index;
  const [low, high] = [HEAT[index]!, HEAT[index + 1]!];
  const ramp = Math.min(probability / FULL_FROM, 1);
  const mix = (channel: 0 | 1 | 2) => low[channel] + share * (high[channel] - low[channel]);
  return [mix(0), mix(1), mix(2), 255 * opacity * ramp * ramp * (3 - 2 * ramp)];
}

/** Red, green and blue, 0 to 255, of a colour like "#fbf8f1". */
export function rgb(colour: string): [number, number, number] {
  const value = Number.parseInt(colour.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}
