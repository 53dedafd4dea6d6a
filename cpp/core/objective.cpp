#include "core/objective.hpp"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalState.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace planformer {

namespace ob = ompl::base;

namespace {

/// Draws before a sampler gives up. Planners pass "unlimited", which would never return once the
/// solution is as short as the straight line.
constexpr unsigned int kMaxDraws = 200;

std::array<double, 2> xy(const Pose& pose) { return {pose.x, pose.y}; }

}  // namespace

RegionInformedSampler::RegionInformedSampler(const ob::ProblemDefinitionPtr& problem,
                                             unsigned int max_calls, Guidance guidance,
                                             Extent extent, std::uint32_t seed)
    : ob::InformedSampler(problem, std::min(max_calls, kMaxDraws)),
      guidance_(std::move(guidance)),
      extent_(extent),
      start_(read_state(*space_, problem->getStartState(0))),
      goal_(read_state(*space_, problem->getGoal()->as<ob::GoalState>()->getState())),
      is_car_(space_->getType() == ob::STATE_SPACE_SE2),
      yaw_measure_(is_car_ ? 2.0 * kPi : 1.0) {
    rng_.setLocalSeed(seed);
    ellipse_ = std::make_shared<ompl::ProlateHyperspheroid>(2, xy(start_).data(), xy(goal_).data());
}

double RegionInformedSampler::heuristic(const Pose& pose) const {
    return std::hypot(pose.x - start_.x, pose.y - start_.y) +
           std::hypot(pose.x - goal_.x, pose.y - goal_.y);
}

Pose RegionInformedSampler::sample_ellipse() {
    std::array<double, 2> point{};
    rng_.uniformProlateHyperspheroid(ellipse_, point.data());
    return {point[0], point[1], rng_.uniformReal(-kPi, kPi)};
}

bool RegionInformedSampler::draw(double min_cost, double max_cost, Pose* pose) {
    const bool bounded = std::isfinite(max_cost);
    if (bounded) ellipse_->setTransverseDiameter(max_cost);
    const bool explore = guidance_.exploration > 0.0 && rng_.uniform01() < guidance_.exploration;
    const bool guided = guidance_.region && !explore;
    const bool refining = chooses_refinement(guidance_, rng_);
    for (unsigned int i = 0; i < numIters_; ++i) {
        // The second half of the draws ignores what the shrinking ellipse may have left.
        const bool is_early = i < numIters_ / 2;
        if (refining && is_early) {
            *pose = guidance_.incumbent->sample_near(rng_);
        } else if (guided && is_early) {
            *pose = sample_region(*guidance_.region, rng_);
        } else {
            *pose = bounded ? sample_ellipse() : sample_extent(extent_, rng_);
        }
        if (!extent_.contains(*pose)) continue;
        const double cost = heuristic(*pose);
        // BIT* asks for no cost below the least one of all solutions, a car's from start to goal
        // by its curve. The straight lines of a pose that is of use may well be shorter.
        if ((is_car_ || cost >= min_cost) && cost < max_cost) return true;
    }
    return false;
}

bool RegionInformedSampler::sampleUniform(ob::State* state, const ob::Cost& max_cost) {
    return sampleUniform(state, ob::Cost(0.0), max_cost);
}

bool RegionInformedSampler::sampleUniform(ob::State* state, const ob::Cost& min_cost,
                                          const ob::Cost& max_cost) {
    // BIT* uses the state whatever is returned here, so a failed draw leaves the start in it.
    Pose pose = start_;
    const bool possible = max_cost.value() > ellipse_->getMinTransverseDiameter();
    const bool drawn = possible && draw(min_cost.value(), max_cost.value(), &pose);
    write_state(*space_, drawn ? pose : start_, state);
    if (!drawn || !is_stuck(state)) return drawn;
    write_state(*space_, start_, state);
    return false;
}

/// Whether this is one more of many states in collision: AIT* asks for samples until one is free,
/// and never looks at the clock meanwhile.
bool RegionInformedSampler::is_stuck(const ob::State* state) {
    in_collision_ = probDefn_->getSpaceInformation()->isValid(state) ? 0 : in_collision_ + 1;
    if (in_collision_ < kMaxDraws) return false;
    in_collision_ = 0;
    return true;
}

double RegionInformedSampler::getInformedMeasure(const ob::Cost& cost) const {
    double area = extent_.area();
    if (guidance_.region && guidance_.exploration == 0.0) {
        area = std::min(area, guidance_.region->area);
    }
    if (std::isfinite(cost.value()) && cost.value() > ellipse_->getMinTransverseDiameter()) {
        area = std::min(area, ellipse_->getPhsMeasure(cost.value()));
    }
    return area * yaw_measure_;
}

GuidedPathLength::GuidedPathLength(const ob::SpaceInformationPtr& si, Guidance guidance,
                                   Extent extent, SeedsPtr seeds)
    : ob::PathLengthOptimizationObjective(si),
      guidance_(std::move(guidance)),
      extent_(extent),
      seeds_(std::move(seeds)) {}

ob::InformedSamplerPtr GuidedPathLength::allocInformedStateSampler(
    const ob::ProblemDefinitionPtr& problem, unsigned int max_calls) const {
    const std::uint32_t seed = seeds_->next();
    return seeded(seed, [&] {
        return std::make_shared<RegionInformedSampler>(problem, max_calls, guidance_, extent_,
                                                       seed);
    });
}

}  // namespace planformer
