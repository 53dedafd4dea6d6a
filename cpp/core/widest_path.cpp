#include "core/widest_path.hpp"

#include <cstddef>
#include <queue>
#include <utility>
#include <vector>

namespace planformer {

namespace {

/// Floods the grid from one cell, always through the best cells that border on the flood.
class Flood {
public:
    Flood(const FreeSpace& space, const float* values)
        : space_(space),
          values_(values),
          seen_(static_cast<std::size_t>(space.height) * static_cast<std::size_t>(space.width)) {}

    float reach(int from, int to) {
        see(from);
        while (!shore_.empty()) {
            const auto [level, cell] = shore_.top();
            shore_.pop();
            level_ = level < level_ ? level : level_;
            flooded_.push_back(cell);
            while (!flooded_.empty()) {
                const int next = flooded_.back();
                flooded_.pop_back();
                if (next == to) return level_;
                see_neighbours(next);
            }
        }
        return kNoPath;
    }

private:
    void see_neighbours(int cell) {
        const int row = cell / space_.width;
        const int col = cell % space_.width;
        if (row > 0) see(cell - space_.width);
        if (row + 1 < space_.height) see(cell + space_.width);
        if (col > 0) see(cell - 1);
        if (col + 1 < space_.width) see(cell + 1);
    }

    /// Cells that do not lower the level are flooded at once, which spares most of the heap's work.
    void see(int cell) {
        const auto index = static_cast<std::size_t>(cell);
        const float value = values_[index];
        if (seen_[index] || space_.blocked[index] != 0 || !(value >= 0.0f)) return;
        seen_[index] = true;
        if (value >= level_) {
            flooded_.push_back(cell);
        } else {
            shore_.emplace(value, cell);
        }
    }

    const FreeSpace& space_;
    const float* values_;
    std::vector<bool> seen_;
    std::vector<int> flooded_;                          ///< in the flood, neighbours not yet seen
    std::priority_queue<std::pair<float, int>> shore_;  ///< beside the flood, below its level
    float level_ = std::numeric_limits<float>::infinity();
};

}  // namespace

float widest_path(const FreeSpace& space, const float* values, int from, int to) {
    return Flood(space, values).reach(from, to);
}

}  // namespace planformer
