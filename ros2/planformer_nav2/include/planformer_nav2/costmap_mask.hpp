#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "planformer_nav2/grid.hpp"

namespace planformer_nav2 {

/// Costs with a meaning of their own, as in nav2_costmap_2d.
constexpr unsigned char kInscribed = 253;
constexpr unsigned char kLethal = 254;
constexpr unsigned char kUnknown = 255;

/// The cells of somebody else's costmap, row by row from the origin.
struct CostmapView {
    unsigned char* cells = nullptr;
    Grid grid;
};

/// A place that stays as it is, whether it lies in the region or not: the cells whose centre lies
/// in it, and the one that its own centre lies in.
struct Disc {
    double x = 0.0;       ///< [m]
    double y = 0.0;       ///< [m]
    double radius = 0.0;  ///< [m]
};

/// What becomes of unknown cells outside the region.
enum class UnknownOutside {
    kClose,  ///< inscribed: for planners that enter unknown cells
    kKeep,   ///< unknown: for planners that never do, and keep their footprint out of them as well
};

/// Closes a costmap outside a region for as long as it lives, then puts back every cell.
///
/// Outside becomes "inscribed": no planner puts the robot's centre there. "Lethal" would keep the
/// robot's footprint out as well and so shrink the region by the footprint. Lethal cells outside
/// stay lethal all the same, since a footprint inside the region may reach them. Inside, nothing
/// changes.
///
/// The cells have to stay where they are meanwhile: hold the costmap's lock.
class CostmapMask {
public:
    /// `region` holds a value for each cell, 0 outside.
    ///
    /// Throws std::invalid_argument if it does not, before any cell is changed.
    CostmapMask(const CostmapView& costmap, const std::vector<std::uint8_t>& region,
                const std::vector<Disc>& kept, UnknownOutside unknown)
        : costmap_(costmap) {
        require_same_size(costmap.grid, region);
        saved_.assign(costmap.cells, costmap.cells + region.size());
        close_outside(region, unknown);
        for (const Disc& disc : kept) reopen(disc);
    }

    ~CostmapMask() { std::copy(saved_.begin(), saved_.end(), costmap_.cells); }

    CostmapMask(const CostmapMask&) = delete;
    CostmapMask& operator=(const CostmapMask&) = delete;

private:
    struct Range {
        unsigned int first;
        unsigned int end;
    };

    static void require_same_size(const Grid& grid, const std::vector<std::uint8_t>& region) {
        if (region.size() == grid.cell_count()) return;
        throw std::invalid_argument("the region has " + std::to_string(region.size()) +
                                    " cells, the costmap has " + std::to_string(grid.width) +
                                    " x " + std::to_string(grid.height));
    }

    void close_outside(const std::vector<std::uint8_t>& region, UnknownOutside unknown) {
        const bool keep_unknown = unknown == UnknownOutside::kKeep;
        for (std::size_t i = 0; i < region.size(); ++i) {
            unsigned char& cost = costmap_.cells[i];
            const bool stays = cost == kLethal || (cost == kUnknown && keep_unknown);
            if (region[i] == 0 && !stays) cost = kInscribed;
        }
    }

    void reopen(const Disc& disc) {
        const Grid& grid = costmap_.grid;
        const double x = (disc.x - grid.origin_x) / grid.resolution;  // [cells], as below
        const double y = (disc.y - grid.origin_y) / grid.resolution;
        const double radius = disc.radius / grid.resolution;
        const Range columns = cells_between(x - radius, x + radius, grid.width);
        const Range rows = cells_between(y - radius, y + radius, grid.height);
        for (unsigned int row = rows.first; row < rows.end; ++row) {
            for (unsigned int column = columns.first; column < columns.end; ++column) {
                const bool is_own = column == std::floor(x) && row == std::floor(y);
                const bool is_near = std::hypot(column + 0.5 - x, row + 0.5 - y) <= radius;
                const std::size_t cell = std::size_t{row} * grid.width + column;
                if (is_own || is_near) costmap_.cells[cell] = saved_[cell];
            }
        }
    }

    /// Indices of the cells that [low, high] touches; none where it lies outside the map.
    static Range cells_between(double low, double high, unsigned int count) {
        return {clamp_to_index(std::floor(low), count),
                clamp_to_index(std::floor(high) + 1.0, count)};
    }

    /// Never converts what an index cannot hold; no number becomes 0.
    static unsigned int clamp_to_index(double value, unsigned int count) {
        if (!(value > 0.0)) return 0;
        return value < count ? static_cast<unsigned int>(value) : count;
    }

    CostmapView costmap_;
    std::vector<unsigned char> saved_;
};

}  // namespace planformer_nav2
