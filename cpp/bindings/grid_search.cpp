#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "core/free_space.hpp"
#include "core/lazy_theta.hpp"
#include "core/wavefront.hpp"

namespace nb = nanobind;

namespace planformer {
namespace {

/// NumPy converts arrays of another type or layout on the way in.
using BlockedArray = nb::ndarray<const bool, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using PointArray = nb::ndarray<const double, nb::shape<2>, nb::c_contig, nb::device::cpu>;
using Path = nb::ndarray<nb::numpy, double, nb::shape<-1, 2>>;
using Distances = nb::ndarray<nb::numpy, float, nb::ndim<2>>;

static_assert(sizeof(bool) == sizeof(std::uint8_t));

const std::uint8_t* cells(const BlockedArray& blocked) {
    return reinterpret_cast<const std::uint8_t*>(blocked.data());
}

void check_size(const BlockedArray& blocked) {
    if (blocked.size() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
        throw nb::value_error("blocked must have fewer than 2^31 - 1 cells");
    }
}

template <typename T>
nb::capsule owner_of(T* data) {
    return nb::capsule(data, [](void* p) noexcept { delete[] static_cast<T*>(p); });
}

Path to_array(const std::vector<Point>& path) {
    auto* data = new double[2 * path.size()];
    nb::capsule owner = owner_of(data);
    for (std::size_t i = 0; i < path.size(); ++i) {
        data[2 * i] = path[i].x;
        data[2 * i + 1] = path[i].y;
    }
    return Path(data, {path.size(), 2}, owner);
}

Path find_path(const BlockedArray& blocked, double resolution, const PointArray& start,
               const PointArray& goal) {
    check_size(blocked);
    if (!(resolution > 0.0)) {
        throw nb::value_error("resolution must be positive");
    }
    const FreeSpace space{static_cast<int>(blocked.shape(0)), static_cast<int>(blocked.shape(1)),
                          resolution, cells(blocked)};
    const Point from{start.data()[0], start.data()[1]};
    const Point to{goal.data()[0], goal.data()[1]};
    std::vector<Point> path;
    {
        nb::gil_scoped_release release;
        path = lazy_theta(space, from, to);
    }
    return to_array(path);
}

Distances find_distances(const BlockedArray& blocked, std::int64_t row, std::int64_t col) {
    check_size(blocked);
    const auto height = static_cast<std::int64_t>(blocked.shape(0));
    const auto width = static_cast<std::int64_t>(blocked.shape(1));
    if (row < 0 || row >= height || col < 0 || col >= width) {
        throw nb::index_error("the source cell lies outside the grid");
    }
    auto* data = new float[blocked.size()];
    nb::capsule owner = owner_of(data);
    {
        nb::gil_scoped_release release;
        wavefront(cells(blocked), static_cast<int>(height), static_cast<int>(width),
                  static_cast<int>(row), static_cast<int>(col), data);
    }
    return Distances(data, {blocked.shape(0), blocked.shape(1)}, owner);
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
