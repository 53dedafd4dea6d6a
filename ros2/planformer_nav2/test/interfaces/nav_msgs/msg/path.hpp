// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <geometry_msgs/msg/pose_stamped.hpp>
#include <std_msgs/msg/header.hpp>
#include <vector>

namespace nav_msgs::msg {

struct Path {
    std_msgs::msg::Header header;
    std::vector<geometry_msgs::msg::PoseStamped> poses;
};

}  // namespace nav_msgs::msg
