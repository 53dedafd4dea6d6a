/// The state space of a car with a minimum turning radius.
#pragma once

#include <ompl/base/spaces/SE2StateSpace.h>

#include "core/curve.hpp"

namespace planformer {

/// SE(2) whose distance and interpolation follow the shortest curve of a car: Dubins curves when it
/// drives forward only, Reeds-Shepp curves when it can reverse.
///
/// It stands in for OMPL's DubinsStateSpace and ReedsSheppStateSpace, which end the process through
/// assertions on rare inputs. `getType()` stays STATE_SPACE_SE2, states are SE2StateSpace's.
class CarSpace : public ompl::base::SE2StateSpace {
public:
    /// \param turning_radius  smallest radius of a turn [m], finite and > 0, else ompl::Exception
    /// \param reverse         whether the car can drive backwards
    CarSpace(double turning_radius, bool reverse);

    double turning_radius() const { return turning_radius_; }

    /// The shortest curve between two states.
    Curve curve(const ompl::base::State* from, const ompl::base::State* to) const;
    Curve curve(const Pose& from, const Pose& to) const;

    /// The pose that a state of this space holds.
    static Pose pose(const ompl::base::State* state);

    /// Writes a pose into a state of this space.
    static void set_pose(const Pose& pose, ompl::base::State* state);

    double distance(const ompl::base::State* from, const ompl::base::State* to) const override;
    void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t,
                     ompl::base::State* state) const override;

    bool isMetricSpace() const override { return false; }
    bool hasSymmetricDistance() const override { return reverse_; }
    bool hasSymmetricInterpolate() const override { return reverse_; }
    void sanityChecks() const override;

private:
    double turning_radius_;
    bool reverse_;
};

}  // namespace planformer
