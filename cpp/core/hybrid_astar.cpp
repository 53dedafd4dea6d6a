#include "core/hybrid_astar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <utility>

#include "core/dubins.hpp"
#include "core/reeds_shepp.hpp"
#include "core/validity.hpp"
#include "core/wavefront.hpp"

namespace planformer {
namespace {

constexpr double kCellSide = 0.25;  ///< of a search cell, in turning radii
constexpr double kStep = 0.4;       ///< driven between two poses, in turning radii; leaves the cell
constexpr std::size_t kYawBins = 72;
constexpr std::array<double, 5> kCurvatures = {-1.0, -0.5, 0.0, 0.5, 1.0};  ///< times 1 / radius
constexpr double kSlack = 1.02;  ///< open poses that gain less are not worth expanding
/// An 8-connected distance exceeds the straight one by at most 1 / 0.9239.
constexpr double kOctileShare = 0.9238795325112867;
constexpr std::int32_t kNone = -1;

struct Node {
    Pose pose;
    double cost;          ///< length driven from the start [m]
    double curvature;     ///< of the step from the parent [1/m]
    double step;          ///< signed length of that step [m]
    std::int32_t parent;  ///< kNone for the start
    std::int32_t* best;   ///< the best node in this one's cell
};

class Search {
public:
    Search(const FreeSpace& space, const CarTurning& car, const Pose& start, const Pose& goal)
        : space_(space),
          car_(car),
          goal_(goal),
          side_(kCellSide * car.radius),
          rows_(static_cast<int>(space.extent_y() / side_) + 1),
          cols_(static_cast<int>(space.extent_x() / side_) + 1),
          cells_(static_cast<std::size_t>(rows_) * cols_),
          to_goal_(static_cast<std::size_t>(space.height) * space.width) {
        wavefront(space.blocked, space.height, space.width, grid_row(goal), grid_col(goal),
                  to_goal_.data());
        open_pose({start, 0.0, 0.0, 0.0, kNone, best_in_cell_of(start)});
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
    using YawBins = std::array<std::int32_t, kYawBins>;
    using Entry = std::pair<double, std::int32_t>;  ///< lower bound of the path's length, node

    void expand(std::int32_t index) {
        try_goal(index);
        for (const double share : kCurvatures) {
            drive(index, share / car_.radius, kStep * car_.radius);
            if (car_.reverse) drive(index, share / car_.radius, -kStep * car_.radius);
        }
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

    void drive(std::int32_t index, double curvature, double step) {
        const Node& from = nodes_[index];
        Curve curve(from.pose);
        curve.append({curvature, step});
        const Pose end = curve.end();
        if (!space_.is_free(end.x, end.y)) return;
        const Node next{end,   from.cost + std::abs(step), curvature, step,
                        index, best_in_cell_of(end)};
        const std::int32_t known = *next.best;
        if (known != kNone && nodes_[known].cost <= next.cost) return;
        if (curve_is_free(space_, curve, end)) open_pose(next);
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
            curve.append({node.curvature, node.step});
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

    std::int32_t* best_in_cell_of(const Pose& pose) {
        const int row = std::clamp(static_cast<int>(pose.y / side_), 0, rows_ - 1);
        const int col = std::clamp(static_cast<int>(pose.x / side_), 0, cols_ - 1);
        auto& bins = cells_[static_cast<std::size_t>(row) * cols_ + col];
        if (!bins) {
            bins = std::make_unique<YawBins>();
            bins->fill(kNone);
        }
        const double turn = (wrap_angle(pose.yaw) + kPi) / kTwoPi;
        return &(*bins)[std::min(static_cast<std::size_t>(turn * kYawBins), kYawBins - 1)];
    }

    const FreeSpace& space_;
    const CarTurning car_;
    const Pose goal_;
    const double side_;  ///< of a search cell [m]
    const int rows_;
    const int cols_;
    std::vector<std::unique_ptr<YawBins>> cells_;  ///< by row and column, made when first visited
    std::vector<float> to_goal_;                   ///< 8-connected distance [grid cells]
    std::vector<Node> nodes_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open_;
    double best_length_ = std::numeric_limits<double>::infinity();
    std::int32_t best_end_ = kNone;
};

}  // namespace

std::vector<Pose> hybrid_astar(const FreeSpace& space, const CarTurning& car, const Pose& start,
                               const Pose& goal, std::size_t max_expansions) {
    if (!space.is_free(start.x, start.y) || !space.is_free(goal.x, goal.y)) return {};
    return Search(space, car, start, goal).run(max_expansions);
}

}  // namespace planformer
