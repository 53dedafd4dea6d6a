"""Whether a network, a recipe and data go together."""

from __future__ import annotations

from planformer.errors import InvalidDataset, InvalidParameter
from planformer.models import CompactBody, MPTConfig
from planformer.training.config import Recipe
from planformer.training.sources import PathSource

_ROBOTS = {True: "a car", False: "a point robot"}
"""Whose paths teach a network with headings, and one without."""


def require_fit(network: MPTConfig, recipe: Recipe, *sources: PathSource) -> None:
    """Refuse a training from which a network would learn nothing or the wrong thing.

    Args:
        network: The network.
        recipe: Its loss and optimiser.
        *sources: Problems to learn from and to validate on.

    Raises:
        InvalidDataset: The paths are of another robot than the network is for.
        InvalidParameter: The recipe does not teach the network all that it predicts.
    """
    if network.headings and isinstance(network.body, CompactBody) and recipe is Recipe.PAPER:
        # The cosine leaves the length free that deployments read as a concentration.
        raise InvalidParameter(
            "a compact network with headings, such as the preset dubins, takes the recipe "
            "'compact'; got 'paper', whose loss does not teach how sure it is of a heading"
        )
    for source in sources:
        car = source[0].path.shape[1] == 3
        if car != network.headings:
            raise InvalidDataset(
                f"a network with{'' if network.headings else 'out'} headings learns from paths of "
                f"{_ROBOTS[network.headings]}; the data set's are of {_ROBOTS[car]}: choose other "
                "data or another network (for cars `generate --robot dubins` and the preset dubins)"
            )
