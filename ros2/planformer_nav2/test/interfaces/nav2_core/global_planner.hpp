// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <functional>
#include <geometry_msgs/msg/pose_stamped.hpp>
#include <memory>
#include <nav2_costmap_2d/costmap_2d_ros.hpp>
#include <nav_msgs/msg/path.hpp>
#include <string>
#include <vector>

#ifdef PLANFORMER_NAV2_LYRICAL
#include <nav2_ros_common/lifecycle_node.hpp>
#include <nav2_ros_common/tf2_factories.hpp>
#else
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <tf2_ros/buffer.hpp>
#endif

namespace nav2_core {

class GlobalPlanner {
public:
    virtual ~GlobalPlanner() = default;

#ifdef PLANFORMER_NAV2_LYRICAL
    virtual void configure(const nav2::LifecycleNode::WeakPtr& parent, std::string name,
                           std::shared_ptr<nav2::TransformBuffer> tf,
                           std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_ros) = 0;
    virtual nav_msgs::msg::Path createPlan(
        const geometry_msgs::msg::PoseStamped& start, const geometry_msgs::msg::PoseStamped& goal,
        const std::vector<geometry_msgs::msg::PoseStamped>& viapoints,
        std::function<bool()> cancel_checker) = 0;
#else
    virtual void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr& parent, std::string name,
                           std::shared_ptr<tf2_ros::Buffer> tf,
                           std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_ros) = 0;
    virtual nav_msgs::msg::Path createPlan(const geometry_msgs::msg::PoseStamped& start,
                                           const geometry_msgs::msg::PoseStamped& goal,
                                           std::function<bool()> cancel_checker) = 0;
#endif

    virtual void cleanup() = 0;
    virtual void activate() = 0;
    virtual void deactivate() = 0;
};

}  // namespace nav2_core
