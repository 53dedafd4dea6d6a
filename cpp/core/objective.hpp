#pragma once

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/samplers/InformedStateSampler.h>
#include <ompl/util/ProlateHyperspheroid.h>
#include <ompl/util/RandomNumbers.h>

#include <cstdint>
#include <memory>

#include "core/region.hpp"
#include "core/seeding.hpp"

namespace planformer {

/// Draws states that are in the region and can still improve the solution.
///
/// Informed RRT*, BIT*, ABIT* and AIT* bypass the state sampler and ask the objective for samples
/// within the informed set (an ellipse between start and goal; Gammell et al. 2014), so guidance
/// has to act here as well. The straight-line distance bounds Dubins and Reeds-Shepp curves from
/// below, so that the same ellipse serves the car.
class RegionInformedSampler : public ompl::base::InformedSampler {
public:
    RegionInformedSampler(const ompl::base::ProblemDefinitionPtr& problem, unsigned int max_calls,
                          Guidance guidance, Extent extent, std::uint32_t seed);

    bool sampleUniform(ompl::base::State* state, const ompl::base::Cost& max_cost) override;
    bool sampleUniform(ompl::base::State* state, const ompl::base::Cost& min_cost,
                       const ompl::base::Cost& max_cost) override;
    bool hasInformedMeasure() const override { return true; }
    double getInformedMeasure(const ompl::base::Cost& cost) const override;

private:
    Pose sample_ellipse();
    bool draw(double min_cost, double max_cost, Pose* pose);
    bool is_stuck(const ompl::base::State* state);
    double heuristic(const Pose& pose) const;

    Guidance guidance_;
    Extent extent_;
    Pose start_;
    Pose goal_;
    bool is_car_;
    double yaw_measure_;             ///< 2 pi for the car, 1 for the point
    unsigned int in_collision_ = 0;  ///< draws in a row
    ompl::RNG rng_;
    ompl::ProlateHyperspheroidPtr ellipse_;
};

/// Path length whose informed sampler knows the region.
class GuidedPathLength : public ompl::base::PathLengthOptimizationObjective {
public:
    GuidedPathLength(const ompl::base::SpaceInformationPtr& si, Guidance guidance, Extent extent,
                     SeedsPtr seeds);

    ompl::base::InformedSamplerPtr allocInformedStateSampler(
        const ompl::base::ProblemDefinitionPtr& problem, unsigned int max_calls) const override;

private:
    Guidance guidance_;
    Extent extent_;
    SeedsPtr seeds_;
};

}  // namespace planformer
