// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

namespace geometry_msgs::msg {

struct Point {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

struct Quaternion {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    double w = 1.0;
};

struct Pose {
    Point position;
    Quaternion orientation;
};

}  // namespace geometry_msgs::msg
