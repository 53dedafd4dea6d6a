"""Region proposal by a network that ONNX Runtime evaluates on the CPU."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import onnxruntime
from numpy.typing import NDArray

from planformer.encoding import NetworkScale, Window, encode_windows, network_map, stitch
from planformer.errors import InvalidParameter, InvalidWeights, WeightsMismatch
from planformer.guidance.region import Region, make_region
from planformer.guidance.weights import scale_of, weights_path
from planformer.planning import Problem
from planformer.robots import Robot
from planformer.weights import Weights, changed_at, open_session, read_weights

_CONCENTRATIONS = (0.3, 100.0)
"""Bounds of the concentration: yaw deviations from 0.1 rad to nearly any yaw."""


class Prediction(NamedTuple):
    """What a network says of a problem.

    Attributes:
        probability: (h, w) float32.
        headings: (h, w) float64 in rad in the map's own frame; None in the plane.
        yaw_deviations: (h, w) float64, how far [rad] the yaw strays from each heading.
        offsets: (h, w, 2) float64 way in metres, in the map's own frame, from each anchor to the
            path; None if not predicted.
    """

    probability: NDArray[np.float32]
    headings: NDArray[np.float64] | None = None
    yaw_deviations: NDArray[np.float64] | None = None
    offsets: NDArray[np.float64] | None = None


@dataclass(frozen=True)
class OnnxNetwork:
    """Weights with their ONNX Runtime session; loading takes a while, running does not.

    Attributes:
        weights: The file and its card.
        scale: Geometry of the network's input and output.
        session: What evaluates the network.
    """

    weights: Weights
    scale: NetworkScale
    session: onnxruntime.InferenceSession

    def require_fit(self, robot: Robot) -> None:
        """Check that the network proposes regions for a robot.

        Raises:
            WeightsMismatch: It does not.
        """
        if self.scale.headings and robot.state_dimension == 2:
            raise WeightsMismatch(
                f"the weights {self.weights.name} need start and goal headings, which a "
                f"{type(robot).__name__} does not have; use weights for a point robot"
            )

    def predict(self, problem: Problem) -> Prediction:
        """Evaluate the network.

        Raises:
            WeightsMismatch: The network does not fit the robot or its card.
            InvalidWeights: It predicts values that are not finite.
        """
        self.require_fit(problem.robot)
        scale = self.scale
        outputs = self._outputs(problem)
        prediction = Prediction(outputs.pop(0)[0])
        if scale.headings:
            x, y = outputs.pop(0).astype(np.float64)
            # The circular variance of a von Mises distribution nears 1 / concentration.
            spread = np.clip(np.hypot(x, y), *_CONCENTRATIONS) ** -0.5
            prediction = prediction._replace(headings=np.arctan2(y, x), yaw_deviations=spread)
        if scale.offsets:
            vectors = outputs.pop(0).astype(np.float64)
            prediction = prediction._replace(offsets=np.moveaxis(vectors, 0, -1))
        return prediction

    def _outputs(self, problem: Problem) -> list[NDArray[np.float32]]:
        """Arrays (channels, h, w) for the whole map, zero where nothing needs a prediction."""
        scale = self.scale
        pixels = network_map(problem.blocked, problem.grid.resolution, scale)
        tokens = [size // scale.stride for size in pixels.shape]
        ends = problem.local_start, problem.local_goal
        predictions: list[tuple[Window, list[NDArray[np.float32]]]] = []
        for window, query in encode_windows(pixels, *ends, scale):
            seen = window.cut(pixels, scale.stride)
            predicted = self._run({"map": seen[None, None], "query": query[None]})
            self._check(predicted, window.shape)
            predictions.append((window, predicted))
        outputs = [np.zeros((channels, *tokens), np.float32) for channels in self._output_channels]
        for i, whole in enumerate(outputs):
            stitch([(window, predicted[i][0]) for window, predicted in predictions], whole)
        return outputs

    @property
    def _output_channels(self) -> list[int]:
        """One for the probability, two for a heading and for an offset."""
        return [1, *[2] * (self.scale.headings + self.scale.offsets)]

    def _run(self, inputs: dict[str, NDArray[Any]]) -> list[NDArray[np.float32]]:
        try:
            outputs: list[NDArray[np.float32]] = self.session.run(None, inputs)
        except Exception as error:  # ONNX Runtime's exceptions share no public base class
            raise WeightsMismatch(
                f"the weights {self.weights.name} do not take what their card says: {error}"
            ) from error
        return outputs

    def _check(self, outputs: list[NDArray[np.float32]], tokens: tuple[int, ...]) -> None:
        expected = [(1, channels, *tokens) for channels in self._output_channels]
        shapes = [np.shape(output) for output in outputs]
        if shapes != expected:
            raise WeightsMismatch(
                f"the weights {self.weights.name} predict arrays of shapes {shapes} where their "
                f"card promises {expected}"
            )
        if not all(np.isfinite(output).all() for output in outputs):
            raise InvalidWeights(
                f"the weights {self.weights.name} predict values that are not finite"
            )


@dataclass(frozen=True)
class OnnxProposer:
    """A `RegionProposer` on an `OnnxNetwork`.

    Attributes:
        network: From `load_network`.
        threshold: Fixed threshold in [0, 1], 0.5 as in the paper; None chooses it per query so
            that start and goal are connected.

    Raises:
        InvalidParameter: The threshold is out of range.
    """

    network: OnnxNetwork
    threshold: float | None = None

    def __post_init__(self) -> None:
        if self.threshold is None:
            return
        if not (math.isfinite(self.threshold) and 0.0 <= self.threshold <= 1.0):
            raise InvalidParameter(
                f"threshold must be between 0 and 1 or None; got {self.threshold}"
            )

    def propose(self, problem: Problem) -> Region:
        """Propose a region for a problem."""
        prediction = self.network.predict(problem)
        return make_region(
            problem,
            prediction.probability,
            self.network.scale,
            headings=prediction.headings,
            yaw_deviations=prediction.yaw_deviations,
            offsets=prediction.offsets,
            threshold=self.threshold,
        )


def load_network(guide: str) -> OnnxNetwork:
    """Load shipped weights by name, or an .onnx file with its card by path.

    A file is loaded once; it is loaded again when it or its card has changed.

    Raises:
        UnknownGuide: No such weights.
        InvalidWeights: The file is damaged or does not fit its card.
    """
    path = weights_path(guide)
    return _load(path, changed_at(path))


@lru_cache(maxsize=8)
def _load(path: Path, changed: tuple[int, int]) -> OnnxNetwork:
    weights = read_weights(path)
    return OnnxNetwork(weights, scale_of(weights), open_session(weights))
