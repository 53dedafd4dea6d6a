"""The library's results as response bodies."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer.guidance import Region
from planformer.planning import PlanResult, Tree, edge_lines
from planformer.robots import Robot
from planformer.serve.pictures import mask_png
from planformer.serve.requests import RunOptions
from planformer.serve.responses import PlanResponse, RegionResponse, TreeResponse

_MOST_ANCHORS = 10_000
_MILLIMETRES = 3


def plan_answer(
    result: PlanResult, options: RunOptions, *, guide: str | None, seed: int
) -> PlanResponse:
    """The response for a plan.

    Args:
        result: The plan.
        options: What was asked for.
        guide: Name of the guide that was used.
        seed: Seed of the search.
    """
    region = None
    if options.region and result.region is not None and guide is not None:
        region = region_answer(result.region, guide, result.proposal_seconds)
    return PlanResponse(
        solved=result.solved,
        status=result.status.value,
        path=result.path.tolist(),
        length=result.length if result.solved else None,
        vertices=result.vertices,
        planning_seconds=result.planning_seconds,
        proposal_seconds=result.proposal_seconds,
        total_seconds=result.planning_seconds + result.proposal_seconds,
        planner=options.planner,
        guide=guide,
        seed=seed,
        region=region,
        tree=tree_answer(result.tree, result.problem.robot)
        if options.tree and result.tree is not None
        else None,
    )


def region_answer(region: Region, guide: str, seconds: float) -> RegionResponse:
    """The response for a region; a dense lattice of anchors is pooled."""
    side = _pool_side(region.probability.shape)
    probability = _pooled(region.probability, side, np.max)
    anchors = np.stack([_pooled(region.anchors[..., i], side, np.mean) for i in (0, 1)], axis=-1)
    rows, columns = probability.shape
    return RegionResponse(
        guide=guide,
        rows=rows,
        columns=columns,
        probability=rounded(probability),
        anchors=anchors.reshape(-1, 2).round(_MILLIMETRES).tolist(),
        anchor_size=_spacing(anchors, region.patch),
        mask=base64.b64encode(mask_png(region.mask)).decode("ascii"),
        threshold=region.threshold,
        connected=region.connected,
        proposal_seconds=seconds,
    )


def _pool_side(shape: tuple[int, ...]) -> int:
    """Side of the blocks into which a lattice is pooled."""
    side = 1
    while -(-shape[0] // side) * -(-shape[1] // side) > _MOST_ANCHORS:
        side += 1
    return side


def _pooled(values: NDArray[Any], side: int, how: Any) -> NDArray[Any]:
    """One value for each block of side x side; those at the far edges may be smaller."""
    if side == 1:
        return values
    starts = [range(0, size, side) for size in values.shape]
    blocks = [
        [how(values[row : row + side, column : column + side]) for column in starts[1]]
        for row in starts[0]
    ]
    return np.array(blocks)


def _spacing(anchors: NDArray[np.float64], patch: float) -> float:
    """Distance of neighbouring anchors in metres; the patch's side where there is only one."""
    rows, columns = anchors.shape[:2]
    if rows * columns == 1:
        return patch
    neighbour = anchors[0, 1] if columns > 1 else anchors[1, 0]
    return float(np.hypot(*(neighbour - anchors[0, 0])))


def tree_answer(tree: Tree, robot: Robot) -> TreeResponse:
    """The response for a robot's tree or roadmap."""
    parents, links = parents_and_links(tree)
    hung = np.column_stack((parents, np.arange(len(parents))))
    return TreeResponse(
        vertices=rounded(tree.vertices[:, :2]),
        parents=parents.tolist(),
        links=links.tolist(),
        curves=curves(robot, tree.vertices, np.concatenate((hung, links.reshape(-1, 2)))),
    )


def curves(
    robot: Robot, vertices: NDArray[np.float64], edges: NDArray[np.int64]
) -> list[list[float]]:
    """What a car drives between the ends of edges; nothing for a point robot.

    Args:
        robot: The robot.
        vertices: (V, 2) or (V, 3) states.
        edges: (E, 2) indices (parent, child) into them; a root has the parent -1.
    """
    if robot.state_dimension == 2:
        return []
    real = edges[:, 0] >= 0
    lines = iter(edge_lines(robot, vertices, edges[real]))
    return [rounded(next(lines)[1:-1]) if exists else [] for exists in real]


def parents_and_links(tree: Tree) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """A parent of each vertex, -1 where it has none, and the edges that this leaves out, flat."""
    parents = np.full(len(tree.vertices), -1, np.int64)
    parent, child = tree.edges[:, 0], tree.edges[:, 1]
    parents[child[::-1]] = parent[::-1]  # the first edge of each child stays
    more = tree.edges[parents[child] != parent]
    return parents, more.ravel()


def rounded(values: NDArray[Any]) -> list[float]:
    """Flat values to a thousandth: millimetres on the way to a screen."""
    numbers: list[float] = np.asarray(values, np.float64).round(_MILLIMETRES).ravel().tolist()
    return numbers
