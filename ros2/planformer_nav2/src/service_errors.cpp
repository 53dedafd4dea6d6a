#include "planformer_nav2/service_errors.hpp"

#include <nav2_core/planner_exceptions.hpp>

namespace planformer_nav2 {

void throw_service_error(std::uint16_t code, const std::string& message) {
    // Those of nav2_msgs/action/ComputePathToPose. Numbers, because the service's are fixed.
    switch (code) {
        case 201: throw nav2_core::InvalidPlanner(message);
        case 202: throw nav2_core::PlannerTFError(message);
        case 203: throw nav2_core::StartOutsideMapBounds(message);
        case 204: throw nav2_core::GoalOutsideMapBounds(message);
        case 205: throw nav2_core::StartOccupied(message);
        case 206: throw nav2_core::GoalOccupied(message);
        case 207: throw nav2_core::PlannerTimedOut(message);
        case 208: throw nav2_core::NoValidPathCouldBeFound(message);
        default: throw nav2_core::PlannerException(message);
    }
}

}  // namespace planformer_nav2
