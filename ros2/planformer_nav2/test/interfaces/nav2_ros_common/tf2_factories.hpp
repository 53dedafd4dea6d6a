// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <tf2_ros/buffer.hpp>

namespace nav2 {

using TransformBuffer = tf2_ros::Buffer;

}  // namespace nav2
