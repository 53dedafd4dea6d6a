#include "core/progress.hpp"

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <chrono>

#include "core/path.hpp"
#include "core/region.hpp"

namespace planformer {

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

/// A snapshot that took a second is followed by so many seconds of planning.
constexpr double kPlanningPerSnapshot = 9.0;

bool is_same(const Pose& a, const Pose& b) { return a.x == b.x && a.y == b.y && a.yaw == b.yaw; }

const ob::StateSpace& space_of(const ob::Planner& planner) {
    return *planner.getSpaceInformation()->getStateSpace();
}

}  // namespace

Recorder::Recorder(Progress* progress, ob::Planner* planner, const StateCount& states, double step)
    : progress_(progress),
      planner_(planner),
      states_(states),
      step_(step),
      next_(progress->interval()) {
    planner_->getProblemDefinition()->setIntermediateSolutionCallback(
        [this](const ob::Planner*, const std::vector<const ob::State*>& path, const ob::Cost cost) {
            note_solution(path, cost.value());
        });
}

Recorder::~Recorder() { planner_->getProblemDefinition()->setIntermediateSolutionCallback({}); }

void Recorder::note_solution(const std::vector<const ob::State*>& states, double length) {
    if (!(length < length_)) return;
    const ob::ProblemDefinition& problem = *planner_->getProblemDefinition();
    const ob::StateSpace& space = space_of(*planner_);
    const Pose start = read_state(space, problem.getStartState(0));
    const Pose goal = read_state(space, problem.getGoal()->as<ob::GoalState>()->getState());
    length_ = length;
    path_states_.clear();
    for (const ob::State* state : states) path_states_.push_back(read_state(space, state));
    // Planners begin at either end, and some leave the ends out.
    const auto is_start = [&](const Pose& pose) { return is_same(pose, start); };
    const auto is_goal = [&](const Pose& pose) { return is_same(pose, goal); };
    const bool from_start =
        !path_states_.empty() && (is_start(path_states_.front()) || is_goal(path_states_.back()));
    if (!from_start) std::reverse(path_states_.begin(), path_states_.end());
    if (path_states_.empty() || !is_start(path_states_.front())) {
        path_states_.insert(path_states_.begin(), start);
    }
    if (!is_goal(path_states_.back())) path_states_.push_back(goal);
}

void Recorder::note_problem_solution() {
    const ob::ProblemDefinition& problem = *planner_->getProblemDefinition();
    if (!problem.hasExactSolution()) return;
    const auto path = std::dynamic_pointer_cast<og::PathGeometric>(problem.getSolutionPath());
    if (!path) return;
    const auto& states = path->getStates();
    note_solution({states.begin(), states.end()}, path->length());
}

void Recorder::take(double seconds) {
    const auto started = std::chrono::steady_clock::now();
    note_problem_solution();
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->seconds = seconds;
    snapshot->length = length_;
    snapshot->path = joined_states(space_of(*planner_), path_states_, step_);
    snapshot->states = states_;
    if (progress_->keep_tree()) snapshot->tree = read_tree(*planner_);
    progress_->publish(std::move(snapshot));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
    next_ = seconds + took.count() +
            std::max(progress_->interval(), kPlanningPerSnapshot * took.count());
}

}  // namespace planformer
