#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/curve.hpp"
#include "core/free_space.hpp"
#include "core/graph.hpp"
#include "core/incumbent.hpp"
#include "core/monitor.hpp"
#include "core/planners.hpp"
#include "core/progress.hpp"
#include "core/region.hpp"

namespace planformer {

/// What moves: a point on the inflated grid, or a car with a bounded turning radius on it.
struct RobotModel {
    RobotKind kind = RobotKind::kPoint;
    double turning_radius = 0.0;  ///< [m]
    bool reverse = false;         ///< the car may drive backwards (Reeds-Shepp curves)
    double wheelbase = 0.0;       ///< [m], for control-space planning
    double max_speed = 0.0;       ///< [m/s], for control-space planning
};

/// One planning request, in the map's local frame.
struct Query {
    FreeSpace free_space;
    RobotModel robot;
    Pose start;
    Pose goal;
    std::string planner;
    Guidance guidance;
    Limits limits;
    std::uint32_t seed = 1;
    bool keep_tree = false;
    const Cancellation* cancellation = nullptr;
    Progress* progress = nullptr;       ///< gets snapshots of the search
    std::function<bool()> interrupted;  ///< asked every 20 ms whether to give up
};

/// The answer; an empty path means that none was found.
struct Answer {
    std::vector<Pose> path;
    double length = 0.0;  ///< [m]
    std::size_t vertices = 0;
    double seconds = 0.0;  ///< of the search with its set-up, without counting and copying the tree
    Outcome outcome = Outcome::kFinished;
    Tree tree;
};

/// Runs one of OMPL's planners, geometric or control-space, on the query.
///
/// The planner name has to be one of `planner_names`; start and goal have to be valid.
Answer plan(const Query& query);

/// Lets a planner search until a limit, and reports; `read_solution` fills in path and length.
Answer run(const Query& query, Clock::time_point started, ompl::base::Planner& planner,
           const StateCount& states, const Incumbent& incumbent,
           const std::function<void(Answer*)>& read_solution);

}  // namespace planformer
