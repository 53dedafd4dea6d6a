"""What a notebook shows of maps, regions and results: a picture with the facts beside it."""

from __future__ import annotations

import base64
import html
import io
import math
from collections.abc import Mapping

import numpy as np
from PIL import Image

from planformer.guidance import Region
from planformer.maps import OccupancyGrid
from planformer.planning import PlanResult
from planformer.plotting.raster import map_image
from planformer.plotting.save import encoded
from planformer.plotting.sketch import sketch
from planformer.plotting.view import View
from planformer.plotting.words import duration, outcome

_WIDTH = 380
"""Pixels across a picture on the page; it has more itself, for sharp screens."""


def map_html(grid: OccupancyGrid) -> str:
    """A map, drawn in its own frame."""
    rows, columns = grid.shape
    view = View(grid, (0, rows), (0, columns))
    pixels = map_image(view, 0.0, None, pixels=2 * _WIDTH)
    levels = np.round(255.0 * np.clip(pixels[::-1], 0.0, 1.0)).astype(np.uint8)
    buffer = io.BytesIO()
    Image.fromarray(levels).save(buffer, format="png")
    x, y, yaw = grid.origin
    return _card(
        "OccupancyGrid",
        {
            "cells": f"{columns} x {rows}",
            "resolution": f"{grid.resolution:g} m",
            "extent": f"{grid.width:g} x {grid.height:g} m",
            "origin": f"({x:g} m, {y:g} m, {math.degrees(yaw):g}°)",
            "occupied": f"{grid.occupied.mean():.1%}",
            "unknown": f"{grid.unknown.mean():.1%}",
        },
        buffer.getvalue(),
    )


def region_html(region: Region) -> str:
    """A region: its probabilities and outline on the map."""
    height, width = region.probability.shape
    return _card(
        "Region",
        {
            "anchors": f"{width} x {height}",
            "selected": f"{int(region.selected.sum()):,}",
            "threshold": f"{region.threshold:.3g}",
            "share of the map": f"{region.share:.1%}",
            "connects the ends": "yes" if region.connected else "no",
        },
        encoded(sketch(region.problem, region=region, result=None), "png"),
    )


def result_html(result: PlanResult) -> str:
    """A plan: path, search tree and region on the map."""
    return _card(
        "PlanResult",
        {
            "outcome": outcome(result),
            "length": f"{result.length:.2f} m" if result.solved else "none",
            "vertices": f"{result.vertices:,}",
            "planning": duration(result.planning_seconds),
            "proposal": duration(result.proposal_seconds) if result.region else "none",
        },
        encoded(sketch(result.problem, region=result.region, result=result), "png"),
    )


def _card(name: str, facts: Mapping[str, str], png: bytes) -> str:
    """A picture beside a table of facts, below the name of what they are of."""
    rows = "".join(
        f"<tr><th style='text-align:left'>{html.escape(key)}</th>"
        f"<td style='text-align:left'>{html.escape(value)}</td></tr>"
        for key, value in facts.items()
    )
    source = base64.b64encode(png).decode("ascii")
    return (
        "<div style='display:flex;flex-wrap:wrap;gap:1em;align-items:flex-start;margin-bottom:1em'>"
        f"<img alt='{name}' width='{_WIDTH}' src='data:image/png;base64,{source}'>"
        f"<div><strong>{name}</strong><table>{rows}</table></div></div>"
    )
