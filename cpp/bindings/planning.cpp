/// Python classes and functions of the planning core.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bindings/bindings.hpp"
#include "core/plan.hpp"
#include "core/validity.hpp"

namespace planformer {
namespace {

/// (E, 2): the parent and the child of each edge.
NumpyArray<std::uint32_t> edges_of(const Tree& tree) {
    std::vector<std::uint32_t> values;
    values.reserve(2 * tree.edges.size());
    for (const auto& [parent, child] : tree.edges) values.insert(values.end(), {parent, child});
    return to_numpy(std::move(values), {tree.edges.size(), 2});
}

using OffsetArray = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using YawArray = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

Region make_region(const PosesArray& anchors, const OffsetArray& offsets, bool has_heading,
                   double half_width, double minor_axis, const YawArray& yaw_deviations,
                   const std::optional<Region::Ends>& ends, double area) {
    if (anchors.shape(0) == 0) throw nb::value_error("a region needs at least one anchor");
    if (yaw_deviations.shape(0) != anchors.shape(0) || offsets.shape(0) != anchors.shape(0)) {
        throw nb::value_error("a region needs an offset and a yaw deviation for each anchor");
    }
    Region region;
    for (std::size_t i = 0; i < anchors.shape(0); ++i) {
        region.anchors.push_back(to_pose(anchors.data() + 3 * i));
        region.offsets.push_back({offsets.data()[2 * i], offsets.data()[2 * i + 1]});
    }
    region.has_heading = has_heading;
    region.half_width = half_width;
    region.minor_axis = minor_axis;
    region.yaw_deviations.assign(yaw_deviations.data(),
                                 yaw_deviations.data() + yaw_deviations.size());
    if (ends) region.ends = *ends;
    region.area = area;
    return region;
}

/// Whether a Python signal handler raised, which is how Ctrl-C arrives.
bool python_interrupted() {
    const nb::gil_scoped_acquire gil;
    return PyErr_CheckSignals() != 0;
}

Answer run_plan(const BlockedArray& blocked, double resolution, const RobotModel& robot,
                const std::array<double, 3>& start, const std::array<double, 3>& goal,
                const std::string& planner, const Region* region, double exploration,
                double refinement, const Limits& limits, std::uint32_t seed, bool keep_tree,
                const Cancellation* cancellation, Progress* progress, bool handle_signals) {
    Query query;
    query.free_space = free_space_of(blocked, resolution);
    query.robot = robot;
    query.start = to_pose(start.data());
    query.goal = to_pose(goal.data());
    query.planner = planner;
    // A copy: OMPL 1.5 may keep it until the process ends, when Python's objects are gone.
    if (region) query.guidance.region = std::make_shared<const Region>(*region);
    query.guidance.exploration = exploration;
    query.guidance.refinement = refinement;
    query.limits = limits;
    query.seed = seed;
    query.keep_tree = keep_tree;
    query.cancellation = cancellation;
    query.progress = progress;
    bool interrupted = false;
    if (handle_signals) {
        query.interrupted = [&interrupted] { return interrupted = python_interrupted(); };
    }
    Answer answer;
    {
        const nb::gil_scoped_release release;
        answer = plan(query);
    }
    if (interrupted) throw nb::python_error();
    return answer;
}

}  // namespace

void register_planning(nb::module_& m) {
    nb::enum_<RobotKind>(m, "RobotKind")
        .value("POINT", RobotKind::kPoint)
        .value("CAR", RobotKind::kCar);
    nb::enum_<Outcome>(m, "Outcome")
        .value("FINISHED", Outcome::kFinished)
        .value("TARGET", Outcome::kTarget)
        .value("TIME_LIMIT", Outcome::kTimeLimit)
        .value("VERTEX_LIMIT", Outcome::kVertexLimit)
        .value("CANCELLED", Outcome::kCancelled);

    nb::class_<RobotModel>(m, "RobotModel")
        .def(
            "__init__",
            [](RobotModel* self, RobotKind kind, double turning_radius, bool reverse,
               double wheelbase, double max_speed) {
                new (self) RobotModel{kind, turning_radius, reverse, wheelbase, max_speed};
            },
            nb::arg("kind"), nb::arg("turning_radius") = 0.0, nb::arg("reverse") = false,
            nb::arg("wheelbase") = 0.0, nb::arg("max_speed") = 0.0);
    nb::class_<Limits>(m, "Limits")
        .def(
            "__init__",
            [](Limits* self, std::optional<double> seconds, std::optional<double> target_length,
               std::optional<std::size_t> vertices) {
                new (self) Limits{};
                if (seconds) self->seconds = *seconds;
                if (target_length) self->target_length = *target_length;
                if (vertices) self->vertices = *vertices;
            },
            nb::arg("seconds") = nb::none(), nb::arg("target_length") = nb::none(),
            nb::arg("vertices") = nb::none());
    nb::class_<Cancellation>(m, "Cancellation", "Ends a plan from another thread.")
        .def(nb::init<>())
        .def("cancel", &Cancellation::cancel, "End the plans that hold this object; thread-safe.")
        .def_prop_ro("is_cancelled", &Cancellation::is_cancelled);
    nb::class_<Snapshot>(m, "Snapshot")
        .def_ro("seconds", &Snapshot::seconds)
        .def_ro("length", &Snapshot::length)
        .def_ro("states", &Snapshot::states)
        .def_prop_ro(
            "path", [](const Snapshot& s) { return to_numpy(s.path); }, nb::rv_policy::move)
        .def_prop_ro(
            "tree_vertices", [](const Snapshot& s) { return to_numpy(s.tree.vertices); },
            nb::rv_policy::move)
        .def_prop_ro(
            "tree_edges", [](const Snapshot& s) { return edges_of(s.tree); }, nb::rv_policy::move);
    nb::class_<Progress>(m, "Progress", "The last snapshot of a plan; thread-safe.")
        .def(nb::init<double, bool>(), nb::arg("interval"), nb::arg("keep_tree"))
        .def("latest", [](const Progress& self) -> std::optional<Snapshot> {
            const auto snapshot = self.latest();
            return snapshot ? std::make_optional(*snapshot) : std::nullopt;
        });
    nb::class_<Region::Ends>(m, "Ends", "Where a car starts and arrives.")
        .def(
            "__init__",
            [](Region::Ends* self, const std::array<double, 3>& start,
               const std::array<double, 3>& goal, double turning_radius) {
                require_positive("turning_radius", turning_radius);
                new (self)
                    Region::Ends{to_pose(start.data()), to_pose(goal.data()), turning_radius};
            },
            nb::arg("start"), nb::arg("goal"), nb::arg("turning_radius"));
    nb::class_<Region>(m, "Region")
        .def(nb::new_(&make_region), nb::arg("anchors"), nb::arg("offsets"), nb::kw_only(),
             nb::arg("has_heading"), nb::arg("half_width"), nb::arg("minor_axis"),
             nb::arg("yaw_deviations"), nb::arg("ends").none(), nb::arg("area"))
        .def(
            "sample",
            [](const Region& self, std::size_t count, std::uint32_t seed) {
                ompl::RNG rng(seed);
                std::vector<Pose> poses(count);
                for (Pose& pose : poses) pose = sample_region(self, rng);
                return to_numpy(poses);
            },
            nb::arg("count"), nb::arg("seed"), "Draw (count, 3) poses, some maybe off the map.");

    nb::class_<Answer>(m, "Answer")
        .def_prop_ro(
            "path", [](const Answer& a) { return to_numpy(a.path); }, nb::rv_policy::move)
        .def_ro("length", &Answer::length)
        .def_ro("vertices", &Answer::vertices)
        .def_ro("seconds", &Answer::seconds)
        .def_ro("outcome", &Answer::outcome)
        .def_prop_ro(
            "tree_vertices", [](const Answer& a) { return to_numpy(a.tree.vertices); },
            nb::rv_policy::move)
        .def_prop_ro(
            "tree_edges", [](const Answer& a) { return edges_of(a.tree); }, nb::rv_policy::move);

    m.def("plan", &run_plan, nb::arg("blocked"), nb::arg("resolution"), nb::arg("robot"),
          nb::arg("start"), nb::arg("goal"), nb::kw_only(), nb::arg("planner"),
          nb::arg("region") = nb::none(), nb::arg("exploration") = 0.0, nb::arg("refinement") = 0.0,
          nb::arg("limits"), nb::arg("seed"), nb::arg("keep_tree") = false,
          nb::arg("cancellation") = nb::none(), nb::arg("progress") = nb::none(),
          nb::arg("handle_signals") = false,
          "Plan in the map's local frame; see planformer.planning.search.");
    m.def("planner_names", &planner_names, nb::arg("robot"));
    m.def(
        "segment_is_free",
        [](const BlockedArray& blocked, double resolution, double x0, double y0, double x1,
           double y1) {
            return free_space_of(blocked, resolution).segment_is_free(x0, y0, x1, y1);
        },
        nb::arg("blocked"), nb::arg("resolution"), nb::arg("x0"), nb::arg("y0"), nb::arg("x1"),
        nb::arg("y1"), "The motion validator's check of one segment in the local frame.");
}

}  // namespace planformer
