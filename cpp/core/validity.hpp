#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

#include <utility>
#include <vector>

#include "core/car_space.hpp"
#include "core/curve.hpp"
#include "core/free_space.hpp"

namespace planformer {

/// Distance between the poses at which an arc is checked and written out [cells].
constexpr double kArcStep = 0.5;

/// Visits the poses of a motion: those of the curve, the last one replaced by the exact target.
///
/// What is checked and what is returned are these very poses, so that they cannot differ.
template <typename Visit>
bool for_each_motion_pose(const Curve& curve, const Pose& target, double step, Visit&& visit) {
    bool first = true;
    Pose pending;
    const bool walked = for_each_pose(curve, step, [&](const Pose& pose) {
        const bool go_on = first || visit(pending);
        first = false;
        pending = pose;
        return go_on;
    });
    // A curve without length consists of its start alone, which the target follows.
    if (walked && curve.segment_count() == 0) return visit(pending) && visit(target);
    return walked && visit(target);
}

/// Whether every cell that the motion touches is free.
///
/// Straight parts are exact; an arc is checked as the chords between poses half a cell apart.
bool curve_is_free(const FreeSpace& space, const Curve& curve, const Pose& target);

/// Appends the poses of a motion that starts at the last pose of `path`.
void append_motion(const Curve& curve, const Pose& target, double step, std::vector<Pose>* path);

/// A state is valid where its cell is free.
class GridValidityChecker : public ompl::base::StateValidityChecker {
public:
    GridValidityChecker(const ompl::base::SpaceInformationPtr& si, const FreeSpace& free_space);
    bool isValid(const ompl::base::State* state) const override;

private:
    FreeSpace free_space_;
};

/// Exact check of straight motions in R^2 and of curves in a `CarSpace`.
class GridMotionValidator : public ompl::base::MotionValidator {
public:
    GridMotionValidator(const ompl::base::SpaceInformationPtr& si, const FreeSpace& free_space);
    bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;

    /// As above; on a collision the last state known to be valid is the motion's start.
    bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                     std::pair<ompl::base::State*, double>& last_valid) const override;

private:
    FreeSpace free_space_;
    const CarSpace* car_;  ///< null for R^2
};

}  // namespace planformer
