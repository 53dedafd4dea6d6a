/// Python functions on the car's curves, for tests and pictures.
#include <cstddef>
#include <utility>
#include <vector>

#include "bindings/bindings.hpp"
#include "core/dubins.hpp"
#include "core/reeds_shepp.hpp"

namespace planformer {
namespace {

using namespace nb::literals;

NumpyArray<double> curve_lengths(const PosesArray& starts, const PosesArray& goals,
                                 double turning_radius, bool reverse) {
    require_positive("turning_radius", turning_radius);
    const std::size_t count = starts.shape(0);
    if (goals.shape(0) != count) throw nb::value_error("starts and goals differ in number");
    std::vector<double> lengths(count);
    {
        const nb::gil_scoped_release unlocked;
        const auto measure = reverse ? reeds_shepp_length : dubins_length;
        for (std::size_t i = 0; i < count; ++i) {
            lengths[i] = measure(to_pose(starts.data() + 3 * i), to_pose(goals.data() + 3 * i),
                                 turning_radius);
        }
    }
    return to_numpy(std::move(lengths), {count});
}

NumpyArray<double> curve_poses(const PoseArray& start, const PoseArray& goal, double turning_radius,
                               bool reverse, double step) {
    require_positive("turning_radius", turning_radius);
    require_positive("step", step);
    std::vector<Pose> poses;
    {
        const nb::gil_scoped_release unlocked;
        const auto solve = reverse ? reeds_shepp : dubins;
        const Curve curve = solve(to_pose(start.data()), to_pose(goal.data()), turning_radius);
        for_each_pose(curve, step, [&poses](const Pose& pose) {
            poses.push_back(pose);
            return true;
        });
    }
    if (poses.empty()) throw nb::value_error("start and goal must be finite");
    return to_numpy(poses);
}

}  // namespace

void register_curves(nb::module_& m) {
    m.def("curve_lengths", &curve_lengths, "starts"_a, "goals"_a, "turning_radius"_a, "reverse"_a,
          "Lengths [m] of the shortest curves between pairs of poses.\n\n"
          "starts, goals: (N, 3) float64 of x, y [m] and yaw [rad]; turning_radius [m].\n"
          "reverse: Reeds-Shepp curves if true, else Dubins curves.\n"
          "Returns (N,) float64; infinite where a pose is not finite.");
    m.def("curve_poses", &curve_poses, "start"_a, "goal"_a, "turning_radius"_a, "reverse"_a,
          "step"_a,
          "Poses along the shortest curve, both ends included.\n\n"
          "start, goal: (3,) float64 of x, y [m] and yaw [rad]; turning_radius [m].\n"
          "step: largest spacing on arcs [m]; straight parts have only their ends.\n"
          "Returns (M, 3) float64, yaw in [-pi, pi].");
}

}  // namespace planformer
