#pragma once

#include <chrono>
#include <functional>
#include <planformer_msgs/srv/propose_region.hpp>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <string>

namespace planformer_nav2 {

/// Asks the service ProposeRegion and waits for its answer. One call at a time.
class RegionClient {
public:
    using Service = planformer_msgs::srv::ProposeRegion;

    RegionClient(rclcpp_lifecycle::LifecycleNode& node, const std::string& service);

    /// Returns an answer without error.
    ///
    /// Throws PlannerCancelled, PlannerTimedOut, the exception of the answer's error code, or
    /// PlannerException where there is no such service.
    Service::Response::SharedPtr propose(const Service::Request::SharedPtr& request,
                                         std::chrono::nanoseconds timeout,
                                         const std::function<bool()>& cancelled);

private:
    Service::Response::SharedPtr wait_for(rclcpp::Client<Service>::FutureAndRequestId& answer,
                                          std::chrono::nanoseconds timeout,
                                          const std::function<bool()>& cancelled);

    std::string service_;
    rclcpp::CallbackGroup::SharedPtr group_;
    rclcpp::Client<Service>::SharedPtr client_;
    rclcpp::executors::SingleThreadedExecutor executor_;
};

}  // namespace planformer_nav2
