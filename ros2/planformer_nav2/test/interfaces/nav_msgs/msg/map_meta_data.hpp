// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <builtin_interfaces/msg/time.hpp>
#include <cstdint>
#include <geometry_msgs/msg/pose.hpp>

namespace nav_msgs::msg {

struct MapMetaData {
    builtin_interfaces::msg::Time map_load_time;
    float resolution = 0.0F;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    geometry_msgs::msg::Pose origin;
};

}  // namespace nav_msgs::msg
