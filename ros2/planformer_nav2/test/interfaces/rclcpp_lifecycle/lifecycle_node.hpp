// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <string>

namespace rclcpp_lifecycle {

class LifecycleNode : public rclcpp::Parameters {
public:
    using SharedPtr = std::shared_ptr<LifecycleNode>;
    using WeakPtr = std::weak_ptr<LifecycleNode>;

    rclcpp::Logger get_logger() const { return {}; }

    rclcpp::node_interfaces::NodeBaseInterface::SharedPtr get_node_base_interface() const {
        return std::make_shared<rclcpp::node_interfaces::NodeBaseInterface>();
    }

    rclcpp::CallbackGroup::SharedPtr create_callback_group(rclcpp::CallbackGroupType,
                                                           bool with_node = true) {
        return std::make_shared<rclcpp::CallbackGroup>(with_node);
    }

    template <typename ServiceT>
    typename rclcpp::Client<ServiceT>::SharedPtr create_client(
        const std::string& service, const rclcpp::QoS& = rclcpp::ServicesQoS(),
        rclcpp::CallbackGroup::SharedPtr group = nullptr) {
        auto client = std::make_shared<rclcpp::Client<ServiceT>>(service, group);
        rclcpp::last_client<ServiceT>() = client;
        return client;
    }
};

}  // namespace rclcpp_lifecycle
