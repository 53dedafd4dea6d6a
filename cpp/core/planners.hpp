#pragma once

#include <ompl/base/Planner.h>

#include <cstddef>
#include <string>
#include <vector>

namespace planformer {

/// The robot's kind, which decides the state space and the planners that fit it.
enum class RobotKind { kPoint, kCar };

/// Constructs one of OMPL's geometric planners by its class name; null for an unknown name.
///
/// FMT* and BFMT* draw all their samples first: not more than a search may have vertices.
ompl::base::PlannerPtr make_planner(const std::string& name,
                                    const ompl::base::SpaceInformationPtr& si,
                                    std::size_t max_vertices);

/// The class names this build has for the robot, SST (see sst.hpp) included.
std::vector<std::string> planner_names(RobotKind robot);

}  // namespace planformer
