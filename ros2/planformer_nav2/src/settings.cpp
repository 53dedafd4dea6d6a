#include "planformer_nav2/settings.hpp"

#include <nav2_core/planner_exceptions.hpp>
#include <rcl_interfaces/msg/set_parameters_result.hpp>

#include "planformer_nav2/parameters.hpp"

namespace planformer_nav2 {

namespace {

constexpr double kMaxTimeout = 60.0;  // [s]

std::string allow_unknown(const std::string& name) { return name + ".planner.allow_unknown"; }

Settings changed(Settings settings, const std::string& name,
                 const std::vector<rclcpp::Parameter>& parameters) {
    for (const rclcpp::Parameter& parameter : parameters) {
        const std::string& which = parameter.get_name();
        if (which == name + ".guide") {
            settings.guide = parameter.get_value<std::string>();
        } else if (which == name + ".proposal_timeout") {
            settings.proposal_timeout = parameter.get_value<double>();
        } else if (which == name + ".keep_radius") {
            settings.keep_radius = parameter.get_value<double>();
        } else if (which == name + ".fallback") {
            settings.fallback = parameter.get_value<bool>();
        } else if (which == allow_unknown(name)) {
            settings.enters_unknown = parameter.get_value<bool>();
        }
    }
    return settings;
}

/// What is wrong with settings; empty where nothing is.
std::string complaint(const Settings& settings, const std::string& name) {
    // Written so that they do not hold for what is no number.
    if (!(settings.proposal_timeout > 0.0 && settings.proposal_timeout <= kMaxTimeout)) {
        return name + ".proposal_timeout has to be above 0 s and at most 60 s";
    }
    if (!(settings.keep_radius >= 0.0)) return name + ".keep_radius must not be negative";
    return {};
}

}  // namespace

void LiveSettings::declare(rclcpp_lifecycle::LifecycleNode& node, const std::string& name) {
    name_ = name;
    const Settings defaults;
    take({declared(node, name + ".guide", defaults.guide),
          declared(node, name + ".proposal_timeout", defaults.proposal_timeout),
          declared(node, name + ".keep_radius", defaults.keep_radius),
          declared(node, name + ".fallback", defaults.fallback)});
    const std::string wrong = complaint(now(), name);
    if (!wrong.empty()) throw nav2_core::PlannerException(wrong);
}

void LiveSettings::follow(rclcpp_lifecycle::LifecycleNode& node) {
    const std::string of_planner = allow_unknown(name_);
    if (node.has_parameter(of_planner)) take({node.get_parameter(of_planner)});
    check_ = node.add_on_set_parameters_callback(
        [this](const std::vector<rclcpp::Parameter>& parameters) {
            rcl_interfaces::msg::SetParametersResult result;
            result.reason = complaint(changed(now(), name_, parameters), name_);
            result.successful = result.reason.empty();
            return result;
        });
    change_ = node.add_post_set_parameters_callback(
        [this](const std::vector<rclcpp::Parameter>& parameters) { take(parameters); });
}

void LiveSettings::unfollow() {
    check_.reset();
    change_.reset();
}

Settings LiveSettings::now() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return settings_;
}

void LiveSettings::take(const std::vector<rclcpp::Parameter>& parameters) {
    const std::lock_guard<std::mutex> lock(mutex_);
    settings_ = changed(settings_, name_, parameters);
}

}  // namespace planformer_nav2
