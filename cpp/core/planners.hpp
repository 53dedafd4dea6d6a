#pragma once

#include <ompl/base/Planner.h>

#include <string>
#include <vector>

namespace planformer {

/// The robot's kind, which decides the state space and the planners that fit it.
enum class RobotKind { kPoint, kCar };

/// Constructs one of OMPL's geometric planners by its class name; null for an unknown name.
ompl::base::PlannerPtr make_planner(const std::string& name,
                                    const ompl::base::SpaceInformationPtr& si);

/// Whether the planner draws its samples in batches into one graph: BIT* and its relatives.
bool samples_in_batches(const ompl::base::Planner& planner);

/// The class names this build has for the robot, SST (see sst.hpp) included.
std::vector<std::string> planner_names(RobotKind robot);

}  // namespace planformer
