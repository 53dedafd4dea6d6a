"""What is new in a growing tree: a whole tree each time would be too much to send."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from planformer.planning import Tree
from planformer.serve.answers import parents_and_links, rounded
from planformer.serve.responses import TreeUpdate


class TreeUpdates:
    """Updates that turn the tree that a client has into the latest one.

    A vertex is known by its place: no planner moves one, and vertices in the same place look the
    same. So they are sent as one.
    """

    def __init__(self) -> None:
        self._forget()

    def _forget(self) -> None:
        self._places = np.empty(0, np.complex128)  # sorted
        self._numbers = np.empty(0, np.int64)  # the client's, of each place
        self._parents = np.empty(0, np.int64)  # the client's, in its order

    def update(self, tree: Tree) -> TreeUpdate:
        """The update to a tree; one without some former vertices starts anew."""
        places, merged = np.unique(
            tree.vertices[:, 0] + 1j * tree.vertices[:, 1], return_inverse=True
        )
        found, numbers = self._find(places)
        if found.sum() < len(self._places):
            self._forget()
            found, numbers = self._find(places)
        first = len(self._places)
        numbers[~found] = first + np.arange(len(places) - first)
        parents, links = parents_and_links(Tree(places, _merged_edges(tree, merged)))
        by_number = np.empty(len(places), np.int64)
        by_number[numbers] = np.where(parents < 0, -1, numbers[parents])
        changed = np.flatnonzero(by_number[:first] != self._parents)
        new = places[~found]
        self._places, self._numbers, self._parents = places, numbers, by_number
        return TreeUpdate(
            first=first,
            vertices=rounded(np.column_stack((new.real, new.imag))),
            parents=by_number[first:].tolist(),
            changed=np.column_stack((changed, by_number[changed])).ravel().tolist(),
            links=numbers[links].tolist(),
        )

    def _find(self, places: NDArray[np.complex128]) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
        """Which places the client knows, and their numbers there."""
        if len(self._places) == 0:
            return np.zeros(len(places), bool), np.zeros(len(places), np.int64)
        at = np.minimum(np.searchsorted(self._places, places), len(self._places) - 1)
        return np.asarray(self._places[at] == places), self._numbers[at]


def _merged_edges(tree: Tree, merged: NDArray[np.intp]) -> NDArray[np.int64]:
    """(E, 2) edges between places; those within one are gone."""
    edges: NDArray[np.int64] = merged.reshape(-1)[tree.edges].reshape(-1, 2).astype(np.int64)
    return np.asarray(edges[edges[:, 0] != edges[:, 1]])
