// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <rclcpp/client.hpp>
#include <rclcpp/executors.hpp>
#include <rclcpp/logging.hpp>
#include <rclcpp/parameter.hpp>
