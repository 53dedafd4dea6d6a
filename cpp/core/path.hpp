#pragma once

#include <ompl/base/StateSpace.h>

#include <vector>

#include "core/curve.hpp"

namespace planformer {

/// The states of a path, and for a car the poses between them at which it was checked.
///
/// `step`: spacing of the poses on arcs [m].
std::vector<Pose> joined_states(const ompl::base::StateSpace& space,
                                const std::vector<Pose>& states, double step);

}  // namespace planformer
