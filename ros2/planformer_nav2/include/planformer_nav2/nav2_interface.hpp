#pragma once

// This header brings the types that it names; tf2_ros renamed its own between the distributions.
#include <functional>
#include <nav2_core/global_planner.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <vector>

#ifdef PLANFORMER_NAV2_LYRICAL
#include <nav2_ros_common/lifecycle_node.hpp>
#endif

namespace planformer_nav2 {

// All that differs between jazzy or kilted and lyrical, but for the declaration of createPlan.
#ifdef PLANFORMER_NAV2_LYRICAL
using Node = nav2::LifecycleNode;
using TransformBuffer = nav2::TransformBuffer;
#else
using Node = rclcpp_lifecycle::LifecycleNode;
using TransformBuffer = tf2_ros::Buffer;
#endif

using Path = nav_msgs::msg::Path;
using PoseStamped = geometry_msgs::msg::PoseStamped;
using CancelChecker = std::function<bool()>;

/// The arguments of createPlan.
struct Query {
    const PoseStamped& start;
    const PoseStamped& goal;
    std::vector<PoseStamped> viapoints;  ///< empty before lyrical
    const CancelChecker& cancelled;
};

inline Path create_plan(nav2_core::GlobalPlanner& planner, const Query& query) {
#ifdef PLANFORMER_NAV2_LYRICAL
    return planner.createPlan(query.start, query.goal, query.viapoints, query.cancelled);
#else
    return planner.createPlan(query.start, query.goal, query.cancelled);
#endif
}

}  // namespace planformer_nav2
