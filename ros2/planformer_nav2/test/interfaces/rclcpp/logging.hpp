// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>
#include <vector>

namespace rclcpp {

class Logger {};

inline Logger get_logger(const std::string&) { return {}; }

/// What was logged, for the tests to read.
inline std::vector<std::string>& log_lines() {
    static std::vector<std::string> lines;
    return lines;
}

/// The attribute lets the compiler check the arguments, as rcutils does.
[[gnu::format(printf, 2, 3)]] inline void log(const Logger&, const char* format, ...) {
    char line[1024];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    log_lines().emplace_back(line);
}

}  // namespace rclcpp

#define RCLCPP_DEBUG(logger, ...) rclcpp::log(logger, __VA_ARGS__)
#define RCLCPP_INFO(logger, ...) rclcpp::log(logger, __VA_ARGS__)
#define RCLCPP_WARN(logger, ...) rclcpp::log(logger, __VA_ARGS__)
