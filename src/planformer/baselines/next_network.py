"""NEXT's network, evaluated by ONNX Runtime on the CPU."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import onnxruntime
from numpy.typing import NDArray

from planformer.errors import InvalidWeights, WeightsMismatch
from planformer.weights import Weights, changed_at, open_session, read_weights

_INPUTS = {"free", "goal", "context", "states"}
_OUTPUTS = {"plan", "mean", "value"}


class NextEvaluator(Protocol):
    """What the search asks of a network; all coordinates go from -1 to 1 over the square map."""

    @property
    def side(self) -> int:
        """Side w in cells of the map that the network plans on."""

    def plan(self, free: NDArray[np.float32], goal: NDArray[np.float32]) -> Any:
        """Plan on a map, once a problem.

        Args:
            free: (w, w) float32, the free part of each cell.
            goal: (2,) float32.

        Returns:
            The context of `evaluate`.
        """

    def evaluate(
        self, context: Any, states: NDArray[np.float32]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Say where to go from states, and how good they are.

        Args:
            context: From `plan`.
            states: (N, 2) float32.

        Returns:
            (N, 2) mean of the next step in lengths of a step, (N,) values.
        """


@dataclass(frozen=True)
class NextOnnxNetwork:
    """Weights with their ONNX Runtime session: a `NextEvaluator`.

    One graph holds both stages side by side: whoever asks for one of them feeds the other the
    smallest input there is, a map of a single cell.

    Attributes:
        weights: The file and its card.
        side: See `NextEvaluator`.
        session: What evaluates the network.
        idle: The smallest input of both stages.
    """

    weights: Weights
    side: int
    session: onnxruntime.InferenceSession
    idle: Mapping[str, NDArray[np.float32]]

    def plan(self, free: NDArray[np.float32], goal: NDArray[np.float32]) -> NDArray[np.float32]:
        """See `NextEvaluator.plan`.

        Raises:
            WeightsMismatch: The network does not fit its card.
        """
        (context,) = self._run(["plan"], free=free[None], goal=goal[None])
        return context

    def evaluate(
        self, context: NDArray[np.float32], states: NDArray[np.float32]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `NextEvaluator.evaluate`.

        Raises:
            WeightsMismatch: The network does not fit its card.
            InvalidWeights: It predicts values that are not finite.
        """
        mean, value = self._run(["mean", "value"], context=context, states=states[None])
        if not (np.isfinite(mean).all() and np.isfinite(value).all()):
            raise InvalidWeights(
                f"the weights {self.weights.name} predict values that are not finite"
            )
        return mean[0].astype(np.float64), value[0].astype(np.float64)

    def _run(self, outputs: list[str], **inputs: NDArray[np.float32]) -> list[NDArray[np.float32]]:
        try:
            values: list[NDArray[np.float32]] = self.session.run(outputs, {**self.idle, **inputs})
        except Exception as error:  # ONNX Runtime's exceptions share no public base class
            raise WeightsMismatch(
                f"the weights {self.weights.name} do not take what their card says: {error}"
            ) from error
        return values


def load_next(path: str | Path) -> NextOnnxNetwork:
    """Load an .onnx file that `planformer.export.next_ks` wrote, with its card.

    A file is loaded once; it is loaded again when it or its card has changed.

    Raises:
        InvalidWeights: The file is missing, damaged, or not NEXT's.
    """
    path = Path(path)
    return _load(path, changed_at(path))


@lru_cache(maxsize=4)
def _load(path: Path, changed: tuple[int, int]) -> NextOnnxNetwork:
    weights = read_weights(path)
    session = open_session(weights)
    names = {value.name for value in session.get_inputs()}
    outputs = {value.name for value in session.get_outputs()}
    if names != _INPUTS or outputs != _OUTPUTS:
        raise WeightsMismatch(
            f"the weights {weights.name} are not NEXT's: a network from {sorted(names)} to "
            f"{sorted(outputs)}; NEXT's goes from {sorted(_INPUTS)} to {sorted(_OUTPUTS)}"
        )
    return NextOnnxNetwork(weights, _side(weights), session, _idle(session))


def _side(weights: Weights) -> int:
    try:
        side = weights.card["network"]["side"]
    except (KeyError, TypeError) as error:
        raise InvalidWeights(f"the card of {weights.path} has no network side") from error
    if not (isinstance(side, int) and side >= 1):
        raise InvalidWeights(f"the card of {weights.path} has a network side of {side!r}")
    return side


def _idle(session: onnxruntime.InferenceSession) -> dict[str, NDArray[np.float32]]:
    return {
        value.name: np.zeros(
            [size if isinstance(size, int) else 1 for size in value.shape], np.float32
        )
        for value in session.get_inputs()
    }
