#include "core/validity.hpp"

#include "core/region.hpp"

namespace planformer {

namespace ob = ompl::base;

bool curve_is_free(const FreeSpace& space, const Curve& curve, const Pose& target) {
    Pose last = curve.start();
    if (!space.is_free(last.x, last.y)) return false;
    return for_each_motion_pose(curve, target, kArcStep * space.resolution, [&](const Pose& pose) {
        const bool free = space.segment_is_free(last.x, last.y, pose.x, pose.y);
        last = pose;
        return free;
    });
}

void append_motion(const Curve& curve, const Pose& target, double step, std::vector<Pose>* path) {
    bool is_start = true;
    for_each_motion_pose(curve, target, step, [&](const Pose& pose) {
        if (!is_start) path->push_back(pose);
        is_start = false;
        return true;
    });
}

GridValidityChecker::GridValidityChecker(const ob::SpaceInformationPtr& si,
                                         const FreeSpace& free_space)
    : ob::StateValidityChecker(si), free_space_(free_space) {}

bool GridValidityChecker::isValid(const ob::State* state) const {
    const Pose pose = read_state(*si_->getStateSpace(), state);
    return free_space_.is_free(pose.x, pose.y);
}

GridMotionValidator::GridMotionValidator(const ob::SpaceInformationPtr& si,
                                         const FreeSpace& free_space)
    : ob::MotionValidator(si),
      free_space_(free_space),
      car_(dynamic_cast<const CarSpace*>(si->getStateSpace().get())) {}

bool GridMotionValidator::checkMotion(const ob::State* from, const ob::State* to) const {
    const Pose a = read_state(*si_->getStateSpace(), from);
    const Pose b = read_state(*si_->getStateSpace(), to);
    if (car_ != nullptr) return curve_is_free(free_space_, car_->curve(from, to), b);
    return free_space_.segment_is_free(a.x, a.y, b.x, b.y);
}

bool GridMotionValidator::checkMotion(const ob::State* from, const ob::State* to,
                                      std::pair<ob::State*, double>& last_valid) const {
    const bool free = checkMotion(from, to);
    if (!free) {
        if (last_valid.first != nullptr) si_->copyState(last_valid.first, from);
        last_valid.second = 0.0;
    }
    return free;
}

}  // namespace planformer
