#pragma once

#include <cstddef>
#include <cstdint>

namespace planformer {

/// A view of the robot-inflated occupancy grid, in the map's local frame.
///
/// Cell (r, c) covers [c, c + 1) x [r, r + 1) times the resolution. The caller owns the cells and
/// keeps them alive. Everything outside the grid is blocked.
struct FreeSpace {
    int height = 0;                         ///< rows
    int width = 0;                          ///< columns
    double resolution = 1.0;                ///< metres per cell
    const std::uint8_t* blocked = nullptr;  ///< row-major, non-zero where the robot may not be

    bool is_free(int row, int col) const {
        return row >= 0 && row < height && col >= 0 && col < width &&
               blocked[static_cast<std::size_t>(row) * width + col] == 0;
    }

    /// Whether the cell that holds the point (x, y) [m] is free; false for NaN.
    bool is_free(double x, double y) const;

    /// Whether every cell that the closed segment touches is free.
    ///
    /// A segment through a corner shared by four cells touches the two cells beside it as well, so
    /// that it never slips between two diagonal obstacles.
    bool segment_is_free(double x0, double y0, double x1, double y1) const;

    double extent_x() const { return width * resolution; }
    double extent_y() const { return height * resolution; }
};

}  // namespace planformer
