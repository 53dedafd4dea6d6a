/** Gets maps from the server with their cells, and makes shared ones again. */

import { ApiError, type Client } from "../api/client";
import type { GenerateRequest, MapInfo, Stroke } from "../api/types";
import type { MapSource } from "../model/problem";
import { decodeRaster, type Raster } from "../model/raster";
import { exactStroke, type Shared } from "../model/share";

export interface LoadedMap {
  info: MapInfo;
  source: MapSource;
  raster: Raster;
}

export class Maps {
  constructor(private readonly client: Client) {}

  async generate(request: GenerateRequest): Promise<LoadedMap> {
    const info = await this.client.generate(request);
    return this.load(info, { kind: "generated", request, strokes: [] });
  }

  async upload(files: Iterable<File>, resolution: number | null): Promise<LoadedMap> {
    return this.load(await this.client.upload(files, resolution), { kind: "stored" });
  }

  async open(info: MapInfo): Promise<LoadedMap> {
    return this.load(info, sourceOf(info));
  }

  async edit({ info, source }: LoadedMap, stroke: Stroke): Promise<LoadedMap> {
    const exact = exactStroke(stroke);
    const edited = await this.client.edit(info.id, [exact]);
    return this.load(
      edited,
      source.kind === "stored" ? source : { ...source, strokes: [...source.strokes, exact] },
    );
  }

  /** The map of a link: the server's, or made again if it was generated. */
  async shared({ id, source }: Shared): Promise<LoadedMap> {
    try {
      return this.load(await this.client.map(id), source);
    } catch (error) {
      if (!(error instanceof ApiError) || error.status !== 404 || source.kind === "stored") {
        throw error;
      }
    }
    const plain = await this.client.generate(source.request);
    if (source.strokes.length === 0) return this.load(plain, source);
    return this.load(await this.client.edit(plain.id, source.strokes), source);
  }

  private async load(info: MapInfo, source: MapSource): Promise<LoadedMap> {
    return { info, source, raster: await decodeRaster(await this.client.image(info.id)) };
  }
}

function sourceOf({ source }: MapInfo): MapSource {
  return source ? { kind: "generated", request: source, strokes: [] } : { kind: "stored" };
}
