#include "core/free_space.hpp"

#include <cmath>
#include <limits>

namespace planformer {

namespace {

/// Crossings of grid lines closer than this (in cells) count as one crossing of a corner.
constexpr double kCornerTolerance = 1e-9;

/// The walk of a segment along one axis of the grid.
struct Axis {
    int cell;     ///< current cell
    int last;     ///< cell of the segment's end
    int step;     ///< +1 or -1
    double next;  ///< segment parameter in [0, 1] of the next grid line, infinite when done

    Axis(double from, double to)
        : cell(static_cast<int>(std::floor(from))),
          last(static_cast<int>(std::floor(to))),
          step(to >= from ? 1 : -1),
          from_(from),
          per_cell_(1.0 / (to - from)) {
        find_next();
    }

    void advance() {
        cell += step;
        find_next();
    }

private:
    /// From the line's number, not from the last crossing: sums drift on long segments.
    void find_next() {
        const int line = step > 0 ? cell + 1 : cell;
        next = cell == last ? std::numeric_limits<double>::infinity() : (line - from_) * per_cell_;
    }

    double from_;
    double per_cell_;  ///< parameter between two grid lines, negative on the way down
};

}  // namespace

bool FreeSpace::is_free(double x, double y) const {
    // Written so that NaN and values beyond the range of int fail before the conversion.
    const double col = x / resolution;
    const double row = y / resolution;
    if (!(col >= 0.0 && col < width && row >= 0.0 && row < height)) return false;
    return is_free(static_cast<int>(row), static_cast<int>(col));
}

bool FreeSpace::segment_is_free(double x0, double y0, double x1, double y1) const {
    if (!is_free(x0, y0) || !is_free(x1, y1)) return false;
    Axis col(x0 / resolution, x1 / resolution);
    Axis row(y0 / resolution, y1 / resolution);
    const double dx = std::abs(x1 - x0) / resolution;
    const double dy = std::abs(y1 - y0) / resolution;
    const double tolerance = kCornerTolerance / std::fmax(1.0, std::fmax(dx, dy));
    while (col.cell != col.last || row.cell != row.last) {
        if (std::abs(col.next - row.next) <= tolerance) {
            if (!is_free(row.cell + row.step, col.cell)) return false;
            if (!is_free(row.cell, col.cell + col.step)) return false;
            col.advance();
            row.advance();
        } else if (col.next < row.next) {
            col.advance();
        } else {
            row.advance();
        }
        if (!is_free(row.cell, col.cell)) return false;
    }
    return true;
}

}  // namespace planformer
