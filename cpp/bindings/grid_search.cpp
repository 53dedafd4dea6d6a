/// Python functions of the searches on the grid itself.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bindings/bindings.hpp"
#include "core/hybrid_astar.hpp"
#include "core/lazy_theta.hpp"
#include "core/wavefront.hpp"
#include "core/widest_path.hpp"

namespace planformer {
namespace {

using PointArray = nb::ndarray<const double, nb::shape<2>, nb::c_contig, nb::device::cpu>;

Point to_point(const PointArray& xy) { return {xy.data()[0], xy.data()[1]}; }

using GridSearch = std::vector<Point>(const FreeSpace&, Point, Point);

NumpyArray<double> find_path(GridSearch* search, const BlockedArray& blocked, double resolution,
                             const PointArray& start, const PointArray& goal) {
    const FreeSpace space = free_space_of(blocked, resolution);
    std::vector<double> values;
    {
        const nb::gil_scoped_release unlocked;
        for (const Point& point : search(space, to_point(start), to_point(goal))) {
            values.insert(values.end(), {point.x, point.y});
        }
    }
    const std::size_t count = values.size() / 2;
    return to_numpy(std::move(values), {count, 2});
}

NumpyArray<double> find_car_path(const BlockedArray& blocked, double resolution,
                                 double turning_radius, bool reverse, const PoseArray& start,
                                 const PoseArray& goal, std::size_t max_expansions) {
    const FreeSpace space = free_space_of(blocked, resolution);
    require_positive("turning_radius", turning_radius);
    std::vector<Pose> poses;
    {
        const nb::gil_scoped_release unlocked;
        poses = hybrid_astar(space, {turning_radius, reverse}, to_pose(start.data()),
                             to_pose(goal.data()), max_expansions);
    }
    return to_numpy(poses);
}

using ValueArray = nb::ndarray<const float, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Cell = std::array<int, 2>;

int index_of(const FreeSpace& space, const Cell& cell) {
    const auto [row, col] = cell;
    if (row < 0 || row >= space.height || col < 0 || col >= space.width) {
        throw nb::index_error("the cell lies outside the grid");
    }
    return row * space.width + col;
}

void require_inside(const FreeSpace& space, const Cell& cell) { index_of(space, cell); }

/// (3, h, w): from the start, from the goal, excess.
std::optional<NumpyArray<float>> find_detours(const BlockedArray& blocked, const Cell& start,
                                              const Cell& goal, double limit, int side) {
    const FreeSpace space = free_space_of(blocked, 1.0);
    require_inside(space, start);
    require_inside(space, goal);
    require_positive("side", side);
    std::optional<Detours> found;
    {
        const nb::gil_scoped_release unlocked;
        found = detours(space, start, goal, limit, side);
    }
    if (!found) return std::nullopt;
    std::vector<float> values = std::move(found->from_start);
    for (const auto* part : {&found->from_goal, &found->excess}) {
        values.insert(values.end(), part->begin(), part->end());
    }
    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    return to_numpy(std::move(values), {3, size(found->height), size(found->width)});
}

std::optional<float> find_widest_path(const BlockedArray& blocked, const ValueArray& values,
                                      const Cell& from, const Cell& to) {
    const FreeSpace space = free_space_of(blocked, 1.0);
    if (values.shape(0) != blocked.shape(0) || values.shape(1) != blocked.shape(1)) {
        throw nb::value_error("values and blocked must have the same shape");
    }
    const int first = index_of(space, from);
    const int last = index_of(space, to);
    float level = kNoPath;
    {
        const nb::gil_scoped_release unlocked;
        level = widest_path(space, values.data(), first, last);
    }
    return level == kNoPath ? std::nullopt : std::optional<float>(level);
}

}  // namespace

void register_grid_search(nb::module_& m) {
    const auto def_search = [&m](const char* name, GridSearch* search, const char* doc) {
        m.def(
            name,
            [search](const BlockedArray& blocked, double resolution, const PointArray& start,
                     const PointArray& goal) {
                return find_path(search, blocked, resolution, start, goal);
            },
            nb::arg("blocked"), nb::arg("resolution"), nb::arg("start"), nb::arg("goal"), doc);
    };
    def_search("lazy_theta", &lazy_theta,
               "Any-angle shortest path between two points, (N, 2) float64 in metres of the local\n"
               "frame, start and goal included; (0, 2) when no path joins them.");
    def_search("astar", &astar, "The same by A* on the 8-connected grid with shortcuts.");
    m.def("hybrid_astar", &find_car_path, nb::arg("blocked"), nb::arg("resolution"),
          nb::arg("turning_radius"), nb::arg("reverse"), nb::arg("start"), nb::arg("goal"),
          nb::arg("max_expansions"),
          "Short path of a car between two poses by Hybrid-A*, (N, 3) float64 poses of the local\n"
          "frame, start and goal included; (0, 3) when none is found.");
    m.def(
        "detours", &find_detours, nb::arg("blocked"), nb::arg("start"), nb::arg("goal"),
        nb::arg("limit"), nb::arg("side"),
        "Least geodesic distance in cells from the start and from the goal (row, col), and least\n"
        "detour, in each square of side x side cells: (3, h, w) float32; only cells count whose\n"
        "detour is at most the limit, infinite where there are none. None when no way joins start\n"
        "and goal.");
    m.def("widest_path", &find_widest_path, nb::arg("blocked"), nb::arg("values"), nb::arg("start"),
          nb::arg("goal"),
          "The largest value such that free cells of at least that value join two cells (row,\n"
          "col) through 4-neighbours; None when no free cells of values >= 0 do.");
}

}  // namespace planformer
