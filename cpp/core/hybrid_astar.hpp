#pragma once

#include <cstddef>
#include <vector>

#include "core/curve.hpp"
#include "core/free_space.hpp"

namespace planformer {

/// The smallest turning radius [m] of a car, and whether it can drive backwards.
struct CarTurning {
    double radius = 0.55;
    bool reverse = false;
};

/// A short path of a car by Hybrid-A* (Dolgov, Thrun, Montemerlo and Diebel, "Path Planning for
/// Autonomous Vehicles in Unknown Semi-structured Environments", IJRR 29(5), 2010): A* over cells
/// of position and heading that keep continuous poses, and from every expanded pose an attempt to
/// reach the goal by the car's shortest curve.
///
/// The cells and the steps between poses are fixed shares of the turning radius. The search goes
/// on until no open pose can lead to a path more than 2 % shorter than the best one found.
///
/// @param max_expansions  Poses expanded at most.
/// @return Poses from `start` to `goal`, joined by arcs of half a cell of the grid or by straight
///         lines, every one of them free as `curve_is_free` says; empty when there is no path at
///         this resolution or within `max_expansions`.
std::vector<Pose> hybrid_astar(const FreeSpace& space, const CarTurning& car, const Pose& start,
                               const Pose& goal, std::size_t max_expansions);

}  // namespace planformer
