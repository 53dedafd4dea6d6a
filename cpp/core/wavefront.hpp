#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/free_space.hpp"

namespace planformer {

/// Geodesic distance in cells from one cell to all others on the 8-connected grid: a straight step
/// costs 1, a diagonal one sqrt(2) and only between two free side cells.
///
/// @param row, col  The source, inside the grid; it may be blocked, the wave leaves it anyway.
/// @return height x width values, row-major; +infinity where the wave does not come.
std::vector<float> wavefront(const FreeSpace& space, int row, int col);

/// For each square of side x side cells, the least over its cells of: the distance from the start,
/// the distance from the goal, and the detour, that is how much longer than the shortest the way
/// through the cell is. Row-major, the squares at the upper edges may be smaller; +infinity where
/// no cell counts.
struct Detours {
    int height;
    int width;
    std::vector<float> from_start;
    std::vector<float> from_goal;
    std::vector<float> excess;
};

/// Geodesic distances as above from a start and from a goal, whose own cells count as free, at the
/// cells whose detour is at most `limit`.
///
/// An A* search from the start finds all cells that may count; a wave from the goal then spreads
/// over these alone, for every cell on a shortest way to one that counts counts itself.
///
/// @param start, goal  (row, col), inside the grid.
/// @param limit        In cells, >= 0.
/// @return Nothing where no way joins start and goal.
std::optional<Detours> detours(const FreeSpace& space, std::array<int, 2> start,
                               std::array<int, 2> goal, double limit, int side);

}  // namespace planformer
