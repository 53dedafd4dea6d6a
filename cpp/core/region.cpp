#include "core/region.hpp"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace planformer {

namespace ob = ompl::base;

namespace {

/// Draws that miss the map or the region are repeated this often before a place inside is taken.
constexpr int kMaxRedraws = 100;
/// Share of a point's samples that come from the anchors' own squares.
constexpr double kLatticeShare = 0.2;
/// Share of the samples next to start and goal.
constexpr double kEndShare = 0.2;
/// Longest of the two arcs to such a sample, in turning radii.
constexpr double kEndArc = 2.5;
/// What rounding may put outside of a square [m].
constexpr double kRounding = 1e-9;

bool is_car(const ob::StateSpace& space) { return space.getType() == ob::STATE_SPACE_SE2; }

Pose sample_square(const Pose& centre, double half_width, ompl::RNG& rng) {
    return {centre.x + rng.uniformReal(-half_width, half_width),
            centre.y + rng.uniformReal(-half_width, half_width), rng.uniformReal(-kPi, kPi)};
}

Pose sample_ellipse(const Region& region, const Pose& centre, double yaw_deviation,
                    ompl::RNG& rng) {
    const double radius = std::sqrt(rng.uniform01());
    const double angle = rng.uniformReal(-kPi, kPi);
    const double along = region.half_width * radius * std::cos(angle);
    const double across = region.minor_axis * radius * std::sin(angle);
    const double c = std::cos(centre.yaw);
    const double s = std::sin(centre.yaw);
    return {centre.x + c * along - s * across, centre.y + s * along + c * across,
            rng.gaussian(centre.yaw, yaw_deviation)};
}

/// Draws from the whole shape of an anchor.
Pose sample_shape(const Region& region, std::size_t index, ompl::RNG& rng) {
    const auto& [dx, dy] = region.offsets[index];
    const Pose& anchor = region.anchors[index];
    // Squares that lie round a predicted path may leave gaps where a path has to pass.
    if (!region.has_heading && rng.uniform01() < kLatticeShare) {
        return sample_square(anchor, region.half_width, rng);
    }
    const Pose centre{anchor.x + dx, anchor.y + dy, anchor.yaw};
    if (region.has_heading) {
        return sample_ellipse(region, centre, region.yaw_deviations[index], rng);
    }
    return sample_square(centre, region.minor_axis, rng);
}

/// Draws a pose two arcs or straights ahead of the start, or as far back from the goal.
Pose sample_end(const Region::Ends& ends, ompl::RNG& rng) {
    const bool ahead = rng.uniformBool();
    Pose pose = ahead ? ends.start : ends.goal;
    for (int i = 0; i < 2; ++i) {
        const double curvature = rng.uniformInt(-1, 1) / ends.turning_radius;
        const double length = rng.uniformReal(0.0, kEndArc * ends.turning_radius);
        pose = advance(pose, curvature, ahead ? length : -length);
    }
    return pose;
}

bool is_in_square(const Pose& anchor, double half_width, const Pose& pose) {
    const double offset = std::max(std::abs(pose.x - anchor.x), std::abs(pose.y - anchor.y));
    return offset <= half_width + kRounding;
}

bool is_in_region(const Region& region, const Pose& pose) {
    return std::any_of(region.anchors.begin(), region.anchors.end(), [&](const Pose& anchor) {
        return is_in_square(anchor, region.half_width, pose);
    });
}

}  // namespace

void write_state(const ob::StateSpace& space, const Pose& pose, ob::State* state) {
    if (!is_car(space)) {
        auto* point = state->as<ob::RealVectorStateSpace::StateType>();
        point->values[0] = pose.x;
        point->values[1] = pose.y;
        return;
    }
    auto* car = state->as<ob::SE2StateSpace::StateType>();
    car->setXY(pose.x, pose.y);
    car->setYaw(wrap_angle(pose.yaw));
}

Pose read_state(const ob::StateSpace& space, const ob::State* state) {
    if (!is_car(space)) {
        const auto* point = state->as<ob::RealVectorStateSpace::StateType>();
        return {point->values[0], point->values[1], 0.0};
    }
    const auto* car = state->as<ob::SE2StateSpace::StateType>();
    return {car->getX(), car->getY(), car->getYaw()};
}

Pose sample_region(const Region& region, ompl::RNG& rng) {
    const bool is_car = region.ends.turning_radius > 0.0;
    if (is_car && rng.uniform01() < kEndShare) return sample_end(region.ends, rng);
    const int last = static_cast<int>(region.anchors.size()) - 1;
    const auto index = static_cast<std::size_t>(rng.uniformInt(0, last));
    Pose pose = sample_shape(region, index, rng);
    for (int i = 0; i < kMaxRedraws; ++i) {
        const bool is_near = is_in_square(region.anchors[index], region.half_width, pose);
        if (is_near || is_in_region(region, pose)) return pose;
        pose = sample_shape(region, index, rng);
    }
    return region.anchors[index];
}

Pose sample_extent(const Extent& extent, ompl::RNG& rng) {
    return {rng.uniformReal(0.0, extent.x), rng.uniformReal(0.0, extent.y),
            rng.uniformReal(-kPi, kPi)};
}

bool chooses_refinement(const Guidance& guidance, ompl::RNG& rng) {
    const bool possible = guidance.incumbent && guidance.incumbent->exists();
    if (!possible || guidance.refinement == 0.0) return false;
    return rng.uniform01() < guidance.refinement;
}

ob::RealVectorBounds Extent::bounds() const {
    ob::RealVectorBounds bounds(2);
    bounds.setLow(0.0);
    bounds.setHigh(0, x);
    bounds.setHigh(1, y);
    return bounds;
}

Pose sample_guided(const Guidance& guidance, const Extent& extent, ompl::RNG& rng) {
    if (chooses_refinement(guidance, rng)) {
        const Pose near = guidance.incumbent->sample_near(rng);
        if (extent.contains(near)) return near;
    }
    const bool explore = guidance.exploration > 0.0 && rng.uniform01() < guidance.exploration;
    if (!guidance.region || explore) return sample_extent(extent, rng);
    Pose pose = sample_region(*guidance.region, rng);
    for (int i = 0; i < kMaxRedraws && !extent.contains(pose); ++i) {
        pose = sample_region(*guidance.region, rng);
    }
    // The map does not contain its far edges.
    pose.x = std::clamp(pose.x, 0.0, std::nextafter(extent.x, 0.0));
    pose.y = std::clamp(pose.y, 0.0, std::nextafter(extent.y, 0.0));
    return pose;
}

GuidedSampler::GuidedSampler(const ob::StateSpace* space, Guidance guidance, Extent extent,
                             std::uint32_t seed)
    : ob::StateSampler(space),
      guidance_(std::move(guidance)),
      extent_(extent),
      local_(space->allocDefaultStateSampler()) {
    rng_.setLocalSeed(seed);
}

void GuidedSampler::sampleUniform(ob::State* state) {
    write_state(*space_, sample_guided(guidance_, extent_, rng_), state);
}

void GuidedSampler::sampleUniformNear(ob::State* state, const ob::State* near, double distance) {
    local_->sampleUniformNear(state, near, distance);
}

void GuidedSampler::sampleGaussian(ob::State* state, const ob::State* mean, double deviation) {
    local_->sampleGaussian(state, mean, deviation);
}

ob::StateSamplerAllocator guided_sampler_allocator(Guidance guidance, Extent extent,
                                                   SeedsPtr seeds) {
    return [guidance = std::move(guidance), extent,
            seeds = std::move(seeds)](const ob::StateSpace* space) {
        const std::uint32_t seed = seeds->next();
        return seeded(
            seed, [&] { return std::make_shared<GuidedSampler>(space, guidance, extent, seed); });
    };
}

}  // namespace planformer
