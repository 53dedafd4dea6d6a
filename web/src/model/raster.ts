/** A map's cells as the server's image gives them. */

export const FREE = 255;
export const UNKNOWN = 127;

export interface Raster {
  columns: number;
  rows: number;
  /** 0 occupied, 255 free, 127 unknown; row 0 = highest y, as in pictures. */
  cells: Uint8Array;
}

export async function decodeRaster(image: Blob): Promise<Raster> {
  const rgba = await imagePixels(image);
  const cells = new Uint8Array(rgba.width * rgba.height);
  for (let i = 0; i < cells.length; i++) cells[i] = rgba.data[4 * i]!;
  return { columns: rgba.width, rows: rgba.height, cells };
}

export async function imagePixels(image: Blob): Promise<ImageData> {
  const bitmap = await createImageBitmap(image, { colorSpaceConversion: "none" });
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return context.getImageData(0, 0, canvas.width, canvas.height);
}
