#pragma once

#include <ompl/base/Planner.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/curve.hpp"

namespace planformer {

/// The planner's tree or roadmap, for pictures.
struct Tree {
    std::vector<Pose> vertices;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  ///< (parent, child)
};

/// The collision-free states in the planner's tree or roadmap, also those not yet connected.
std::size_t count_vertices(const ompl::base::Planner& planner);

/// The planner's graph as poses: collision-free states, and the edges that joined them.
///
/// LazyPRM* adds edges unseen; those that it did not find to be blocked are here as well.
Tree read_tree(const ompl::base::Planner& planner);

}  // namespace planformer
