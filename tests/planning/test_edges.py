from __future__ import annotations

import numpy as np

import planformer as pf
from planformer.planning import edge_lines


def test_car_edges_are_arcs_between_their_states():
    robot = pf.DubinsCar(0.1, 0.5)
    states = np.array([(0.0, 0.0, 0.0), (1.0, 2.0, 2.0), (-2.0, 1.0, -1.0)])
    edges = np.array([(0, 1), (1, 2)])
    for line, (parent, child) in zip(edge_lines(robot, states, edges), edges, strict=True):
        np.testing.assert_allclose(line[[0, -1]], states[[parent, child], :2], atol=1e-9)
        assert len(line) > 4
    (straight,) = edge_lines(pf.PointRobot(), states[:, :2], edges[:1])
    np.testing.assert_array_equal(straight, states[:2, :2])
