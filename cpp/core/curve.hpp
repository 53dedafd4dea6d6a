/// Value types of a car's motion: poses and curves of constant-curvature segments.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace planformer {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTwoPi = 2.0 * kPi;

/// The same angle in [-pi, pi].
inline double wrap_angle(double angle) {
    if (std::abs(angle) > 2.5 * kPi) angle = std::remainder(angle, kTwoPi);
    if (angle > kPi) return angle - kTwoPi;
    if (angle < -kPi) return angle + kTwoPi;
    return angle;
}

/// Position [m] and heading [rad, counter-clockwise].
struct Pose {
    double x = 0.0;
    double y = 0.0;
    double yaw = 0.0;
};

inline bool is_finite(const Pose& pose) {
    return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
}

/// Part of a curve: curvature [1/m] (left > 0, straight 0, right < 0) over a signed length [m]
/// (negative: driven in reverse).
struct Segment {
    double curvature = 0.0;
    double length = 0.0;
};

/// The pose after driving `length` metres (signed) at constant `curvature`.
///
/// The chord form keeps full precision on arcs of any length, however short.
inline Pose advance(const Pose& pose, double curvature, double length) {
    const double half_turn = 0.5 * curvature * length;
    const double chord = curvature == 0.0 ? length : 2.0 / curvature * std::sin(half_turn);
    const double direction = pose.yaw + half_turn;
    return {pose.x + chord * std::cos(direction), pose.y + chord * std::sin(direction),
            wrap_angle(pose.yaw + 2.0 * half_turn)};
}

/// A start pose and up to five segments driven one after another; a plain value without heap.
class Curve {
public:
    static constexpr int kMaxSegments = 5;

    Curve() = default;
    explicit Curve(const Pose& start) : start_(start) {}

    /// What a search for a curve returns when there is none (poses that are not finite): a curve of
    /// infinite length, so that no planner takes it for an edge.
    static Curve unreachable(const Pose& start) {
        Curve curve(start);
        curve.append({0.0, std::numeric_limits<double>::infinity()});
        return curve;
    }

    /// Appends a segment; one of zero length is skipped. At most kMaxSegments.
    void append(const Segment& segment) {
        if (segment.length == 0.0 || count_ == kMaxSegments) return;
        segments_[static_cast<std::size_t>(count_++)] = segment;
        length_ += std::abs(segment.length);
    }

    const Pose& start() const { return start_; }
    int segment_count() const { return count_; }
    const Segment& segment(int i) const { return segments_[static_cast<std::size_t>(i)]; }

    /// Length driven [m], forward and reverse.
    double length() const { return length_; }

    /// False for `unreachable`.
    bool reachable() const { return std::isfinite(length_); }

    /// The pose after `s` metres along the curve, exact; `s` is clamped to [0, length()].
    Pose pose_at(double s) const {
        if (!(s < length_)) return end();
        Pose pose = start_;
        for (int i = 0; i < count_ && s > 0.0; ++i) {
            const Segment& part = segment(i);
            const double driven = std::min(s, std::abs(part.length));
            pose = advance(pose, part.curvature, std::copysign(driven, part.length));
            s -= driven;
        }
        return pose;
    }

    /// The last pose.
    Pose end() const {
        Pose pose = start_;
        for (int i = 0; i < count_; ++i) {
            pose = advance(pose, segment(i).curvature, segment(i).length);
        }
        return pose;
    }

private:
    Pose start_;
    std::array<Segment, kMaxSegments> segments_{};
    int count_ = 0;
    double length_ = 0.0;
};

/// Visits the inner poses of one arc at a spacing of at most `step` metres and a quarter turn,
/// beyond which two poses and their distance would not tell the arc between them, and then
/// `arc_end`. Turning the radius vector by a constant rotation spares the trigonometry of every
/// pose.
template <typename Visit>
bool for_each_arc_pose(const Pose& arc_start, const Segment& arc, const Pose& arc_end, double step,
                       Visit&& visit) {
    constexpr double kMostPoses = 1 << 20;  // bounds the loop whatever the step
    const double quarters = std::abs(arc.curvature * arc.length) / (0.5 * kPi);
    const double wanted = std::ceil(std::max(std::abs(arc.length) / step, quarters));
    const int poses = static_cast<int>(std::min(kMostPoses, std::max(1.0, wanted)));
    const double turn = arc.curvature * arc.length / poses;
    const double turn_cos = std::cos(turn);
    const double turn_sin = std::sin(turn);
    double radius_x = std::sin(arc_start.yaw) / arc.curvature;
    double radius_y = -std::cos(arc_start.yaw) / arc.curvature;
    const double centre_x = arc_start.x - radius_x;
    const double centre_y = arc_start.y - radius_y;
    for (int i = 1; i < poses; ++i) {
        const double rotated_x = turn_cos * radius_x - turn_sin * radius_y;
        radius_y = turn_sin * radius_x + turn_cos * radius_y;
        radius_x = rotated_x;
        const double yaw = wrap_angle(arc_start.yaw + i * turn);
        if (!visit(Pose{centre_x + radius_x, centre_y + radius_y, yaw})) return false;
    }
    return visit(arc_end);
}

/// Visits the start, every segment's end and, on arcs, poses at a spacing of at most `step` metres
/// (> 0), so that consecutive poses are joined by one arc or by one straight line of any length.
///
/// \param visit  bool(const Pose&); false ends the walk
/// \return whether every pose was visited and none said false; false for an unreachable curve
template <typename Visit>
bool for_each_pose(const Curve& curve, double step, Visit&& visit) {
    if (!curve.reachable()) return false;
    Pose pose = curve.start();
    if (!visit(pose)) return false;
    for (int i = 0; i < curve.segment_count(); ++i) {
        const Segment& part = curve.segment(i);
        const Pose next = advance(pose, part.curvature, part.length);
        const bool go_on =
            part.curvature == 0.0 ? visit(next) : for_each_arc_pose(pose, part, next, step, visit);
        if (!go_on) return false;
        pose = next;
    }
    return true;
}

/// What the curve solvers require: finite poses and a finite radius > 0.
inline bool solvable(const Pose& from, const Pose& to, double turning_radius) {
    return is_finite(from) && is_finite(to) && std::isfinite(turning_radius) &&
           turning_radius > 0.0;
}

/// Slack of the curve solvers in turning radii: a curve may miss its goal by this. It lies far
/// above rounding (1e-12 for maps of a kilometre) and far below what a robot can measure.
constexpr double kCurveSlack = 1e-9;

/// The vector between the centres of a turning circle at the start and one at the goal.
struct CentreOffset {
    double x;
    double y;

    double squared_distance() const { return x * x + y * y; }
    double angle() const { return std::atan2(y, x); }
};

/// A goal seen from a start at the origin that heads along +x, lengths in turning radii.
struct UnitGoal {
    double x;
    double y;
    double yaw;  ///< in [-pi, pi]
    double yaw_sin;
    double yaw_cos;

    UnitGoal(const Pose& from, const Pose& to, double turning_radius)
        : yaw(wrap_angle(to.yaw - from.yaw)), yaw_sin(std::sin(yaw)), yaw_cos(std::cos(yaw)) {
        const double dx = (to.x - from.x) / turning_radius;
        const double dy = (to.y - from.y) / turning_radius;
        const double from_sin = std::sin(from.yaw);
        const double from_cos = std::cos(from.yaw);
        x = from_cos * dx + from_sin * dy;
        y = from_cos * dy - from_sin * dx;
    }

    CentreOffset left_to_left() const { return {x - yaw_sin, y - (1.0 - yaw_cos)}; }
    CentreOffset left_to_right() const { return {x + yaw_sin, y - (1.0 + yaw_cos)}; }
    CentreOffset right_to_right() const { return {x + yaw_sin, y + (1.0 - yaw_cos)}; }
    CentreOffset right_to_left() const { return {x - yaw_sin, y + (1.0 + yaw_cos)}; }
};

/// Whether the curve's last pose is `target`: within 1e-7 turning radii and rad, and rounding.
inline bool reaches(const Curve& curve, const Pose& target, double turning_radius) {
    const Pose end = curve.end();
    const double size = std::abs(end.x) + std::abs(end.y) + curve.length();
    const double slack = 100.0 * kCurveSlack * turning_radius + 1e-14 * size;
    return std::hypot(end.x - target.x, end.y - target.y) <= slack &&
           std::abs(wrap_angle(end.yaw - target.yaw)) <= 100.0 * kCurveSlack;
}

}  // namespace planformer
