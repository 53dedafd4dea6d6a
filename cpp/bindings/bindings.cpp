#include "bindings/bindings.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace planformer {

void require_positive(const char* name, double value) {
    if (std::isfinite(value) && value > 0.0) return;
    const std::string message =
        std::string(name) + " must be finite and > 0, not " + std::to_string(value);
    throw nb::value_error(message.c_str());
}

FreeSpace free_space_of(const BlockedArray& blocked, double resolution) {
    static_assert(sizeof(bool) == sizeof(std::uint8_t));
    // The core numbers cells, and those of a ring round them, with int.
    if ((blocked.shape(0) + 2) * (blocked.shape(1) + 2) >=
        static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw nb::value_error("blocked must have fewer than 2^31 - 1 cells, with a ring of one");
    }
    require_positive("resolution", resolution);
    return {static_cast<int>(blocked.shape(0)), static_cast<int>(blocked.shape(1)), resolution,
            reinterpret_cast<const std::uint8_t*>(blocked.data())};
}

NumpyArray<double> to_numpy(const std::vector<Pose>& poses) {
    std::vector<double> values;
    values.reserve(3 * poses.size());
    for (const Pose& pose : poses) values.insert(values.end(), {pose.x, pose.y, pose.yaw});
    return to_numpy(std::move(values), {poses.size(), 3});
}

}  // namespace planformer
