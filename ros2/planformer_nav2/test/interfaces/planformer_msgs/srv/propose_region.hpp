// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <cstdint>
#include <geometry_msgs/msg/pose.hpp>
#include <memory>
#include <nav_msgs/msg/map_meta_data.hpp>
#include <std_msgs/msg/header.hpp>
#include <string>
#include <vector>

namespace planformer_msgs::srv {

/// As planformer_msgs/srv/ProposeRegion.srv, which service_contract_test.cpp compares.
struct ProposeRegion {
    struct Request {
        using SharedPtr = std::shared_ptr<Request>;
        std_msgs::msg::Header header;
        nav_msgs::msg::MapMetaData info;
        std::vector<std::uint8_t> costs;
        geometry_msgs::msg::Pose start;
        geometry_msgs::msg::Pose goal;
        std::string guide;
    };
    struct Response {
        using SharedPtr = std::shared_ptr<Response>;
        std::uint16_t error_code = 0;
        std::string error_msg;
        std::vector<std::uint8_t> mask;
        double seconds = 0.0;
    };
};

}  // namespace planformer_msgs::srv
