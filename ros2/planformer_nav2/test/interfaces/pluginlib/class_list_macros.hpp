// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <pluginlib/registry.hpp>

#define PLUGINLIB_EXPORT_CLASS(Class, Base) \
    static const bool kIsExported = pluginlib::export_class<Class, Base>(#Class);
