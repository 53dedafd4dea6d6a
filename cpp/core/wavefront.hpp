#pragma once

#include <cstdint>

namespace planformer {

/// Geodesic distance in cells from one cell to all others by Dijkstra's algorithm on the
/// 8-connected grid: a straight step costs 1, a diagonal one sqrt(2) and only between two free
/// side cells.
///
/// @param blocked   Row-major height x width, nonzero = blocked.
/// @param row, col  The source, inside the grid; it may be blocked, the wave leaves it anyway.
/// @param distance  Receives height x width values; +infinity where the wave does not come.
void wavefront(const std::uint8_t* blocked, int height, int width, int row, int col,
               float* distance);

}  // namespace planformer
