#include "core/prm_star.hpp"

#include <ompl/geometric/PathGeometric.h>

namespace planformer {

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

constexpr std::size_t kFewestMilestones = 30;  ///< between two searches of the roadmap

}  // namespace

void SteadyPRMstar::grow(const ob::PlannerTerminationCondition& ptc, std::size_t milestones) {
    const auto until = [&](std::size_t count) {
        return ob::PlannerTerminationCondition(
            [this, &ptc, count] { return ptc() || milestoneCount() >= count; });
    };
    const std::size_t now = milestoneCount();
    growRoadmap(until(now + 2 * milestones / 3));
    expandRoadmap(until(now + milestones));
}

void SteadyPRMstar::report(const ob::PathPtr& path) const {
    const auto& callback = pdef_->getIntermediateSolutionCallback();
    if (!path || !callback) return;
    const auto& states = path->as<og::PathGeometric>()->getStates();
    callback(this, {states.begin(), states.end()}, bestCost_);
}

ob::PlannerStatus SteadyPRMstar::solve(const ob::PlannerTerminationCondition& ptc) {
    checkValidity();
    while (const ob::State* start = pis_.nextStart()) {
        startM_.push_back(addMilestone(si_->cloneState(start)));
    }
    while (const ob::State* goal = pis_.nextGoal()) {
        goalM_.push_back(addMilestone(si_->cloneState(goal)));
    }
    bestCost_ = opt_->infiniteCost();
    ob::PathPtr path;
    bool satisfied = maybeConstructSolution(startM_, goalM_, path);
    while (!ptc && !satisfied) {
        grow(ptc, kFewestMilestones + milestoneCount() / 10);
        satisfied = maybeConstructSolution(startM_, goalM_, path);
        report(path);
    }
    if (!path) return ob::PlannerStatus::TIMEOUT;
    ob::PlannerSolution solution(path);
    solution.setPlannerName(getName());
    solution.setOptimized(opt_, bestCost_, satisfied);
    pdef_->addSolutionPath(solution);
    return ob::PlannerStatus::EXACT_SOLUTION;
}

}  // namespace planformer
