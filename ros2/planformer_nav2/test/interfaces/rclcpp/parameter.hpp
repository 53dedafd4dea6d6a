// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <variant>

namespace rclcpp {

using ParameterValue = std::variant<bool, double, std::string>;

class Parameter {
public:
    explicit Parameter(ParameterValue value) : value_(std::move(value)) {}

    template <typename T>
    const T& get_value() const {
        return std::get<T>(value_);
    }

private:
    ParameterValue value_;
};

/// A node's parameters; `overrides` stands for the parameter file.
class Parameters {
public:
    std::map<std::string, ParameterValue> overrides;

    bool has_parameter(const std::string& name) const { return declared_.count(name) > 0; }

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
        return Parameter(declared_.at(name));
    }

    void set_parameter(const std::string& name, const ParameterValue& value) {
        declared_.at(name) = value;
    }

private:
    std::map<std::string, ParameterValue> declared_;
};

}  // namespace rclcpp
