/** Numbers in words. */

export function seconds(value: number): string {
  return value >= 1 ? `${value.toFixed(2)} s` : `${(value * 1e3).toPrecision(3)} ms`;
}

export function metres(value: number): string {
  return `${value.toFixed(2)} m`;
}

export function count(value: number): string {
  return value.toLocaleString("en-US");
}
