#include "core/reeds_shepp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/dubins.hpp"

namespace planformer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kQuarter = 0.5 * kPi;

using Turns = std::array<double, 5>;    // +1 left, 0 straight, -1 right
using Lengths = std::array<double, 5>;  // signed, in turning radii; zero past the word's end

constexpr Turns kLSL{1, 0, 1};
constexpr Turns kLSR{1, 0, -1};
constexpr Turns kLRL{1, -1, 1};
constexpr Turns kLRLR{1, -1, 1, -1};
constexpr Turns kLRSL{1, -1, 0, 1};
constexpr Turns kLRSR{1, -1, 0, -1};
constexpr Turns kLRSLR{1, -1, 0, 1, -1};

/// A circle at the start and one at the goal: distance and direction from the first centre to the
/// second, and, from a distance of 2 on, their inner tangent's length and its angle to that
/// direction.
struct Centres {
    double distance;
    double angle;
    double tangent;
    double tangent_angle;

    explicit Centres(const CentreOffset& offset) : angle(offset.angle()) {
        const double squared = offset.squared_distance();
        distance = std::sqrt(squared);
        tangent = std::sqrt(std::max(0.0, squared - 4.0));
        tangent_angle = std::atan2(2.0, tangent);
    }

    /// The same pair of circles with the plane mirrored (-1) or as it is (+1), seen from a heading.
    Centres seen(double side, double heading) const {
        Centres other = *this;
        other.angle = side * angle + heading;
        return other;
    }
};

/// How a word was found: `side` -1 exchanges left and right, `backward` drives it from its end.
struct View {
    double side;
    bool backward;
};

/// The shortest word offered so far.
struct Best {
    double length = kInfinity;
    const Turns* turns = nullptr;
    Lengths lengths{};
    View view{1.0, false};

    void offer(const View& offered_view, const Turns& offered_turns, const Lengths& offered) {
        double total = 0.0;
        for (const double part : offered) total += std::abs(part);
        if (!(total < length)) return;
        *this = {total, &offered_turns, offered, offered_view};
    }
};

// The paper solves each word for given signs and accepts it only if all signs come out as assumed;
// rounding at a border can then reject both neighbours. Here every solution counts, whatever its
// signs: turns are taken in [-pi, pi], a negative length is driven in reverse, and the curve
// reaches the goal either way. It is at least as long as the best of the 48 words, which are among
// these solutions, so that their minimum is the shortest length. All words start with a left turn
// and `View` mirrors them. `same` is the pair of left circles, `other` the start's left and the
// goal's right circle.

/// C S C on two left circles (8.1); both directions of the straight.
void offer_lsl(Best& best, const View& view, const Centres& same, double yaw) {
    for (const double sign : {1.0, -1.0}) {
        const double first = wrap_angle(sign > 0.0 ? same.angle : same.angle + kPi);
        best.offer(view, kLSL, {first, sign * same.distance, wrap_angle(yaw - first)});
    }
}

/// C S C on a left and a right circle (8.2).
void offer_lsr(Best& best, const View& view, const Centres& other, double yaw) {
    if (other.distance < 2.0 - kCurveSlack) return;
    for (const double sign : {1.0, -1.0}) {
        const double tilt = sign > 0.0 ? other.tangent_angle : kPi - other.tangent_angle;
        const double first = wrap_angle(other.angle + tilt);
        best.offer(view, kLSR, {first, sign * other.tangent, wrap_angle(first - yaw)});
    }
}

/// C|C|C, C|CC and CC|C (8.3, 8.4): a circle that touches both, on either side of them.
void offer_lrl(Best& best, const View& view, const Centres& same, double yaw) {
    if (same.distance > 4.0) return;
    const double half = std::asin(0.25 * same.distance);
    for (const double sign : {1.0, -1.0}) {
        const double first = wrap_angle(same.angle + (sign > 0.0 ? half : kPi - half));
        const double middle = 2.0 * sign * half;
        best.offer(view, kLRL, {first, middle, wrap_angle(yaw - first + middle)});
    }
}

/// CCu|CuC (8.7).
void offer_ccu_cuc(Best& best, const View& view, const Centres& other, double yaw) {
    if (other.distance > 2.0 + kCurveSlack) return;
    const double arc = std::acos(std::min(1.0, 0.5 + 0.25 * other.distance));
    for (const double middle : {arc, -arc}) {
        const double first = wrap_angle(other.angle + middle + kQuarter);
        best.offer(view, kLRLR, {first, middle, -middle, wrap_angle(first - 2.0 * middle - yaw)});
    }
}

/// C|CuCu|C (8.8); its middle turns are at most pi / 2 each.
void offer_c_cucu_c(Best& best, const View& view, const Centres& other, double yaw) {
    const double squared = other.distance * other.distance;
    if (squared < 4.0 - kCurveSlack || squared > 20.0 + kCurveSlack) return;
    const double cosine = std::min(1.0, 1.25 - squared / 16.0);
    const double arc = std::acos(cosine);
    const double tilt = std::atan2(std::sqrt(1.0 - cosine * cosine), 2.0 - cosine);
    for (const double sign : {1.0, -1.0}) {
        const double first = wrap_angle(other.angle + kQuarter - sign * tilt);
        const double middle = sign * arc;
        best.offer(view, kLRLR, {first, middle, middle, wrap_angle(first - yaw)});
    }
}

/// C|C(pi/2)SC (8.9, 8.10); seen from the goal, CSC(pi/2)|C.
void offer_ccsc(Best& best, const View& view, const Centres& same, const Centres& other,
                double yaw) {
    for (const double sign : {1.0, -1.0}) {
        const double cusp = -sign * kQuarter;
        if (same.distance >= 2.0 - kCurveSlack) {
            const double first = wrap_angle(same.angle + kQuarter + sign * same.tangent_angle);
            best.offer(view, kLRSL,
                       {first, cusp, sign * (2.0 - same.tangent), wrap_angle(yaw - first + cusp)});
        }
        const double first = wrap_angle(other.angle + kQuarter);
        best.offer(view, kLRSR,
                   {first, cusp, sign * (2.0 - other.distance), wrap_angle(first - cusp - yaw)});
    }
}

/// C|C(pi/2)SC(pi/2)|C (8.11).
void offer_ccscc(Best& best, const View& view, const Centres& other, double yaw) {
    if (other.distance < 2.0 - kCurveSlack) return;
    for (const double sign : {1.0, -1.0}) {
        const double cusp = -sign * kQuarter;
        const double first = wrap_angle(other.angle + kQuarter + sign * other.tangent_angle);
        best.offer(view, kLRSLR,
                   {first, cusp, sign * (4.0 - other.tangent), cusp, wrap_angle(first - yaw)});
    }
}

Best solve(const UnitGoal& goal) {
    const Centres left(goal.left_to_left());
    const Centres right(goal.right_to_right());
    const Centres left_right(goal.left_to_right());
    const Centres right_left(goal.right_to_left());
    Best best;
    for (const double side : {1.0, -1.0}) {
        const double yaw = side * goal.yaw;
        const View view{side, false};
        const Centres same = (side > 0.0 ? left : right).seen(side, 0.0);
        const Centres other = (side > 0.0 ? left_right : right_left).seen(side, 0.0);
        offer_lsl(best, view, same, yaw);
        offer_lsr(best, view, other, yaw);
        offer_lrl(best, view, same, yaw);
        offer_ccu_cuc(best, view, other, yaw);
        offer_c_cucu_c(best, view, other, yaw);
        offer_ccscc(best, view, other, yaw);
        offer_ccsc(best, view, same, other, yaw);
        const Centres first_of_goal = (side > 0.0 ? right_left : left_right).seen(-side, yaw);
        offer_ccsc(best, View{side, true}, same.seen(-1.0, yaw), first_of_goal, yaw);
    }
    return best;
}

Curve build(const Best& best, const Pose& from, double turning_radius) {
    Curve curve(from);
    for (std::size_t i = 0; i < best.lengths.size(); ++i) {
        const std::size_t at = best.view.backward ? best.lengths.size() - 1 - i : i;
        const double curvature = best.view.side * (*best.turns)[at] / turning_radius;
        curve.append({curvature, best.lengths[at] * turning_radius});
    }
    return curve;
}

/// The same curve driven the other way, from its last pose.
Curve reversed(const Curve& curve, const Pose& end) {
    Curve back(end);
    for (int i = curve.segment_count() - 1; i >= 0; --i) {
        back.append({curve.segment(i).curvature, -curve.segment(i).length});
    }
    return back;
}

/// Both directions of travel between two poses are solved as one, for exact symmetry.
bool in_order(const Pose& a, const Pose& b) {
    return std::tie(a.x, a.y, a.yaw) <= std::tie(b.x, b.y, b.yaw);
}

Curve solve_in_order(const Pose& from, const Pose& to, double turning_radius) {
    const Best best = solve(UnitGoal(from, to, turning_radius));
    if (!std::isfinite(best.length)) return Curve::unreachable(from);
    return build(best, from, turning_radius);
}

}  // namespace

Curve reeds_shepp(const Pose& from, const Pose& to, double turning_radius) {
    if (!solvable(from, to, turning_radius)) return Curve::unreachable(from);
    const Curve curve = in_order(from, to)
                            ? solve_in_order(from, to, turning_radius)
                            : reversed(solve_in_order(to, from, turning_radius), from);
    return reaches(curve, to, turning_radius) ? curve : dubins(from, to, turning_radius);
}

double reeds_shepp_length(const Pose& from, const Pose& to, double turning_radius) {
    if (!solvable(from, to, turning_radius)) return kInfinity;
    const bool ordered = in_order(from, to);
    const UnitGoal goal(ordered ? from : to, ordered ? to : from, turning_radius);
    return solve(goal).length * turning_radius;
}

}  // namespace planformer
