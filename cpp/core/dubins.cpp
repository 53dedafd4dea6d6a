#include "core/dubins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace planformer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One of the six words in turning radii; `turns` holds +1 (left), 0 or -1 (right) per segment.
struct Word {
    std::array<double, 3> turns{};
    std::array<double, 3> lengths{};
    double length = kInfinity;  ///< infinite: the word does not reach the goal
};

using Words = std::array<Word, 6>;

/// The same angle in [0, 2 pi].
double positive_angle(double angle) {
    const double wrapped = wrap_angle(angle);
    return wrapped < 0.0 ? wrapped + kTwoPi : wrapped;
}

Word make_word(std::array<double, 3> turns, std::array<double, 3> lengths) {
    return {turns, lengths, lengths[0] + lengths[1] + lengths[2]};
}

// The solvers below are written for a first turn to the left. The right-hand words are the mirror
// image: `side` is -1, and angles come in negated.

/// Left, straight, left. Both turns add up to the goal's yaw, or to a whole turn more when the
/// straight's heading `angle` is not between 0 and that yaw. Where rounding alone puts it outside,
/// the curve would gain a whole turn; it is moved back if that moves the end by no more than
/// kCurveSlack. (The other words need no such care: where a turn of theirs vanishes, this word or
/// its mirror image is as short.)
Word solve_csc_same(double side, double distance, double angle, double yaw) {
    const double total = positive_angle(yaw);
    double first = positive_angle(angle);
    if (first > total) {
        if ((first - total) * distance <= kCurveSlack) {
            first = total;
        } else if ((kTwoPi - first) * distance <= kCurveSlack) {
            first = 0.0;
        }
    }
    const double whole_turn = first > total ? kTwoPi : 0.0;
    return make_word({side, 0.0, side}, {first, distance, total - first + whole_turn});
}

/// Left, straight, right: the inner tangent of two circles, which exists from a distance of 2.
Word solve_csc_other(double side, const CentreOffset& centres, double yaw) {
    const double squared = centres.squared_distance();
    if (squared < 4.0 - kCurveSlack) return {};
    const double straight = std::sqrt(std::max(0.0, squared - 4.0));
    const double first = positive_angle(side * centres.angle() + std::atan2(2.0, straight));
    return make_word({side, 0.0, -side}, {first, straight, positive_angle(first - yaw)});
}

/// Left, right, left with a middle turn of more than pi (shorter ones are never optimal): a circle
/// that touches both others, which exists up to a distance of 4.
Word solve_ccc(double side, double distance, double angle, double yaw) {
    if (distance > 4.0) return {};
    const double half = kPi - std::asin(0.25 * distance);
    const double first = positive_angle(angle + half);
    const double last = positive_angle(yaw - first + 2.0 * half - kTwoPi);
    return make_word({side, -side, side}, {first, 2.0 * half, last});
}

Words solve(const UnitGoal& goal) {
    const CentreOffset left = goal.left_to_left();
    const CentreOffset right = goal.right_to_right();
    const double left_distance = std::sqrt(left.squared_distance());
    const double right_distance = std::sqrt(right.squared_distance());
    const double left_angle = left.angle();
    const double right_angle = -right.angle();
    return {solve_csc_same(1.0, left_distance, left_angle, goal.yaw),
            solve_csc_same(-1.0, right_distance, right_angle, -goal.yaw),
            solve_csc_other(1.0, goal.left_to_right(), goal.yaw),
            solve_csc_other(-1.0, goal.right_to_left(), -goal.yaw),
            solve_ccc(1.0, left_distance, left_angle, goal.yaw),
            solve_ccc(-1.0, right_distance, right_angle, -goal.yaw)};
}

Word& shortest(Words& words) {
    return *std::min_element(words.begin(), words.end(),
                             [](const Word& a, const Word& b) { return a.length < b.length; });
}

Curve build(const Word& word, const Pose& from, double turning_radius) {
    Curve curve(from);
    for (std::size_t i = 0; i < word.turns.size(); ++i) {
        curve.append({word.turns[i] / turning_radius, word.lengths[i] * turning_radius});
    }
    return curve;
}

}  // namespace

Curve dubins(const Pose& from, const Pose& to, double turning_radius) {
    if (!solvable(from, to, turning_radius)) return Curve::unreachable(from);
    Words words = solve(UnitGoal(from, to, turning_radius));
    for (std::size_t tried = 0; tried < words.size(); ++tried) {
        Word& best = shortest(words);
        if (!std::isfinite(best.length)) break;
        const Curve curve = build(best, from, turning_radius);
        if (reaches(curve, to, turning_radius)) return curve;
        best.length = kInfinity;
    }
    return Curve::unreachable(from);
}

double dubins_length(const Pose& from, const Pose& to, double turning_radius) {
    if (!solvable(from, to, turning_radius)) return kInfinity;
    Words words = solve(UnitGoal(from, to, turning_radius));
    const double length = shortest(words).length * turning_radius;
    return std::isfinite(length) ? length : kInfinity;
}

}  // namespace planformer
