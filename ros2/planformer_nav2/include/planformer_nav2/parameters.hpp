#pragma once

#include <rclcpp/rclcpp.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <string>

namespace planformer_nav2 {

/// A parameter, declared unless it is already: nodes keep theirs when they are configured again.
template <typename T>
rclcpp::Parameter declared(rclcpp_lifecycle::LifecycleNode& node, const std::string& name,
                           const T& default_value) {
    if (!node.has_parameter(name)) node.declare_parameter<T>(name, default_value);
    return node.get_parameter(name);
}

}  // namespace planformer_nav2
