#pragma once

#include <cstddef>

namespace planformer_nav2 {

/// Size and place of a costmap; the origin is the lower left corner of cell (0, 0).
struct Grid {
    unsigned int width = 0;   ///< [cells]
    unsigned int height = 0;  ///< [cells]
    double resolution = 0.0;  ///< [m]
    double origin_x = 0.0;    ///< [m]
    double origin_y = 0.0;    ///< [m]

    std::size_t cell_count() const { return std::size_t{width} * height; }
};

/// Exact, since any difference would lay a mask beside the map that it was made for.
inline bool operator==(const Grid& a, const Grid& b) {
    return a.width == b.width && a.height == b.height && a.resolution == b.resolution &&
           a.origin_x == b.origin_x && a.origin_y == b.origin_y;
}

inline bool operator!=(const Grid& a, const Grid& b) { return !(a == b); }

}  // namespace planformer_nav2
