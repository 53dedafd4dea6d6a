#pragma once

#include <ompl/base/OptimizationObjective.h>
#include <ompl/geometric/planners/prm/PRMstar.h>

#include <cstddef>

namespace planformer {

/// OMPL's PRM*, run so that the same seed gives the same path.
///
/// OMPL grows the roadmap by the clock and looks for paths in a second thread. Here the roadmap
/// grows by milestones, sampling two for each that a random walk from a badly connected one adds
/// (OMPL's ratio in time), and a path is looked for whenever it has grown by a tenth.
class SteadyPRMstar : public ompl::geometric::PRMstar {
public:
    using PRMstar::PRMstar;

    ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& ptc) override;

private:
    void grow(const ompl::base::PlannerTerminationCondition& ptc, std::size_t milestones);
    void report(const ompl::base::PathPtr& path) const;
};

}  // namespace planformer
