#include "core/wavefront.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace planformer {
namespace {

/// Lengths in 1 / 985 of a cell: exact sums, in half of a double's memory. sqrt(2) is 1393 / 985
/// but for 3 parts in 10 million.
using Length = std::uint32_t;
constexpr Length kStraight = 985;
constexpr Length kDiagonal = 1393;
constexpr Length kUnreached = std::numeric_limits<Length>::max();
/// Ways that are longer, of millions of cells, are none: a step beyond would not fit.
constexpr Length kLongest = kUnreached - kDiagonal - 1;
/// Sums of lengths.
using Total = std::uint64_t;

float in_cells(Length length) {
    return length == kUnreached ? std::numeric_limits<float>::infinity()
                                : static_cast<float>(length / static_cast<double>(kStraight));
}

/// A cell of a padded grid.
struct Cell {
    int index;
    int row;
    int col;
};

/// The grid inside a ring of blocked cells, so that no step needs a bounds check.
class PaddedGrid {
public:
    explicit PaddedGrid(const FreeSpace& space)
        : stride_(space.width + 2),
          free_((static_cast<std::size_t>(space.height) + 2) * stride_, 0) {
        for (int r = 0; r < space.height; ++r) {
            const std::uint8_t* row = space.blocked + static_cast<std::size_t>(r) * space.width;
            std::uint8_t* padded = free_.data() + at(r, 0).index;
            for (int c = 0; c < space.width; ++c) padded[c] = row[c] == 0;
        }
    }

    void open(Cell cell) { free_[cell.index] = 1; }
    std::size_t size() const { return free_.size(); }
    bool is_free(Cell cell) const { return free_[cell.index] != 0; }
    Cell at(int row, int col) const { return {(row + 1) * stride_ + col + 1, row, col}; }
    Cell beside(Cell cell, int rows, int cols) const {
        return {cell.index + rows * stride_ + cols, cell.row + rows, cell.col + cols};
    }

private:
    int stride_;
    std::vector<std::uint8_t> free_;
};

struct FreeMemory {
    void operator()(Length* memory) const { std::free(memory); }
};

/// Dijkstra's algorithm with buckets one cell of distance wide. No step costs less than 1, so no
/// cell of a bucket can improve another one of it: their order is free (Denardo and Fox,
/// Operations Research 27(1), 1979). No step costs 2 or more, so a third bucket is the last.
class Wave {
public:
    explicit Wave(const PaddedGrid& grid)
        : grid_(grid),
          length_plus_1_(static_cast<Length*>(std::calloc(grid.size(), sizeof(Length)))) {
        if (!length_plus_1_) throw std::bad_alloc();
    }

    Length length(Cell cell) const { return length_plus_1_[cell.index] - 1; }

    /// Spreads from a cell over all but those where admit(cell), asked with the final length, is
    /// false.
    template <class Admit>
    void spread(Cell source, const Admit& admit) {
        set_length(source, 0);
        spread(std::vector<Cell>{source}, admit);
    }

    /// Goes on from cells that were not admitted before.
    template <class Admit>
    void spread(std::vector<Cell> from, const Admit& admit) {
        std::sort(from.begin(), from.end(),
                  [this](Cell a, Cell b) { return length(a) > length(b); });
        while (true) {
            if (buckets_[0].empty() && buckets_[1].empty() && buckets_[2].empty()) {
                if (from.empty()) return;
                floor_ = length(from.back());
            }
            for (; !from.empty() && length(from.back()) < floor_ + kStraight; from.pop_back()) {
                buckets_[0].push_back(from.back());
            }
            for (const Cell cell : buckets_[0]) {
                // Else it was reached on a shorter way before.
                if (length(cell) >= floor_ && admit(cell)) expand(cell);
            }
            buckets_[0].clear();
            std::swap(buckets_[0], buckets_[1]);
            std::swap(buckets_[1], buckets_[2]);
            floor_ += kStraight;
        }
    }

private:
    void set_length(Cell cell, Length length) { length_plus_1_[cell.index] = length + 1; }

    void expand(Cell cell) {
        const Length length = this->length(cell);
        if (length > kLongest) return;
        const auto step = [&](int rows, int cols, Length size) {
            return reach(grid_.beside(cell, rows, cols), length + size);
        };
        const bool east = step(0, 1, kStraight);
        const bool west = step(0, -1, kStraight);
        const bool north = step(1, 0, kStraight);
        const bool south = step(-1, 0, kStraight);
        if (north && east) step(1, 1, kDiagonal);
        if (north && west) step(1, -1, kDiagonal);
        if (south && east) step(-1, 1, kDiagonal);
        if (south && west) step(-1, -1, kDiagonal);
    }

    /// Offers a cell a way of this length; returns whether the cell is free.
    bool reach(Cell cell, Length length) {
        if (!grid_.is_free(cell)) return false;
        if (length < this->length(cell)) {
            set_length(cell, length);
            buckets_[(length - floor_) / kStraight].push_back(cell);
        }
        return true;
    }

    const PaddedGrid& grid_;
    /// Zero, for kUnreached + 1, where the wave has not come: on a large map the system never makes
    /// the pages of zeros that nothing touches.
    std::unique_ptr<Length[], FreeMemory> length_plus_1_;
    std::vector<Cell> buckets_[3];
    Total floor_ = 0;  ///< Lower edge of the first bucket.
};

/// Distance between two cells of a grid without obstacles.
Total octile(Cell from, Cell to) {
    const auto rows = static_cast<Total>(std::abs(from.row - to.row));
    const auto cols = static_cast<Total>(std::abs(from.col - to.col));
    const Total diagonal = std::min(rows, cols);
    return kStraight * (std::max(rows, cols) - diagonal) + kDiagonal * diagonal;
}

/// The square that each row or column belongs to.
std::vector<int> squares(int cells, int side) {
    std::vector<int> result(cells);
    for (int i = 0; i < cells; ++i) result[i] = i / side;
    return result;
}

/// Distances from the source at all cells where distance + octile distance to the target is at most
/// the target's distance + limit; and at others, where they may be too long.
///
/// The bound grows until it suffices: by A*'s argument, what is within a bound is exact.
void spread_towards(Wave& wave, Cell source, Cell target, Total limit) {
    Total bound = octile(source, target) + limit;
    std::vector<Cell> stopped;
    const auto admit = [&](Cell cell) {
        if (wave.length(cell) + octile(cell, target) <= bound) return true;
        stopped.push_back(cell);
        return false;
    };
    wave.spread(source, admit);
    while (!stopped.empty()) {
        const Length found = wave.length(target);
        if (found != kUnreached && found + limit <= bound) return;
        bound = found != kUnreached ? found + limit : bound / 4 * 5;
        wave.spread(std::exchange(stopped, {}), admit);
    }
}

std::vector<float> in_cells(const std::vector<Length>& lengths) {
    std::vector<float> cells(lengths.size());
    std::transform(lengths.begin(), lengths.end(), cells.begin(),
                   [](Length length) { return in_cells(length); });
    return cells;
}

}  // namespace

std::vector<float> wavefront(const FreeSpace& space, int row, int col) {
    const PaddedGrid grid(space);
    Wave wave(grid);
    wave.spread(grid.at(row, col), [](Cell) { return true; });
    std::vector<float> distances;
    distances.reserve(static_cast<std::size_t>(space.height) * space.width);
    for (int r = 0; r < space.height; ++r) {
        for (int c = 0; c < space.width; ++c) {
            distances.push_back(in_cells(wave.length(grid.at(r, c))));
        }
    }
    return distances;
}

std::optional<Detours> detours(const FreeSpace& space, std::array<int, 2> start,
                               std::array<int, 2> goal, double limit, int side) {
    PaddedGrid grid(space);
    const Cell source = grid.at(start[0], start[1]);
    const Cell target = grid.at(goal[0], goal[1]);
    grid.open(source);
    grid.open(target);
    Wave outward(grid);
    // No detour on the grid is as long as a step for each of its cells.
    const double cells = std::min(limit, static_cast<double>(grid.size()));
    const auto longest_detour = static_cast<Total>(cells * kStraight);
    spread_towards(outward, source, target, longest_detour);
    const Length shortest = outward.length(target);
    if (shortest == kUnreached) return std::nullopt;

    const std::vector<int> rows = squares(space.height, side);
    const std::vector<int> cols = squares(space.width, side);
    const int height = rows.back() + 1;
    const int width = cols.back() + 1;
    // Converted in the end, once for each square.
    std::vector<Length> least_from_start(static_cast<std::size_t>(height) * width, kUnreached);
    std::vector<Length> least_from_goal = least_from_start;
    std::vector<Length> least_excess = least_from_start;
    Wave inward(grid);
    inward.spread(target, [&](Cell cell) {
        const Length length = inward.length(cell);
        const Length from_start = outward.length(cell);
        if (from_start == kUnreached) return false;
        const Total detour = Total{from_start} + length - shortest;
        if (detour > longest_detour) return false;
        const std::size_t square =
            static_cast<std::size_t>(rows[cell.row]) * width + cols[cell.col];
        least_from_start[square] = std::min(least_from_start[square], from_start);
        least_from_goal[square] = std::min(least_from_goal[square], length);
        least_excess[square] = std::min(least_excess[square], static_cast<Length>(detour));
        return true;
    });
    return Detours{height, width, in_cells(least_from_start), in_cells(least_from_goal),
                   in_cells(least_excess)};
}

}  // namespace planformer
