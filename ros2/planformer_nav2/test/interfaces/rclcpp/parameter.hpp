// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <rcl_interfaces/msg/set_parameters_result.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rclcpp {

using ParameterValue = std::variant<bool, double, std::string>;

class Parameter {
public:
    Parameter(std::string name, ParameterValue value)
        : name_(std::move(name)), value_(std::move(value)) {}

    const std::string& get_name() const { return name_; }

    template <typename T>
    const T& get_value() const {
        return std::get<T>(value_);
    }

private:
    std::string name_;
    ParameterValue value_;
};

namespace node_interfaces {

template <typename Result>
struct ParametersCallbackHandle {
    using SharedPtr = std::shared_ptr<ParametersCallbackHandle>;
    std::function<Result(const std::vector<Parameter>&)> callback;
};

using OnSetParametersCallbackHandle =
    ParametersCallbackHandle<rcl_interfaces::msg::SetParametersResult>;
using PostSetParametersCallbackHandle = ParametersCallbackHandle<void>;

}  // namespace node_interfaces

/// A node's parameters; `overrides` stands for the parameter file.
///
/// Counts how often it is asked for them: the real one locks them each time, also while it waits
/// for the callbacks of a change.
class Parameters {
public:
    using OnSet = node_interfaces::OnSetParametersCallbackHandle;
    using PostSet = node_interfaces::PostSetParametersCallbackHandle;

    std::map<std::string, ParameterValue> overrides;

    bool has_parameter(const std::string& name) const {
        ++lookups_;
        return declared_.count(name) > 0;
    }

    template <typename T>
    T declare_parameter(const std::string& name, const T& default_value) {
        if (has_parameter(name)) throw std::runtime_error(name + " is declared already");
        const auto found = overrides.find(name);
        ParameterValue value = found == overrides.end() ? default_value : found->second;
        if (!std::holds_alternative<T>(value)) throw std::runtime_error(name + " has another type");
        declared_.emplace(name, value);
        return std::get<T>(value);
    }

    Parameter get_parameter(const std::string& name) const {
        if (!has_parameter(name)) throw std::runtime_error(name + " is not declared");
        return {name, declared_.at(name)};
    }

    rcl_interfaces::msg::SetParametersResult set_parameter(const std::string& name,
                                                           const ParameterValue& value) {
        const std::vector<Parameter> changes = {{name, value}};
        rcl_interfaces::msg::SetParametersResult result;
        result.successful = true;
        for (const auto& known : on_set_) {
            const auto handle = known.lock();
            if (handle != nullptr && result.successful) result = handle->callback(changes);
        }
        if (!result.successful) return result;
        declared_.at(name) = value;
        for (const auto& known : post_set_) {
            if (const auto handle = known.lock()) handle->callback(changes);
        }
        return result;
    }

    OnSet::SharedPtr add_on_set_parameters_callback(decltype(OnSet::callback) callback) {
        auto handle = std::make_shared<OnSet>(OnSet{std::move(callback)});
        on_set_.push_back(handle);
        return handle;
    }

    PostSet::SharedPtr add_post_set_parameters_callback(decltype(PostSet::callback) callback) {
        auto handle = std::make_shared<PostSet>(PostSet{std::move(callback)});
        post_set_.push_back(handle);
        return handle;
    }

    int lookups() const { return lookups_; }

private:
    mutable int lookups_ = 0;
    std::map<std::string, ParameterValue> declared_;
    std::vector<std::weak_ptr<OnSet>> on_set_;
    std::vector<std::weak_ptr<PostSet>> post_set_;
};

}  // namespace rclcpp
