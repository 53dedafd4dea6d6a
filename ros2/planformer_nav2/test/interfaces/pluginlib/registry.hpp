// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace pluginlib {

/// The classes that the program exports, by name.
template <typename Base>
std::map<std::string, std::function<Base*()>>& registry() {
    static std::map<std::string, std::function<Base*()>> classes;
    return classes;
}

template <typename Class, typename Base>
bool export_class(const std::string& name) {
    return registry<Base>().emplace(name, [] { return new Class; }).second;
}

}  // namespace pluginlib
