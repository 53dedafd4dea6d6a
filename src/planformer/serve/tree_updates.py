"""What is new in a growing tree: a whole tree each time would be too much to send."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from planformer.planning import Tree
from planformer.robots import Robot
from planformer.serve.answers import curves, parents_and_links, rounded
from planformer.serve.responses import TreeUpdate


class TreeUpdates:
    """Updates that turn the tree that a client has into the latest one.

    A vertex is known by its place: no planner moves one, and vertices in the same place look the
    same. So they are sent as one.

    Args:
        robot: Whose trees they are.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._forget()

    def _forget(self) -> None:
        self._places = np.empty(0, np.complex128)  # sorted
        self._numbers = np.empty(0, np.int64)  # the client's, of each place
        self._parents = np.empty(0, np.int64)  # the client's, in its order

    def update(self, tree: Tree) -> TreeUpdate:
        """The update to a tree; one without some former vertices starts anew."""
        places, of_place, merged = np.unique(
            tree.vertices[:, 0] + 1j * tree.vertices[:, 1], return_index=True, return_inverse=True
        )
        numbers = self._numbered(places)
        first = len(self._places)
        states = np.empty((len(places), tree.vertices.shape[1]))
        states[numbers] = tree.vertices[of_place]
        of_places, links = parents_and_links(Tree(places, _merged_edges(tree, merged)))
        parents = np.empty(len(places), np.int64)
        parents[numbers] = np.where(of_places < 0, -1, numbers[of_places])
        changed = np.flatnonzero(parents[:first] != self._parents)
        links = numbers[links].reshape(-1, 2)
        self._places, self._numbers, self._parents = places, numbers, parents
        hung = np.concatenate((np.arange(first, len(places)), changed))
        edges = np.concatenate((np.column_stack((parents[hung], hung)), links))
        return TreeUpdate(
            first=first,
            vertices=rounded(states[first:, :2]),
            parents=parents[first:].tolist(),
            changed=np.column_stack((changed, parents[changed])).ravel().tolist(),
            links=links.ravel().tolist(),
            curves=curves(self._robot, states, edges),
        )

    def _numbered(self, places: NDArray[np.complex128]) -> NDArray[np.int64]:
        """The client's numbers of places; those that it does not know follow those that it does."""
        found, numbers = self._find(places)
        if found.sum() < len(self._places):
            self._forget()
            found, numbers = self._find(places)
        first = len(self._places)
        numbers[~found] = first + np.arange(len(places) - first)
        return numbers

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
