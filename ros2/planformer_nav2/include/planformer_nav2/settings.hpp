#pragma once

#include <mutex>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <string>
#include <vector>

namespace planformer_nav2 {

/// What may be changed while the planner server runs.
struct Settings {
    std::string guide;
    double proposal_timeout = 0.5;  ///< [s]
    double keep_radius = 0.3;       ///< [m]
    bool fallback = true;
    bool enters_unknown = true;  ///< whether the guided planner does, its `allow_unknown`
};

/// Settings that follow a node's parameters.
///
/// A plan takes a copy and never asks the node: who sets a parameter holds the node's parameters
/// while he waits for a lock that the planner server holds during a plan.
class LiveSettings {
public:
    /// Declares the plugin's parameters, whose names begin with `name` and a dot.
    ///
    /// Throws PlannerException where one is out of range.
    void declare(rclcpp_lifecycle::LifecycleNode& node, const std::string& name);

    /// From now on the settings change with the parameters; those of the guided planner are
    /// declared. A change that makes no sense is refused.
    void follow(rclcpp_lifecycle::LifecycleNode& node);

    /// No further change.
    void unfollow();

    Settings now() const;

private:
    void take(const std::vector<rclcpp::Parameter>& parameters);

    std::string name_;
    mutable std::mutex mutex_;
    Settings settings_;
    rclcpp::node_interfaces::OnSetParametersCallbackHandle::SharedPtr check_;
    rclcpp::node_interfaces::PostSetParametersCallbackHandle::SharedPtr change_;
};

}  // namespace planformer_nav2
