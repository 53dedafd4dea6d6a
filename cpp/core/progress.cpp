#include "core/progress.hpp"

#include <ompl/base/ProblemDefinition.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <chrono>

#include "core/path.hpp"

namespace planformer {

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

/// A snapshot that took a second is followed by so many seconds of planning.
constexpr double kPlanningPerSnapshot = 9.0;

const ob::StateSpace& space_of(const ob::Planner& planner) {
    return *planner.getSpaceInformation()->getStateSpace();
}

}  // namespace

Recorder::Recorder(Progress* progress, ob::Planner* planner, const StateCount& states,
                   const Incumbent& incumbent, double step)
    : progress_(progress),
      planner_(planner),
      states_(states),
      incumbent_(incumbent),
      added_(incumbent),
      step_(step),
      next_(progress->interval()) {}

const Incumbent& Recorder::best() {
    const ob::ProblemDefinition& problem = *planner_->getProblemDefinition();
    if (problem.hasExactSolution()) {
        const auto path = std::dynamic_pointer_cast<og::PathGeometric>(problem.getSolutionPath());
        if (path)
            added_.improve({path->getStates().begin(), path->getStates().end()}, path->length());
    }
    return added_.length() < incumbent_.length() ? added_ : incumbent_;
}

void Recorder::take(double seconds) {
    const auto started = std::chrono::steady_clock::now();
    const Incumbent& best_path = best();
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->seconds = seconds;
    snapshot->length = best_path.length();
    snapshot->path = joined_states(space_of(*planner_), best_path.states(), step_);
    snapshot->states = states_;
    if (progress_->keep_tree()) snapshot->tree = read_tree(*planner_);
    progress_->publish(std::move(snapshot));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
    next_ = seconds + took.count() +
            std::max(progress_->interval(), kPlanningPerSnapshot * took.count());
}

}  // namespace planformer
