#pragma once

#include "core/plan.hpp"

namespace planformer {

/// Runs OMPL's SST (Li, Littlefield and Bekris 2016) for the car, with wheel velocity and steering
/// angle as controls, in steps of 0.1 s.
///
/// Random controls cannot hit a pose: the last stretch to the goal is a Dubins curve.
Answer plan_sst(const Query& query);

}  // namespace planformer
