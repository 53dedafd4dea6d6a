#pragma once

#include <cstdint>
#include <memory>
#include <nav2_core/global_planner.hpp>
#include <nav2_costmap_2d/costmap_2d_ros.hpp>
#include <pluginlib/class_loader.hpp>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <vector>

#include "planformer_nav2/grid.hpp"
#include "planformer_nav2/nav2_interface.hpp"
#include "planformer_nav2/region_client.hpp"
#include "planformer_nav2/settings.hpp"

namespace planformer_nav2 {

/// Plans with another Nav2 planner in the region that a network proposes.
///
/// The other planner sees the costmap closed outside the region; where it fails there, or there is
/// no region, it plans once more, or at all, in the costmap as it is.
class MPTPlanner : public nav2_core::GlobalPlanner {
public:
    MPTPlanner();

    void configure(const Node::WeakPtr& parent, std::string name,
                   std::shared_ptr<TransformBuffer> tf,
                   std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_ros) override;
    void cleanup() override;
    void activate() override;
    void deactivate() override;

#ifdef PLANFORMER_NAV2_LYRICAL
    /// A plan through viapoints is the other planner's alone: regions lead from start to goal.
    Path createPlan(const PoseStamped& start, const PoseStamped& goal,
                    const std::vector<PoseStamped>& viapoints,
                    std::function<bool()> cancel_checker) override;
#else
    Path createPlan(const PoseStamped& start, const PoseStamped& goal,
                    std::function<bool()> cancel_checker) override;
#endif

private:
    /// A region and the costmap that it was proposed for.
    struct Proposal {
        Grid grid;
        std::vector<std::uint8_t> region;
        double seconds = 0.0;
    };

    Path plan(const Query& query);
    Path plan_guided(const Query& query, const Settings& settings);
    Proposal propose(const Query& query, const Settings& settings);
    Path plan_inside(const Proposal& proposal, const Query& query, const Settings& settings);

    std::string name_;
    rclcpp::Logger logger_ = rclcpp::get_logger("planformer_nav2");
    std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_ros_;
    LiveSettings settings_;
    std::unique_ptr<RegionClient> client_;
    pluginlib::ClassLoader<nav2_core::GlobalPlanner> loader_;  ///< has to outlive what it loads
    std::shared_ptr<nav2_core::GlobalPlanner> planner_;
};

}  // namespace planformer_nav2
