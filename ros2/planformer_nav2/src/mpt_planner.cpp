#include "planformer_nav2/mpt_planner.hpp"

#include <chrono>
#include <mutex>
#include <nav2_core/planner_exceptions.hpp>
#include <nav2_costmap_2d/costmap_2d.hpp>
#include <pluginlib/class_list_macros.hpp>
#include <utility>

#include "planformer_nav2/costmap_mask.hpp"
#include "planformer_nav2/fallback.hpp"
#include "planformer_nav2/parameters.hpp"

namespace planformer_nav2 {

using nav2_costmap_2d::Costmap2D;
using CostmapLock = std::lock_guard<Costmap2D::mutex_t>;

namespace {

void require(bool holds, const std::string& message) {
    if (!holds) throw nav2_core::PlannerException(message);
}

Grid grid_of(const Costmap2D& costmap) {
    return {costmap.getSizeInCellsX(), costmap.getSizeInCellsY(), costmap.getResolution(),
            costmap.getOriginX(), costmap.getOriginY()};
}

nav_msgs::msg::MapMetaData describe(const Grid& grid) {
    nav_msgs::msg::MapMetaData info;
    info.width = grid.width;
    info.height = grid.height;
    info.resolution = static_cast<float>(grid.resolution);
    info.origin.position.x = grid.origin_x;
    info.origin.position.y = grid.origin_y;
    info.origin.orientation.w = 1.0;
    return info;
}

Disc disc_round(const PoseStamped& pose, double radius) {
    return {pose.pose.position.x, pose.pose.position.y, radius};
}

}  // namespace

MPTPlanner::MPTPlanner() : loader_("nav2_core", "nav2_core::GlobalPlanner") {}

void MPTPlanner::configure(const Node::WeakPtr& parent, std::string name,
                           std::shared_ptr<TransformBuffer> tf,
                           std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_ros) {
    const auto node = parent.lock();
    require(node != nullptr, name + ": the planner server is gone");
    name_ = name;
    logger_ = node->get_logger();
    costmap_ros_ = costmap_ros;
    settings_.declare(*node, name);
    const auto text = [&](const std::string& which, const std::string& default_value) {
        return declared(*node, name + which, default_value).get_value<std::string>();
    };
    client_ = std::make_unique<RegionClient>(*node, text(".service", "propose_region"));

    const std::string plugin = text(".planner.plugin", "");
    require(!plugin.empty(), "set " + name + ".planner.plugin to the planner that is to be guided");
    planner_ = loader_.createSharedInstance(plugin);
    planner_->configure(parent, name + ".planner", tf, costmap_ros);
    settings_.follow(*node);
    RCLCPP_INFO(logger_, "%s guides a %s", name.c_str(), plugin.c_str());
}

void MPTPlanner::cleanup() {
    settings_.unfollow();
    planner_->cleanup();
    planner_.reset();
    client_.reset();
    costmap_ros_.reset();
}

void MPTPlanner::activate() { planner_->activate(); }

void MPTPlanner::deactivate() { planner_->deactivate(); }

#ifdef PLANFORMER_NAV2_LYRICAL
Path MPTPlanner::createPlan(const PoseStamped& start, const PoseStamped& goal,
                            const std::vector<PoseStamped>& viapoints,
                            std::function<bool()> cancel_checker) {
    return plan({start, goal, viapoints, cancel_checker});
}
#else
Path MPTPlanner::createPlan(const PoseStamped& start, const PoseStamped& goal,
                            std::function<bool()> cancel_checker) {
    return plan({start, goal, {}, cancel_checker});
}
#endif

Path MPTPlanner::plan(const Query& query) {
    const Settings settings = settings_.now();
    const auto guided = [&] { return plan_guided(query, settings); };
    const auto unguided = [&] { return create_plan(*planner_, query); };
    if (!query.viapoints.empty()) return unguided();
    return with_fallback(settings.fallback, guided, unguided, [this](const char* reason) {
        RCLCPP_WARN(logger_, "%s plans without a region: %s", name_.c_str(), reason);
    });
}

Path MPTPlanner::plan_guided(const Query& query, const Settings& settings) {
    using nav2_core::PlannerCancelled;
    // What the node says of start and goal is no last word: the planner knows the footprint.
    const Proposal proposal =
        recoverable<PlannerCancelled>([&] { return propose(query, settings); });
    // These errors are the same in the whole map, where start and goal look as they do here.
    return recoverable<PlannerCancelled, nav2_core::PlannerTFError, nav2_core::StartOccupied,
                       nav2_core::GoalOccupied, nav2_core::StartOutsideMapBounds,
                       nav2_core::GoalOutsideMapBounds>(
        [&] { return plan_inside(proposal, query, settings); });
}

MPTPlanner::Proposal MPTPlanner::propose(const Query& query, const Settings& settings) {
    auto request = std::make_shared<RegionClient::Service::Request>();
    Proposal proposal;
    {
        Costmap2D& costmap = *costmap_ros_->getCostmap();
        const CostmapLock lock(*costmap.getMutex());
        proposal.grid = grid_of(costmap);
        const unsigned char* cells = costmap.getCharMap();
        request->costs.assign(cells, cells + proposal.grid.cell_count());
    }
    require(!request->costs.empty(), "the costmap is empty");
    // The planner server has already brought start and goal into this frame.
    request->header.frame_id = costmap_ros_->getGlobalFrameID();
    request->header.stamp = query.start.header.stamp;
    request->info = describe(proposal.grid);
    request->start = query.start.pose;
    request->goal = query.goal.pose;
    request->guide = settings.guide;

    const auto timeout = std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::chrono::duration<double>(settings.proposal_timeout));
    const auto answer = client_->propose(request, timeout, query.cancelled);
    proposal.region = std::move(answer->mask);
    proposal.seconds = answer->seconds;
    return proposal;
}

Path MPTPlanner::plan_inside(const Proposal& proposal, const Query& query,
                             const Settings& settings) {
    Costmap2D& costmap = *costmap_ros_->getCostmap();
    // Held all the while: nobody else may see, or change, the masked costmap. The planner may lock
    // it again, as the mutex is recursive.
    const CostmapLock lock(*costmap.getMutex());
    require(grid_of(costmap) == proposal.grid, "the costmap was moved or resized meanwhile");
    const CostmapMask mask(
        {costmap.getCharMap(), proposal.grid}, proposal.region,
        {disc_round(query.start, settings.keep_radius),
         disc_round(query.goal, settings.keep_radius)},
        settings.enters_unknown ? UnknownOutside::kClose : UnknownOutside::kKeep);
    Path path = create_plan(*planner_, query);
    // The planner server takes an empty path for a failure, and so do we.
    if (path.poses.empty()) throw nav2_core::NoValidPathCouldBeFound("an empty path");
    RCLCPP_DEBUG(logger_, "%s planned in a region that took %.3f s", name_.c_str(),
                 proposal.seconds);
    return path;
}

}  // namespace planformer_nav2

PLUGINLIB_EXPORT_CLASS(planformer_nav2::MPTPlanner, nav2_core::GlobalPlanner)
