#pragma once

#include <vector>

#include "core/free_space.hpp"

namespace planformer {

/// A point in the map's local frame, in metres.
struct Point {
    double x;
    double y;
};

/// Any-angle shortest path on a blocked grid by Lazy Theta* (Nash, Koenig and Tovey, "Lazy
/// Theta*: Any-Angle Path Planning and Path Length Analysis in 3D", AAAI 2010, fig. 5), then
/// tightened: greedy line-of-sight shortcuts, and vertices moved from cell to cell while the path
/// gets shorter. That takes out the slack that the search's unproven parents leave.
///
/// The search runs over the centres of the free cells; the cells of `start` and `goal` stand for
/// exactly these points. Every segment of the result satisfies `FreeSpace::segment_is_free`.
///
/// @param space  Fewer than 2^31 - 1 cells.
/// @return The vertices, `start` first and `goal` last, so at least two of them; empty when
///         either point is blocked or no path joins them. The path is within a fraction of a
///         percent of the shortest any-angle one in practice, without a guarantee.
std::vector<Point> lazy_theta(const FreeSpace& space, Point start, Point goal);

/// A path by A* on the 8-connected grid, then greedy line-of-sight shortcuts; as `lazy_theta` but
/// longer, mostly by less than a percent.
std::vector<Point> astar(const FreeSpace& space, Point start, Point goal);

}  // namespace planformer
