#include "core/car_space.hpp"

#include <ompl/util/Exception.h>

#include <limits>
#include <string>

#include "core/dubins.hpp"
#include "core/reeds_shepp.hpp"

namespace planformer {

namespace ob = ompl::base;

CarSpace::CarSpace(double turning_radius, bool reverse)
    : turning_radius_(turning_radius), reverse_(reverse) {
    if (!(std::isfinite(turning_radius) && turning_radius > 0.0)) {
        throw ompl::Exception("turning radius must be finite and > 0, not " +
                              std::to_string(turning_radius));
    }
    setName((reverse ? "ReedsShepp" : "Dubins") + getName());
}

Pose CarSpace::pose(const ob::State* state) {
    const auto* se2 = state->as<StateType>();
    return {se2->getX(), se2->getY(), se2->getYaw()};
}

void CarSpace::set_pose(const Pose& pose, ob::State* state) {
    auto* se2 = state->as<StateType>();
    se2->setXY(pose.x, pose.y);
    se2->setYaw(pose.yaw);
}

Curve CarSpace::curve(const ob::State* from, const ob::State* to) const {
    return curve(pose(from), pose(to));
}

Curve CarSpace::curve(const Pose& from, const Pose& to) const {
    return reverse_ ? reeds_shepp(from, to, turning_radius_) : dubins(from, to, turning_radius_);
}

double CarSpace::distance(const ob::State* from, const ob::State* to) const {
    return reverse_ ? reeds_shepp_length(pose(from), pose(to), turning_radius_)
                    : dubins_length(pose(from), pose(to), turning_radius_);
}

void CarSpace::interpolate(const ob::State* from, const ob::State* to, double t,
                           ob::State* state) const {
    if (t >= 1.0) {
        copyState(state, to);
        return;
    }
    const Curve motion = curve(from, to);
    const bool moves = t > 0.0 && motion.reachable();
    set_pose(moves ? motion.pose_at(t * motion.length()) : motion.start(), state);
}

void CarSpace::sanityChecks() const {
    // As for OMPL's own curve spaces: rounding moves a point of a shortest curve off it by 1e-15,
    // and from there the way can be longer by the root of that or, forward only, by a whole turn;
    // and curves leave the bounds, so that the extent does not bound their length.
    int flags =
        ~(STATESPACE_INTERPOLATION | STATESPACE_TRIANGLE_INEQUALITY | STATESPACE_DISTANCE_BOUND);
    if (!reverse_) flags &= ~STATESPACE_DISTANCE_SYMMETRIC;
    ob::StateSpace::sanityChecks(std::numeric_limits<double>::epsilon(),
                                 std::numeric_limits<float>::epsilon(), flags);
}

}  // namespace planformer
