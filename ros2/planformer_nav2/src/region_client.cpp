#include "planformer_nav2/region_client.hpp"

#include <nav2_core/planner_exceptions.hpp>

#include "planformer_nav2/service_errors.hpp"
#include "planformer_nav2/waiting.hpp"

namespace planformer_nav2 {

// The answer is received by an executor of our own, inside propose(): the planner server's may be
// busy with a callback that waits for the end of this very plan.
RegionClient::RegionClient(rclcpp_lifecycle::LifecycleNode& node, const std::string& service)
    : service_(service),
      group_(node.create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false)),
      client_(node.create_client<Service>(service, rclcpp::ServicesQoS(), group_)) {
    executor_.add_callback_group(group_, node.get_node_base_interface());
}

RegionClient::Service::Response::SharedPtr RegionClient::propose(
    const Service::Request::SharedPtr& request, std::chrono::nanoseconds timeout,
    const std::function<bool()>& cancelled) {
    // Not waited for: a planner that works without it has no reason to start late.
    if (!client_->service_is_ready()) {
        throw nav2_core::PlannerException("there is no service " + service_);
    }
    auto answer = client_->async_send_request(request);
    auto response = wait_for(answer, timeout, cancelled);
    if (response->error_code != 0) {
        throw_service_error(response->error_code, service_ + ": " + response->error_msg);
    }
    return response;
}

RegionClient::Service::Response::SharedPtr RegionClient::wait_for(
    rclcpp::Client<Service>::FutureAndRequestId& answer, std::chrono::nanoseconds timeout,
    const std::function<bool()>& cancelled) {
    const auto answered_within = [&](std::chrono::nanoseconds time) {
        const auto code = executor_.spin_until_future_complete(answer, time);
        if (code != rclcpp::FutureReturnCode::INTERRUPTED) {
            return code == rclcpp::FutureReturnCode::SUCCESS;
        }
        throw nav2_core::PlannerException("shut down while waiting for " + service_);
    };
    const Wait wait = wait_for_answer(timeout, answered_within, cancelled);
    if (wait == Wait::kAnswered) return answer.get();
    // Otherwise the client would keep it for ever; the answer is dropped when it comes after all.
    client_->remove_pending_request(answer);
    if (wait == Wait::kCancelled) {
        throw nav2_core::PlannerCancelled("cancelled while waiting for " + service_);
    }
    throw nav2_core::PlannerTimedOut("no answer in time from " + service_);
}

}  // namespace planformer_nav2
