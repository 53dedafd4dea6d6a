/** Numbers in words. */

export function seconds(value: number): string {
  if (value >= 0.9995) return `${value.toFixed(2)} s`;
  return `${(value * 1e3).toPrecision(3)} ms`;
}

export function metres(value: number): string {
  return `${value.toFixed(2)} m`;
}

const NUMBER = new Intl.NumberFormat("en-US");

export function count(value: number): string {
  return NUMBER.format(value);
}
