#include "core/path.hpp"

#include <cstddef>

#include "core/car_space.hpp"
#include "core/validity.hpp"

namespace planformer {

std::vector<Pose> joined_states(const ompl::base::StateSpace& space,
                                const std::vector<Pose>& states, double step) {
    const auto* car = dynamic_cast<const CarSpace*>(&space);
    if (car == nullptr || states.empty()) return states;
    std::vector<Pose> poses{states.front()};
    for (std::size_t i = 1; i < states.size(); ++i) {
        append_motion(car->curve(states[i - 1], states[i]), states[i], step, &poses);
    }
    return poses;
}

}  // namespace planformer
