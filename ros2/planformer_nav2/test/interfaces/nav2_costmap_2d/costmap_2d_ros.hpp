// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <nav2_costmap_2d/costmap_2d.hpp>
#include <string>

namespace nav2_costmap_2d {

class Costmap2DROS {
public:
    Costmap2D* getCostmap() { return &costmap_; }
    std::string getGlobalFrameID() const { return "map"; }

private:
    Costmap2D costmap_;
};

}  // namespace nav2_costmap_2d
