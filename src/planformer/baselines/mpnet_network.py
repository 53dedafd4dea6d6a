"""MPNet's networks, evaluated by ONNX Runtime on the CPU."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import onnxruntime
from numpy.typing import NDArray

from planformer.encoding import NetworkScale, network_map
from planformer.errors import InvalidParameter, InvalidWeights, WeightsMismatch
from planformer.planning import Problem
from planformer.weights import Weights, changed_at, open_session, read_weights

_INPUTS = {"map", "latent", "current", "goal", "noise"}
_OUTPUTS = ("encoding", "waypoint")


@dataclass(frozen=True)
class MPNetNetwork:
    """Weights with their ONNX Runtime session.

    One graph holds both networks, which share nothing: whoever asks for one of them feeds the
    other the smallest input there is.

    Attributes:
        weights: The file and its card.
        scale: Geometry of the encoder's map.
        session: What evaluates the networks.
        idle: The smallest input of both.
    """

    weights: Weights
    scale: NetworkScale
    session: onnxruntime.InferenceSession
    idle: Mapping[str, NDArray[Any]]

    def encode(self, problem: Problem) -> NDArray[np.float32]:
        """Describe a problem's map.

        Returns:
            (1, L) float32.

        Raises:
            WeightsMismatch: The network does not fit its card.
        """
        pixels = network_map(problem.blocked, problem.grid.resolution, self.scale)
        return self._run("encoding", map=pixels[None, None])

    def next_waypoint(
        self,
        latent: NDArray[np.float32],
        current: NDArray[np.float64],
        goal: NDArray[np.float64],
        rng: np.random.Generator,
    ) -> NDArray[np.float64]:
        """Predict where to go next.

        Args:
            latent: From `encode`.
            current: (2,) state, its coordinates from -1 to 1 over the map.
            goal: (2,) state to reach.
            rng: What dropout draws from.

        Returns:
            (2,) float64 state, each coordinate in [-1, 1].

        Raises:
            WeightsMismatch: The network does not fit its card.
            InvalidWeights: It predicts values that are not finite.
        """
        waypoint = self._run(
            "waypoint",
            latent=latent,
            current=current[None].astype(np.float32),
            goal=goal[None].astype(np.float32),
            noise=rng.random(self.idle["noise"].shape, dtype=np.float32),
        )
        if waypoint.shape != (1, 2) or not np.isfinite(waypoint).all():
            raise InvalidWeights(
                f"the weights {self.weights.name} predict {waypoint.tolist()}, which is no waypoint"
            )
        return np.asarray(waypoint[0], np.float64)

    def _run(self, output: str, **inputs: NDArray[Any]) -> NDArray[np.float32]:
        try:
            values: NDArray[np.float32] = self.session.run([output], {**self.idle, **inputs})[0]
        except Exception as error:  # ONNX Runtime's exceptions share no public base class
            raise WeightsMismatch(
                f"the weights {self.weights.name} do not take what their card says: {error}"
            ) from error
        return values


def load_mpnet(path: str | Path) -> MPNetNetwork:
    """Load an .onnx file that `planformer.export.mpnet` wrote, with its card.

    A file is loaded once; it is loaded again when it or its card has changed.

    Raises:
        InvalidWeights: The file is missing, damaged, or not MPNet's.
    """
    path = Path(path)
    return _load(path, changed_at(path))


@lru_cache(maxsize=4)
def _load(path: Path, changed: tuple[int, int]) -> MPNetNetwork:
    weights = read_weights(path)
    try:
        scale = NetworkScale.from_dict(weights.card["scale"])
    except (KeyError, TypeError, InvalidParameter) as error:
        raise InvalidWeights(f"{path.with_suffix('.json')} has no valid scale: {error}") from error
    session = open_session(weights)
    return MPNetNetwork(weights, scale, session, _idle(session, weights))


def _idle(session: onnxruntime.InferenceSession, weights: Weights) -> dict[str, NDArray[Any]]:
    names = {value.name for value in session.get_inputs()}
    outputs = {value.name for value in session.get_outputs()}
    if names != _INPUTS or outputs != set(_OUTPUTS):
        raise WeightsMismatch(
            f"the weights {weights.name} are not MPNet's: a network from {sorted(names)} to "
            f"{sorted(outputs)}; MPNet's goes from {sorted(_INPUTS)} to {sorted(_OUTPUTS)}"
        )
    return {
        value.name: np.zeros(
            [size if isinstance(size, int) else 1 for size in value.shape],
            np.uint8 if value.name == "map" else np.float32,
        )
        for value in session.get_inputs()
    }
