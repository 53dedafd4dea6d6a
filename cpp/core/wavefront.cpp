#include "core/wavefront.hpp"

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace planformer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSqrt2 = 1.41421356237309504880;

/// The grid inside a ring of blocked cells, so that no step needs a bounds check.
class PaddedGrid {
public:
    PaddedGrid(const std::uint8_t* blocked, int height, int width)
        : height_(height),
          width_(width),
          stride_(static_cast<std::ptrdiff_t>(width) + 2),
          free_((static_cast<std::size_t>(height) + 2) * stride_, 0) {
        for (int r = 0; r < height; ++r) {
            for (int c = 0; c < width; ++c) {
                free_[index(r, c)] = blocked[static_cast<std::size_t>(r) * width + c] == 0;
            }
        }
    }

    std::size_t size() const { return free_.size(); }
    std::ptrdiff_t stride() const { return stride_; }
    bool is_free(std::ptrdiff_t cell) const { return free_[cell] != 0; }
    std::ptrdiff_t index(int row, int col) const { return (row + 1) * stride_ + col + 1; }

    void copy_inside(const std::vector<double>& padded, float* out) const {
        for (int r = 0; r < height_; ++r) {
            for (int c = 0; c < width_; ++c) {
                *out++ = static_cast<float>(padded[index(r, c)]);
            }
        }
    }

private:
    int height_;
    int width_;
    std::ptrdiff_t stride_;
    std::vector<std::uint8_t> free_;
};

/// Dijkstra's algorithm with buckets one cell of distance wide. No step costs less than 1, so no
/// cell of the lowest bucket can improve another one of it: their order is free (Denardo and Fox,
/// Operations Research 27(1), 1979). No step costs 2 or more, so a third bucket is the last.
class Wave {
public:
    explicit Wave(const PaddedGrid& grid) : grid_(grid), distance_(grid.size(), kInfinity) {}

    const std::vector<double>& spread(std::ptrdiff_t source) {
        distance_[source] = 0.0;
        buckets_[0].push_back(source);
        while (!(buckets_[0].empty() && buckets_[1].empty() && buckets_[2].empty())) {
            for (const std::ptrdiff_t cell : buckets_[0]) {
                if (distance_[cell] >= floor_) {  // else it was reached on a shorter way before
                    expand(cell);
                }
            }
            buckets_[0].clear();
            std::swap(buckets_[0], buckets_[1]);
            std::swap(buckets_[1], buckets_[2]);
            floor_ += 1.0;
        }
        return distance_;
    }

private:
    void expand(std::ptrdiff_t cell) {
        const std::ptrdiff_t up = grid_.stride();
        const double length = distance_[cell];
        const bool east = reach(cell + 1, length + 1.0);
        const bool west = reach(cell - 1, length + 1.0);
        const bool north = reach(cell + up, length + 1.0);
        const bool south = reach(cell - up, length + 1.0);
        if (north && east) reach(cell + up + 1, length + kSqrt2);
        if (north && west) reach(cell + up - 1, length + kSqrt2);
        if (south && east) reach(cell - up + 1, length + kSqrt2);
        if (south && west) reach(cell - up - 1, length + kSqrt2);
    }

    /// Offers a cell a way of this length; returns whether the cell is free.
    bool reach(std::ptrdiff_t cell, double length) {
        if (!grid_.is_free(cell)) {
            return false;
        }
        if (length < distance_[cell]) {
            distance_[cell] = length;
            const auto bucket = static_cast<int>(length - floor_);
            buckets_[bucket].push_back(cell);
        }
        return true;
    }

    const PaddedGrid& grid_;
    std::vector<double> distance_;
    std::vector<std::ptrdiff_t> buckets_[3];
    double floor_ = 0.0;  ///< Lower edge of the first bucket.
};

}  // namespace

void wavefront(const std::uint8_t* blocked, int height, int width, int row, int col,
               float* distance) {
    const PaddedGrid grid(blocked, height, width);
    Wave wave(grid);
    grid.copy_inside(wave.spread(grid.index(row, col)), distance);
}

}  // namespace planformer
