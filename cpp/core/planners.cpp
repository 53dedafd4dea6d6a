#include "core/planners.hpp"

#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>

#if __has_include(<ompl/geometric/planners/informedtrees/EITstar.h>)
#include <ompl/geometric/planners/informedtrees/EIRMstar.h>
#include <ompl/geometric/planners/informedtrees/EITstar.h>
#define PLANFORMER_HAS_EITSTAR
#endif

#include <algorithm>

#include "core/car_neighbors.hpp"
#include "core/prm_star.hpp"
#include "core/sorrt_star.hpp"

namespace planformer {

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

struct Entry {
    const char* name;
    ob::PlannerPtr (*make)(const ob::SpaceInformationPtr&, std::size_t max_vertices);
    bool car;  ///< whether it respects that a car's curve back is not its curve there
};

template <typename Planner>
ob::PlannerPtr make(const ob::SpaceInformationPtr& si, std::size_t) {
    return std::make_shared<Planner>(si);
}

/// For planners that look for the nearest vertices of a tree: OMPL's structures are for metrics.
template <typename Planner>
ob::PlannerPtr make_tree(const ob::SpaceInformationPtr& si, std::size_t) {
    auto planner = std::make_shared<Planner>(si);
    const bool is_car = si->getStateSpace()->getType() == ob::STATE_SPACE_SE2;
    if (is_car) planner->template setNearestNeighbors<CarNeighbors>();
    return planner;
}

/// Start and goal are vertices too, and the search has to begin below the limit.
constexpr std::size_t kOtherVertices = 3;

template <typename Planner>
ob::PlannerPtr make_sampled_first(const ob::SpaceInformationPtr& si, std::size_t max_vertices) {
    auto planner = std::make_shared<Planner>(si);
    const std::size_t samples = std::max(max_vertices, kOtherVertices + 1) - kOtherVertices;
    if (samples < planner->getNumSamples()) {
        planner->setNumSamples(static_cast<unsigned int>(samples));
    }
    return planner;
}

/// Roadmaps and backward searches treat an edge as passable both ways, which is wrong for a car.
const Entry kPlanners[] = {
    {"RRT", make_tree<og::RRT>, true},
    {"RRTConnect", make_tree<og::RRTConnect>, true},
    {"RRTstar", make_tree<og::RRTstar>, true},
    {"RRTsharp", make<og::RRTsharp>, false},
    {"RRTXstatic", make<og::RRTXstatic>, false},
    {"InformedRRTstar", make_tree<og::InformedRRTstar>, true},
    {"SORRTstar", make_tree<TidySORRTstar>, true},
    {"BITstar", make<og::BITstar>, true},
    {"ABITstar", make<og::ABITstar>, true},
    {"AITstar", make<og::AITstar>, false},
#ifdef PLANFORMER_HAS_EITSTAR
    {"EITstar", make<og::EITstar>, false},
    {"EIRMstar", make<og::EIRMstar>, false},
#endif
    {"FMT", make_sampled_first<og::FMT>, true},
    {"BFMT", make_sampled_first<og::BFMT>, false},
    {"PRMstar", make<SteadyPRMstar>, false},
    {"LazyPRMstar", make<og::LazyPRMstar>, false},
};

}  // namespace

ob::PlannerPtr make_planner(const std::string& name, const ob::SpaceInformationPtr& si,
                            std::size_t max_vertices) {
    for (const Entry& entry : kPlanners) {
        if (name == entry.name) return entry.make(si, max_vertices);
    }
    return nullptr;
}

std::vector<std::string> planner_names(RobotKind robot) {
    std::vector<std::string> names;
    for (const Entry& entry : kPlanners) {
        if (robot == RobotKind::kPoint || entry.car) names.emplace_back(entry.name);
    }
    if (robot == RobotKind::kCar) names.emplace_back("SST");
    return names;
}

}  // namespace planformer
