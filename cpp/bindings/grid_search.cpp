/// Python functions of the searches on the grid itself.
#include <cstdint>
#include <utility>
#include <vector>

#include "bindings/bindings.hpp"
#include "core/lazy_theta.hpp"
#include "core/wavefront.hpp"

namespace planformer {
namespace {

using PointArray = nb::ndarray<const double, nb::shape<2>, nb::c_contig, nb::device::cpu>;

Point to_point(const PointArray& xy) { return {xy.data()[0], xy.data()[1]}; }

NumpyArray<double> find_path(const BlockedArray& blocked, double resolution,
                             const PointArray& start, const PointArray& goal) {
    const FreeSpace space = free_space_of(blocked, resolution);
    std::vector<double> values;
    {
        const nb::gil_scoped_release unlocked;
        for (const Point& point : lazy_theta(space, to_point(start), to_point(goal))) {
            values.insert(values.end(), {point.x, point.y});
        }
    }
    const std::size_t count = values.size() / 2;
    return to_numpy(std::move(values), {count, 2});
}

NumpyArray<float> find_distances(const BlockedArray& blocked, std::int64_t row, std::int64_t col) {
    const FreeSpace space = free_space_of(blocked, 1.0);
    if (row < 0 || row >= space.height || col < 0 || col >= space.width) {
        throw nb::index_error("the source cell lies outside the grid");
    }
    std::vector<float> distances(blocked.size());
    {
        const nb::gil_scoped_release unlocked;
        wavefront(space.blocked, space.height, space.width, static_cast<int>(row),
                  static_cast<int>(col), distances.data());
    }
    return to_numpy(std::move(distances), {blocked.shape(0), blocked.shape(1)});
}

}  // namespace

void register_grid_search(nb::module_& m) {
    m.def("lazy_theta", &find_path, nb::arg("blocked"), nb::arg("resolution"), nb::arg("start"),
          nb::arg("goal"),
          "Any-angle shortest path between two points, (N, 2) float64 in metres of the local\n"
          "frame, start and goal included; (0, 2) when no path joins them.");
    m.def("wavefront", &find_distances, nb::arg("blocked"), nb::arg("row"), nb::arg("col"),
          "Geodesic distance in cells from one cell to all, (h, w) float32, infinite where\n"
          "unreachable; 8-connected, diagonal steps don't cut corners.");
}

}  // namespace planformer
