#pragma once

#include <ompl/base/StateSampler.h>
#include <ompl/base/StateSpace.h>
#include <ompl/base/spaces/RealVectorBounds.h>
#include <ompl/util/RandomNumbers.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "core/curve.hpp"
#include "core/incumbent.hpp"
#include "core/seeding.hpp"

namespace planformer {

/// A proposed part of the state space: shapes of one size round anchor points, in the local frame.
///
/// Without headings the shape is a square of side 2 * minor_axis, and a car's yaw is uniform. With
/// headings it is an ellipse with semi-axes (half_width, minor_axis) turned along the heading, and
/// the yaw is Gaussian round it (Motion Planning Transformers, section III.B), as widely as the
/// proposal is unsure of it. A shape may lie beside its anchor; what of it leaves the anchors'
/// squares of side 2 * half_width is cut off. Without headings some samples fill these squares.
///
/// Some samples are poses soon after a car's start or shortly before its goal: in a tight place
/// hardly any others join a tree to the goal, and one heading an anchor cannot tell how a car turns
/// about.
struct Region {
    /// Where a car starts and arrives; a turning radius [m] of 0 stands for no car.
    struct Ends {
        Pose start;
        Pose goal;
        double turning_radius = 0.0;
    };
    struct Offset {
        double x = 0.0;  ///< [m]
        double y = 0.0;  ///< [m]
    };

    std::vector<Pose> anchors;    ///< yaw is the predicted heading
    std::vector<Offset> offsets;  ///< from each anchor to its shape's centre, inside its square
    bool has_heading = false;
    double half_width = 0.0;             ///< [m]
    double minor_axis = 0.0;             ///< [m]
    std::vector<double> yaw_deviations;  ///< standard deviation of each anchor's yaw [rad]
    Ends ends;
    double area = 0.0;  ///< [m^2] of the union of the shapes
};

/// Extent of the map: states are drawn from [0, x] x [0, y].
struct Extent {
    double x = 0.0;
    double y = 0.0;

    double area() const { return x * y; }
    bool contains(const Pose& pose) const {
        return pose.x >= 0.0 && pose.x <= x && pose.y >= 0.0 && pose.y <= y;
    }
    ompl::base::RealVectorBounds bounds() const;
};

/// Where samples come from: once a path is known, with probability `refinement` its surroundings,
/// wherever they lie; else the region, or with probability `exploration` the whole map.
struct Guidance {
    std::shared_ptr<const Region> region;  ///< null: the whole map
    double exploration = 0.0;
    double refinement = 0.0;
    std::shared_ptr<const Incumbent> incumbent;  ///< the search's best path; null: unknown
};

/// Writes a pose into a state of R^2 or SE(2); the yaw is dropped in R^2.
void write_state(const ompl::base::StateSpace& space, const Pose& pose, ompl::base::State* state);

/// Reads a state of R^2 (yaw 0) or SE(2).
Pose read_state(const ompl::base::StateSpace& space, const ompl::base::State* state);

/// Draws one pose inside the region; it may lie outside the map.
Pose sample_region(const Region& region, ompl::RNG& rng);

/// Draws one pose uniformly on the map.
Pose sample_extent(const Extent& extent, ompl::RNG& rng);

/// Decides whether the next pose is drawn near the best path; never before there is one.
bool chooses_refinement(const Guidance& guidance, ompl::RNG& rng);

/// Draws poses as the guidance says, never outside the map.
Pose sample_guided(const Guidance& guidance, const Extent& extent, ompl::RNG& rng);

/// OMPL's view of `sample_guided`.
class GuidedSampler : public ompl::base::StateSampler {
public:
    GuidedSampler(const ompl::base::StateSpace* space, Guidance guidance, Extent extent,
                  std::uint32_t seed);

    void sampleUniform(ompl::base::State* state) override;
    void sampleUniformNear(ompl::base::State* state, const ompl::base::State* near,
                           double distance) override;
    void sampleGaussian(ompl::base::State* state, const ompl::base::State* mean,
                        double deviation) override;

private:
    Guidance guidance_;
    Extent extent_;
    ompl::base::StateSamplerPtr local_;  ///< OMPL's own sampler, for draws near a given state
};

/// Makes `GuidedSampler`s; give it to a state space.
ompl::base::StateSamplerAllocator guided_sampler_allocator(Guidance guidance, Extent extent,
                                                           SeedsPtr seeds);

}  // namespace planformer
