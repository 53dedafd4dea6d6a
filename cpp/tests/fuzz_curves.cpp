/// Fuzz test of the car's curves: `fuzz_curves PAIRS [SEED]`. Ends with 0 when every pair passes,
/// with 1 and the offending pair otherwise.
///
/// Lengths are checked to be shortest in three ways: against a second derivation of Dubins' words
/// from circles and tangents; against brute force over the first turn (one pair in 1000); and
/// against one arbitrary piece of motion: D(a, c) <= |s| + D(b, c) for every b that a piece s leads
/// to from a. A length that is reached by a curve and holds that for all pieces is at most that of
/// any curve of pieces, hence shortest, for Reeds-Shepp curves too.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

#include "core/dubins.hpp"
#include "core/reeds_shepp.hpp"

namespace {

using namespace planformer;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Pair {
    Pose from;
    Pose to;
    double radius;
};

[[noreturn]] void fail(const Pair& pair, const char* what, double value, double limit) {
    std::printf("FAILED: %s: %.17g, limit %.17g\n", what, value, limit);
    std::printf("from {%.17g, %.17g, %.17g}\n", pair.from.x, pair.from.y, pair.from.yaw);
    std::printf("to {%.17g, %.17g, %.17g}\n", pair.to.x, pair.to.y, pair.to.yaw);
    std::printf("turning radius %.17g\n", pair.radius);
    std::exit(1);
}

void require_at_most(double value, double limit, const Pair& pair, const char* what) {
    if (!(value <= limit)) fail(pair, what, value, limit);
}

// ---- pairs ------------------------------------------------------------------------------------

class Generator {
public:
    explicit Generator(unsigned long long seed) : bits_(seed) {}

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(bits_);
    }
    int pick(int count) { return static_cast<int>(bits_() % static_cast<unsigned>(count)); }
    double side() { return pick(2) ? 1.0 : -1.0; }
    double angle() { return uniform(-kPi, kPi); }
    double power(double low, double high) { return std::pow(10.0, uniform(low, high)); }
    /// Zero, or of either sign and of any magnitude from rounding to visible.
    double tiny() { return pick(4) ? side() * power(-17.0, -3.0) : 0.0; }

    Pair pair() {
        constexpr int kKinds = 7;
        Pair made{{uniform(-20.0, 20.0), uniform(-20.0, 20.0), angle()}, {}, power(-1.0, 1.0)};
        switch (pick(kKinds)) {
            case 0: made.to = {uniform(-20.0, 20.0), uniform(-20.0, 20.0), angle()}; break;
            case 1: made.to = close(made); break;
            case 2: made.to = aligned(made); break;
            case 3: made.to = with_special_centres(made); break;
            case 4: on_grid(made); break;
            case 5: made.to = {uniform(-20.0, 20.0), uniform(-20.0, 20.0), made.from.yaw}; break;
            default: made.to = driven(made); break;
        }
        if (pick(8) == 0) shift(made);
        return made;
    }

    /// A piece of one curve; reverse only where the car can.
    Segment piece(double radius, bool reverse) {
        const double curvature = (pick(3) - 1) / radius;
        const double length = radius * (pick(2) ? uniform(0.0, kTwoPi) : power(-12.0, 0.0));
        return {curvature, reverse ? side() * length : length};
    }

private:
    Pose close(const Pair& pair) {
        const double distance = pair.radius * power(-12.0, std::log10(4.0));
        const double direction = angle();
        const double yaw = pick(2) ? angle() : wrap_angle(pair.from.yaw + tiny());
        return {pair.from.x + distance * std::cos(direction),
                pair.from.y + distance * std::sin(direction), yaw};
    }

    Pose aligned(const Pair& pair) {
        const Pose on_line = advance(pair.from, 0.0, side() * power(-9.0, 1.5));
        const double turned = pick(2) ? 0.0 : kPi;
        return {on_line.x + tiny(), on_line.y + tiny(), wrap_angle(on_line.yaw + turned + tiny())};
    }

    /// Centres of turning circles at, or next to, the distances where words begin and end.
    Pose with_special_centres(const Pair& pair) {
        const std::array<double, 5> special{0.0, 2.0, 4.0, std::sqrt(20.0), 6.0};
        const double distance = special[static_cast<std::size_t>(pick(5))] + tiny();
        const double direction = pick(2) ? angle() : pair.from.yaw + pick(4) * 0.5 * kPi;
        const double yaw = pick(2) ? angle() : wrap_angle(pair.from.yaw + pick(4) * 0.5 * kPi);
        const double first = side() * pair.radius;
        const double last = side() * pair.radius;
        return {pair.from.x - first * std::sin(pair.from.yaw) + last * std::sin(yaw) +
                    distance * pair.radius * std::cos(direction),
                pair.from.y + first * std::cos(pair.from.yaw) - last * std::cos(yaw) +
                    distance * pair.radius * std::sin(direction),
                yaw};
    }

    /// Both poses on multiples of the radius and of a right angle, give or take a little.
    void on_grid(Pair& pair) {
        for (Pose* pose : {&pair.from, &pair.to}) {
            *pose = {pair.radius * (pick(9) - 4) + tiny(), pair.radius * (pick(9) - 4) + tiny(),
                     wrap_angle(pick(4) * 0.5 * kPi + tiny())};
        }
    }

    /// A goal that a few pieces lead to, as the states along another curve.
    Pose driven(const Pair& pair) {
        Pose pose = pair.from;
        const bool reverse = pick(2);
        for (int i = pick(4); i >= 0; --i) {
            const Segment part = piece(pair.radius, reverse);
            pose = advance(pose, part.curvature, part.length);
        }
        return pose;
    }

    void shift(Pair& pair) {
        const double dx = side() * power(0.0, 3.0);
        const double dy = side() * power(0.0, 3.0);
        for (Pose* pose : {&pair.from, &pair.to}) {
            pose->x += dx;
            pose->y += dy;
        }
    }

    std::mt19937_64 bits_;
};

/// About ten times the rounding of a pair's coordinates [m].
double rounding(const Pair& pair) {
    return 1e-15 * std::max({std::abs(pair.from.x), std::abs(pair.from.y), std::abs(pair.to.x),
                             std::abs(pair.to.y), pair.radius});
}

/// Slack for comparing lengths [m]. Where words meet, and for sideways motion, a length changes
/// with the root of the offset, so that rounding of coordinates shows as its root.
double length_slack(const Pair& pair) {
    return pair.radius * (1e-8 + 20.0 * std::sqrt(rounding(pair) / pair.radius));
}

// ---- second derivation of Dubins' words ---------------------------------------------------------

struct Vec {
    double x;
    double y;
};

Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y}; }
Vec operator*(double s, Vec a) { return {s * a.x, s * a.y}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y; }
Vec left_of(Vec a) { return {-a.y, a.x}; }
Vec position(const Pose& pose) { return {pose.x, pose.y}; }
Vec heading(const Pose& pose) { return {std::cos(pose.yaw), std::sin(pose.yaw)}; }
Vec centre(const Pose& pose, double side, double radius) {
    return position(pose) + side * radius * left_of(heading(pose));
}

/// Angle from one vector to another when turning to `side`, in [0, 2 pi].
double turn_between(Vec a, Vec b, double side) {
    const double angle = side * std::atan2(dot(left_of(a), b), dot(a, b));
    return angle < 0.0 ? angle + kTwoPi : angle;
}

/// Length of turn, straight, turn along the common tangent of two circles.
double tangent_word(const Pair& pair, double first, double last) {
    const Vec between = centre(pair.to, last, pair.radius) - centre(pair.from, first, pair.radius);
    const double offset = (last - first) * pair.radius;
    const double squared = dot(between, between);
    const double straight = std::sqrt(squared - offset * offset);
    if (!(squared > 0.0) || std::isnan(straight)) return kInfinity;
    const Vec along = (1.0 / squared) * (straight * between - offset * left_of(between));
    return pair.radius * (turn_between(heading(pair.from), along, first) +
                          turn_between(along, heading(pair.to), last)) +
           straight;
}

/// Length of three turns; the middle circle touches the other two on the given flank.
double touching_word(const Pair& pair, double side, double flank) {
    const Vec a = centre(pair.from, side, pair.radius);
    const Vec b = centre(pair.to, side, pair.radius);
    const double distance = std::sqrt(dot(b - a, b - a));
    const double height = std::sqrt(4.0 * pair.radius * pair.radius - 0.25 * distance * distance);
    if (!(distance > 0.0) || std::isnan(height)) return kInfinity;
    const Vec middle = 0.5 * (a + b) + (flank * height / distance) * left_of(b - a);
    return pair.radius * (turn_between(position(pair.from) - a, middle - a, side) +
                          turn_between(a - middle, b - middle, -side) +
                          turn_between(middle - b, position(pair.to) - b, side));
}

double second_derivation(const Pair& pair) {
    double best = kInfinity;
    for (const double side : {1.0, -1.0}) {
        for (const double other : {1.0, -1.0}) {
            best =
                std::min({best, tangent_word(pair, side, other), touching_word(pair, side, other)});
        }
    }
    return best;
}

// ---- brute force over the first turn ------------------------------------------------------------

/// How far a straight from `pose` passes from the goal's circle on side `last`.
double straight_gap(const Pair& pair, const Pose& pose, double last) {
    const Vec to_centre = centre(pair.to, last, pair.radius) - position(pose);
    return dot(to_centre, left_of(heading(pose))) - last * pair.radius;
}

/// How far the next circle is from touching the goal's circle on side `first`.
double circle_gap(const Pair& pair, const Pose& pose, double first) {
    const Vec between = centre(pair.to, first, pair.radius) - centre(pose, -first, pair.radius);
    return dot(between, between) - 4.0 * pair.radius * pair.radius;
}

double finish_straight(const Pair& pair, const Pose& pose, double last) {
    const double straight = dot(centre(pair.to, last, pair.radius) - position(pose), heading(pose));
    if (straight < 0.0) return kInfinity;
    return straight + pair.radius * turn_between(heading(pose), heading(pair.to), last);
}

double finish_circle(const Pair& pair, const Pose& pose, double first) {
    const Vec middle = centre(pose, -first, pair.radius);
    const Vec last = centre(pair.to, first, pair.radius);
    return pair.radius * (turn_between(position(pose) - middle, last - middle, -first) +
                          turn_between(middle - last, position(pair.to) - last, first));
}

/// The shortest curve that starts with a turn to `first` of an angle where `gap` changes its sign.
template <typename Gap, typename Finish>
double scan_first_turn(const Pair& pair, double first, double side, Gap gap, Finish finish) {
    constexpr int kTurns = 360;
    const auto pose_after = [&](double turn) {
        return advance(pair.from, first / pair.radius, turn * pair.radius);
    };
    double best = kInfinity;
    double low_gap = gap(pair, pair.from, side);
    for (int i = 0; i < kTurns; ++i) {
        double low = kTwoPi * i / kTurns;
        double high = kTwoPi * (i + 1) / kTurns;
        const double high_gap = gap(pair, pose_after(high), side);
        if (low_gap * high_gap < 0.0) {
            for (int step = 0; step < 60; ++step) {
                const double middle = 0.5 * (low + high);
                const double middle_gap = gap(pair, pose_after(middle), side);
                (middle_gap * high_gap < 0.0 ? low : high) = middle;
            }
            best = std::min(best, low * pair.radius + finish(pair, pose_after(low), side));
        }
        low_gap = high_gap;
    }
    return best;
}

double brute_force(const Pair& pair) {
    double best = kInfinity;
    for (const double first : {1.0, -1.0}) {
        for (const double last : {1.0, -1.0}) {
            best =
                std::min(best, scan_first_turn(pair, first, last, straight_gap, finish_straight));
        }
        best = std::min(best, scan_first_turn(pair, first, first, circle_gap, finish_circle));
    }
    return best;
}

// ---- checks -------------------------------------------------------------------------------------

using Solver = Curve (*)(const Pose&, const Pose&, double);
using Length = double (*)(const Pose&, const Pose&, double);

void check_end(const Curve& curve, const Pair& pair) {
    const Pose end = curve.end();
    const double miss = std::hypot(end.x - pair.to.x, end.y - pair.to.y);
    const double euclid = std::hypot(pair.to.x - pair.from.x, pair.to.y - pair.from.y);
    require_at_most(curve.length(), 1e9, pair, "length is finite");
    require_at_most(miss, 1e-6, pair, "distance of the end from the goal");
    require_at_most(std::abs(wrap_angle(end.yaw - pair.to.yaw)), 1e-6, pair, "yaw at the goal");
    require_at_most(euclid, curve.length() + 1e-7 * pair.radius, pair, "straight-line distance");
}

/// A solver's answer for one pair.
struct Answer {
    const Pair& pair;
    Length measure;
    double length;
};

/// The length stays within the bound that a way to `reached` gives. A goal within the solvers'
/// slack of `reached` may miss the shorter curve that `reached` itself has.
void check_bound(const Answer& answer, const Pose& reached, double bound, const char* what) {
    const Pair& pair = answer.pair;
    const double limit = bound + length_slack(pair);
    if (answer.length <= limit) return;
    require_at_most(answer.measure(pair.from, reached, pair.radius), limit, pair, what);
}

void check_piece(const Answer& answer, Solver solve, const Segment& piece) {
    const Pair& pair = answer.pair;
    const Pose moved = advance(pair.from, piece.curvature, piece.length);
    const Curve rest = solve(moved, pair.to, pair.radius);
    check_bound(answer, rest.end(), std::abs(piece.length) + rest.length(),
                "longer than a piece and the curve from its end");
}

/// Rounding of a goal that the curve reaches must not make the way longer, by a whole turn say.
void check_rounded_goal(const Answer& answer, const Pose& end, Generator& random) {
    const double offset = 2.0 * rounding(answer.pair);
    const Pose rounded{end.x + random.uniform(-offset, offset),
                       end.y + random.uniform(-offset, offset),
                       wrap_angle(end.yaw + random.uniform(-2e-15, 2e-15))};
    require_at_most(answer.measure(answer.pair.from, rounded, answer.pair.radius),
                    answer.length + length_slack(answer.pair), answer.pair,
                    "length after rounding the goal");
}

void check_motion(const Pose& a, const Pose& b, double driven, const Pair& pair) {
    const double slack = 1e-9 * pair.radius + 1e-12;
    require_at_most(std::hypot(b.x - a.x, b.y - a.y), driven + slack, pair, "jump in position");
    require_at_most(std::abs(wrap_angle(b.yaw - a.yaw)), driven / pair.radius + 1e-9, pair,
                    "jump in yaw");
}

void check_continuous(const Curve& curve, const Pair& pair, Generator& random) {
    const double s = random.uniform(0.0, curve.length());
    const double ahead = random.uniform(0.0, 0.2 * pair.radius);
    check_motion(curve.pose_at(s), curve.pose_at(s + ahead), ahead, pair);
    check_motion(curve.pose_at(curve.length() - 1e-9), curve.end(), 1e-9, pair);
}

/// Poses along arcs keep the step; they start and end where the curve does.
void check_walk(const Curve& curve, const Pair& pair, double step) {
    Pose last = curve.start();
    double bends = 0.0;
    const bool complete = for_each_pose(curve, step, [&](const Pose& pose) {
        const double turned = std::abs(wrap_angle(pose.yaw - last.yaw)) * pair.radius;
        if (turned > 1e-9) check_motion(last, pose, step * (1.0 + 1e-9), pair);
        bends += turned;
        last = pose;
        return true;
    });
    require_at_most(complete ? 0.0 : 1.0, 0.0, pair, "walk along the curve ended early");
    check_motion(last, curve.end(), 0.0, pair);
    require_at_most(bends, curve.length() * (1.0 + 1e-9) + 1e-9, pair, "length of the arcs");
}

/// What holds for either solver; `thorough` adds a walk along the curve.
Answer check_curve(Solver solve, Length measure, const Pair& pair, Generator& random,
                   bool thorough) {
    const Curve curve = solve(pair.from, pair.to, pair.radius);
    check_end(curve, pair);
    check_continuous(curve, pair, random);
    if (thorough) check_walk(curve, pair, 0.1 * pair.radius);
    const double apart = std::abs(measure(pair.from, pair.to, pair.radius) - curve.length());
    require_at_most(apart, 1e-12 * (pair.radius + curve.length()), pair, "length on its own");
    const Answer answer{pair, measure, curve.length()};
    check_rounded_goal(answer, curve.end(), random);
    check_piece(answer, solve, random.piece(pair.radius, solve == reeds_shepp));
    return answer;
}

void check_dubins(const Pair& pair, Generator& random, bool thorough) {
    const Answer answer = check_curve(dubins, dubins_length, pair, random, thorough);
    check_bound(answer, pair.to, second_derivation(pair), "longer than another word");
    if (thorough) check_bound(answer, pair.to, brute_force(pair), "longer than brute force");
}

void check_reeds_shepp(const Pair& pair, Generator& random, bool thorough) {
    const Answer answer = check_curve(reeds_shepp, reeds_shepp_length, pair, random, thorough);
    const double back = reeds_shepp_length(pair.to, pair.from, pair.radius);
    require_at_most(std::abs(back - answer.length), 1e-12 * (pair.radius + back), pair,
                    "the way back differs");
    const double forward = std::min(dubins_length(pair.from, pair.to, pair.radius),
                                    dubins_length(pair.to, pair.from, pair.radius));
    require_at_most(answer.length, forward + 1e-8 * pair.radius + 1e-12 * forward, pair,
                    "longer than Dubins");
}

/// Poses no planner should ask for have an answer too.
void check_special(Solver solve) {
    const Pair same{{3.0, -2.0, 1.0}, {3.0, -2.0, 1.0}, 0.5};
    require_at_most(solve(same.from, same.to, same.radius).length(), 0.0, same, "identical poses");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {nan, kInfinity, -kInfinity, 1e300}) {
        for (const Pose& pose : {Pose{bad, 0.0, 0.0}, Pose{0.0, bad, 0.0}, Pose{0.0, 0.0, bad}}) {
            const Pair pair{{}, pose, 0.5};
            const double length = solve(pair.from, pair.to, pair.radius).length();
            if (std::isnan(length) || std::isnan(solve(pose, {}, 0.5).length())) {
                fail(pair, "length is a number", length, 0.0);
            }
        }
    }
    for (const double radius : {0.0, -1.0, nan, kInfinity}) {
        const Pair pair{{}, {1.0, 1.0, 1.0}, radius};
        if (solve(pair.from, pair.to, radius).reachable()) fail(pair, "reachable", 1.0, 0.0);
    }
}

}  // namespace

int main(int argc, char** argv) {
    const long long pairs = argc > 1 ? std::atoll(argv[1]) : 1000000;
    const unsigned long long seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
    check_special(dubins);
    check_special(reeds_shepp);
    Generator random(seed);
    for (long long i = 0; i < pairs; ++i) {
        const Pair pair = random.pair();
        const bool thorough = i % 1000 == 0;
        check_dubins(pair, random, thorough);
        check_reeds_shepp(pair, random, thorough);
    }
    std::printf("%lld pairs passed\n", pairs);
    return 0;
}
