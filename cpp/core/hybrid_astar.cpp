#include "core/hybrid_astar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <stdexcept>
#include <utility>

#include "core/dubins.hpp"
#include "core/reeds_shepp.hpp"
#include "core/validity.hpp"
#include "core/wavefront.hpp"

namespace planformer {
namespace {

constexpr double kCellSide = 0.25;  ///< of a search cell, in turning radii
constexpr double kStep = 0.4;       ///< driven between two poses, in turning radii; leaves the cell
constexpr double kMostCells = 10'000;  ///< along a side; more would take gigabytes
constexpr std::size_t kYawBins = 72;
constexpr std::array<double, 5> kCurvatures = {-1.0, -0.5, 0.0, 0.5, 1.0};  ///< times 1 / radius
constexpr std::size_t kFewCells = 5'000;  ///< explored from the goal before the search begins
constexpr double kSlack = 1.02;           ///< open poses that gain less are not worth expanding
/// An 8-connected distance exceeds the straight one by at most 1 / 0.9239.
constexpr double kOctileShare = 0.9238795325112867;
constexpr std::int32_t kNone = -1;

struct Node {
    Pose pose;
    double cost;          ///< length driven from the start [m]
    Segment step;         ///< from the parent
    std::int32_t parent;  ///< kNone for the start
    std::int32_t* best;   ///< the best node in this one's cell
};

/// The best node by cell of position and heading; a position's cells are made when first visited.
class Cells {
public:
    Cells(const FreeSpace& space, double side)
        : side_(side),
          rows_(cells_along(space.extent_y())),
          cols_(cells_along(space.extent_x())),
          bins_(static_cast<std::size_t>(rows_) * cols_) {}

    std::int32_t* best_at(const Pose& pose) {
        const int row = std::clamp(static_cast<int>(pose.y / side_), 0, rows_ - 1);
        const int col = std::clamp(static_cast<int>(pose.x / side_), 0, cols_ - 1);
        auto& bins = bins_[static_cast<std::size_t>(row) * cols_ + col];
        if (!bins) {
            bins = std::make_unique<YawBins>();
            bins->fill(kNone);
        }
        const double turn = (wrap_angle(pose.yaw) + kPi) / kTwoPi;
        return &(*bins)[std::min(static_cast<std::size_t>(turn * kYawBins), kYawBins - 1)];
    }

private:
    using YawBins = std::array<std::int32_t, kYawBins>;

    int cells_along(double extent) const {
        const double cells = extent / side_ + 1.0;
        if (cells <= kMostCells) return static_cast<int>(cells);
        throw std::invalid_argument("the turning radius is too small for a map of this size");
    }

    double side_;  ///< [m]
    int rows_;
    int cols_;
    std::vector<std::unique_ptr<YawBins>> bins_;
};

/// Calls visit(curve) for each step that the car can make from a pose.
template <typename Visit>
void for_each_step(const CarTurning& car, const Pose& from, Visit&& visit) {
    for (const double share : kCurvatures) {
        for (const double direction : {1.0, -1.0}) {
            if (direction < 0.0 && !car.reverse) continue;
            Curve curve(from);
            curve.append({share / car.radius, direction * kStep * car.radius});
            visit(curve);
        }
    }
}

/// Whether a short search from a pose exhausts all that the car can reach and stays far from a
/// target.
bool is_boxed_in(const FreeSpace& space, const CarTurning& car, const Pose& pose,
                 const Pose& target) {
    const double near = 2.0 * car.radius;
    Cells cells(space, kCellSide * car.radius);
    std::vector<Pose> reached{pose};
    *cells.best_at(pose) = 0;
    for (std::size_t i = 0; i < reached.size(); ++i) {
        const Pose from = reached[i];
        const bool is_near = std::hypot(from.x - target.x, from.y - target.y) < near;
        if (is_near || reached.size() > kFewCells) return false;
        for_each_step(car, from, [&](const Curve& curve) {
            const Pose end = curve.end();
            if (!space.is_free(end.x, end.y)) return;
            std::int32_t* const best = cells.best_at(end);
            if (*best != kNone || !curve_is_free(space, curve, end)) return;
            *best = 0;
            reached.push_back(end);
        });
    }
    return true;
}

class Search {
public:
    Search(const FreeSpace& space, const CarTurning& car, const Pose& start, const Pose& goal)
        : space_(space),
          car_(car),
          goal_(goal),
          cells_(space, kCellSide * car.radius),
          to_goal_(wavefront(space, grid_row(goal), grid_col(goal))) {
        open_pose({start, 0.0, Segment{}, kNone, cells_.best_at(start)});
    }

    std::vector<Pose> run(std::size_t max_expansions) {
        for (std::size_t i = 0; i < max_expansions && !open_.empty(); ++i) {
            const auto [bound, index] = open_.top();
            if (bound * kSlack >= best_length_) break;
            open_.pop();
            // A shorter way into the cell has made this pose obsolete.
            if (*nodes_[index].best == index) expand(index);
        }
        return best_end_ == kNone ? std::vector<Pose>{} : path();
    }

private:
    using Entry = std::pair<double, std::int32_t>;  ///< lower bound of the path's length, node

    void expand(std::int32_t index) {
        try_goal(index);
        const Pose from = nodes_[index].pose;
        for_each_step(car_, from, [&](const Curve& curve) { drive(index, curve); });
    }

    /// Joins a pose with the goal by the shortest curve if that is free and an improvement.
    void try_goal(std::int32_t index) {
        const Node& node = nodes_[index];
        const Curve curve = curve_to_goal(node.pose);
        const double length = node.cost + curve.length();
        if (length < best_length_ && curve_is_free(space_, curve, goal_)) {
            best_length_ = length;
            best_end_ = index;
        }
    }

    void drive(std::int32_t index, const Curve& curve) {
        const Pose end = curve.end();
        if (!space_.is_free(end.x, end.y)) return;
        const double cost = nodes_[index].cost + curve.length();
        std::int32_t* const best = cells_.best_at(end);
        if (*best != kNone && nodes_[*best].cost <= cost) return;
        if (curve_is_free(space_, curve, end)) {
            open_pose({end, cost, curve.segment(0), index, best});
        }
    }

    void open_pose(const Node& node) {
        const double bound = node.cost + least_to_goal(node.pose);
        if (!(bound * kSlack < best_length_)) return;
        const auto index = static_cast<std::int32_t>(nodes_.size());
        nodes_.push_back(node);
        *node.best = index;
        open_.emplace(bound, index);
    }

    /// A lower bound of the way to the goal: round the obstacles, or with the turns.
    double least_to_goal(const Pose& pose) const {
        const std::size_t cell =
            static_cast<std::size_t>(grid_row(pose)) * space_.width + grid_col(pose);
        // Up to a cell's diagonal at either end is not on the way between the cells' centres.
        const double round = (kOctileShare * to_goal_[cell] - 2.0) * space_.resolution;
        return std::max(round, curve_length_to_goal(pose));
    }

    Curve curve_to_goal(const Pose& pose) const {
        return car_.reverse ? reeds_shepp(pose, goal_, car_.radius)
                            : dubins(pose, goal_, car_.radius);
    }

    double curve_length_to_goal(const Pose& pose) const {
        return car_.reverse ? reeds_shepp_length(pose, goal_, car_.radius)
                            : dubins_length(pose, goal_, car_.radius);
    }

    std::vector<Pose> path() const {
        std::vector<std::int32_t> chain;
        for (std::int32_t i = best_end_; i != kNone; i = nodes_[i].parent) chain.push_back(i);
        const double spacing = kArcStep * space_.resolution;
        std::vector<Pose> poses{nodes_[chain.back()].pose};
        for (auto i = std::next(chain.rbegin()); i != chain.rend(); ++i) {
            const Node& node = nodes_[*i];
            Curve curve(nodes_[node.parent].pose);
            curve.append(node.step);
            append_motion(curve, node.pose, spacing, &poses);
        }
        append_motion(curve_to_goal(nodes_[best_end_].pose), goal_, spacing, &poses);
        return poses;
    }

    int grid_row(const Pose& pose) const {
        return std::clamp(static_cast<int>(pose.y / space_.resolution), 0, space_.height - 1);
    }
    int grid_col(const Pose& pose) const {
        return std::clamp(static_cast<int>(pose.x / space_.resolution), 0, space_.width - 1);
    }

    const FreeSpace& space_;
    const CarTurning car_;
    const Pose goal_;
    Cells cells_;
    std::vector<float> to_goal_;  ///< 8-connected distance [grid cells]
    std::vector<Node> nodes_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open_;
    double best_length_ = std::numeric_limits<double>::infinity();
    std::int32_t best_end_ = kNone;
};

}  // namespace

std::vector<Pose> hybrid_astar(const FreeSpace& space, const CarTurning& car, const Pose& start,
                               const Pose& goal, std::size_t max_expansions) {
    if (!space.is_free(start.x, start.y) || !space.is_free(goal.x, goal.y)) return {};
    // Seen from the goal backwards, an unreachable one is often plain at once; the search itself
    // would have to exhaust all that the start can reach.
    const Pose backwards{goal.x, goal.y, goal.yaw + kPi};
    if (is_boxed_in(space, car, backwards, start)) return {};
    return Search(space, car, start, goal).run(max_expansions);
}

}  // namespace planformer
