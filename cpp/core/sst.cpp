#include "core/sst.hpp"

#include <ompl/base/goals/GoalState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/dubins.hpp"
#include "core/seeding.hpp"
#include "core/validity.hpp"

namespace planformer {

namespace ob = ompl::base;
namespace oc = ompl::control;

namespace {

constexpr double kStepSeconds = 0.1;
constexpr unsigned int kMaxSteps = 20;
constexpr double kSelectionRadius = 1.0;
constexpr double kPruningRadius = 0.3;

/// Longest curve that closes the gap to the goal pose [m].
constexpr double kFinalCurve = 2.0;

/// One control may turn the car by at most this much, so that states alone tell the arc's length.
constexpr double kMaxTurn = 3.0;  // [rad], below pi

double turn_rate(const RobotModel& robot) { return robot.max_speed / robot.turning_radius; }

/// The step of the propagation, shorter than usual for a car so fast that it would turn too far.
double step_seconds(const RobotModel& robot) {
    return std::min(kStepSeconds, kMaxTurn / turn_rate(robot));
}

/// The arc that a control drives from a pose.
Curve drive(const Pose& from, const oc::Control* control, double seconds, double wheelbase) {
    const double* values = control->as<oc::RealVectorControlSpace::ControlType>()->values;
    Curve curve(from);
    curve.append({std::tan(values[1]) / wheelbase, values[0] * seconds});
    return curve;
}

/// The car's bicycle model, integrated in closed form.
class CarPropagator : public oc::StatePropagator {
public:
    CarPropagator(oc::SpaceInformation* si, const FreeSpace& free_space, double wheelbase)
        : oc::StatePropagator(si), free_space_(free_space), wheelbase_(wheelbase) {}

    void propagate(const ob::State* state, const oc::Control* control, double seconds,
                   ob::State* result) const override {
        const ob::StateSpace& space = *si_->getStateSpace();
        const Curve arc = drive(read_state(space, state), control, seconds, wheelbase_);
        const Pose end = arc.end();
        // OMPL only checks the states between steps. A step that collides on the way is sent
        // outside the map, where no state is valid.
        const Pose outside{-1.0, -1.0, 0.0};
        write_state(space, curve_is_free(free_space_, arc, end) ? end : outside, result);
    }

private:
    FreeSpace free_space_;
    double wheelbase_;
};

/// Reached by a state from which a short Dubins curve leads to the goal pose without collision.
///
/// Random controls cannot hit a pose. The curve consists of straight driving and full steering, so
/// it is a sequence of controls as well.
class CarGoal : public ob::GoalState {
public:
    CarGoal(const ob::SpaceInformationPtr& si, const FreeSpace& free_space, double turning_radius)
        : ob::GoalState(si), free_space_(free_space), turning_radius_(turning_radius) {}

    Curve final_curve(const ob::State* state) const {
        const ob::StateSpace& space = *si_->getStateSpace();
        return dubins(read_state(space, state), goal(), turning_radius_);
    }

    Pose goal() const { return read_state(*si_->getStateSpace(), getState()); }

    double distanceGoal(const ob::State* state) const override {
        return final_curve(state).length();
    }

    bool isSatisfied(const ob::State* state, double* distance) const override {
        const Curve curve = final_curve(state);
        *distance = curve.length();
        if (curve.length() > kFinalCurve || !curve_is_free(free_space_, curve, goal()))
            return false;
        last_final_length_ = curve.length();
        return true;
    }

    bool isSatisfied(const ob::State* state) const override {
        double distance = 0.0;
        return isSatisfied(state, &distance);
    }

    /// Length of the final curve of the state that satisfied the goal last.
    double last_final_length() const { return last_final_length_; }

private:
    FreeSpace free_space_;
    double turning_radius_;
    mutable double last_final_length_ = 0.0;
};

/// The length of the arc between two states that one control joins.
class DrivenLength : public ob::PathLengthOptimizationObjective {
public:
    DrivenLength(const ob::SpaceInformationPtr& si, std::shared_ptr<const CarGoal> goal)
        : ob::PathLengthOptimizationObjective(si), goal_(std::move(goal)) {}

    ob::Cost motionCost(const ob::State* from, const ob::State* to) const override {
        const ob::StateSpace& space = *si_->getStateSpace();
        const Pose a = read_state(space, from);
        const Pose b = read_state(space, to);
        const double half = 0.5 * wrap_angle(b.yaw - a.yaw);
        const double chord = std::hypot(b.x - a.x, b.y - a.y);
        return ob::Cost(std::abs(half) < 1e-6 ? chord : chord * half / std::sin(half));
    }

    /// SST asks this of a motion right after it satisfied the goal; the final curve counts as well.
    bool isSatisfied(ob::Cost cost) const override {
        return cost.value() + goal_->last_final_length() <= getCostThreshold().value();
    }

private:
    std::shared_ptr<const CarGoal> goal_;
};

ob::StateSpacePtr make_space(const Query& query, const Extent& extent, const StateCountPtr& count,
                             const SeedsPtr& seeds) {
    auto space = std::make_shared<Counted<ob::SE2StateSpace>>(count);
    space->setBounds(extent.bounds());
    space->setStateSamplerAllocator(guided_sampler_allocator(query.guidance, extent, seeds));
    return space;
}

oc::ControlSpacePtr make_controls(const Query& query, const ob::StateSpacePtr& space,
                                  const SeedsPtr& seeds) {
    auto controls = std::make_shared<oc::RealVectorControlSpace>(space, 2);
    const double steering = std::atan(query.robot.wheelbase / query.robot.turning_radius);
    ob::RealVectorBounds bounds(2);
    bounds.setLow(0, query.robot.reverse ? -query.robot.max_speed : 0.0);
    bounds.setHigh(0, query.robot.max_speed);
    bounds.setLow(1, -steering);
    bounds.setHigh(1, steering);
    controls->setBounds(bounds);
    controls->setControlSamplerAllocator([seeds](const oc::ControlSpace* c) {
        return seeded(seeds->next(), [&] { return c->allocDefaultControlSampler(); });
    });
    return controls;
}

std::shared_ptr<oc::SpaceInformation> make_space_information(const Query& query,
                                                             const Extent& extent,
                                                             const StateCountPtr& count,
                                                             const SeedsPtr& seeds) {
    const ob::StateSpacePtr space = make_space(query, extent, count, seeds);
    auto si = std::make_shared<oc::SpaceInformation>(space, make_controls(query, space, seeds));
    si->setStateValidityChecker(std::make_shared<GridValidityChecker>(si, query.free_space));
    si->setMotionValidator(std::make_shared<GridMotionValidator>(si, query.free_space));
    si->setStatePropagator(
        std::make_shared<CarPropagator>(si.get(), query.free_space, query.robot.wheelbase));
    const double step = step_seconds(query.robot);
    si->setPropagationStepSize(step);
    const double turn = turn_rate(query.robot) * step;
    const double steps = std::clamp(std::floor(kMaxTurn / turn), 1.0, double{kMaxSteps});
    si->setMinMaxControlDuration(1, static_cast<unsigned int>(steps));
    si->setup();
    return si;
}

ob::ProblemDefinitionPtr make_problem(const Query& query,
                                      const std::shared_ptr<oc::SpaceInformation>& si) {
    auto problem = std::make_shared<ob::ProblemDefinition>(si);
    ob::ScopedState<> start(si);
    ob::ScopedState<> goal_state(si);
    write_state(*si->getStateSpace(), query.start, start.get());
    write_state(*si->getStateSpace(), query.goal, goal_state.get());
    problem->addStartState(start);
    const auto goal = std::make_shared<CarGoal>(si, query.free_space, query.robot.turning_radius);
    goal->setState(goal_state);
    problem->setGoal(goal);
    auto objective = std::make_shared<DrivenLength>(si, goal);
    objective->setCostThreshold(ob::Cost(query.limits.longest_on_target()));
    problem->setOptimizationObjective(objective);
    return problem;
}

/// The driven poses, at the spacing at which they were checked.
void read_path(const Query& query, const CarGoal& goal, oc::PathControl& path, Answer* answer) {
    const ob::StateSpace& space = *path.getSpaceInformation()->getStateSpace();
    const double spacing = kArcStep * query.free_space.resolution;
    const double step = step_seconds(query.robot);
    answer->path.push_back(read_state(space, path.getState(0)));
    answer->length = 0.0;
    const auto controls = static_cast<unsigned int>(path.getControlCount());
    for (unsigned int i = 0; i < controls; ++i) {
        const int steps = static_cast<int>(std::lround(path.getControlDuration(i) / step));
        Pose pose = read_state(space, path.getState(i));
        // Step by step, as it was propagated, so that the very chords that were checked come back.
        for (int k = 0; k < steps; ++k) {
            const Curve arc = drive(pose, path.getControl(i), step, query.robot.wheelbase);
            answer->length += arc.length();
            pose = arc.end();
            append_motion(arc, pose, spacing, &answer->path);
        }
    }
    const Curve last = goal.final_curve(path.getState(controls));  // one state more than controls
    answer->length += last.length();
    append_motion(last, goal.goal(), spacing, &answer->path);
}

}  // namespace

Answer plan_sst(const Query& query) {
    const auto started = Clock::now();
    const Extent extent{query.free_space.extent_x(), query.free_space.extent_y()};
    const auto states = std::make_shared<StateCount>(0);
    const auto seeds = std::make_shared<Seeds>(query.seed);
    const auto si = make_space_information(query, extent, states, seeds);
    const auto problem = make_problem(query, si);
    const auto planner = seeded(seeds->next(), [&] {
        auto made = std::make_shared<oc::SST>(si);
        made->setSelectionRadius(kSelectionRadius);
        made->setPruningRadius(kPruningRadius);
        made->setProblemDefinition(problem);
        made->setup();
        return made;
    });
    const Incumbent incumbent(*si->getStateSpace(), query.start, query.goal);
    return run(query, started, *planner, *states, incumbent, [&](Answer* answer) {
        read_path(query, *problem->getGoal()->as<CarGoal>(),
                  *problem->getSolutionPath()->as<oc::PathControl>(), answer);
    });
}

}  // namespace planformer
