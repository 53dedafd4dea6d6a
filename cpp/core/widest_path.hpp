#pragma once

#include <limits>

#include "core/free_space.hpp"

namespace planformer {

/// What `widest_path` returns where no path exists.
constexpr float kNoPath = -std::numeric_limits<float>::infinity();

/// The largest value v such that free cells of at least v join two cells through 4-neighbours: the
/// bottleneck of the best of all paths (the maximin or widest path problem).
///
/// @param values  Row-major, one a cell; cells below 0 are as good as blocked.
/// @param from, to  Row-major indices inside the grid.
float widest_path(const FreeSpace& space, const float* values, int from, int to);

}  // namespace planformer
