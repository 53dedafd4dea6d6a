// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <memory>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <string>

namespace nav2 {

/// Hides some of its base class behind factories of its own, as the real one does.
class LifecycleNode : public rclcpp_lifecycle::LifecycleNode {
public:
    using SharedPtr = std::shared_ptr<LifecycleNode>;
    using WeakPtr = std::weak_ptr<LifecycleNode>;

    template <typename ServiceT>
    void create_client(const std::string& service, bool use_internal_executor = false) = delete;
};

}  // namespace nav2
