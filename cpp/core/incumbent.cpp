#include "core/incumbent.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/region.hpp"

namespace planformer {

namespace ob = ompl::base;

namespace {

/// Standard deviations of the samples from the path, as shares of its length. Which of them helps
/// depends on how good the path is and how narrow its surroundings are.
constexpr double kFinest = 0.0003;
constexpr double kCoarsest = 0.003;

bool is_same(const Pose& a, const Pose& b) { return a.x == b.x && a.y == b.y && a.yaw == b.yaw; }

}  // namespace

Incumbent::Incumbent(const ob::StateSpace& space, const Pose& start, const Pose& goal)
    : space_(space), car_(dynamic_cast<const CarSpace*>(&space)), start_(start), goal_(goal) {}

void Incumbent::improve(const std::vector<const ob::State*>& states, double length) {
    if (!(length < length_)) return;
    length_ = length;
    std::vector<Pose> poses;
    for (const ob::State* state : states) poses.push_back(read_state(space_, state));
    states_ = from_start_to_goal(std::move(poses));
    motions_.clear();
    ends_.clear();
    double end = 0.0;
    for (std::size_t i = 1; i < states_.size(); ++i) {
        motions_.push_back(motion(states_[i - 1], states_[i]));
        ends_.push_back(end += motions_.back().length());
    }
}

std::vector<Pose> Incumbent::from_start_to_goal(std::vector<Pose> states) const {
    const bool from_start =
        !states.empty() && (is_same(states.front(), start_) || is_same(states.back(), goal_));
    if (!from_start) std::reverse(states.begin(), states.end());
    if (states.empty() || !is_same(states.front(), start_)) states.insert(states.begin(), start_);
    if (!is_same(states.back(), goal_)) states.push_back(goal_);
    return states;
}

Curve Incumbent::motion(const Pose& from, const Pose& to) const {
    if (car_) return car_->curve(from, to);
    const double dx = to.x - from.x;
    const double dy = to.y - from.y;
    Curve straight({from.x, from.y, std::atan2(dy, dx)});
    straight.append({0.0, std::hypot(dx, dy)});
    return straight;
}

Pose Incumbent::sample_on(ompl::RNG& rng) const {
    if (motions_.empty()) return start_;
    const double driven = rng.uniformReal(0.0, ends_.back());
    const auto found = std::lower_bound(ends_.begin(), ends_.end() - 1, driven);
    const Curve& motion = motions_[static_cast<std::size_t>(found - ends_.begin())];
    return motion.pose_at(driven - (*found - motion.length()));
}

Pose Incumbent::sample_near(ompl::RNG& rng) const {
    const Pose pose = sample_on(rng);
    const double deviation = length_ * kFinest * std::pow(kCoarsest / kFinest, rng.uniform01());
    // So far a car turns while it moves aside.
    const double yaw_deviation = car_ ? deviation / car_->turning_radius() : 0.0;
    return {rng.gaussian(pose.x, deviation), rng.gaussian(pose.y, deviation),
            rng.gaussian(pose.yaw, yaw_deviation)};
}

}  // namespace planformer
