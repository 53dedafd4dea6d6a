#pragma once

#include "core/plan.hpp"

namespace planformer {

/// Runs OMPL's SST (Li, Littlefield and Bekris 2016) for the car, with wheel velocity and steering
/// angle as controls, in steps of 0.1 s.
///
/// Controls cannot hit a pose exactly: the path ends within `goal_tolerance` of the goal's position
/// and within the turn that the car makes over that distance of its heading.
Answer plan_sst(const Query& query);

}  // namespace planformer
