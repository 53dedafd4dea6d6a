#include "core/plan.hpp"

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "core/car_space.hpp"
#include "core/objective.hpp"
#include "core/path.hpp"
#include "core/seeding.hpp"
#include "core/sst.hpp"
#include "core/validity.hpp"

namespace planformer {

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

/// A path that is at most this share longer than the way without obstacles is optimal.
constexpr double kOptimalityGap = 1e-6;

ob::StateSpacePtr make_space(const RobotModel& robot, const Extent& extent,
                             const StateCountPtr& count) {
    if (robot.kind == RobotKind::kPoint) {
        auto space = std::make_shared<Counted<ob::RealVectorStateSpace>>(count, 2u);
        space->setBounds(extent.bounds());
        return space;
    }
    auto space = std::make_shared<Counted<CarSpace>>(count, robot.turning_radius, robot.reverse);
    space->setBounds(extent.bounds());
    return space;
}

ob::SpaceInformationPtr make_space_information(const Query& query, const ob::StateSpacePtr& space) {
    auto si = std::make_shared<ob::SpaceInformation>(space);
    si->setStateValidityChecker(std::make_shared<GridValidityChecker>(si, query.free_space));
    si->setMotionValidator(std::make_shared<GridMotionValidator>(si, query.free_space));
    si->setup();
    return si;
}

ob::ProblemDefinitionPtr make_problem(const Query& query, const Guidance& guidance,
                                      const Extent& extent, const ob::SpaceInformationPtr& si,
                                      const SeedsPtr& seeds) {
    auto problem = std::make_shared<ob::ProblemDefinition>(si);
    ob::ScopedState<> start(si);
    ob::ScopedState<> goal(si);
    write_state(*si->getStateSpace(), query.start, start.get());
    write_state(*si->getStateSpace(), query.goal, goal.get());
    problem->setStartAndGoalStates(start, goal);
    auto objective = std::make_shared<GuidedPathLength>(si, guidance, extent, seeds);
    // Nothing is shorter than the way without obstacles: a path as short ends the search too, which
    // could only go on sampling an informed set that has become empty.
    const double optimal = si->distance(start.get(), goal.get()) * (1.0 + kOptimalityGap);
    objective->setCostThreshold(ob::Cost(std::max(query.limits.longest_on_target(), optimal)));
    problem->setOptimizationObjective(objective);
    return problem;
}

std::vector<Pose> read_path(const og::PathGeometric& path, double step) {
    const ob::StateSpace& space = *path.getSpaceInformation()->getStateSpace();
    std::vector<Pose> states;
    for (std::size_t i = 0; i < path.getStateCount(); ++i) {
        states.push_back(read_state(space, path.getState(static_cast<unsigned int>(i))));
    }
    return joined_states(space, states, step);
}

/// Frees the graph: the destructor of OMPL's LazyPRM* leaves its states.
void clear(ob::Planner& planner, std::uint32_t seed) {
    // BIT* makes a generator of random numbers then, others may. Those with the largest graphs do
    // not, and would keep other threads from making theirs for as long as it takes.
    const bool makes_none = dynamic_cast<const og::RRTstar*>(&planner) != nullptr ||
                            dynamic_cast<const og::PRM*>(&planner) != nullptr ||
                            dynamic_cast<const og::LazyPRM*>(&planner) != nullptr;
    if (makes_none) {
        planner.clear();
    } else {
        seeded(seed, [&] { planner.clear(); });
    }
}

double pose_spacing(const Query& query) { return kArcStep * query.free_space.resolution; }

Answer plan_geometric(const Query& query) {
    const auto started = Clock::now();
    const Extent extent{query.free_space.extent_x(), query.free_space.extent_y()};
    const auto states = std::make_shared<StateCount>(0);
    const auto seeds = std::make_shared<Seeds>(query.seed);
    const ob::StateSpacePtr space = make_space(query.robot, extent, states);
    const auto incumbent = std::make_shared<Incumbent>(*space, query.start, query.goal);
    Guidance guidance = query.guidance;
    guidance.incumbent = incumbent;
    space->setStateSamplerAllocator(guided_sampler_allocator(guidance, extent, seeds));
    const auto si = make_space_information(query, space);
    const auto problem = make_problem(query, guidance, extent, si, seeds);
    problem->setIntermediateSolutionCallback(
        [incumbent](const ob::Planner*, const std::vector<const ob::State*>& found,
                    const ob::Cost cost) { incumbent->improve(found, cost.value()); });
    const ob::PlannerPtr planner = seeded(seeds->next(), [&] {
        ob::PlannerPtr made = make_planner(query.planner, si, query.limits.vertices);
        if (!made) throw std::invalid_argument("unknown planner: " + query.planner);
        made->setProblemDefinition(problem);
        made->setup();
        return made;
    });

    return run(query, started, *planner, *states, *incumbent, [&](Answer* answer) {
        const auto& path = *problem->getSolutionPath()->as<og::PathGeometric>();
        answer->length = path.length();
        answer->path = read_path(path, pose_spacing(query));
    });
}

}  // namespace

Answer run(const Query& query, Clock::time_point started, ob::Planner& planner,
           const StateCount& states, const Incumbent& incumbent,
           const std::function<void(Answer*)>& read_solution) {
    std::optional<Recorder> recorder;
    if (query.progress) {
        recorder.emplace(query.progress, &planner, states, incumbent, pose_spacing(query));
    }
    Monitor monitor(query.limits, started, planner, states, query.cancellation, query.interrupted,
                    recorder ? &*recorder : nullptr);
    planner.solve(monitor.condition());
    Answer answer;
    answer.length = std::numeric_limits<double>::infinity();
    if (planner.getProblemDefinition()->hasExactSolution()) read_solution(&answer);
    answer.outcome = monitor.outcome(answer.length);
    answer.seconds = seconds_since(started);
    answer.vertices = count_vertices(planner);
    if (query.keep_tree) answer.tree = read_tree(planner);
    clear(planner, query.seed);
    return answer;
}

Answer plan(const Query& query) {
    if (query.planner == "SST") return plan_sst(query);
    return plan_geometric(query);
}

}  // namespace planformer
