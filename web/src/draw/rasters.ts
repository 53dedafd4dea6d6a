/** What is drawn as an image: obstacles, heat map and region, each on a canvas of its own. */

import type { MapInfo, RegionResponse } from "../api/types";
import { toLocal } from "../geometry/frame";
import { FREE, imagePixels, type Raster, UNKNOWN } from "../model/raster";
import { heat, type Palette, rgb } from "./palette";

type Context = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

/** An image that covers part of a map; its first row is the highest y. */
export interface Placed {
  image: OffscreenCanvas;
  /** Lower-left corner and size in metres in the map's own frame. */
  left: number;
  bottom: number;
  width: number;
  height: number;
}

/** How an image is drawn that is this many pixels of the screen large for each of its own. */
export function smoothing(pixels: number): Smoothing {
  if (pixels >= 2) return "off"; // one sees cells as they are
  return pixels >= 1 ? "low" : "medium"; // which costs more, and keeps thin walls
}

export type Smoothing = "off" | "low" | "medium";

/** Draws in the world frame. */
export function drawPlaced(
  context: Context,
  map: MapInfo,
  placed: Placed,
  smooth: Smoothing,
): void {
  const { image, left, bottom, width, height } = placed;
  context.save();
  inMapFrame(context, map);
  context.translate(left, bottom + height);
  context.scale(width / image.width, -height / image.height);
  context.imageSmoothingEnabled = smooth !== "off";
  if (smooth !== "off") context.imageSmoothingQuality = smooth;
  context.drawImage(image, 0, 0);
  context.restore();
}

/** Fills the map's rectangle. */
export function fillMap(context: Context, map: MapInfo, colour: string): void {
  context.save();
  inMapFrame(context, map);
  context.fillStyle = colour;
  context.fillRect(0, 0, map.width, map.height);
  context.restore();
}

/** Nothing beside the map is drawn until the context is restored. */
export function clipToMap(context: Context, map: MapInfo): void {
  const transform = context.getTransform();
  inMapFrame(context, map);
  context.beginPath();
  context.rect(0, 0, map.width, map.height);
  context.clip();
  context.setTransform(transform);
}

function inMapFrame(context: Context, { origin: [x, y, yaw] }: MapInfo): void {
  context.translate(x, y);
  context.rotate(yaw);
}

function onWholeMap(image: OffscreenCanvas, { width, height }: MapInfo): Placed {
  return { image, left: 0, bottom: 0, width, height };
}

/** Obstacles and unknown space; what is free is transparent. */
export function obstacles(map: MapInfo, raster: Raster, colours: Palette): Placed {
  const { columns, rows, cells } = raster;
  const wall = packed([...rgb(colours.obstacle), 255]);
  const unseen = packed([...rgb(colours.unknown), 255]);
  const image = painted(columns, rows, (index) => {
    const cell = cells[index]!;
    if (cell === FREE) return TRANSPARENT;
    return cell === UNKNOWN ? unseen : wall;
  });
  return onWholeMap(image, map);
}

/** The probability of each anchor, to be drawn smoothly. */
export function heatMap(map: MapInfo, region: RegionResponse, colours: Palette): Placed {
  const { rows, columns, probability, anchors, anchor_size } = region;
  const image = painted(columns, rows, (index) => {
    const row = rows - 1 - Math.floor(index / columns);
    return packed(heat(probability[row * columns + (index % columns)]!, colours.heat));
  });
  const at = (index: number) => {
    const [x, y] = anchors[index]!;
    return toLocal(map, { x, y });
  };
  const corner = at(0);
  const dx = columns > 1 ? at(1).x - corner.x : anchor_size;
  const dy = rows > 1 ? at(columns).y - corner.y : anchor_size;
  return {
    image,
    left: corner.x - dx / 2,
    bottom: corner.y - dy / 2,
    width: dx * columns,
    height: dy * rows,
  };
}

export interface RegionMask {
  columns: number;
  rows: number;
  inside: Uint8Array;
}

export async function decodeMask(base64: string): Promise<RegionMask> {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const { width, height, data } = await imagePixels(new Blob([bytes], { type: "image/png" }));
  const inside = new Uint8Array(width * height);
  for (let i = 0; i < inside.length; i++) inside[i] = data[4 * i]! > 127 ? 1 : 0;
  return { columns: width, rows: height, inside };
}

const REGION_FILL = 26;
const REGION_EDGE = 200;

/** The region: a tint with an outline a cell wide. */
export function regionImage(map: MapInfo, mask: RegionMask, colours: Palette): Placed {
  const { columns, rows, inside } = mask;
  const fill = packed([...rgb(colours.region), REGION_FILL]);
  const edge = packed([...rgb(colours.region), REGION_EDGE]);
  const image = painted(columns, rows, (index) => {
    if (inside[index] === 0) return TRANSPARENT;
    const column = index % columns;
    const surrounded =
      (column === 0 || inside[index - 1] === 1) &&
      (column === columns - 1 || inside[index + 1] === 1) &&
      (index < columns || inside[index - columns] === 1) &&
      (index >= columns * (rows - 1) || inside[index + columns] === 1);
    return surrounded ? fill : edge;
  });
  return onWholeMap(image, map);
}

const TRANSPARENT = 0;

/** A colour as the 32 bits of a pixel, on a little-endian machine as all with browsers are. */
function packed([red, green, blue, alpha]: [number, number, number, number]): number {
  return ((alpha << 24) | (blue << 16) | (green << 8) | red) >>> 0;
}

/** A canvas whose pixels have the colours that a function gives. */
function painted(
  columns: number,
  rows: number,
  colourOf: (index: number) => number,
): OffscreenCanvas {
  const canvas = new OffscreenCanvas(columns, rows);
  const context = canvas.getContext("2d")!;
  const image = context.createImageData(columns, rows);
  const pixels = new Uint32Array(image.data.buffer);
  for (let i = 0; i < pixels.length; i++) pixels[i] = colourOf(i);
  context.putImageData(image, 0, 0);
  return canvas;
}
