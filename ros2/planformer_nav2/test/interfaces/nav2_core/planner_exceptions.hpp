// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <stdexcept>

namespace nav2_core {

struct PlannerException : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct InvalidPlanner : PlannerException {
    using PlannerException::PlannerException;
};
struct StartOccupied : PlannerException {
    using PlannerException::PlannerException;
};
struct GoalOccupied : PlannerException {
    using PlannerException::PlannerException;
};
struct StartOutsideMapBounds : PlannerException {
    using PlannerException::PlannerException;
};
struct GoalOutsideMapBounds : PlannerException {
    using PlannerException::PlannerException;
};
struct NoValidPathCouldBeFound : PlannerException {
    using PlannerException::PlannerException;
};
struct PlannerTimedOut : PlannerException {
    using PlannerException::PlannerException;
};
struct PlannerTFError : PlannerException {
    using PlannerException::PlannerException;
};
struct PlannerCancelled : PlannerException {
    using PlannerException::PlannerException;
};

}  // namespace nav2_core
