#pragma once

#include <ompl/base/State.h>
#include <ompl/base/StateSpace.h>
#include <ompl/util/RandomNumbers.h>

#include <limits>
#include <vector>

#include "core/car_space.hpp"
#include "core/curve.hpp"

namespace planformer {

/// The best path that a search has found so far, and samples near it.
///
/// Most samples make no path shorter, those close to the best one often do (Akgun and Stilman 2011,
/// "Sampling heuristics for optimal motion planning in high dimensions").
class Incumbent {
public:
    /// The space, of R^2 or a car, has to outlive it.
    Incumbent(const ompl::base::StateSpace& space, const Pose& start, const Pose& goal);

    /// Takes a path of this length [m] if it is shorter. Its states may begin at either end, and
    /// may leave the ends out.
    void improve(const std::vector<const ompl::base::State*>& states, double length);

    bool exists() const { return !states_.empty(); }

    /// From the start to the goal; empty without a path.
    const std::vector<Pose>& states() const { return states_; }

    /// [m]; infinite without a path.
    double length() const { return length_; }

    /// Draws a pose near the path, which has to exist; it may lie outside of the map.
    Pose sample_near(ompl::RNG& rng) const;

private:
    std::vector<Pose> from_start_to_goal(std::vector<Pose> states) const;
    Curve motion(const Pose& from, const Pose& to) const;
    Pose sample_on(ompl::RNG& rng) const;

    const ompl::base::StateSpace& space_;
    const CarSpace* car_;  ///< the space of a car; null for a point
    Pose start_;
    Pose goal_;
    std::vector<Pose> states_;
    std::vector<Curve> motions_;
    std::vector<double> ends_;  ///< length of the path up to the end of each motion [m]
    double length_ = std::numeric_limits<double>::infinity();
};

}  // namespace planformer
