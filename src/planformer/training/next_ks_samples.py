"""From paths to the states that NEXT's network learns from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from planformer.baselines.next_ks import STEP, NextPlanner
from planformer.baselines.next_map import free_parts, normalised, square_side
from planformer.data.experts import shortest_path
from planformer.geometry import polyline_length
from planformer.maps import OccupancyGrid
from planformer.models.next_ks import NextNetwork
from planformer.planning import Problem, SearchLimits
from planformer.robots import PointRobot
from planformer.training.augmentation import Example

_STATES_OF_A_TREE = 4


class Lessons(NamedTuple):
    """Problems with some states each; coordinates go from -1 to 1 over the square map.

    Attributes:
        free: (B, w, w) float32, the free part of each cell.
        goal: (B, 2) float32.
        states: (B, K, 2) float32.
        steps: (B, K, 2) float32, the expert's next step from each state in lengths of a step.
        values: (B, K) float32, minus the length of the expert's way to the goal.
    """

    free: Tensor
    goal: Tensor
    states: Tensor
    steps: Tensor
    values: Tensor

    def to(self, device: torch.device) -> Lessons:
        """The lessons on a device."""
        return Lessons(*(tensor.to(device) for tensor in self))


def make_lessons(
    examples: Sequence[Example],
    paths: Sequence[Sequence[NDArray[np.float64]]],
    cells: int,
    count: int,
    rng: np.random.Generator,
) -> Lessons:
    """Draw states from paths.

    Args:
        examples: Problems.
        paths: For each, one path or more to its goal: (N, 2) in metres in the map's frame.
        cells: Side of the network's map.
        count: Number of states a problem.
        rng: Source of randomness.
    """
    rows = [_lesson(e, p, cells, count, rng) for e, p in zip(examples, paths, strict=True)]
    return Lessons(*(torch.from_numpy(np.stack(column)) for column in zip(*rows, strict=True)))


def _lesson(
    example: Example,
    paths: Sequence[NDArray[np.float64]],
    cells: int,
    count: int,
    rng: np.random.Generator,
) -> tuple[NDArray[np.float32], ...]:
    side = square_side(example.blocked, example.resolution)
    drawn = [
        _follow(paths[which], place, 0.5 * STEP * side)
        for which, place in zip(
            rng.integers(len(paths), size=count), rng.random(count), strict=True
        )
    ]
    states, steps, lengths = (np.array(column) for column in zip(*drawn, strict=True))
    return (
        free_parts(example.blocked, cells),
        normalised(example.goal, side),
        normalised(states, side),
        steps.astype(np.float32),
        (-2.0 / side * lengths).astype(np.float32),
    )


def _follow(
    path: NDArray[np.float64], place: float, step: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """A point of a path, the step from it to the point one step on, and the length that is left.

    Args:
        path: (N, 2) vertices in metres.
        place: Where the point lies, in [0, 1) of the path.
        step: Length of a step in metres.
    """
    along = np.concatenate(([0.0], np.hypot(*np.diff(path, axis=0).T).cumsum()))
    at = place * along[-1]
    state, after = np.column_stack([np.interp((at, at + step), along, x) for x in path.T])
    return state, (after - state) / step, float(along[-1] - at)


def searched_paths(
    network: NextNetwork, example: Example, exploration: float, samples: int, seed: int
) -> list[NDArray[np.float64]]:
    """Let the network search, and the expert show the way from where it got to.

    The shorter of the expert's path and the search's own comes first, as the published training
    keeps the best path known; the others start at random states of the search tree, which the
    network must judge but no expert's path visits.

    Args:
        network: The network in evaluation mode.
        example: The problem.
        exploration: The search's probability of RRT's samples.
        samples: Its samples.
        seed: Its seed.
    """
    grid = OccupancyGrid(np.ascontiguousarray(example.blocked), example.resolution)
    # The map is inflated already: what is left of the robot is a point.
    problem = Problem(grid, PointRobot(0.0), tuple(example.start), tuple(example.goal))
    planner = NextPlanner(TorchEvaluator(network), samples, exploration)
    result = planner.search(problem, limits=SearchLimits(None), seed=seed, keep_tree=True)
    assert result.tree is not None  # as asked for
    own = [result.path] if result.solved else []
    states = np.random.default_rng(seed).choice(result.tree.vertices, _STATES_OF_A_TREE)
    shown = (shortest_path(grid, 0.0, state, example.goal) for state in states)
    return [
        min([example.path, *own], key=polyline_length),
        *(path for path in shown if path is not None),
    ]


class TorchEvaluator:
    """A network in PyTorch as the search asks for it.

    Args:
        network: The network in evaluation mode.
    """

    def __init__(self, network: NextNetwork) -> None:
        self._network = network
        self._device = next(network.parameters()).device
        self.side = network.config.side

    @torch.no_grad()
    def plan(self, free: NDArray[np.float32], goal: NDArray[np.float32]) -> Any:
        """See `planformer.baselines.next_network.NextEvaluator`."""
        return self._network.plan(self._tensor(free), self._tensor(goal))

    @torch.no_grad()
    def evaluate(
        self, context: Any, states: NDArray[np.float32]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `planformer.baselines.next_network.NextEvaluator`."""
        mean, value = self._network.evaluate(context, self._tensor(states))
        return mean[0].double().cpu().numpy(), value[0].double().cpu().numpy()

    def _tensor(self, values: NDArray[np.float32]) -> Tensor:
        return torch.from_numpy(values)[None].to(self._device)
