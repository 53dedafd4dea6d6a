// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <mutex>
#include <vector>

namespace nav2_costmap_2d {

class Costmap2D {
public:
    using mutex_t = std::recursive_mutex;

    void resizeMap(unsigned int size_x, unsigned int size_y, double resolution, double origin_x,
                   double origin_y) {
        size_x_ = size_x;
        size_y_ = size_y;
        resolution_ = resolution;
        origin_x_ = origin_x;
        origin_y_ = origin_y;
        cells_.assign(std::size_t{size_x} * size_y, 0);
    }

    unsigned char* getCharMap() const { return cells_.data(); }
    unsigned int getSizeInCellsX() const { return size_x_; }
    unsigned int getSizeInCellsY() const { return size_y_; }
    double getResolution() const { return resolution_; }
    double getOriginX() const { return origin_x_; }
    double getOriginY() const { return origin_y_; }
    mutex_t* getMutex() { return &mutex_; }

private:
    unsigned int size_x_ = 0;
    unsigned int size_y_ = 0;
    double resolution_ = 0.0;
    double origin_x_ = 0.0;
    double origin_y_ = 0.0;
    mutable std::vector<unsigned char> cells_;
    mutex_t mutex_;
};

}  // namespace nav2_costmap_2d
