#include "core/planners.hpp"

#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>

#if __has_include(<ompl/geometric/planners/informedtrees/EITstar.h>)
#include <ompl/geometric/planners/informedtrees/EIRMstar.h>
#include <ompl/geometric/planners/informedtrees/EITstar.h>
#define PLANFORMER_HAS_EITSTAR
#endif

namespace planformer {

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

struct Entry {
    const char* name;
    ob::PlannerPtr (*make)(const ob::SpaceInformationPtr&);
    bool car;  ///< whether it respects that a car's curve back is not its curve there
};

template <typename Planner>
ob::PlannerPtr make(const ob::SpaceInformationPtr& si) {
    return std::make_shared<Planner>(si);
}

/// Roadmaps and backward searches treat an edge as passable both ways, which is wrong for a car.
const Entry kPlanners[] = {
    {"RRT", make<og::RRT>, true},
    {"RRTConnect", make<og::RRTConnect>, true},
    {"RRTstar", make<og::RRTstar>, true},
    {"RRTsharp", make<og::RRTsharp>, false},
    {"RRTXstatic", make<og::RRTXstatic>, false},
    {"InformedRRTstar", make<og::InformedRRTstar>, true},
    {"SORRTstar", make<og::SORRTstar>, true},
    {"BITstar", make<og::BITstar>, true},
    {"ABITstar", make<og::ABITstar>, true},
    {"AITstar", make<og::AITstar>, false},
#ifdef PLANFORMER_HAS_EITSTAR
    {"EITstar", make<og::EITstar>, false},
    {"EIRMstar", make<og::EIRMstar>, false},
#endif
    {"FMT", make<og::FMT>, true},
    {"BFMT", make<og::BFMT>, false},
    {"PRMstar", make<og::PRMstar>, false},
    {"LazyPRMstar", make<og::LazyPRMstar>, false},
};

}  // namespace

ob::PlannerPtr make_planner(const std::string& name, const ob::SpaceInformationPtr& si) {
    for (const Entry& entry : kPlanners) {
        if (name == entry.name) return entry.make(si);
    }
    return nullptr;
}

bool samples_in_batches(const ob::Planner& planner) {
    // ABIT* is a BIT*, EIRM* an EIT*.
#ifdef PLANFORMER_HAS_EITSTAR
    if (dynamic_cast<const og::EITstar*>(&planner) != nullptr) return true;
#endif
    return dynamic_cast<const og::BITstar*>(&planner) != nullptr ||
           dynamic_cast<const og::AITstar*>(&planner) != nullptr;
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
